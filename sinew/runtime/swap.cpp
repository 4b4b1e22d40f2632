#include "sinew/runtime/swap.h"

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/data/units.h"
#include "sinew/program/kernels.h"

namespace sinew::runtime {
namespace {

[[noreturn]] void fail(const Executable& executable, std::string what, std::string remedy) {
  throw Error(
      Problem{{}, "", executable.name() + ": " + std::move(what), std::move(remedy), {}, {}});
}

// "a joint-force in N-M (1 numbers, seen from ...)"
std::string prototype(const program::Variable& block) {
  std::string text =
      "a " + block.quantity + " of " + std::to_string(block.size) + " in " + block.unit;
  if (!block.frame.empty()) text += " seen from <" + block.frame + ">";
  return text;
}

std::uint32_t require(const Executable& executable, const std::string& block) {
  const std::uint32_t found = executable.storage().find(block);
  if (found == kNoBlock)
    fail(executable, "has no data block '" + block + "'", "name one by its IRI or name");
  return found;
}

// The unit of a block, where it has a single one.
data::Dimension dimension_of(const Executable& executable, const std::string& unit) {
  const auto found = data::find_unit(unit);
  if (!found) fail(executable, "'" + unit + "' is no single known unit", "convert by an operator");
  return found->dimension;
}

// Of an operator from one block to one: what it takes must be what the old block is.
StateCopy by_operator(const Executable& next, const program::SwapRule& rule,
                      const program::Variable& from, const program::Variable& to) {
  const algorithm::Operator& op = *rule.op;
  if (from.quantity != op.ports[0].quantity)
    fail(next,
         "'" + to.name + "' is converted by " + std::string(op.name) + ", but " + from.name +
             " of the old program is a " + from.quantity,
         "it takes a " + op.ports[0].quantity);
  for (const algorithm::UnitRule& units : op.unit_rules) {
    data::Dimension product = units.rest;
    for (const auto& factor : units.factors)
      product = product * data::power(dimension_of(next, factor.port == 0 ? from.unit : to.unit),
                                      factor.exponent);
    if (!product.dimensionless())
      fail(next, from.name + " is in " + from.unit + ", " + to.name + " in " + to.unit,
           "must hold: " + units.text);
  }
  const program::Kernel* kernel = program::find_kernel(op.name);
  const std::uint32_t in = kernel->ports[0].size, out = kernel->ports[1].size;
  if ((in != 0 && in != from.size) || (out != 0 && out != to.size))
    fail(next, "'" + to.name + "': the sizes do not fit " + std::string(op.name),
         std::to_string(in) + " numbers to " + std::to_string(out));
  return {
      {}, {}, [evaluate = kernel->evaluate](std::span<const double> old, std::span<double> now) {
        // Kernels read their inputs only.
        double* const arguments[] = {const_cast<double*>(old.data()), now.data()};
        evaluate(arguments);
      }};
}

StateCopy by_factor(const Executable& next, const program::SwapRule& rule,
                    const program::Variable& from, const program::Variable& to) {
  const auto unit = data::find_unit(rule.factor_unit);
  if (!unit)
    fail(next, "'" + rule.factor_unit + "' is no known unit", "one of metamodels/units.json");
  if (from.size != to.size ||
      !(dimension_of(next, from.unit) * unit->dimension == dimension_of(next, to.unit)))
    fail(next,
         "'" + to.name + "' in " + to.unit + " is no " + from.name + " in " + from.unit +
             " times a factor in " + rule.factor_unit,
         "the same count of numbers, and units that fit");
  return {{},
          {},
          [factor = rule.factor * unit->scale](std::span<const double> old, std::span<double> now) {
            for (std::size_t i = 0; i < now.size(); ++i) now[i] = factor * old[i];
          }};
}

}  // namespace

StatePlan plan_states(const Executable& old, const std::vector<bool>& given, Executable& next,
                      const SwapRules& rules) {
  StatePlan plan;
  plan.given.resize(next.storage().size(), false);
  std::vector<bool> done(next.storage().size(), false);
  for (const StateConversion& rule : rules.conversions) {
    const std::uint32_t from = require(old, rule.from), to = require(next, rule.to);
    plan.copies.push_back({old.storage().numbers(from), next.storage().numbers(to), rule.convert});
    plan.report.converted.push_back(next.storage().about(to).name);
    done[to] = true;
  }
  for (const std::string& name : rules.initialise) {
    const std::uint32_t block = require(next, name);
    plan.report.initialised.push_back(next.storage().about(block).name);
    done[block] = true;
  }
  // Its block in the old program, if that is the same in IRI and prototype.
  const auto before = [&](std::uint32_t block) {
    const program::Variable& about = next.storage().about(block);
    const std::uint32_t found = old.storage().find(about.iri);
    return found != kNoBlock && same_prototype(old.storage().about(found), about) ? found
                                                                                  : kNoBlock;
  };
  const auto copy = [&](std::uint32_t from, std::uint32_t to) {
    plan.copies.push_back({old.storage().numbers(from), next.storage().numbers(to), {}});
  };
  for (const std::uint32_t state : next.states()) {
    if (done[state]) continue;
    const program::Variable& about = next.storage().about(state);
    const std::uint32_t found = before(state);
    if (found != kNoBlock && old.storage().about(found).role == program::Role::kState) {
      copy(found, state);
      plan.report.carried.push_back(about.name);
      continue;
    }
    const auto& declared = next.swap_rules();
    const auto rule = std::find_if(declared.begin(), declared.end(),
                                   [&](const auto& one) { return one.block == state; });
    if (rule == declared.end()) {
      const std::uint32_t same = old.storage().find(about.iri);
      if (same != kNoBlock && old.storage().about(same).role == program::Role::kState)
        fail(next,
             "the state '" + about.name + "' <" + about.iri + "> was " +
                 prototype(old.storage().about(same)) + " and is " + prototype(about) +
                 ", and its model does not declare what happens to it at a swap",
             "state sa:at-swap: sa:initialise, or a conversion (sa:operator, sa:factor)");
      plan.report.initialised.push_back(about.name);
    } else if (rule->kind == algorithm::AtSwap::Kind::kInitialise) {
      plan.report.initialised.push_back(about.name);
    } else {
      const std::uint32_t from = require(old, rule->from);
      StateCopy conversion = rule->kind == algorithm::AtSwap::Kind::kOperator
                                 ? by_operator(next, *rule, old.storage().about(from), about)
                                 : by_factor(next, *rule, old.storage().about(from), about);
      conversion.from = old.storage().numbers(from);
      conversion.to = next.storage().numbers(state);
      plan.copies.push_back(std::move(conversion));
      plan.report.converted.push_back(about.name);
    }
  }
  for (const auto& [name, values] : rules.set_points) {
    const std::uint32_t block = require(next, name);
    const std::span<double> numbers = next.storage().numbers(block);
    if (numbers.size() != values.size())
      fail(next,
           "'" + name + "' holds " + std::to_string(numbers.size()) + " numbers, not " +
               std::to_string(values.size()),
           "give each of them a value");
    std::copy(values.begin(), values.end(), numbers.begin());
    plan.report.set.push_back(next.storage().about(block).name);
    done[block] = plan.given[block] = true;
  }
  for (const std::uint32_t point : next.set_points()) {
    if (done[point]) continue;
    const std::uint32_t found = before(point);
    if (found == kNoBlock || !given[found]) continue;
    copy(found, point);
    plan.given[point] = true;
    plan.report.kept.push_back(next.storage().about(point).name);
  }
  return plan;
}

}  // namespace sinew::runtime
