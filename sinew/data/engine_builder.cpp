// From the straight-line program to operations and registers.
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "sinew/data/engine.h"
#include "sinew/data/engine_code.h"
#include "sinew/data/engine_compile.h"

namespace sinew::data {

class ConverterBuilder {
 public:
  ConverterBuilder(const Library& library, const Plan& plan, const EngineOptions& options)
      : library_(library), plan_(plan), options_(options) {
    program_ = lower(library, plan);
  }

  Converter build() {
    place_blocks();
    number_constants();
    add_guards();
    for (const auto& stage : program_.stages) {
      // Everything is computed before anything is stored: source and target may be the same memory.
      for (const auto& store : stage.stores) compute(store.value);
      for (const auto& store : stage.stores) add_store(store);
      for (const auto& call : stage.calls) add_call(call);
    }
    add({Code::kEnd, 0, 0, 0, 0, 0, 0});
    gather(Code::kLoadDouble, Code::kLoadDoubles);
    gather(Code::kStoreDouble, Code::kStoreDoubles);
    if (!options_.interpret) compile(result_);
    return std::move(result_);
  }

 private:
  using Code = Converter::Code;
  using Operation = Converter::Operation;
  using Node = ScalarGraph::Node;
  using Op = ScalarOperation;

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    const Prototype& prototype = library_.prototypes[plan_.source];
    throw Error(Problem{prototype.place, prototype.name, what, remedy, Severity::kError, {}});
  }

  const Type& type_of(Index block) const {
    return *library_.prototypes[program_.blocks[block].prototype].representation.type;
  }

  void place_blocks() {
    if (program_.blocks.size() > kMaximumBlocks) {
      fail(fmt::format("the conversion needs {} blocks of memory", program_.blocks.size()),
           fmt::format("at most {} are possible", kMaximumBlocks));
    }
    std::size_t used = 0;
    result_.inputs_ = program_.inputs;
    for (Index block = 2 + program_.inputs; block < program_.blocks.size(); ++block) {
      const std::size_t alignment = std::max<std::size_t>(type_of(block).alignment, 16);
      used = (used + alignment - 1) / alignment * alignment;
      result_.scratch_.push_back(used);
      used += type_of(block).size;
    }
    if (used > kMaximumScratch) {
      fail(fmt::format("the conversion needs {} bytes for intermediate values", used),
           fmt::format("at most {} are possible", kMaximumScratch));
    }
    for (Index block = 0; block < program_.blocks.size(); ++block) {
      const Prototype& prototype = library_.prototypes[program_.blocks[block].prototype];
      if (prototype.representation.context != "JSON") continue;
      fail(fmt::format("'{}' is JSON, which has no fixed place in memory", prototype.name),
           "emit source code (--emit cpp)");
    }
  }

  std::uint16_t new_register(std::size_t count = 1) {
    if (next_register_ + count > kMaximumRegisters) {
      fail(fmt::format("the conversion needs more than {} numbers at once", kMaximumRegisters),
           "emit source code instead");
    }
    const auto first = static_cast<std::uint16_t>(next_register_);
    next_register_ += count;
    return first;
  }

  void number_constants() {
    const auto& nodes = program_.graph.nodes();
    std::vector<Node> needed;
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) needed.push_back(store.value);
    }
    const std::vector<bool> live = program_.graph.live(needed);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].operation != Op::kConstant || !live[i]) continue;
      registers_[static_cast<Node>(i)] = new_register();
      result_.constants_.push_back(nodes[i].value);
    }
  }

  void add(const Operation& operation) { result_.operations_.push_back(operation); }

  void add_guards() {
    const auto guard = [&](Index block, const Access& access) {
      for (const Access::Guard& it : access.guards) {
        const bool known =
            std::any_of(result_.guards_.begin(), result_.guards_.end(), [&](const auto& other) {
              return other.block == block && other.offsets == it.offsets && other.index >= it.index;
            });
        if (known) continue;
        result_.guards_.push_back(
            {block, it.kind == Type::Kind::kList, it.offsets, it.element_size, it.index});
        add({Code::kGuard, 0, 0, 0, 0, static_cast<std::uint32_t>(result_.guards_.size() - 1), 0});
      }
    };
    for (const auto& load : program_.loads) guard(load.block, load.access);
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) guard(store.block, store.access);
    }
  }

  // What lies behind one step from the block's begin, as a number of bytes.
  static bool is_direct(const Access& access) { return access.offsets.size() == 1; }
  std::uint32_t path(const Access& access) {
    result_.paths_.push_back({access.offsets});
    return static_cast<std::uint32_t>(result_.paths_.size() - 1);
  }

  void compute(Node wanted) {
    std::vector<std::pair<Node, bool>> stack = {{wanted, false}};
    while (!stack.empty()) {
      const auto [at, ready] = stack.back();
      stack.pop_back();
      if (registers_.count(at)) continue;
      const ScalarNode& node = program_.graph.nodes()[at];
      if (node.operation == Op::kInput) {
        add_load(at, program_.loads[node.a]);
        continue;
      }
      if (!ready) {
        stack.emplace_back(at, true);
        const int operands = row(node.operation).operands;
        if (operands > 2) stack.emplace_back(node.c, false);
        if (operands > 1) stack.emplace_back(node.b, false);
        stack.emplace_back(node.a, false);
        continue;
      }
      add_arithmetic(at, node);
    }
  }

  void add_load(Node at, const ConversionProgram::Load& load) {
    const std::uint16_t result = new_register();
    registers_[at] = result;
    const auto kind = static_cast<std::uint8_t>(load.access.scalar);
    const auto block = static_cast<std::uint16_t>(load.block);
    if (!is_direct(load.access)) {
      add({Code::kLoadPath, kind, block, 0, result, path(load.access), 0});
    } else {
      add({load.access.scalar == ScalarKind::kFloat64 ? Code::kLoadDouble : Code::kLoad, kind,
           block, 0, result, static_cast<std::uint32_t>(load.access.offsets[0]), 0});
    }
  }

  // Several loads (or stores) of one block in a row become one operation.
  void gather(Code one, Code several) {
    std::vector<Operation> result;
    auto& operations = result_.operations_;
    for (std::size_t i = 0; i < operations.size();) {
      std::size_t end = i;
      while (end < operations.size() && operations[end].code == one &&
             operations[end].a == operations[i].a)
        ++end;
      if (end - i < 2) {
        result.push_back(operations[i++]);
        continue;
      }
      const auto first = static_cast<std::uint32_t>(result_.places_.size());
      for (; i < end; ++i) result_.places_.push_back({operations[i].x, operations[i].c});
      result.push_back({several, 0, operations[end - 1].a, 0, 0, first,
                        static_cast<std::uint32_t>(result_.places_.size())});
    }
    operations = std::move(result);
  }

  void add_arithmetic(Node at, const ScalarNode& node) {
    const auto simple = [&]() -> std::optional<Code> {
      switch (node.operation) {
        case Op::kAdd:
          return Code::kAdd;
        case Op::kSubtract:
          return Code::kSubtract;
        case Op::kMultiply:
          return Code::kMultiply;
        case Op::kDivide:
          return Code::kDivide;
        case Op::kNegate:
          return Code::kNegate;
        case Op::kSquareRoot:
          return Code::kSquareRoot;
        case Op::kSelect:
          return Code::kSelect;
        default:
          return std::nullopt;
      }
    }();
    const int operands = row(node.operation).operands;
    const std::uint16_t a = registers_.at(node.a);
    const std::uint16_t b = operands > 1 ? registers_.at(node.b) : a;
    const std::uint32_t c = operands > 2 ? registers_.at(node.c) : 0;
    const std::uint16_t result = new_register();
    registers_[at] = result;
    add({simple.value_or(Code::kOther), static_cast<std::uint8_t>(node.operation), a, b, result, c,
         0});
  }

  void add_store(const ConversionProgram::Store& store) {
    const auto kind = static_cast<std::uint8_t>(store.access.scalar);
    const auto block = static_cast<std::uint16_t>(store.block);
    const std::uint16_t value = registers_.at(store.value);
    if (!is_direct(store.access)) {
      add({Code::kStorePath, kind, block, 0, value, path(store.access), 0});
      return;
    }
    add({store.access.scalar == ScalarKind::kFloat64 ? Code::kStoreDouble : Code::kStore, kind,
         block, 0, value, static_cast<std::uint32_t>(store.access.offsets[0]), 0});
  }

  void add_call(const ConversionProgram::Call& call) {
    using Form = Converter::Call::Form;
    const Function& function = library_.functions[call.function];
    Converter::Call result;
    result.function = find_symbol(function);
    bool by_value = false, returns = false, output_first = false;
    for (std::size_t i = 0; i < call.blocks.size(); ++i) {
      const Function::Argument& argument = function.arguments[i];
      const Type& type = type_of(call.blocks[i]);
      const bool number = type.kind == Type::Kind::kScalar;
      (argument.input ? result.input : result.output) = call.blocks[i];
      if (argument.position == 0) returns = true;
      if (argument.input && number) by_value = true;
      if (!argument.input && argument.position == 1) output_first = true;
      if (number && type.scalar != ScalarKind::kFloat64 &&
          (argument.input || argument.position == 0)) {
        fail(fmt::format("the function '{}' passes a {} by value", function.name, type.spelling),
             "pass a double or a pointer, or emit source code");
      }
      if (argument.position == 0 && !number) {
        fail(fmt::format("the function '{}' returns a struct", function.name),
             "let it write into an argument, or emit source code");
      }
    }
    result.form = returns        ? (by_value ? Form::kReturnOfValue : Form::kReturnOfIn)
                  : output_first ? (by_value ? Form::kOutValue : Form::kOutIn)
                                 : (by_value ? Form::kValueOut : Form::kInOut);
    result_.calls_.push_back(result);
    add({Code::kCall, 0, 0, 0, 0, static_cast<std::uint32_t>(result_.calls_.size() - 1), 0});
  }

  void* find_symbol(const Function& function) {
    // References and pointers are passed alike (Itanium C++ ABI, 3.1.2).
    if (function.context != "c99" && !function.symbol.starts_with(kMangledPrefix)) {
      fail(fmt::format("the function '{}' is of the kind {}", function.name, function.context),
           "functions of C++ are called while a program runs by their mangled name (fname = "
           "\"_Z…\", see nm); or emit source code");
    }
    void* handle = nullptr;
    if (!function.library.empty()) {
      std::vector<std::string> names;
      for (const std::string& directory : options_.library_directories) {
        names.push_back(fmt::format("{}/lib{}.so", directory, function.library));
      }
      names.push_back(fmt::format("lib{}.so", function.library));
      names.push_back(function.library);
      for (const std::string& name : names) {
        if (!handle) handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      }
      if (!handle) {
        fail(fmt::format("the library '{}' of the function '{}' is not found", function.library,
                         function.name),
             "put it where the loader looks, or name its directory");
      }
      result_.libraries_.push_back(
          std::shared_ptr<void>(handle, [](void* library) { dlclose(library); }));
    }
    void* symbol = dlsym(handle ? handle : RTLD_DEFAULT, function.symbol.c_str());
    if (!symbol) {
      fail(fmt::format("there is no symbol '{}' for the function '{}'", function.symbol,
                       function.name),
           "check fname and library");
    }
    return symbol;
  }

  const Library& library_;
  const Plan& plan_;
  const EngineOptions& options_;
  ConversionProgram program_;
  Converter result_;
  std::map<Node, std::uint16_t> registers_;
  std::size_t next_register_ = 0;
};

Converter make_converter(const Library& library, const Plan& plan, const EngineOptions& options) {
  return ConverterBuilder(library, plan, options).build();
}

}  // namespace sinew::data
