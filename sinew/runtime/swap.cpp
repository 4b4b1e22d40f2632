#include "sinew/runtime/swap.h"

#include <algorithm>

#include "sinew/base/error.h"

namespace sinew::runtime {
namespace {

[[noreturn]] void fail(const Executable& executable, std::string what, std::string remedy) {
  throw Error(
      Problem{{}, "", executable.name() + ": " + std::move(what), std::move(remedy), {}, {}});
}

std::uint32_t require(const Executable& executable, const std::string& block) {
  const std::uint32_t found = executable.storage().find(block);
  if (found == kNoBlock)
    fail(executable, "has no data block '" + block + "'", "name one by its IRI or name");
  return found;
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
    const std::string& name = next.storage().about(state).name;
    const std::uint32_t found = before(state);
    if (found != kNoBlock && old.storage().about(found).role == program::Role::kState) {
      copy(found, state);
      plan.report.carried.push_back(name);
    } else {
      plan.report.initialised.push_back(name);
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
