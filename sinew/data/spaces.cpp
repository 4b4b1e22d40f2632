// Spaces: made where prototypes need them, and wherever formulas lead from there.
#include <fmt/format.h>

#include <algorithm>
#include <queue>

#include "sinew/data/library_builder.h"

namespace sinew::data {

std::string join_convention(const std::map<std::string, std::string>& convention) {
  std::string text;
  for (const auto& [name, value] : convention) {
    if (!text.empty()) text += ", ";
    text += name + "=" + value;
  }
  return text;
}

std::map<std::string, std::string> split_convention(const std::string& convention) {
  std::map<std::string, std::string> result;
  std::string_view rest = convention;
  while (!rest.empty()) {
    const std::string_view entry = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 2));
    const std::size_t equals = entry.find('=');
    result.emplace(entry.substr(0, equals), entry.substr(equals + 1));
  }
  return result;
}

std::string convention_of(const Library& library, Index index) {
  const Space& space = library.spaces[index];
  if (!space.composed()) return space.convention;
  std::map<std::string, std::string> all;
  for (const auto& [member, part] : space.members) {
    for (const auto& [name, value] : split_convention(convention_of(library, part))) {
      const auto [known, added] = all.emplace(name, value);
      if (!added && known->second != value) known->second += " and " + value;
    }
  }
  return join_convention(all);
}

Index LibraryBuilder::plain_space(const std::string& domain, const std::string& semantic,
                                  const std::string& coordinates, const std::string& convention) {
  std::string key = fmt::format("{}.{} {}", domain, semantic, coordinates);
  if (!convention.empty()) key += fmt::format(" ({})", convention);
  const auto [known, added] = spaces_.try_emplace(key, library_.spaces.size());
  if (added) {
    library_.spaces.push_back({key,
                               domain,
                               semantic,
                               coordinates,
                               convention,
                               domains_.at(domain).coordinates.at({semantic, coordinates}).slots,
                               {}});
  }
  return known->second;
}

Index LibraryBuilder::free_space(const std::string& domain, const std::string& semantic,
                                 const std::string& coordinates, const std::string& convention,
                                 const std::string& algebraic) {
  std::string key = fmt::format("{}.{} {} as {}", domain, semantic, coordinates, algebraic);
  if (!convention.empty()) key += fmt::format(" ({})", convention);
  const auto [known, added] = spaces_.try_emplace(key, library_.spaces.size());
  if (added) {
    Space space{key, domain, semantic, coordinates, convention, {}, {}};
    const Algebraic& form = algebraics_.at(algebraic);
    for (std::size_t i = 0; i < form.size(); ++i) {
      space.slots.push_back({to_string(accessor_of(form, i)), {}, {}, {}});
    }
    library_.spaces.push_back(std::move(space));
  }
  return known->second;
}

Index LibraryBuilder::composed_space(const std::string& domain, const std::string& semantic,
                                     std::vector<std::pair<std::string, Index>> members) {
  std::string key = fmt::format("{}.{} of", domain, semantic);
  Space space{{}, domain, semantic, {}, {}, {}, std::move(members)};
  for (const auto& [member, index] : space.members) {
    key += fmt::format(" [{}]", library_.spaces[index].key);
    for (Space::Slot slot : library_.spaces[index].slots) {
      slot.name = member + "." + slot.name;
      space.slots.push_back(std::move(slot));
    }
  }
  space.key = key;
  const auto [known, added] = spaces_.try_emplace(key, library_.spaces.size());
  if (added) library_.spaces.push_back(std::move(space));
  return known->second;
}

// The space to which a formula leads from this one; nothing when it does not apply.
std::optional<Index> LibraryBuilder::formula_target(const FormulaDeclaration& formula,
                                                    const Domain& domain, const Space& from) {
  std::map<std::string, std::string> convention;
  if (formula.from.members.empty()) {
    if (from.composed() || from.coordinates != formula.from.coordinates) return std::nullopt;
    convention = split_convention(from.convention);
  } else {
    if (from.members.size() != formula.from.members.size()) return std::nullopt;
    for (const auto& [member, index] : from.members) {
      const Space& part = library_.spaces[index];
      bool fits = false;
      for (const auto& [name, coordinates] : formula.from.members) {
        fits |= name == member && !part.composed() && part.coordinates == coordinates;
      }
      if (!fits) return std::nullopt;
      for (const auto& [name, value] : split_convention(part.convention)) {
        if (convention.try_emplace(name, value).first->second != value) return std::nullopt;
      }
    }
    // What one part states and another leaves open is not known of the whole.
    for (const auto& [member, index] : from.members) {
      const auto stated = split_convention(library_.spaces[index].convention);
      for (const std::string& name : domain.conventions_of(member)) {
        if (convention.count(name) && !stated.count(name)) return std::nullopt;
      }
    }
  }
  const std::string& name = domain.declaration->name;
  const auto convention_of = [&](const std::string& semantic) {
    std::map<std::string, std::string> needed;
    for (const std::string& asked : domain.conventions_of(semantic)) {
      const auto value = convention.find(asked);
      if (value != convention.end()) {
        needed.insert(*value);
      } else if (!domain.is_optional(asked, semantic)) {
        return std::optional<std::string>();
      }
    }
    return std::optional(join_convention(needed));
  };
  if (formula.to.members.empty()) {
    const auto needed = convention_of(formula.semantic);
    if (!needed || !domain.coordinates.count({formula.semantic, formula.to.coordinates}))
      return std::nullopt;
    return plain_space(name, formula.semantic, formula.to.coordinates, *needed);
  }
  std::vector<std::pair<std::string, Index>> members;
  const auto composite = domain.composites.find(formula.semantic);
  if (composite == domain.composites.end()) return std::nullopt;
  for (const std::string& member : composite->second) {
    for (const auto& [given, coordinates] : formula.to.members) {
      if (given != member) continue;
      const auto needed = convention_of(member);
      if (!needed || !domain.coordinates.count({member, coordinates})) return std::nullopt;
      members.emplace_back(member, plain_space(name, member, coordinates, *needed));
    }
  }
  if (members.size() != composite->second.size()) return std::nullopt;
  return composed_space(name, formula.semantic, std::move(members));
}

// What a formula reads or gives, in the order of the slots. Nothing when the domain lacks it.
std::optional<std::vector<FormulaParameter>> LibraryBuilder::formula_parameters(
    const Domain& domain, const std::string& semantic, const FormulaSide& side,
    bool constants) const {
  std::vector<FormulaParameter> result;
  const auto add = [&](const std::string& of, const std::string& coordinates,
                       const std::string& prefix) {
    const auto found = domain.coordinates.find({of, coordinates});
    if (found == domain.coordinates.end()) return false;
    for (const Space::Slot& slot : found->second.slots) {
      if (constants || !slot.constant) result.push_back({prefix + slot.name, slot.dimension});
    }
    return true;
  };
  if (side.members.empty()) {
    if (!add(semantic, side.coordinates, "")) return std::nullopt;
    return result;
  }
  const auto composite = domain.composites.find(semantic);
  if (composite == domain.composites.end()) return std::nullopt;
  for (const std::string& member : composite->second) {
    for (const auto& [name, coordinates] : side.members) {
      if (name == member && !add(member, coordinates, member + ".")) return std::nullopt;
    }
  }
  return result;
}

// All formulas are read, whether a prototype needs them or not: a domain is right or wrong as a
// whole.
void LibraryBuilder::read_formulas() {
  for (const auto& [name, domain] : domains_) {
    for (const FormulaDeclaration& formula : domain.declaration->formulas) {
      const auto inputs = formula_parameters(domain, formula.semantic, formula.from, true);
      const auto outputs = formula_parameters(domain, formula.semantic, formula.to, false);
      if (!inputs || !outputs) {
        error(formula.place, name,
              fmt::format("a formula of {} is between coordinates that it does not have",
                          formula.semantic),
              "declare them with 'coordinates'");
        continue;
      }
      SpaceFormula result;
      result.loses = formula.loses;
      result.place = formula.place;
      const auto read = read_formula(formula.text, formula.text_place, *inputs, *outputs, name);
      if (!read) continue;
      result.formula = *read;
      result.cost = result.formula.graph.cost(result.formula.outputs);
      formula_index_[&formula] = library_.formulas.size();
      library_.formulas.push_back(std::move(result));
    }
  }
}

std::optional<Formula> LibraryBuilder::read_formula(const std::string& text, const Place& place,
                                                    const std::vector<FormulaParameter>& inputs,
                                                    const std::vector<FormulaParameter>& outputs,
                                                    const std::string& about) {
  try {
    return parse_formula(text, place, inputs, outputs);
  } catch (const Error& error) {
    for (Problem problem : error.problems()) {
      problem.iri = about;
      report_.add(std::move(problem));
    }
    return std::nullopt;
  }
}

void LibraryBuilder::close_over_formulas() {
  std::map<std::string, std::vector<const FormulaDeclaration*>> sorted;  // by domain
  for (const auto& [name, domain] : domains_) {
    auto& formulas = sorted[name];
    for (const FormulaDeclaration& formula : domain.declaration->formulas) {
      formulas.push_back(&formula);
    }
    const auto key = [](const FormulaDeclaration* f) {
      return std::tie(f->semantic, f->from.coordinates, f->from.members, f->to.coordinates,
                      f->to.members);
    };
    std::sort(formulas.begin(), formulas.end(),
              [&](const auto* a, const auto* b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < formulas.size(); ++i) {
      if (key(formulas[i - 1]) != key(formulas[i])) continue;
      error(formulas[i]->place, name, "the formula is there twice", "leave one out");
    }
  }
  for (std::size_t at = 0; at < library_.spaces.size(); ++at) {
    const auto domain = domains_.find(library_.spaces[at].domain);
    for (const FormulaDeclaration* declared : sorted.at(domain->first)) {
      const FormulaDeclaration& formula = *declared;
      if (formula.semantic != library_.spaces[at].semantic) continue;
      const Space from = library_.spaces[at];  // a copy: making spaces moves them
      const auto target = formula_target(formula, domain->second, from);
      if (!target) continue;
      const auto index = formula_index_.find(&formula);
      if (index == formula_index_.end()) continue;  // reported where it was read
      library_.formula_edges.push_back({at, *target, index->second, true});
    }
  }
  std::set<std::pair<Index, Index>> edges;
  for (const FormulaEdge& edge : library_.formula_edges) edges.insert({edge.from, edge.to});
  for (const FormulaEdge& edge : library_.formula_edges) {
    library_.formulas[edge.formula].one_way |= !edges.count({edge.to, edge.from});
  }
}

// The cheapest chain of formulas; edges by their index.
std::vector<Index> LibraryBuilder::formula_path(Index from, Index to) const {
  using Entry = std::tuple<int, std::vector<Index>, Index>;  // cost, edges so far, space
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({0, {}, from});
  std::set<Index> done;
  while (!queue.empty()) {
    auto [cost, path, space] = queue.top();
    queue.pop();
    if (space == to) return path;
    if (!done.insert(space).second) continue;
    for (Index i = 0; i < library_.formula_edges.size(); ++i) {
      const FormulaEdge& edge = library_.formula_edges[i];
      if (edge.from != space || done.count(edge.to) ||
          !library_.formulas[edge.formula].loses.empty())
        continue;
      auto longer = path;
      longer.push_back(i);
      queue.emplace(cost + library_.formulas[edge.formula].cost + 1, std::move(longer), edge.to);
    }
  }
  return {};
}

void LibraryBuilder::follow_coordinate_functions() {
  std::set<std::pair<Index, Index>> replaced;
  for (FunctionEdge& edge : library_.function_edges) {
    bool back = false;
    for (const FunctionEdge& other : library_.function_edges) {
      back |= other.from == edge.to && other.to == edge.from;
    }
    edge.one_way = !back;
    // A part that only functions reach is in no space.
    const auto &source = library_.prototypes[edge.from], &target = library_.prototypes[edge.to];
    if (source.bindings.empty() || target.bindings.empty()) continue;
    const Index from = source.bindings.front().space, to = target.bindings.front().space;
    if (edge.loses.empty()) replaced.insert({from, to});
    edge.one_way &= formula_path(to, from).empty();
    const Function& function = library_.functions[edge.function];
    if (function.context != "coordinates") continue;
    edge.formulas = formula_path(from, to);
    if (edge.formulas.empty() && from != to) {
      error(edge.place, function.name,
            fmt::format("no formula leads from {} to {}", library_.spaces[from].key,
                        library_.spaces[to].key),
            "declare one in the domain");
      continue;
    }
    if (!edge.cost_known) {
      edge.cost = 0;
      for (const Index i : edge.formulas) {
        edge.cost += library_.formulas[library_.formula_edges[i].formula].cost;
      }
      edge.cost_known = true;
    }
  }
  // What is declared wins over what the domain offers.
  for (FormulaEdge& edge : library_.formula_edges)
    edge.offered = !replaced.count({edge.from, edge.to});
}

}  // namespace sinew::data
