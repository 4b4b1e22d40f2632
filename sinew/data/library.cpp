#include "sinew/data/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "sinew/data/library_builder.h"

namespace sinew::data {

LibraryBuilder::LibraryBuilder(const Declarations& declarations, const TypeSources& sources)
    : declarations_(declarations), sources_(sources) {}

Library LibraryBuilder::build() {
  read_domains();
  read_formulas();
  read_changes();
  read_algebraics();
  read_aliases();
  read_units();
  for (const RepresentationDeclaration& declaration : declarations_.representations) {
    if (!representations_.emplace(declaration.name, &declaration).second) {
      error(declaration.place, declaration.name, "the data representation is declared twice",
            "rename one of them");
    }
  }
  read_prototypes();
  read_views();
  read_functions();
  read_function_views();
  finish_views();
  read_conversions();
  read_relations();
  sort_by_name();
  close_over_formulas();
  check_dimensions();
  follow_coordinate_functions();
  report_.throw_if_errors();
  index();
  for (const Problem& problem : report_.problems()) library_.warnings.push_back(problem);
  return std::move(library_);
}

void LibraryBuilder::error(const Place& place, const std::string& about, std::string what,
                           std::string remedy) {
  report_.error(place, about, std::move(what), std::move(remedy));
}

// Where the domain does not say what a number is, prototypes that are to be converted into each
// other still have to agree on it.
void LibraryBuilder::check_dimensions() {
  std::map<std::pair<Index, Index>, std::pair<const Prototype*, const SlotBinding*>> first;
  for (const Prototype& prototype : library_.prototypes) {
    for (const Binding& binding : prototype.bindings) {
      for (const SlotBinding& slot : binding.slots) {
        const auto [known, added] =
            first.try_emplace({binding.space, slot.slot}, std::pair(&prototype, &slot));
        Dimension& dimension = library_.spaces[binding.space].slots[slot.slot].dimension;
        if (added) {
          dimension = slot.unit.dimension;
          continue;
        }
        if (slot.unit.dimension == dimension) continue;
        error(prototype.place, prototype.name,
              fmt::format("{} of '{}' is in {} ({}), but of '{}' in {} ({})",
                          library_.spaces[binding.space].slots[slot.slot].name, prototype.name,
                          slot.unit.name, to_string(slot.unit.dimension), known->second.first->name,
                          known->second.second->unit.name, to_string(dimension)),
              "numbers that mean the same have the same dimension");
        return;
      }
    }
  }
}

// Renumbers everything by name, so that no result depends on the order of the declarations.
void LibraryBuilder::sort_by_name() {
  // Prototypes that turned out unsound are dropped with them.
  std::vector<Index> order;
  for (const auto& [name, index] : prototypes_) order.push_back(index);
  std::vector<Index> place(library_.prototypes.size(), 0);
  for (Index i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<Index> space_order(library_.spaces.size());
  std::iota(space_order.begin(), space_order.end(), 0);
  std::sort(space_order.begin(), space_order.end(),
            [&](Index a, Index b) { return library_.spaces[a].key < library_.spaces[b].key; });
  std::vector<Index> space_place(space_order.size());
  for (Index i = 0; i < space_order.size(); ++i) space_place[space_order[i]] = i;
  std::vector<Index> function_order;
  for (const auto& [name, index] : functions_) function_order.push_back(index);
  std::vector<Index> function_place(library_.functions.size());
  for (Index i = 0; i < function_order.size(); ++i) function_place[function_order[i]] = i;

  std::vector<Prototype> prototypes;
  for (const Index i : order) {
    Prototype& prototype = library_.prototypes[i];
    prototype.owner = place[prototype.owner];
    for (Binding& binding : prototype.bindings) binding.space = space_place[binding.space];
    for (auto& [member, part] : prototype.members) part = place[part];
    for (auto* space : {&prototype.taken_apart, &prototype.put_together}) {
      if (*space) *space = space_place[**space];
    }
    prototypes.push_back(std::move(prototype));
  }
  library_.prototypes = std::move(prototypes);
  for (auto& [name, index] : prototypes_) index = place[index];
  std::vector<Space> spaces;
  for (const Index i : space_order) {
    for (auto& [member, space] : library_.spaces[i].members) space = space_place[space];
    spaces.push_back(std::move(library_.spaces[i]));
  }
  library_.spaces = std::move(spaces);
  for (auto& [key, index] : spaces_) index = space_place[index];
  std::vector<Function> functions;
  for (const Index i : function_order) {
    for (auto& argument : library_.functions[i].arguments)
      argument.prototype = place[argument.prototype];
    functions.push_back(std::move(library_.functions[i]));
  }
  library_.functions = std::move(functions);
  for (FunctionEdge& edge : library_.function_edges) {
    edge.from = place[edge.from];
    edge.to = place[edge.to];
    edge.function = function_place[edge.function];
  }
  for (Relation& relation : library_.relations) {
    relation.prototype = place[relation.prototype];
    relation.space = space_place[relation.space];
  }
  std::sort(library_.relations.begin(), library_.relations.end(),
            [](const Relation& a, const Relation& b) {
              return std::tie(a.frame, a.reference) < std::tie(b.frame, b.reference);
            });
  std::sort(library_.function_edges.begin(), library_.function_edges.end(),
            [](const FunctionEdge& a, const FunctionEdge& b) {
              return std::tie(a.from, a.to, a.function) < std::tie(b.from, b.to, b.function);
            });
}

void LibraryBuilder::index() {
  for (Index i = 0; i < library_.spaces.size(); ++i) {
    const Space& space = library_.spaces[i];
    if (!space.composed())
      library_.alike[{space.domain, space.semantic, space.coordinates}].push_back(i);
  }
  library_.bound_to.resize(library_.spaces.size());
  for (Index i = 0; i < library_.prototypes.size(); ++i) {
    for (Index b = 0; b < library_.prototypes[i].bindings.size(); ++b) {
      library_.bound_to[library_.prototypes[i].bindings[b].space].emplace_back(i, b);
    }
  }
  library_.formulas_from.resize(library_.spaces.size());
  for (Index i = 0; i < library_.formula_edges.size(); ++i) {
    library_.formulas_from[library_.formula_edges[i].from].push_back(i);
  }
  library_.functions_from.resize(library_.prototypes.size());
  for (Index i = 0; i < library_.function_edges.size(); ++i) {
    library_.functions_from[library_.function_edges[i].from].push_back(i);
  }
}

std::optional<Index> Library::find_prototype(const std::string& name) const {
  const auto found =
      std::lower_bound(prototypes.begin(), prototypes.end(), name,
                       [](const Prototype& p, const std::string& n) { return p.name < n; });
  if (found == prototypes.end() || found->name != name) return std::nullopt;
  return static_cast<Index>(found - prototypes.begin());
}

std::optional<Index> Library::find_space(const std::string& key) const {
  for (Index i = 0; i < spaces.size(); ++i) {
    if (spaces[i].key == key) return i;
  }
  return std::nullopt;
}

Library make_library(const Declarations& declarations, const TypeSources& sources) {
  return LibraryBuilder(declarations, sources).build();
}

}  // namespace sinew::data
