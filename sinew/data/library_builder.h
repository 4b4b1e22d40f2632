// What make_library works with while it checks: tables by name, and the steps. Internal to the
// module.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sinew/data/alias_algebra.h"
#include "sinew/data/library.h"

namespace sinew::data {

// A domain's coordinates with their units read.
struct Coordinates {
  const CoordinatesDeclaration* declaration = nullptr;
  std::vector<Space::Slot> slots;
};

struct Domain {
  const DomainDeclaration* declaration = nullptr;
  std::set<std::string> semantics;
  std::map<std::string, std::vector<std::string>> composites;
  std::map<std::pair<std::string, std::string>, Coordinates> coordinates;  // by semantic and name
  bool has_coordinates_for(const std::string& semantic) const;
  std::vector<std::string> coordinates_of(const std::string& semantic) const;
  // The conventions that prototypes of this meaning state; those that they have to.
  std::vector<std::string> conventions_of(const std::string& semantic) const;
  bool is_optional(const std::string& convention, const std::string& semantic) const;
  // Nothing when the annotation is not declared.
  const AnnotationDeclaration* annotation(const std::string& name) const;
};

// What the views of a plain prototype need to know of its elements.
struct PlainElements {
  Algebraic form;
  ElementMap to_slots;
  struct Element {
    std::optional<Access> access;
    double scale = 1, offset = 0;  // to the element's value in SI units
    Unit unit;
    bool constant = false;
  };
  std::vector<Element> elements;
};

struct Units {
  const UnitsDeclaration* declaration = nullptr;
  std::vector<Unit> units;  // by element of the algebraic form
};

class LibraryBuilder {
 public:
  LibraryBuilder(const Declarations& declarations, const TypeSources& sources);
  Library build();

 private:
  // check_domains.cpp
  void read_domains();
  void read_domain(const DomainDeclaration& declaration);
  void read_coordinates(Domain& domain, const CoordinatesDeclaration& declaration);
  void check_composites(const Domain& domain);
  const Domain* find_domain(const Field& name, const std::string& about);

  // check_forms.cpp: algebraic forms, aliases, units
  void read_algebraics();
  void read_aliases();
  void read_units();

  // check_prototypes.cpp
  void read_prototypes();
  // The sound prototype of this name, read now if it was not yet; nothing if there is none.
  std::optional<Index> require_prototype(const std::string& name);
  void read_prototype(const PrototypeDeclaration& declaration);
  bool is_viewed_by_functions(const PrototypeDeclaration& declaration) const;
  bool read_plain(const PrototypeDeclaration& declaration, const Domain& domain,
                  Prototype& prototype);
  bool read_composite(const PrototypeDeclaration& declaration, const Domain& domain,
                      Prototype& prototype);
  bool read_convention(const PrototypeDeclaration& declaration, const Domain& domain,
                       std::string& convention);
  std::vector<Unit> units_for(const PrototypeDeclaration& declaration, const std::string& algebraic,
                              const ElementMap& map, const Space& space);
  // A copy of `part` that lies inside `whole`, at `place_of_part`; with its own parts.
  Index add_part(Index whole, const std::string& name, Index part, const Access& place_of_part);
  // Binds a prototype with members to the composed space of its members.
  void bind_members(Index prototype, bool writable);
  std::optional<Representation> representation_of(const Field& name, const std::string& about);
  void check_dimensions();

  // check_composites.cpp
  void make_parts(const PrototypeDeclaration& declaration, Index prototype);

  // check_views.cpp
  void read_views();
  // The meaning that the view is of, if it is a member of the whole's.
  bool check_member(const ViewDeclaration& view, const Prototype& owner);
  std::optional<Index> read_view(const ViewDeclaration& declaration, Index whole,
                                 std::set<std::size_t>& covered);

  void read_function_views();
  // Members that are all viewed make the prototype a composite.
  void finish_views();

  // check_relations.cpp
  void read_changes();
  void read_relation_rule(const Domain& domain, const RelationRuleDeclaration& declaration);
  void read_change(const Domain& domain, const ChangeDeclaration& declaration);
  void read_relations();

  // check_functions.cpp
  void read_functions();
  void read_conversions();

  // spaces.cpp
  Index plain_space(const std::string& domain, const std::string& semantic,
                    const std::string& coordinates, const std::string& convention);
  Index free_space(const std::string& domain, const std::string& semantic,
                   const std::string& coordinates, const std::string& convention,
                   const std::string& algebraic);
  Index composed_space(const std::string& domain, const std::string& semantic,
                       std::vector<std::pair<std::string, Index>> members);
  void read_formulas();
  std::optional<std::vector<FormulaParameter>> formula_parameters(const Domain& domain,
                                                                  const std::string& semantic,
                                                                  const FormulaSide& side,
                                                                  bool constants) const;
  std::optional<Formula> read_formula(const std::string& text, const Place& place,
                                      const std::vector<FormulaParameter>& inputs,
                                      const std::vector<FormulaParameter>& outputs,
                                      const std::string& about);
  void close_over_formulas();
  std::optional<Index> formula_target(const FormulaDeclaration& formula, const Domain& domain,
                                      const Space& from);
  void follow_coordinate_functions();
  std::vector<Index> formula_path(Index from, Index to) const;
  void sort_by_name();
  void index();

  void error(const Place& place, const std::string& about, std::string what, std::string remedy);

  const Declarations& declarations_;
  const TypeSources& sources_;
  Report report_;
  Library library_;
  std::map<std::string, Domain> domains_;
  std::map<std::string, std::string> older_domain_names_;
  std::map<std::string, Algebraic> algebraics_;
  std::map<std::string, const RepresentationDeclaration*> representations_;
  std::map<std::string, Representation> representations_read_;
  std::map<std::string, Units> units_;
  AliasAlgebra aliases_;
  std::map<const FormulaDeclaration*, Index> formula_index_;
  std::map<std::string, const PrototypeDeclaration*> prototype_declarations_;
  std::map<std::string, Index> prototypes_;  // those that are sound
  std::set<std::string> open_prototypes_, unsound_prototypes_;
  std::map<Index, PlainElements> plain_elements_;
  struct View {
    Index part = 0;
    bool readable = false, writable = false;
    std::optional<Index> read_as, written_from;  // prototypes, where functions do it
  };
  std::map<Index, std::map<std::string, View>> views_;  // by whole and member
  std::map<Index, std::set<std::size_t>> covered_;      // elements that views map
  std::map<std::string, Index> spaces_;
  std::map<std::string, Index> functions_;
};

template <typename Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : map) names.push_back(name);
  return names;
}

}  // namespace sinew::data
