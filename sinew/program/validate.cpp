#include "sinew/program/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <numeric>
#include <span>
#include <unordered_set>

#include "sinew/program/kernels.h"

namespace sinew::program {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;
constexpr std::uint32_t kDerivative = 0xfffffffeU;

class Validator {
 public:
  Validator(const Program& program, Report& report)
      : program_(program),
        report_(report),
        writer_(program.variables.size(), kNobody),
        is_entry_(program.variables.size(), false) {
    for (const Derivative& derivative : program.derivatives)
      for (const DerivativeEntry& entry : derivative.entries)
        if (entry.variable < is_entry_.size()) is_entry_[entry.variable] = true;
  }

  void run() {
    for (const Variable& variable : program_.variables) check_variable(variable);
    check_names();
    kernels_.resize(program_.closures.size());
    std::vector<bool> sound(program_.closures.size());
    for (std::size_t i = 0; i < sound.size(); ++i) sound[i] = check_closure(i);
    for (const Derivative& derivative : program_.derivatives) check_derivative(derivative);
    check_schedule(sound);
    check_outputs();
  }

 private:
  void fault(const std::string& iri, std::string what, std::string remedy) {
    report_.error({}, iri, std::move(what), std::move(remedy));
  }

  static std::string label(const Variable& variable) {
    return variable.iri.empty() || variable.name.empty() ? variable.name + variable.iri
                                                         : variable.name;
  }

  void check_variable(const Variable& v) {
    const bool valued = v.role == Role::kConstant || v.role == Role::kState;
    if (v.name.empty()) fault(v.iri, "variable without a name", "name it QUANTITY.ELEMENT");
    if (v.size == 0) {
      fault(v.iri, fmt::format("variable '{}' holds no numbers", v.name), "give it a size");
    }
    if (valued && v.value.size() != v.size) {
      fault(
          v.iri,
          fmt::format("variable '{}' has {} values for {} numbers", v.name, v.value.size(), v.size),
          "a constant or state has one value for each number");
    }
    if (!valued && !v.value.empty()) {
      fault(v.iri,
            fmt::format("variable '{}' has values but is neither constant nor state", v.name),
            "leave them out, or give it the role 'constant'");
    }
    for (const double value : v.value) {
      if (std::isfinite(value)) continue;
      fault(v.iri, fmt::format("variable '{}' has a value that is not finite", v.name),
            "constants and first values of states are finite numbers");
      break;
    }
  }

  void check_names() {
    std::pmr::monotonic_buffer_resource memory;
    std::pmr::unordered_set<std::string_view> seen(&memory);
    seen.reserve(program_.variables.size());
    for (const Variable& v : program_.variables) {
      if (!seen.insert(v.name).second) {
        fault(v.iri, fmt::format("a second variable is named '{}'", v.name),
              "names are unique in a program");
      }
    }
  }

  static std::uint32_t size_of_many(const Kernel& kernel, std::span<const std::uint32_t> sizes) {
    if (kernel.size_of_many != nullptr) return kernel.size_of_many(sizes);
    return std::accumulate(sizes.begin(), sizes.end(), std::uint32_t{0});
  }

  // Whether its operator and arguments fit, so that its reads and writes can be followed.
  bool check_closure(std::size_t at) {
    const Closure& closure = program_.closures[at];
    const Kernel* const kernel = kernels_[at] = find_kernel(closure.operation);
    if (kernel == nullptr) {
      fault(closure.iri, fmt::format("unknown operator '{}'", closure.operation),
            "use an operator of the catalogue");
      return false;
    }
    const std::size_t count = closure.arguments.size();
    if (kernel->many() ? count < 2 : count != kernel->ports.size()) {
      fault(closure.iri,
            fmt::format("operator '{}' is bound to {} variables", closure.operation,
                        closure.arguments.size()),
            fmt::format("it has {} ports", kernel->ports.size()));
      return false;
    }
    bool sound = true;
    std::vector<std::uint32_t>& sizes = sizes_;  // of the arguments before
    sizes.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t index = closure.arguments[i];
      if (index >= program_.variables.size()) {
        fault(closure.iri,
              fmt::format("argument {} of '{}' is variable {}", i + 1, closure.operation, index),
              fmt::format("there are {} variables", program_.variables.size()));
        sound = false;
        continue;
      }
      const Variable& v = program_.variables[index];
      const Port& port = kernel->port(i, count);
      std::uint32_t size = port.size;
      if (size == 0) size = port.output ? size_of_many(*kernel, sizes) : v.size;
      sizes.push_back(v.size);
      if (v.size != size) {
        fault(closure.iri,
              fmt::format("argument {} of '{}' is '{}' <{}>, which holds {} numbers", i + 1,
                          closure.operation, v.name, v.iri, v.size),
              fmt::format("the port takes {}", size));
        sound = false;
      }
    }
    return sound;
  }

  // Rows are outputs, columns inputs, and every entry has an output of one number to itself.
  void check_derivative(const Derivative& derivative) {
    const auto complain = [&](const std::string& what, const char* remedy) {
      fault(program_.iri, fmt::format("derivative '{}': {}", derivative.name, what), remedy);
    };
    const auto known = [&](std::uint32_t variable) { return variable < program_.variables.size(); };
    const auto among = [](const std::vector<std::uint32_t>& list, std::uint32_t variable) {
      return std::find(list.begin(), list.end(), variable) != list.end();
    };
    for (const std::uint32_t row : derivative.of) {
      if (!known(row) || !program_.variables[row].output || is_entry_[row])
        complain("a row is no output", "differentiate outputs of the program");
    }
    for (const std::uint32_t column : derivative.by) {
      if (!known(column) || program_.variables[column].role != Role::kInput)
        complain("a column is no input", "differentiate by inputs of the program");
    }
    for (const DerivativeEntry& entry : derivative.entries) {
      if (!known(entry.variable) || !among(derivative.of, entry.of) ||
          !among(derivative.by, entry.by) || !known(entry.of) || !known(entry.by) ||
          entry.of_number >= program_.variables[entry.of].size ||
          entry.by_number >= program_.variables[entry.by].size) {
        complain("an entry is outside its rows and columns", "name a number of each");
        continue;
      }
      const Variable& v = program_.variables[entry.variable];
      if (v.role != Role::kInternal || !v.output || v.size != 1)
        complain(fmt::format("'{}' cannot hold an entry", v.name), "use an output of one number");
      if (writer_[entry.variable] != kNobody)
        complain(fmt::format("'{}' holds two entries", v.name), "use one variable for each");
      writer_[entry.variable] = kDerivative;
    }
  }

  void check_schedule(const std::vector<bool>& sound) {
    std::vector<bool> scheduled(program_.closures.size(), false);
    for (const std::uint32_t index : program_.schedule) {
      if (index >= program_.closures.size()) {
        fault(program_.iri, fmt::format("the schedule names closure {}", index),
              fmt::format("there are {} closures", program_.closures.size()));
        continue;
      }
      const Closure& closure = program_.closures[index];
      if (scheduled[index]) {
        fault(closure.iri, "the closure is scheduled twice", "schedule it once");
        continue;
      }
      scheduled[index] = true;
      if (sound[index]) follow(index, closure);
    }
  }

  void follow(std::uint32_t index, const Closure& closure) {
    const Kernel& kernel = *kernels_[index];
    const std::size_t count = closure.arguments.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (!kernel.port(i, count).output) check_read(closure, closure.arguments[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (kernel.port(i, count).output) check_write(index, closure, closure.arguments[i]);
    }
  }

  void check_read(const Closure& closure, std::uint32_t variable) {
    const Variable& v = program_.variables[variable];
    if (v.role != Role::kInternal || (writer_[variable] != kNobody && !is_entry_[variable])) return;
    fault(closure.iri,
          fmt::format("'{}' reads '{}' <{}> before anything has written it", closure.operation,
                      v.name, v.iri),
          "schedule the closure that writes it earlier, or make it an input");
  }

  void check_write(std::uint32_t index, const Closure& closure, std::uint32_t variable) {
    const Variable& v = program_.variables[variable];
    if (v.role == Role::kInput || v.role == Role::kConstant) {
      fault(closure.iri,
            fmt::format("'{}' writes '{}' <{}>, which is {}", closure.operation, v.name, v.iri,
                        v.role == Role::kInput ? "an input" : "a constant"),
            "write to an internal variable");
      return;
    }
    for (std::size_t i = 0; i + 1 < closure.arguments.size(); ++i) {
      const bool input = !kernels_[index]->port(i, closure.arguments.size()).output;
      if (input && closure.arguments[i] == variable) {
        fault(closure.iri,
              fmt::format("'{}' both reads and writes '{}' <{}>", closure.operation, v.name, v.iri),
              "write to another variable");
      }
    }
    if (writer_[variable] == kDerivative) {
      fault(closure.iri, fmt::format("'{}' writes '{}', a derivative", closure.operation, v.name),
            "write to another variable");
      return;
    }
    if (writer_[variable] != kNobody) {
      fault(closure.iri,
            fmt::format("'{}' writes '{}' <{}>, which <{}> has written", closure.operation, v.name,
                        v.iri, program_.closures[writer_[variable]].iri),
            "a variable has one writer");
      return;
    }
    writer_[variable] = index;
  }

  void check_outputs() {
    for (std::size_t i = 0; i < program_.variables.size(); ++i) {
      const Variable& v = program_.variables[i];
      if (v.output && v.role == Role::kInternal && writer_[i] == kNobody) {
        fault(v.iri, fmt::format("nothing writes the output '{}'", v.name),
              "schedule a closure that writes it");
      }
    }
  }

  const Program& program_;
  Report& report_;
  std::vector<std::uint32_t> writer_;   // closure that has written each variable so far
  std::vector<const Kernel*> kernels_;  // of the closures
  std::vector<std::uint32_t> sizes_;    // of the arguments of the closure that is looked at
  std::vector<bool> is_entry_;          // whether each variable is an entry of a derivative
};

}  // namespace

void validate(const Program& program, Report& report) { Validator(program, report).run(); }

void require_valid(const Program& program) {
  Report report;
  validate(program, report);
  report.throw_if_errors();
}

}  // namespace sinew::program
