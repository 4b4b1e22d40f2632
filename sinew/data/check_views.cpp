// Views: a part of a plain prototype that means something by itself, described by another
// prototype.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/data/library_builder.h"
#include "sinew/data/spelling.h"

namespace sinew::data {

void LibraryBuilder::read_views() {
  std::map<std::string, std::map<std::string, const ViewDeclaration*>> by_prototype;
  for (const ViewDeclaration& view : declarations_.views) {
    const std::string about = fmt::format("view {}.{}", view.prototype, view.member);
    if (!prototype_declarations_.count(view.prototype)) {
      error(view.place, about, fmt::format("there is no prototype '{}'", view.prototype),
            did_you_mean(view.prototype, names_of(prototype_declarations_),
                         "declare it with 'dproto'"));
    } else if (!by_prototype[view.prototype].emplace(view.member, &view).second) {
      error(view.place, about, "the part has two views", "leave one out");
    }
  }
  for (const auto& [name, views] : by_prototype) {
    const auto whole = prototypes_.find(name);
    if (whole == prototypes_.end()) continue;  // reported where it was read
    const Index index = whole->second;
    const std::string semantic = library_.prototypes[index].semantic;
    const Domain& domain = domains_.at(library_.prototypes[index].domain);
    std::map<std::string, Index> parts;
    std::set<std::size_t> covered;
    for (const auto& [member, view] : views) {
      if (const auto part = read_view(*view, index, covered)) parts[member] = *part;
    }
    // With a view for every member the prototype can be taken apart and, if nothing is left
    // undefined, put together.
    const auto composite = domain.composites.find(semantic);
    if (composite == domain.composites.end() || parts.size() != composite->second.size()) continue;
    for (const std::string& member : composite->second) {
      library_.prototypes[index].members.emplace_back(member, parts.at(member));
    }
    const PlainElements& elements = plain_elements_.at(index);
    bool whole_covered = true;
    for (std::size_t i = 0; i < elements.elements.size(); ++i) {
      whole_covered &= elements.elements[i].constant || covered.count(i);
    }
    bind_members(index, whole_covered);
  }
}

std::optional<Index> LibraryBuilder::read_view(const ViewDeclaration& view, Index whole,
                                               std::set<std::size_t>& covered) {
  const std::string about = fmt::format("view {}.{}", view.prototype, view.member);
  const auto fail = [&](const Place& place, std::string what, std::string remedy) {
    error(place, about, std::move(what), std::move(remedy));
    return std::nullopt;
  };
  const Prototype& owner = library_.prototypes[whole];
  const Domain& domain = domains_.at(owner.domain);
  const auto details = plain_elements_.find(whole);
  if (details == plain_elements_.end()) {
    return fail(view.place, fmt::format("'{}' is composed of prototypes", view.prototype),
                "its members are parts already; views are of plain prototypes");
  }
  const auto composite = domain.composites.find(owner.semantic);
  if (composite == domain.composites.end()) {
    return fail(view.place,
                fmt::format("'{}' means {}, which is no composite", view.prototype, owner.semantic),
                fmt::format("composites are {}", fmt::join(names_of(domain.composites), ", ")));
  }
  const auto& members = composite->second;
  if (std::find(members.begin(), members.end(), view.member) == members.end()) {
    return fail(view.place, fmt::format("'{}' is no member of {}", view.member, owner.semantic),
                did_you_mean(view.member, members,
                             fmt::format("its members are {}", fmt::join(members, ", "))));
  }
  if (!view.function.empty()) {
    return fail(view.place,
                fmt::format("a view by the function '{}' is not a part of memory", view.function),
                "give the map of the elements, or declare a conversion");
  }
  const auto target_index = prototypes_.find(view.target);
  if (target_index == prototypes_.end()) {
    if (prototype_declarations_.count(view.target)) return std::nullopt;
    return fail(
        view.place, fmt::format("there is no prototype '{}'", view.target),
        did_you_mean(view.target, names_of(prototype_declarations_), "declare it with 'dproto'"));
  }
  const Prototype& target = library_.prototypes[target_index->second];
  const auto target_details = plain_elements_.find(target_index->second);
  if (target.semantic != view.member || target_details == plain_elements_.end()) {
    return fail(view.place,
                fmt::format("'{}' is no plain prototype of {}", view.target, view.member),
                "a view's target means what the member means");
  }
  const Algebraic& left_form = details->second.form;
  const Algebraic& right_form = target_details->second.form;
  Prototype part = target;
  part.name = view.prototype + "." + view.member;
  part.place = view.place;
  part.owner = whole;
  part.representation = owner.representation;
  part.bindings.clear();
  part.constants.clear();
  part.members.clear();
  Binding binding{target.bindings.front().space, {}, true};
  std::set<std::size_t> left_given, right_given;
  bool sound = true;
  for (const MapEntry& entry : view.entries) {
    const auto wrong = [&](std::string what, std::string remedy) {
      error(entry.place, about, std::move(what), std::move(remedy));
      sound = false;
    };
    const auto left = element_of(left_form, entry.left);
    if (!left) {
      wrong(fmt::format("'{}' is no element of '{}'", to_string(entry.left), owner.algebraic),
            describe_accessors(left_form));
      continue;
    }
    if (!left_given.insert(*left).second) {
      wrong(fmt::format("'{}' is mapped twice", to_string(entry.left)), "map every element once");
      continue;
    }
    const PlainElements::Element& element = details->second.elements[*left];
    if (entry.constant) {
      if (element.access)
        part.constants.push_back({*element.access, *entry.constant / element.scale});
      covered.insert(*left);
      continue;
    }
    const auto right = element_of(right_form, entry.right);
    if (!right) {
      wrong(fmt::format("'{}' is no element of '{}'", to_string(entry.right), target.algebraic),
            describe_accessors(right_form));
      continue;
    }
    if (!right_given.insert(*right).second) {
      wrong(fmt::format("'{}' of '{}' is mapped twice", to_string(entry.right), view.target),
            "map every element once");
      continue;
    }
    if (!element.access) {
      wrong(fmt::format("'{}' has no place in memory", to_string(entry.left)),
            "view elements that do");
      continue;
    }
    covered.insert(*left);
    const ElementMap::Image& image = target_details->second.to_slots.images[*right];
    if (!image.element) continue;
    const PlainElements::Element& meant = target_details->second.elements[*right];
    if (element.unit.dimension != meant.unit.dimension) {
      wrong(fmt::format("'{}' of '{}' is in {} ({}), '{}' of '{}' in {} ({})",
                        to_string(entry.left), view.prototype, element.unit.name,
                        to_string(element.unit.dimension), to_string(entry.right), view.target,
                        meant.unit.name, to_string(meant.unit.dimension)),
            "a view's elements have the same dimension");
      continue;
    }
    const double sign = image.sign * (entry.negative ? -1.0 : 1.0);
    binding.slots.push_back({*image.element, *element.access, sign * element.scale,
                             sign * element.offset, element.unit});
  }
  if (!sound) return std::nullopt;
  for (std::size_t i = 0; i < right_form.size(); ++i) {
    if (right_given.count(i) || target_details->second.elements[i].constant) continue;
    return fail(view.place,
                fmt::format("the map does not give '{}' of '{}'",
                            to_string(accessor_of(right_form, i)), view.target),
                "map every element of the target");
  }
  std::sort(binding.slots.begin(), binding.slots.end(),
            [](const SlotBinding& a, const SlotBinding& b) { return a.slot < b.slot; });
  part.bindings.push_back(std::move(binding));
  library_.prototypes.push_back(std::move(part));
  const Index index = library_.prototypes.size() - 1;
  prototypes_[library_.prototypes[index].name] = index;
  return index;
}

}  // namespace sinew::data
