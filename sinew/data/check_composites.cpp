// Composite prototypes: made of other prototypes (type I in the source's terms).
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {
namespace {

bool same_layout(const Type& a, const Type& b) {
  if (a.kind != b.kind || a.size != b.size) return false;
  if (a.kind == Type::Kind::kScalar) return a.scalar == b.scalar;
  if (a.rows != b.rows || a.columns != b.columns || a.row_major != b.row_major ||
      a.count != b.count) {
    return false;
  }
  if ((a.element == nullptr) != (b.element == nullptr)) return false;
  if (a.element && !same_layout(*a.element, *b.element)) return false;
  if (a.members.size() != b.members.size()) return false;
  for (std::size_t i = 0; i < a.members.size(); ++i) {
    if (a.members[i].offset != b.members[i].offset) return false;
    if (!same_layout(*a.members[i].type, *b.members[i].type)) return false;
  }
  return true;
}

std::string c_identifier(std::string name) {
  for (char& c : name) {
    if (c == '.' || c == '-') c = '_';
  }
  return name;
}

}  // namespace

void LibraryBuilder::make_parts(const PrototypeDeclaration& declaration, Index index) {
  std::vector<std::pair<std::string, Index>> parts = library_.prototypes[index].members;
  for (auto& [member, part] : parts) {
    Accessor place{false, {member}};
    for (const MapEntry& entry : declaration.map) {
      if (entry.right.steps == std::vector<std::string>{member}) place = entry.left;
    }
    Access access;
    find_part(library_.prototypes[index].representation.type, place, &access, nullptr);
    part = add_part(index, declaration.name + "." + member, part, access);
  }
  library_.prototypes[index].members = std::move(parts);
  bind_members(index, true);
}

Index LibraryBuilder::add_part(Index whole, const std::string& name, Index part, const Access& at) {
  Prototype copy = library_.prototypes[part];
  copy.name = name;
  copy.owner = whole;
  copy.representation = library_.prototypes[whole].representation;
  // An access within the part becomes one within the whole.
  const auto rebase = [&](Access& access) {
    const auto join_source = [&](std::string& source) {
      std::string joined;
      for (const char c : source) joined += c == '$' ? at.source : std::string(1, c);
      source = joined;
    };
    const auto join_offsets = [&](std::vector<std::size_t>& offsets) {
      std::vector<std::size_t> joined = at.offsets;
      joined.back() += offsets.front();
      joined.insert(joined.end(), offsets.begin() + 1, offsets.end());
      offsets = std::move(joined);
    };
    join_source(access.source);
    join_offsets(access.offsets);
    for (Access::Guard& guard : access.guards) {
      join_source(guard.source);
      join_offsets(guard.offsets);
    }
    access.guards.insert(access.guards.begin(), at.guards.begin(), at.guards.end());
  };
  for (Binding& binding : copy.bindings) {
    for (SlotBinding& slot : binding.slots) rebase(slot.access);
  }
  for (ConstantWrite& constant : copy.constants) rebase(constant.access);
  const auto members = copy.members;
  library_.prototypes.push_back(std::move(copy));
  const Index index = library_.prototypes.size() - 1;
  prototypes_[name] = index;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Index inner = add_part(whole, name + "." + members[i].first, members[i].second, at);
    library_.prototypes[index].members[i].second = inner;
  }
  return index;
}

void LibraryBuilder::bind_members(Index index, bool writable) {
  Prototype& prototype = library_.prototypes[index];
  std::vector<std::pair<std::string, Index>> spaces;
  Binding binding;
  binding.writable = writable;
  std::size_t first_slot = 0;
  for (const auto& [member, part] : prototype.members) {
    const Binding& inner = library_.prototypes[part].bindings.front();
    spaces.emplace_back(member, inner.space);
    for (SlotBinding slot : inner.slots) {
      slot.slot += first_slot;
      binding.slots.push_back(std::move(slot));
    }
    first_slot += library_.spaces[inner.space].slots.size();
    const auto& constants = library_.prototypes[part].constants;
    prototype.constants.insert(prototype.constants.end(), constants.begin(), constants.end());
  }
  binding.space = composed_space(prototype.domain, prototype.semantic, std::move(spaces));
  prototype.bindings.push_back(std::move(binding));
}

bool LibraryBuilder::read_composite(const PrototypeDeclaration& declaration, const Domain& domain,
                                    Prototype& prototype) {
  const std::string& about = declaration.name;
  const auto composite = domain.composites.find(prototype.semantic);
  if (composite == domain.composites.end()) {
    error(declaration.semantic.place, about,
          fmt::format("'{}' is no composite of the domain '{}'", prototype.semantic,
                      prototype.domain),
          fmt::format("use one of {}", fmt::join(names_of(domain.composites), ", ")));
    return false;
  }
  std::map<std::string, Index> found;
  bool sound = true;
  for (const auto& [member, reference] : declaration.members) {
    const auto& expected = composite->second;
    if (std::find(expected.begin(), expected.end(), member) == expected.end()) {
      error(reference.place, about,
            fmt::format("'{}' is no member of {}", member, prototype.semantic),
            did_you_mean(member, expected,
                         fmt::format("its members are {}", fmt::join(expected, ", "))));
      sound = false;
      continue;
    }
    const auto part = require_prototype(reference.value);
    if (!part) {
      if (!prototype_declarations_.count(reference.value)) {
        error(reference.place, about, fmt::format("there is no prototype '{}'", reference.value),
              did_you_mean(reference.value, names_of(prototype_declarations_),
                           "declare it with 'dproto'"));
      }
      sound = false;
      continue;
    }
    const Prototype& type = library_.prototypes[*part];
    if (type.semantic != member || type.domain != prototype.domain) {
      error(reference.place, about,
            fmt::format("'{}' means {}, not {}", reference.value, type.semantic, member),
            "compose prototypes of the members' meanings");
      sound = false;
      continue;
    }
    if (type.bindings.empty()) {
      error(reference.place, about,
            fmt::format("the numbers of '{}' are reached by functions only", reference.value),
            "compose prototypes with maps");
      sound = false;
      continue;
    }
    if (!found.emplace(member, *part).second) {
      error(reference.place, about, fmt::format("member '{}' is there twice", member),
            "leave one out");
      sound = false;
    }
  }
  if (!sound) return false;
  for (const std::string& member : composite->second) {
    if (!found.count(member)) {
      error(declaration.place, about,
            fmt::format("member '{}' of {} is missing", member, prototype.semantic),
            fmt::format("compose {}", fmt::join(composite->second, ", ")));
      return false;
    }
    prototype.members.emplace_back(member, found[member]);
  }
  std::map<std::string, const MapEntry*> places;
  for (const MapEntry& entry : declaration.map) {
    const std::string member =
        entry.right.braces || entry.right.steps.size() != 1 ? "" : entry.right.steps[0];
    if (entry.constant || entry.negative || !found.count(member) ||
        !places.emplace(member, &entry).second) {
      error(
          entry.place, about,
          fmt::format("'{}' is not one member of {}, given once", to_string(entry.right),
                      prototype.semantic),
          fmt::format("map parts of the representation to {}", fmt::join(composite->second, ", ")));
      return false;
    }
  }
  for (const std::string& member : composite->second) {
    if (declaration.has_map && !places.count(member)) {
      error(declaration.place, about, fmt::format("the map does not give the member '{}'", member),
            "map every member to a part of the representation");
      return false;
    }
  }
  if (!declaration.representation.given()) {
    // A struct of the members' own types.
    std::vector<Member> members;
    for (const auto& [member, part] : prototype.members) {
      const Representation& type = library_.prototypes[part].representation;
      const bool named = declaration.has_map;
      if (named && (places[member]->left.braces || places[member]->left.steps.size() != 1)) {
        error(places[member]->place, about,
              fmt::format("'{}' is no name of a struct's member", to_string(places[member]->left)),
              "give each member one name, or the composite a ddr of its own");
        return false;
      }
      members.push_back({named ? places[member]->left.steps[0] : member, type.type, 0, {}});
      prototype.representation.headers.insert(prototype.representation.headers.end(),
                                              type.headers.begin(), type.headers.end());
      prototype.representation.cpp_only |= type.cpp_only;
      prototype.representation.header_optional |= type.header_optional;
    }
    Type type = *struct_type("struct " + c_identifier(about), std::move(members));
    type.declared = true;
    prototype.representation.type = std::make_shared<const Type>(std::move(type));
    prototype.representation.context = "c99";
    return true;
  }
  const auto representation = representation_of(declaration.representation, about);
  if (!representation) return false;
  prototype.representation = *representation;
  if (!declaration.has_map) {
    error(declaration.place, about, "the prototype has no 'dr'",
          "map parts of the representation to members");
    return false;
  }
  for (const auto& [member, part] : prototype.members) {
    std::string why;
    const TypePointer type = find_part(representation->type, places[member]->left, nullptr, &why);
    if (!type) {
      error(places[member]->place, about,
            fmt::format("the representation has no '{}': {}", to_string(places[member]->left), why),
            "");
      return false;
    }
    if (!same_layout(*type, *library_.prototypes[part].representation.type)) {
      error(places[member]->place, about,
            fmt::format("'{}' of the representation has another layout than '{}'",
                        to_string(places[member]->left), library_.prototypes[part].name),
            "compose prototypes whose ddr is that of the part");
      return false;
    }
  }
  return true;
}

}  // namespace sinew::data
