// Data prototypes: plain ones, and composites of others (type I in the source's terms).
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {
namespace {

// The coordinates' own way from an algebraic form to their parameters: by name, or by index where
// they declare a shape. Nothing when the form fits neither.
std::optional<ElementMap> direct_map(const Algebraic& algebraic,
                                     const CoordinatesDeclaration& declaration,
                                     const std::vector<Space::Slot>& slots) {
  if (algebraic.kind != Algebraic::Kind::kScalar) {
    if (!declaration.shape || *declaration.shape != algebraic) return std::nullopt;
    return identity_map(slots.size());
  }
  ElementMap map;
  std::set<std::size_t> found;
  for (const std::string& name : algebraic.names) {
    std::size_t slot = 0;
    while (slot < slots.size() && slots[slot].name != name) ++slot;
    if (slot == slots.size()) return std::nullopt;
    found.insert(slot);
    map.images.push_back({slot, 1, 0});
  }
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    if (!slots[slot].constant && !found.count(slot)) return std::nullopt;
  }
  return map;
}

}  // namespace

void LibraryBuilder::read_prototypes() {
  for (const PrototypeDeclaration& declaration : declarations_.prototypes) {
    if (!prototype_declarations_.emplace(declaration.name, &declaration).second) {
      error(declaration.place, declaration.name, "the prototype is declared twice",
            "rename one of them");
    }
  }
  for (const auto& [name, declaration] : prototype_declarations_) require_prototype(name);
}

std::optional<Index> LibraryBuilder::require_prototype(const std::string& name) {
  const auto declaration = prototype_declarations_.find(name);
  if (declaration == prototype_declarations_.end()) return std::nullopt;
  if (open_prototypes_.count(name)) {
    error(declaration->second->place, name, "the prototype composes itself",
          "a composite is made of simpler prototypes");
    return std::nullopt;
  }
  if (!prototypes_.count(name) && !unsound_prototypes_.count(name)) {
    open_prototypes_.insert(name);
    read_prototype(*declaration->second);
    open_prototypes_.erase(name);
  }
  const auto known = prototypes_.find(name);
  if (known == prototypes_.end()) return std::nullopt;
  return known->second;
}

void LibraryBuilder::read_prototype(const PrototypeDeclaration& declaration) {
  Prototype prototype;
  prototype.name = declaration.name;
  prototype.place = declaration.place;
  prototype.semantic = declaration.semantic.value;
  unsound_prototypes_.insert(declaration.name);  // until it is found to be sound
  const Domain* domain = find_domain(declaration.domain, declaration.name);
  if (!domain) return;
  prototype.domain = domain->declaration->name;
  if (!declaration.semantic.given()) {
    return error(declaration.place, declaration.name, "the prototype has no 'semantic'",
                 fmt::format("say what it means: one of {}", fmt::join(domain->semantics, ", ")));
  }
  if (!domain->semantics.count(prototype.semantic)) {
    const std::vector<std::string> known(domain->semantics.begin(), domain->semantics.end());
    return error(
        declaration.semantic.place, declaration.name,
        fmt::format("'{}' is no meaning of the domain '{}'", prototype.semantic, prototype.domain),
        did_you_mean(prototype.semantic, known,
                     fmt::format("use one of {}", fmt::join(known, ", "))));
  }
  library_.prototypes.push_back(prototype);
  const Index index = library_.prototypes.size() - 1;
  prototype.owner = index;
  const bool sound = declaration.members.empty() ? read_plain(declaration, *domain, prototype)
                                                 : read_composite(declaration, *domain, prototype);
  if (!sound) return;
  library_.prototypes[index] = std::move(prototype);
  unsound_prototypes_.erase(declaration.name);
  prototypes_[declaration.name] = index;
  if (declaration.members.empty()) return;
  make_parts(declaration, index);
}

bool LibraryBuilder::read_convention(const PrototypeDeclaration& declaration, const Domain& domain,
                                     std::string& convention) {
  const auto asked = domain.conventions_of(declaration.semantic.value);
  std::map<std::string, std::string> given;
  bool sound = true;
  for (const auto& [name, value] : declaration.convention) {
    if (std::find(asked.begin(), asked.end(), name) == asked.end()) {
      error(value.place, declaration.name,
            fmt::format("'{}' is no convention for {}", name, declaration.semantic.value),
            did_you_mean(
                name, asked,
                asked.empty() ? "leave it out" : fmt::format("use {}", fmt::join(asked, ", "))));
      sound = false;
    } else if (!given.emplace(name, value.value).second) {
      error(value.place, declaration.name, fmt::format("convention '{}' is given twice", name),
            "leave one out");
      sound = false;
    }
  }
  for (const std::string& name : asked) {
    if (given.count(name) || !sound || domain.is_optional(name, declaration.semantic.value))
      continue;
    error(declaration.place, declaration.name,
          fmt::format("{} needs the convention '{}'", declaration.semantic.value, name),
          fmt::format("write convention = {{ {} = NAME }}", name));
    sound = false;
  }
  convention = join_convention(given);
  return sound;
}

std::optional<Representation> LibraryBuilder::representation_of(const Field& name,
                                                                const std::string& about) {
  const auto known = representations_read_.find(name.value);
  if (known != representations_read_.end()) {
    if (!known->second.type) return std::nullopt;  // reported when it was first read
    return known->second;
  }
  const auto declaration = representations_.find(name.value);
  if (declaration == representations_.end()) {
    error(name.place, about, fmt::format("there is no data representation '{}'", name.value),
          did_you_mean(name.value, names_of(representations_), "declare it with 'ddr'"));
    return std::nullopt;
  }
  Representation& result = representations_read_[name.value];
  try {
    result = read_representation(declaration->second->context, declaration->second->text,
                                 declaration->second->place, sources_);
  } catch (const Error& error) {
    for (Problem problem : error.problems()) {
      if (problem.iri.empty()) problem.iri = about;
      report_.add(std::move(problem));
    }
    return std::nullopt;
  }
  return result;
}

std::vector<Unit> LibraryBuilder::units_for(const PrototypeDeclaration& declaration,
                                            const std::string& algebraic, const ElementMap& map,
                                            const Space& space) {
  std::vector<Unit> result;
  const Domain& domain = domains_.at(space.domain);
  if (!declaration.units.given()) {
    const AnnotationDeclaration* annotation = domain.annotation("units");
    bool needed = annotation && !annotation->optional;
    std::string quantity;
    for (const Space::Slot& slot : space.slots) {
      if (slot.dimension.dimensionless()) continue;
      needed = true;
      quantity = fmt::format(": {} is a {}", slot.name, to_string(slot.dimension));
      break;
    }
    if (needed) {
      error(declaration.place, declaration.name, "the prototype has no units" + quantity,
            "add units = ::qudt, FORM { UNIT = ELEMENT … }");
      return result;
    }
    result.resize(map.images.size(), Unit{"unitless", {}, 1, 0});
    return result;
  }
  const auto found = units_.find(declaration.units.value);
  if (found == units_.end()) {
    error(declaration.units.place, declaration.name,
          fmt::format("there are no units '{}'", declaration.units.value),
          did_you_mean(declaration.units.value, names_of(units_), "declare them with 'units'"));
    return result;
  }
  if (found->second.units.empty()) return result;  // reported at their declaration
  const std::string& units_form = found->second.declaration->algebraic;
  const auto way = aliases_.find(algebraic, units_form, map.images.size());
  if (!way && algebraics_.at(algebraic) != algebraics_.at(units_form)) {
    error(
        declaration.units.place, declaration.name,
        fmt::format("units '{}' are of '{}', the prototype is of '{}', and no alias leads from one "
                    "to the other",
                    declaration.units.value, units_form, algebraic),
        "declare an alias, or other units");
    return result;
  }
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    const auto element = way ? way->images[i].element : std::optional(i);
    result.push_back(element ? found->second.units[*element] : Unit{"unitless", {}, 1, 0});
  }
  return result;
}

// Only its memory is described, and functions say what is in it.
bool LibraryBuilder::is_viewed_by_functions(const PrototypeDeclaration& declaration) const {
  if (declaration.algebraic.given() || declaration.coordinates.given() ||
      declaration.units.given() || declaration.has_map) {
    return false;
  }
  return std::any_of(declarations_.views.begin(), declarations_.views.end(),
                     [&](const ViewDeclaration& view) {
                       return view.prototype == declaration.name && !view.function.empty();
                     });
}

bool LibraryBuilder::read_plain(const PrototypeDeclaration& declaration, const Domain& domain,
                                Prototype& prototype) {
  const std::string& about = declaration.name;
  const auto missing = [&](const char* what) {
    error(declaration.place, about, fmt::format("the prototype has no '{}'", what),
          fmt::format("add {} = …", what));
    return false;
  };
  if (!declaration.representation.given()) return missing("ddr");
  if (is_viewed_by_functions(declaration)) {
    const auto representation = representation_of(declaration.representation, about);
    if (representation) prototype.representation = *representation;
    return representation.has_value();
  }
  if (!declaration.algebraic.given()) return missing("algebraic");
  if (!declaration.coordinates.given() && domain.has_coordinates_for(prototype.semantic))
    return missing("coord");
  const AnnotationDeclaration* coord = domain.annotation("coord");
  if (coord && !coord->optional && !declaration.coordinates.given()) return missing("coord");

  const auto algebraic = algebraics_.find(declaration.algebraic.value);
  if (algebraic == algebraics_.end()) {
    error(declaration.algebraic.place, about,
          fmt::format("there is no algebraic form '{}'", declaration.algebraic.value),
          did_you_mean(declaration.algebraic.value, names_of(algebraics_),
                       "declare it with 'algebraic'"));
    return false;
  }
  const Algebraic& form = algebraic->second;
  // An unnamed form is known by what it is: equal unnamed forms are the same.
  prototype.algebraic =
      algebraic->first.find("::") == std::string::npos ? algebraic->first : to_string(form);
  prototype.coordinates = declaration.coordinates.value;
  const auto representation = representation_of(declaration.representation, about);
  std::string convention;
  if (!read_convention(declaration, domain, convention) || !representation) return false;
  prototype.representation = *representation;

  // Which coordinate parameter is each element?
  std::optional<ElementMap> to_slots;
  Index space = 0;
  if (domain.has_coordinates_for(prototype.semantic)) {
    const auto known = domain.coordinates.find({prototype.semantic, prototype.coordinates});
    if (known == domain.coordinates.end()) {
      const auto names = domain.coordinates_of(prototype.semantic);
      error(declaration.coordinates.place, about,
            fmt::format("{} has no coordinates '{}'", prototype.semantic, prototype.coordinates),
            did_you_mean(prototype.coordinates, names,
                         fmt::format("use one of {}", fmt::join(names, ", "))));
      return false;
    }
    for (const auto& [name, map] : aliases_.reachable(algebraic->first, form.size())) {
      const auto direct =
          direct_map(algebraics_.at(name), *known->second.declaration, known->second.slots);
      if (!direct) continue;
      ElementMap whole = compose(map, *direct);
      if (!to_slots) {
        to_slots = std::move(whole);
      } else if (*to_slots != whole) {
        error(declaration.algebraic.place, about,
              fmt::format("the aliases of '{}' contradict the order of '{}'", algebraic->first,
                          prototype.coordinates),
              "aliases have to agree with the coordinates' own names and indices");
        return false;
      }
    }
    if (!to_slots) {
      std::vector<std::string> names;
      for (const Space::Slot& slot : known->second.slots) names.push_back(slot.name);
      error(declaration.algebraic.place, about,
            fmt::format("it is not known which element of '{}' is which parameter of '{}'",
                        prototype.algebraic, prototype.coordinates),
            fmt::format("declare an alias with Scalar{{{}}}", fmt::join(names, ",")));
      return false;
    }
    space = plain_space(prototype.domain, prototype.semantic, prototype.coordinates, convention);
  } else {
    if (coord && !coord->values.empty() && declaration.coordinates.given() &&
        std::find(coord->values.begin(), coord->values.end(), prototype.coordinates) ==
            coord->values.end()) {
      error(declaration.coordinates.place, about,
            fmt::format("the domain '{}' has no coordinates '{}'", prototype.domain,
                        prototype.coordinates),
            did_you_mean(prototype.coordinates, coord->values,
                         fmt::format("use one of {}", fmt::join(coord->values, ", "))));
      return false;
    }
    // The first by name of the forms that are aliases of each other stands for all of them.
    auto forms = aliases_.reachable(algebraic->first, form.size());
    std::string least =
        algebraic->first.find("::") == std::string::npos ? algebraic->first : prototype.algebraic;
    if (!algebraics_.count(least)) algebraics_[least] = form;
    to_slots = forms.front().second;
    for (const auto& [name, map] : forms) {
      const bool whole = std::all_of(map.images.begin(), map.images.end(),
                                     [](const auto& image) { return image.element.has_value(); });
      if (name < least && whole && algebraics_.at(name).size() == form.size()) {
        least = name;
        to_slots = map;
      }
    }
    space =
        free_space(prototype.domain, prototype.semantic, prototype.coordinates, convention, least);
  }

  const std::vector<Unit> units =
      units_for(declaration, algebraic->first, *to_slots, library_.spaces[space]);
  if (units.empty()) return false;

  // The map from memory to elements.
  if (!declaration.has_map) return missing("dr");
  struct Placed {
    std::optional<Access> access;
    double sign = 1;
    bool given = false;
    const MapEntry* entry = nullptr;
  };
  std::vector<Placed> elements(form.size());
  std::set<std::string> used;
  bool sound = true;
  const auto fail = [&](const Place& place, std::string what, std::string remedy) {
    error(place, about, std::move(what), std::move(remedy));
    sound = false;
  };
  for (const MapEntry& entry : declaration.map) {
    std::string why;
    auto access = find_access(*prototype.representation.type, entry.left, &why);
    if (access && !used.insert(access->source).second) {
      fail(entry.place,
           fmt::format("'{}' of the representation is mapped twice", to_string(entry.left)),
           "map every part once");
      continue;
    }
    if (entry.constant) {
      const auto element = element_of(form, entry.left);
      if (!access && !element) {
        fail(entry.place,
             fmt::format("the representation has no '{}': {}", to_string(entry.left), why), "");
      } else if (element && !elements[*element].given) {
        elements[*element].given = true;
      }
      if (access) prototype.constants.push_back({*access, *entry.constant});
      continue;
    }
    if (!access) {
      fail(entry.place,
           fmt::format("the representation has no '{}': {}", to_string(entry.left), why), "");
      continue;
    }
    const auto element = element_of(form, entry.right);
    if (!element) {
      fail(entry.place,
           fmt::format("'{}' is no element of '{}'", to_string(entry.right), prototype.algebraic),
           describe_accessors(form));
      continue;
    }
    if (elements[*element].given) {
      fail(entry.place, fmt::format("element '{}' is mapped twice", to_string(entry.right)),
           "map every element once");
      continue;
    }
    elements[*element] = {std::move(access), entry.negative ? -1.0 : 1.0, true, &entry};
  }
  if (!sound) return false;

  Binding binding{space, {}, true};
  const Space& here = library_.spaces[space];
  PlainElements details{form, *to_slots, {}};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const bool constant =
        !to_slots->images[i].element || here.slots[*to_slots->images[i].element].constant;
    details.elements.push_back({elements[i].access, elements[i].sign * units[i].scale,
                                units[i].offset, units[i], constant});
  }
  plain_elements_[library_.prototypes.size() - 1] = std::move(details);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ElementMap::Image& image = to_slots->images[i];
    const std::optional<double> constant =
        image.element ? here.slots[*image.element].constant : std::optional(image.constant);
    if (constant) {
      if (elements[i].access)
        prototype.constants.push_back({*elements[i].access, *constant * elements[i].sign});
      continue;
    }
    if (!elements[i].access) {
      error(declaration.place, about,
            fmt::format("the map does not give '{}' of '{}'", to_string(accessor_of(form, i)),
                        prototype.algebraic),
            "map every element to a part of the representation");
      return false;
    }
    const Space::Slot& slot = here.slots[*image.element];
    if (domain.has_coordinates_for(prototype.semantic) && units[i].dimension != slot.dimension) {
      error(
          declaration.units.given() ? declaration.units.place : declaration.place, about,
          fmt::format("'{}' has the unit {} ({}), but {} of {} is a {}",
                      to_string(accessor_of(form, i)), units[i].name, to_string(units[i].dimension),
                      slot.name, prototype.coordinates, to_string(slot.dimension)),
          fmt::format("use a unit like {}", slot.unit));
      return false;
    }
    binding.slots.push_back({*image.element, *elements[i].access,
                             image.sign * elements[i].sign * units[i].scale,
                             image.sign * units[i].offset, units[i]});
  }
  std::sort(binding.slots.begin(), binding.slots.end(),
            [](const SlotBinding& a, const SlotBinding& b) { return a.slot < b.slot; });
  prototype.bindings.push_back(std::move(binding));
  return true;
}

}  // namespace sinew::data
