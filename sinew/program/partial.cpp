#include "sinew/program/partial.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/interface.h"
#include "sinew/program/trace.h"

namespace sinew::program {
namespace {

bool fits(const Variable& variable, const std::string& name) {
  return variable.name == name || variable.quantity == name ||
         (variable.name.size() > name.size() && variable.name.starts_with(name) &&
          variable.name[name.size()] == '.');
}

// For each variable, whether it is named; every name has to fit one of those that `may` be named.
template <typename May>
std::vector<bool> named(const Program& program, const std::vector<std::string>& names, May may,
                        const char* what) {
  std::vector<bool> result(program.variables.size(), false);
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Variable& v = program.variables[i];
      if (!may(v) || !fits(v, name)) continue;
      result[i] = found = true;
    }
    if (found) continue;
    std::vector<std::string> candidates;
    for (const Variable& v : program.variables) {
      if (!may(v)) continue;
      const std::string& known = v.role == Role::kInput ? v.name : v.quantity;
      if (std::find(candidates.begin(), candidates.end(), known) == candidates.end()) {
        candidates.push_back(known);
      }
    }
    throw Error(Problem{{},
                        program.iri,
                        fmt::format("'{}' is {}", name, what),
                        fmt::format("name one of: {}", fmt::join(candidates, ", ")),
                        Severity::kError,
                        {}});
  }
  return result;
}

// A copy of `from` in `to`, where the inputs from `first` on stand for `replacement`.
std::vector<Ref> graft(const Dag& from, Dag& to, std::uint32_t first,
                       const std::vector<Ref>& replacement) {
  std::vector<Ref> copy(from.size());
  const auto of = [&](Ref ref) { return copy[ref.node()].negated_if(ref.negative()); };
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    const Node& node = from.node(i);
    to.set_origin(node.origin);
    if (node.op == Op::kConstant) {
      copy[i] = to.constant(node.value);
    } else if (node.op == Op::kInput) {
      copy[i] = node.index < first ? to.input(node.index) : replacement[node.index - first];
    } else {
      const int operands = arity(node.op);
      copy[i] = to.make(node, of(node.a), operands > 1 ? of(node.b) : Ref{},
                        operands > 2 ? of(node.c) : Ref{});
    }
  }
  to.set_origin(kNoOrigin);
  return copy;
}

// Drops the kept values, numbered from `first`, that the evaluation does not read.
void drop_unread(Hoisted& parts, std::uint32_t first) {
  const Computation& evaluate = parts.evaluate;
  const std::vector<std::uint8_t> live = live_nodes(evaluate);
  std::vector<bool> read(parts.update.results.size(), false);
  for (std::uint32_t i = 0; i < evaluate.dag.size(); ++i) {
    const Node& node = evaluate.dag.node(i);
    if (live[i] && node.op == Op::kInput && node.index >= first) read[node.index - first] = true;
  }
  Computation fewer;
  std::vector<Ref> renumbered(read.size());
  std::vector<Ref> kept;
  for (std::size_t k = 0; k < read.size(); ++k) {
    if (!read[k]) continue;
    renumbered[k] = fewer.dag.input(first + static_cast<std::uint32_t>(kept.size()));
    kept.push_back(parts.update.results[k]);
  }
  const std::vector<Ref> copy = graft(evaluate.dag, fewer.dag, first, renumbered);
  for (const Ref result : evaluate.results) {
    fewer.results.push_back(copy[result.node()].negated_if(result.negative()));
  }
  fewer.inputs = first + static_cast<std::uint32_t>(kept.size());
  parts.evaluate = std::move(fewer);
  parts.update.results = std::move(kept);
}

}  // namespace

PartialOptions with_held(const Program& program, PartialOptions options) {
  for (const Variable& variable : program.variables) {
    if (!variable.held) continue;
    std::vector<std::string>& names = variable.role == Role::kInput ? options.slow : options.held;
    if (std::find(names.begin(), names.end(), variable.name) == names.end())
      names.push_back(variable.name);
  }
  return options;
}

Hoisted trace_in_parts(const Program& program, const PartialOptions& options) {
  const std::vector<bool> slow_variable = named(
      program, options.slow, [](const Variable& v) { return v.role == Role::kInput; },
      "no input of the program");
  const std::vector<bool> held_variable = named(
      program, options.held, [](const Variable& v) { return v.role == Role::kInternal; },
      "nothing that the program computes");

  if (!options.held.empty() && !program.derivatives.empty()) {
    throw Error(Problem{{},
                        program.iri,
                        "asks for the derivative of results that depend on held data blocks",
                        "hold nothing, or ask for no derivative",
                        Severity::kError,
                        {}});
  }

  const Interface interface = interface_of(program);
  const std::uint32_t first = interface.in_size + interface.state_size;
  std::vector<bool> slow(first, false);
  for (const Slot& slot : interface.inputs) {
    if (!slow_variable[slot.variable]) continue;
    std::fill_n(slow.begin() + slot.offset, program.variables[slot.variable].size, true);
  }

  // Held blocks first, then what depends on slow inputs and on them alone.
  Hoisted blocks = trace_with_held(program, held_variable);
  slow.resize(blocks.evaluate.inputs, true);
  Hoisted rest = hoist(blocks.evaluate, slow);
  Hoisted parts;
  parts.update = std::move(blocks.update);
  const std::vector<Ref> copy =
      graft(rest.update.dag, parts.update.dag, first, parts.update.results);
  for (const Ref result : rest.update.results) {
    parts.update.results.push_back(copy[result.node()].negated_if(result.negative()));
  }
  parts.evaluate = std::move(rest.evaluate);
  drop_unread(parts, first);
  return parts;
}

}  // namespace sinew::program
