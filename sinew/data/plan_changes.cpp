#include "sinew/data/plan_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace sinew::data {
namespace {

std::optional<std::string> value_of(const std::map<std::string, std::string>& convention,
                                    const std::string& name) {
  const auto found = convention.find(name);
  if (found == convention.end()) return std::nullopt;
  return found->second;
}

MissingChange unrelated(const Library& library, const std::string& domain, const std::string& of,
                        const std::string& in) {
  std::set<std::string> frames;
  for (const Relation& relation : library.relations) {
    if (relation.domain == domain) frames.insert({relation.frame, relation.reference});
  }
  MissingChange missing;
  missing.why = fmt::format("it is not known how '{}' is related to '{}'", of, in);
  if (!frames.empty()) {
    missing.why += fmt::format(" (related frames are {})", fmt::join(frames, ", "));
  }
  missing.remedy = fmt::format("declare relation {} in {} = PROTOTYPE", of, in);
  return missing;
}

}  // namespace

std::optional<std::vector<RelationLink>> relation_chain(const Library& library,
                                                        const std::string& domain,
                                                        const std::string& of,
                                                        const std::string& in) {
  struct Stop {
    std::string before;
    RelationLink link;
  };
  std::map<std::string, Stop> reached = {{of, {}}};
  std::deque<std::string> open = {of};
  while (!open.empty() && !reached.count(in)) {
    const std::string at = open.front();
    open.pop_front();
    std::map<std::string, RelationLink> next;  // by name
    for (Index i = 0; i < library.relations.size(); ++i) {
      const Relation& relation = library.relations[i];
      if (relation.domain != domain) continue;
      if (relation.frame == at) next[relation.reference] = {i, false};
      if (relation.reference == at) next[relation.frame] = {i, true};
    }
    for (const auto& [frame, link] : next) {
      if (reached.emplace(frame, Stop{at, link}).second) open.push_back(frame);
    }
  }
  if (!reached.count(in)) return std::nullopt;
  std::vector<RelationLink> links;
  for (std::string at = in; at != of; at = reached.at(at).before) {
    links.push_back(reached.at(at).link);
  }
  std::reverse(links.begin(), links.end());
  return links;
}

std::optional<std::vector<ConventionStep>> convention_steps(
    const Library& library, const std::string& domain, const std::string& semantic,
    const std::string& coordinates, const std::string& from, const std::string& to,
    MissingChange* missing) {
  const auto refuse = [&](MissingChange why) {
    if (missing) *missing = std::move(why);
    return std::nullopt;
  };
  auto at = split_convention(from);
  const auto goal = split_convention(to);
  for (const auto& [name, value] : at) {
    if (goal.count(name)) continue;
    return refuse({fmt::format("the target does not state '{}'", name), "state it"});
  }
  std::vector<ConventionStep> steps;
  for (const auto& [name, value] : goal) {
    const auto before = value_of(at, name);
    if (!before) return refuse({fmt::format("the source does not state '{}'", name), "state it"});
    if (*before == value) continue;
    const auto change = library.changes.find({domain, semantic, coordinates, name});
    if (change == library.changes.end()) {
      return refuse({fmt::format("the domain {} does not say what {} becomes when '{}' changes",
                                 domain, semantic, name),
                     "declare a change in the domain, or a conversion"});
    }
    if (!change->second.needs.empty()) {
      return refuse(
          {fmt::format("to change the {} of {} takes {}", name, semantic, change->second.needs),
           "convert something that has it, or declare a conversion"});
    }
    ConventionStep step{name, *before, value, {}};
    for (const ChangeInput& input : change->second.inputs) {
      const auto frame = [&](const std::string& word) {
        return word == "old" ? before : word == "new" ? std::optional(value) : value_of(at, word);
      };
      const auto of = frame(input.of), in = frame(input.in);
      if (!of || !in) {
        return refuse(
            {fmt::format("the value does not state '{}'", of ? input.in : input.of), "state it"});
      }
      auto chain = relation_chain(library, domain, *of, *in);
      if (!chain) return refuse(unrelated(library, domain, *of, *in));
      step.inputs.push_back(std::move(*chain));
    }
    at[name] = value;
    steps.push_back(std::move(step));
  }
  return steps;
}

int cost_of(const Library& library, Index space_index, const std::vector<ConventionStep>& steps) {
  const Space& space = library.spaces[space_index];
  int cost = 1;
  for (const ConventionStep& step : steps) {
    cost +=
        library.changes.at({space.domain, space.semantic, space.coordinates, step.convention}).cost;
    for (const auto& chain : step.inputs) {
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const RelationRule& rule = library.relation_rules.at(space.domain);
        if (chain[i].inverse) cost += rule.inverse.graph.cost(rule.inverse.outputs);
        if (i > 0) cost += rule.product.graph.cost(rule.product.outputs);
      }
    }
  }
  return cost;
}

MissingChange missing_change(const Library& library, const std::string& domain,
                             const std::string& semantic, const std::string& from,
                             const std::string& to) {
  // The coordinates in which most is known decide; what they lack is what is missing.
  MissingChange missing;
  bool tried = false;
  for (const auto& [key, change] : library.changes) {
    if (std::get<0>(key) != domain || std::get<1>(key) != semantic) continue;
    MissingChange why;
    if (convention_steps(library, domain, semantic, std::get<2>(key), from, to, &why)) continue;
    const bool better = !tried || missing.why.find("does not say") != std::string::npos;
    if (better) missing = std::move(why);
    tried = true;
  }
  if (!tried) convention_steps(library, domain, semantic, {}, from, to, &missing);
  return missing;
}

}  // namespace sinew::data
