#include "sinew/program/derivatives.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/base/error.h"
#include "sinew/program/dag/derivative.h"
#include "sinew/program/interface.h"
#include "sinew/program/snap_constants.h"
#include "sinew/program/trace.h"

namespace sinew::program {
namespace {

[[noreturn]] void fail(const std::string& request, std::string what, std::string remedy) {
  throw Error(Problem{{},
                      {},
                      fmt::format("derivative '{}': {}", request, what),
                      std::move(remedy),
                      Severity::kError,
                      {}});
}

std::string quantity_of(const Variable& variable) {
  return variable.name.substr(0, variable.name.find('.'));
}

// The variables that a side of a request names, in the order of the interface.
std::vector<std::uint32_t> select(const Program& program, const std::vector<Slot>& slots,
                                  const std::string& side, const std::string& request,
                                  const char* kind) {
  std::vector<std::uint32_t> found;
  std::set<std::string> known;
  for (const Slot& slot : slots) {
    const Variable& v = program.variables[slot.variable];
    known.insert(quantity_of(v));
    if (v.name == side || quantity_of(v) == side) found.push_back(slot.variable);
  }
  if (found.empty())
    fail(
        request, fmt::format("the program has no {} '{}'", kind, side),
        fmt::format("name one of its {}s, or all of a quantity: {}", kind, fmt::join(known, ", ")));
  return found;
}

std::string number_name(const Variable& v, std::uint32_t number) {
  return v.size == 1 ? v.name : fmt::format("{}[{}]", v.name, number);
}

// One side of a Jacobian: which number of which variable each row or column is.
struct Number {
  std::uint32_t variable, number;
};
std::vector<Number> numbers_of(const Program& program, const std::vector<std::uint32_t>& list) {
  std::vector<Number> numbers;
  for (const std::uint32_t variable : list)
    for (std::uint32_t k = 0; k < program.variables[variable].size; ++k)
      numbers.push_back({variable, k});
  return numbers;
}

// What a request asks for, before any entry is known to be there.
struct Asked {
  Derivative derivative;
  std::vector<Number> rows, columns;
};

// Which entries are not zero whatever the inputs are: those of a Jacobian of the traced program,
// row after row.
std::vector<bool> structure(const Program& program, const Interface& interface,
                            const Computation& values, const Asked& asked) {
  std::vector<std::uint32_t> out(program.variables.size()), in(program.variables.size());
  for (const Slot& slot : interface.outputs) out[slot.variable] = slot.offset;
  for (const Slot& slot : interface.inputs) in[slot.variable] = slot.offset;
  std::vector<std::uint32_t> rows, columns;
  for (const Number& row : asked.rows) rows.push_back(out[row.variable] + row.number);
  for (const Number& column : asked.columns) columns.push_back(in[column.variable] + column.number);
  const Computation jacobian = differentiate(values, rows, columns);
  std::vector<bool> filled;
  for (const Ref entry : jacobian.results) filled.push_back(!jacobian.dag.is_constant(entry, 0.0));
  return filled;
}

void add_entries(Program& program, Asked asked, const std::vector<bool>& filled,
                 const std::string& request) {
  for (std::size_t at = 0; at < filled.size(); ++at) {
    if (!filled[at]) continue;
    const auto [of, of_number] = asked.rows[at / asked.columns.size()];
    const auto [by, by_number] = asked.columns[at % asked.columns.size()];
    const Variable &row = program.variables[of], &column = program.variables[by];
    Variable entry;
    entry.name = number_name(row, of_number) + "/" + number_name(column, by_number);
    entry.represents = row.represents;
    entry.quantity = "derivative";
    entry.unit = row.unit + "/" + column.unit;
    entry.frame = row.frame;
    entry.output = true;
    entry.size = 1;
    const bool taken = std::any_of(program.variables.begin(), program.variables.end(),
                                   [&](const Variable& v) { return v.name == entry.name; });
    if (taken) fail(request, entry.name + " is asked for twice", "ask for it once");
    asked.derivative.entries.push_back(
        {static_cast<std::uint32_t>(program.variables.size()), of, of_number, by, by_number});
    program.variables.push_back(std::move(entry));
  }
  program.derivatives.push_back(std::move(asked.derivative));
}

}  // namespace

void add_derivatives(Program& program, std::span<const std::string> requests) {
  if (requests.empty()) return;
  Program plain = program;
  snap_constants(plain);
  const Interface interface = interface_of(plain);
  const Computation values = trace(plain);
  std::size_t entries = 0;
  for (const std::string& request : requests) {
    const std::size_t slash = request.find('/');
    if (slash == std::string::npos || slash == 0 || slash + 1 == request.size())
      fail(request, "it is not of the form OUT/IN", "write for example force/position");
    Asked asked;
    asked.derivative.name = request;
    asked.derivative.of =
        select(plain, interface.outputs, request.substr(0, slash), request, "output");
    asked.derivative.by =
        select(plain, interface.inputs, request.substr(slash + 1), request, "input");
    asked.rows = numbers_of(plain, asked.derivative.of);
    asked.columns = numbers_of(plain, asked.derivative.by);
    entries += asked.rows.size() * asked.columns.size();
    if (entries > kMaximumDerivativeEntries)
      fail(request, fmt::format("{} entries", entries),
           fmt::format("ask for at most {} in one program", kMaximumDerivativeEntries));
    const std::vector<bool> filled = structure(plain, interface, values, asked);
    add_entries(program, std::move(asked), filled, request);
  }
}

}  // namespace sinew::program
