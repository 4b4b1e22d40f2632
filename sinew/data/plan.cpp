#include "sinew/data/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <set>

#include "sinew/base/spelling.h"
#include "sinew/data/plan_changes.h"

namespace sinew::data {
namespace {

// What reading or writing the slots of a binding costs.
int binding_cost(const Binding& binding) {
  int cost = 0;
  for (const SlotBinding& slot : binding.slots) cost += 1 + (slot.scale != 1) + (slot.offset != 0);
  return cost;
}

constexpr int kCallCost = 2;

// The loss of writing a prototype's numbers where `source` (perhaps nothing) is read; empty: none.
std::string write_loss(const Library& library, std::optional<Index> source, const Prototype& target,
                       const Binding& binding) {
  const Binding* read = nullptr;
  bool source_wide = true;
  if (source) {
    const Prototype& prototype = library.prototypes[*source];
    source_wide = false;
    for (const Binding& candidate : prototype.bindings) {
      if (candidate.space == binding.space) read = &candidate;
      for (const SlotBinding& slot : candidate.slots) {
        const ScalarKind kind = slot.access.scalar;
        source_wide |= kind != ScalarKind::kFloat32 && size_of(kind) > 2;
      }
    }
  }
  for (std::size_t i = 0; i < binding.slots.size(); ++i) {
    const SlotBinding& slot = binding.slots[i];
    const ScalarKind kind = slot.access.scalar;
    if (kind == ScalarKind::kFloat64) continue;
    if (kind == ScalarKind::kFloat32) {
      if (source_wide)
        return fmt::format("the digits that '{}' has no room for (float)", target.name);
      continue;
    }
    const bool same = read && i < read->slots.size() && read->slots[i].access.scalar == kind &&
                      read->slots[i].scale == slot.scale && read->slots[i].offset == slot.offset;
    if (!same) return fmt::format("what '{}' cannot hold in {}", target.name, name_of(kind));
  }
  return {};
}

// In which space a prototype's value is found, or left; nothing where only functions reach it.
std::optional<Index> space_of(const Prototype& prototype, bool reading) {
  if (!prototype.bindings.empty()) return prototype.bindings.front().space;
  return reading ? prototype.taken_apart : prototype.put_together;
}

// Nodes are prototypes, then spaces.
class Search {
 public:
  Search(const Library& library, const PlanOptions& options, std::optional<Index> source)
      : library_(library), options_(options), source_(source) {}

  // Without functions of libraries, and without changes of conventions: for the relations that
  // these changes compute with.
  Search& by_formulas_alone() {
    formulas_alone_ = true;
    return *this;
  }

  // The way of a relation's value to where it is used; nothing where there is none.
  const Plan* relation_plan(Index relation) {
    const auto known = relation_plans_.find(relation);
    if (known != relation_plans_.end()) return known->second ? &*known->second : nullptr;
    const Relation& it = library_.relations[relation];
    auto plan = Search(library_, options_, it.prototype)
                    .by_formulas_alone()
                    .find(it.prototype, node_of_space(it.space));
    if (plan) plan->target = it.space;
    auto& place = relation_plans_[relation] = std::move(plan);
    return place ? &*place : nullptr;
  }

  std::optional<Plan> find(std::size_t from, std::size_t to) {
    const auto goal = to < library_.prototypes.size()
                          ? space_of(library_.prototypes[to], false)
                          : std::optional(to - library_.prototypes.size());
    const std::map<std::string, std::string> convention =
        split_convention(goal ? convention_of(library_, *goal) : "");
    struct Best {
      int cost = 0, steps = 0;
      bool known = false, done = false;
      std::size_t before = 0;
      PlanStep step;
    };
    std::vector<Best> best(library_.prototypes.size() + library_.spaces.size());
    using Entry = std::tuple<int, int, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    best[from].known = true;
    queue.emplace(0, 0, from);
    const auto relax = [&](std::size_t at, std::size_t next, PlanStep&& step) {
      Best& known = best[next];
      const int cost = best[at].cost + step.cost, steps = best[at].steps + 1;
      if (known.done || (known.known && std::tie(known.cost, known.steps, known.before) <=
                                            std::tie(cost, steps, at))) {
        return;
      }
      known = {cost, steps, true, false, at, std::move(step)};
      queue.emplace(cost, steps, next);
    };
    while (!queue.empty()) {
      const auto [cost, steps, at] = queue.top();
      queue.pop();
      if (best[at].done) continue;
      best[at].done = true;
      if (at == to && steps > 0) break;
      if (at < library_.prototypes.size()) {
        leave_prototype(
            at, to, [&](std::size_t next, PlanStep&& step) { relax(at, next, std::move(step)); });
      } else {
        const Index space = at - library_.prototypes.size();
        const auto take = [&](std::size_t next, PlanStep&& step) {
          relax(at, next, std::move(step));
        };
        leave_space(space, to, take);
        change_conventions(space, convention, take);
      }
    }
    if (!best[to].known) return std::nullopt;
    Plan plan{from, to, {}, best[to].cost, {}, {}};
    for (std::size_t at = to; at != from; at = best[at].before)
      plan.steps.push_back(std::move(best[at].step));
    std::reverse(plan.steps.begin(), plan.steps.end());
    return plan;
  }

 private:
  bool allowed(const std::string& loses) const { return loses.empty() || options_.allow_lossy; }
  std::size_t node_of_space(Index space) const { return library_.prototypes.size() + space; }

  template <typename Relax>
  void leave_prototype(Index at, std::size_t goal, Relax&& relax) {
    const Prototype& prototype = library_.prototypes[at];
    for (Index i = 0; i < prototype.bindings.size(); ++i) {
      const Binding& binding = prototype.bindings[i];
      relax(
          node_of_space(binding.space),
          PlanStep{PlanStep::Kind::kRead, at, binding.space, i, binding_cost(binding), {}, {}, {}});
    }
    if (formulas_alone_) return;
    for (const Index i : library_.functions_from[at]) {
      const FunctionEdge& edge = library_.function_edges[i];
      // A part is written where it is asked for; on the way the rest of its whole is not there.
      if (library_.prototypes[edge.to].owner != edge.to && edge.to != goal) continue;
      if (!allowed(edge.loses)) continue;
      relax(edge.to, PlanStep{PlanStep::Kind::kFunction,
                              at,
                              edge.to,
                              i,
                              edge.cost + kCallCost,
                              edge.loses,
                              {},
                              {}});
    }
    if (prototype.taken_apart) {
      PlanStep step{PlanStep::Kind::kApart, at, *prototype.taken_apart, 0, 1, {}, {}, {}};
      const Space& space = library_.spaces[*prototype.taken_apart];
      for (std::size_t i = 0; i < prototype.members.size(); ++i) {
        auto part = find(prototype.members[i].second, node_of_space(space.members[i].second));
        if (!part) return;
        part->target = space.members[i].second;
        step.cost += part->cost;
        step.members.push_back(*std::move(part));
      }
      relax(node_of_space(*prototype.taken_apart), std::move(step));
    }
  }

  // Only to the goal's conventions: one step makes all changes, so others are never on the way.
  template <typename Relax>
  void change_conventions(Index at, const std::map<std::string, std::string>& goal, Relax&& relax) {
    const Space& space = library_.spaces[at];
    if (formulas_alone_ || space.composed() || space.convention.empty()) return;
    for (const Index other : library_.alike.at({space.domain, space.semantic, space.coordinates})) {
      if (other == at || library_.spaces[other].slots.size() != space.slots.size()) continue;
      bool wanted = true;
      for (const auto& [name, value] : split_convention(library_.spaces[other].convention)) {
        const auto asked = goal.find(name);
        wanted &= asked != goal.end() && asked->second == value;
      }
      if (!wanted) continue;
      auto steps = convention_steps(library_, space.domain, space.semantic, space.coordinates,
                                    space.convention, library_.spaces[other].convention);
      if (!steps || steps->empty()) continue;
      PlanStep step{PlanStep::Kind::kChange,       at, other, 0,
                    cost_of(library_, at, *steps), {}, {},    std::move(*steps)};
      bool possible = true;
      for (const ConventionStep& change : step.changes) {
        for (const auto& chain : change.inputs) {
          for (const RelationLink& link : chain) {
            const Plan* plan = relation_plan(link.relation);
            possible &= plan != nullptr;
            if (plan) step.cost += plan->cost;
          }
        }
      }
      if (possible) relax(node_of_space(other), std::move(step));
    }
  }

  template <typename Relax>
  void leave_space(Index at, std::size_t goal, Relax&& relax) {
    for (const auto& [prototype_index, binding_index] : library_.bound_to[at]) {
      // A prototype on the way is of use only where a function starts from it.
      if (prototype_index != goal &&
          (formulas_alone_ || library_.functions_from[prototype_index].empty())) {
        continue;
      }
      const Prototype& prototype = library_.prototypes[prototype_index];
      if (prototype_index != goal && prototype.owner != prototype_index) continue;
      const Binding& binding = prototype.bindings[binding_index];
      if (!binding.writable) continue;
      std::string loses = write_loss(library_, source_, prototype, binding);
      if (!allowed(loses)) continue;
      relax(prototype_index, PlanStep{PlanStep::Kind::kWrite,
                                      at,
                                      prototype_index,
                                      binding_index,
                                      binding_cost(binding),
                                      std::move(loses),
                                      {},
                                      {}});
    }
    if (goal < library_.prototypes.size() && library_.prototypes[goal].put_together == at) {
      const Prototype& whole = library_.prototypes[goal];
      PlanStep step{PlanStep::Kind::kTogether, at, goal, 0, 1, {}, {}, {}};
      bool possible = true;
      for (std::size_t i = 0; i < whole.members.size() && possible; ++i) {
        const Index from = library_.spaces[at].members[i].second;
        auto part = find(node_of_space(from), whole.members[i].second);
        possible = part.has_value();
        if (!part) break;
        part->source = from;
        step.cost += part->cost;
        step.members.push_back(*std::move(part));
      }
      if (possible) relax(goal, std::move(step));
    }
    for (const Index i : library_.formulas_from[at]) {
      const FormulaEdge& edge = library_.formula_edges[i];
      const SpaceFormula& formula = library_.formulas[edge.formula];
      if ((!edge.offered && !formulas_alone_) || !allowed(formula.loses)) continue;
      relax(node_of_space(edge.to),
            PlanStep{
                PlanStep::Kind::kFormula, at, edge.to, i, formula.cost + 1, formula.loses, {}, {}});
    }
    const Space& space = library_.spaces[at];
    if (!space.composed()) return;
    for (Index other = 0; other < library_.spaces.size(); ++other) {
      const Space& target = library_.spaces[other];
      if (other == at || !target.composed() || target.domain != space.domain ||
          target.semantic != space.semantic || target.members.size() != space.members.size()) {
        continue;
      }
      PlanStep step{PlanStep::Kind::kMembers, at, other, 0, 1, {}, {}, {}};
      bool possible = true;
      for (std::size_t i = 0; i < space.members.size() && possible; ++i) {
        const Plan* part = member_plan(space.members[i].second, target.members[i].second);
        possible = part != nullptr;
        if (!part) break;
        step.cost += part->cost;
        step.members.push_back(*part);
      }
      if (possible) relax(node_of_space(other), std::move(step));
    }
  }

  const Plan* member_plan(Index from, Index to) {
    const auto known = member_plans_.find({from, to});
    if (known != member_plans_.end()) return known->second ? &*known->second : nullptr;
    std::optional<Plan> plan;
    if (from == to) {
      plan = Plan{from, to, {}, 0, {}, {}};
    } else {
      plan = find(node_of_space(from), node_of_space(to));
      if (plan) {
        plan->source = from;
        plan->target = to;
      }
    }
    return (member_plans_[{from, to}] = std::move(plan)) ? &*member_plans_[{from, to}] : nullptr;
  }

  const Library& library_;
  const PlanOptions& options_;
  std::optional<Index> source_;
  bool formulas_alone_ = false;
  std::map<std::pair<Index, Index>, std::optional<Plan>> member_plans_;
  std::map<Index, std::optional<Plan>> relation_plans_;
};

void collect_relations(const Plan& plan, std::set<Index>& relations) {
  for (const PlanStep& step : plan.steps) {
    for (const Plan& member : step.members) collect_relations(member, relations);
    for (const ConventionStep& change : step.changes) {
      for (const auto& chain : change.inputs) {
        for (const RelationLink& link : chain) relations.insert(link.relation);
      }
    }
  }
}

void collect_losses(const Plan& plan, std::vector<std::string>& losses) {
  for (const PlanStep& step : plan.steps) {
    if (!step.loses.empty()) losses.push_back(step.loses);
    for (const Plan& member : step.members) collect_losses(member, losses);
  }
}

[[noreturn]] void fail(const Library& library, Index source, Index target) {
  const Prototype &a = library.prototypes[source], &b = library.prototypes[target];
  const std::string both = fmt::format("'{}' cannot be converted to '{}'", a.name, b.name);
  const auto refuse = [&](const std::string& why, const std::string& remedy) {
    throw Error(Problem{a.place, a.name, both + ": " + why, remedy, Severity::kError, {}});
  };
  if (a.domain != b.domain) {
    refuse(fmt::format("'{}' is of the domain {}, '{}' of {}", a.name, a.domain, b.name, b.domain),
           "only what means the same can be converted");
  }
  if (a.semantic != b.semantic) {
    refuse(fmt::format("'{}' means {}, '{}' means {}", a.name, a.semantic, b.name, b.semantic),
           "only what means the same can be converted");
  }
  const auto source_space = space_of(a, true), target_space = space_of(b, false);
  if (!source_space || !target_space) {
    const bool reading = !source_space;
    refuse(
        fmt::format("no function {} '{}'", reading ? "reads" : "writes", reading ? a.name : b.name),
        fmt::format("declare a view by a function that {} it, of every part",
                    reading ? "reads" : "writes"));
  }
  const std::string from = convention_of(library, *source_space);
  const std::string to = convention_of(library, *target_space);
  if (from != to) {
    const auto named = [](const std::string& convention) {
      return convention.empty() ? "of no stated convention" : convention;
    };
    const MissingChange missing = missing_change(library, a.domain, a.semantic, from, to);
    std::string why = fmt::format("the value of '{}' is {}, that of '{}' {}", a.name, named(from),
                                  b.name, named(to));
    if (!missing.why.empty()) why += ", and " + missing.why;
    refuse(why, missing.remedy.empty() ? "declare a conversion" : missing.remedy);
  }
  PlanOptions lossy;
  lossy.allow_lossy = true;
  if (const auto plan = Search(library, lossy, source).find(source, target)) {
    std::vector<std::string> losses;
    collect_losses(*plan, losses);
    refuse(fmt::format("every way loses something: {}", fmt::join(losses, "; ")),
           "allow it (--allow-lossy) if that is meant");
  }
  refuse(fmt::format("nothing leads from {} to {}", library.spaces[*source_space].key,
                     library.spaces[*target_space].key),
         "declare an alias or a conversion");
  std::abort();  // refuse does not return
}

}  // namespace

std::vector<Index> inputs_of(const Library& library, const Plan& plan) {
  std::vector<Index> inputs;
  for (const Index relation : plan.relations) {
    if (!library.relations[relation].constant) inputs.push_back(relation);
  }
  return inputs;
}

Plan find_plan(const Library& library, Index source, Index target, const PlanOptions& options) {
  if (source == target && !library.prototypes[source].bindings.empty()) {
    // A copy.
    const Binding& binding = library.prototypes[source].bindings.front();
    const int cost = binding_cost(binding);
    return {source,
            target,
            {{PlanStep::Kind::kRead, source, binding.space, 0, cost, {}, {}, {}},
             {PlanStep::Kind::kWrite, binding.space, target, 0, cost, {}, {}, {}}},
            2 * cost,
            {},
            {}};
  }
  if (library.prototypes[source].semantic == library.prototypes[target].semantic &&
      library.prototypes[source].domain == library.prototypes[target].domain) {
    Search search(library, options, source);
    if (auto plan = search.find(source, target)) {
      std::set<Index> relations;
      collect_relations(*plan, relations);
      for (const Index relation : relations) {
        plan->relations.push_back(relation);
        plan->relation_plans.push_back(*search.relation_plan(relation));
      }
      return *std::move(plan);
    }
  }
  fail(library, source, target);
}

Plan find_plan(const Library& library, const std::string& source, const std::string& target,
               const PlanOptions& options) {
  Index ends[2] = {};
  for (int side = 0; side < 2; ++side) {
    const std::string& name = side == 0 ? source : target;
    const auto found = library.find_prototype(name);
    if (!found) {
      std::vector<std::string> names;
      for (const Prototype& prototype : library.prototypes) names.push_back(prototype.name);
      throw Error(Problem{{},
                          name,
                          "there is no such data prototype",
                          did_you_mean(name, names, "declare it with 'dproto'"),
                          Severity::kError,
                          {}});
    }
    ends[side] = *found;
  }
  return find_plan(library, ends[0], ends[1], options);
}

}  // namespace sinew::data
