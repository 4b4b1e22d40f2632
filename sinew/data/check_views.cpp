// Views: a part of a plain prototype that means something by itself, described by another
// prototype.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {

void LibraryBuilder::read_views() {
  std::map<std::pair<std::string, std::string>, const ViewDeclaration*> seen;
  for (const ViewDeclaration& view : declarations_.views) {
    const std::string about = fmt::format("view {}.{}", view.prototype, view.member);
    if (!prototype_declarations_.count(view.prototype)) {
      error(view.place, about, fmt::format("there is no prototype '{}'", view.prototype),
            did_you_mean(view.prototype, names_of(prototype_declarations_),
                         "declare it with 'dproto'"));
      continue;
    }
    // Two functions may view one part: one reads it, the other writes it.
    const auto [known, added] = seen.try_emplace({view.prototype, view.member}, &view);
    if (!added && (view.function.empty() || known->second->function.empty())) {
      error(view.place, about, "the part has two views", "leave one out");
    }
  }
  for (const auto& [names, view] : seen) {
    const auto whole = prototypes_.find(names.first);
    if (whole == prototypes_.end() || !view->function.empty()) continue;
    if (const auto part = read_view(*view, whole->second, covered_[whole->second])) {
      views_[whole->second][names.second] = {*part, true, true, {}, {}};
    }
  }
}

bool LibraryBuilder::check_member(const ViewDeclaration& view, const Prototype& owner) {
  const std::string about = fmt::format("view {}.{}", view.prototype, view.member);
  const auto& composites = domains_.at(owner.domain).composites;
  const auto composite = composites.find(owner.semantic);
  if (composite == composites.end()) {
    error(view.place, about,
          fmt::format("'{}' means {}, which is no composite", view.prototype, owner.semantic),
          fmt::format("composites are {}", fmt::join(names_of(composites), ", ")));
    return false;
  }
  const auto& members = composite->second;
  if (std::find(members.begin(), members.end(), view.member) == members.end()) {
    error(view.place, about, fmt::format("'{}' is no member of {}", view.member, owner.semantic),
          did_you_mean(view.member, members,
                       fmt::format("its members are {}", fmt::join(members, ", "))));
    return false;
  }
  return true;
}

// A part that a function reads (whole <=, part =>) or writes (part <=, whole <=>): no place in
// memory, but a prototype from which and to which the function leads.
void LibraryBuilder::read_function_views() {
  for (const ViewDeclaration& view : declarations_.views) {
    if (view.function.empty()) continue;
    const std::string about = fmt::format("view {}.{}", view.prototype, view.member);
    const auto fail = [&](std::string what, std::string remedy) {
      error(view.place, about, std::move(what), std::move(remedy));
    };
    const auto whole = prototypes_.find(view.prototype), target = prototypes_.find(view.target);
    if (target == prototypes_.end() && !unsound_prototypes_.count(view.target)) {
      fail(
          fmt::format("there is no prototype '{}'", view.target),
          did_you_mean(view.target, names_of(prototype_declarations_), "declare it with 'dproto'"));
    }
    const auto known = functions_.find(view.function);
    if (known == functions_.end()) {
      std::vector<std::string> declared;
      for (const FunctionDeclaration& it : declarations_.functions) declared.push_back(it.name);
      if (std::find(declared.begin(), declared.end(), view.function) == declared.end()) {
        fail(fmt::format("there is no function '{}'", view.function),
             did_you_mean(view.function, declared, "declare it with 'fproto'"));
      }
    }
    if (whole == prototypes_.end() || target == prototypes_.end() || known == functions_.end()) {
      continue;  // reported
    }
    const Index index = whole->second, member = target->second;
    if (!check_member(view, library_.prototypes[index])) continue;
    if (library_.prototypes[member].semantic != view.member) {
      fail(fmt::format("'{}' means {}, not {}", view.target, library_.prototypes[member].semantic,
                       view.member),
           "a view's target means what the member means");
      continue;
    }
    const Function& function = library_.functions[known->second];
    const auto has = [&](bool input, bool in_place, Index prototype) {
      return std::any_of(function.arguments.begin(), function.arguments.end(),
                         [&](const Function::Argument& argument) {
                           return argument.input == input && argument.in_place == in_place &&
                                  argument.prototype == prototype;
                         });
    };
    const bool two = function.arguments.size() == 2;
    const bool reads = two && has(true, false, index) && has(false, false, member);
    const bool writes = two && has(true, false, member) && has(false, true, index);
    if (!reads && !writes) {
      fail(fmt::format("the function '{}' neither reads nor writes the part", function.name),
           fmt::format("to read: <= {0}, => {1}; to write: <= {1}, <=> {0}", view.prototype,
                       view.target));
      continue;
    }
    auto [part, added] = views_[index].try_emplace(view.member);
    if (added) {
      const Prototype& owner = library_.prototypes[index];
      Prototype made;
      made.name = view.prototype + "." + view.member;
      made.place = view.place;
      made.domain = owner.domain;
      made.semantic = view.member;
      made.coordinates = library_.prototypes[member].coordinates;
      made.algebraic = library_.prototypes[member].algebraic;
      made.representation = owner.representation;
      made.owner = index;
      library_.prototypes.push_back(std::move(made));
      part->second.part = library_.prototypes.size() - 1;
      prototypes_[library_.prototypes.back().name] = part->second.part;
    }
    bool& way = reads ? part->second.readable : part->second.writable;
    if (way) {
      fail(fmt::format("two functions {} the part", reads ? "read" : "write"), "leave one out");
      continue;
    }
    way = true;
    (reads ? part->second.read_as : part->second.written_from) = member;
    library_.function_edges.push_back({reads ? part->second.part : member,
                                       reads ? member : part->second.part,
                                       known->second,
                                       kUnknownFunctionCost,
                                       false,
                                       false,
                                       {},
                                       view.place,
                                       {}});
  }
}

// With a view for every member the prototype can be taken apart and, if nothing is left undefined,
// put together. What a function writes is the function's own business.
void LibraryBuilder::finish_views() {
  for (const auto& [index, parts] : views_) {
    const Domain& domain = domains_.at(library_.prototypes[index].domain);
    const auto composite = domain.composites.find(library_.prototypes[index].semantic);
    if (composite == domain.composites.end() || parts.size() != composite->second.size()) continue;
    bool readable = true, writable = true, mapped = true;
    std::vector<std::pair<std::string, Index>> read, written;
    for (const std::string& member : composite->second) {
      const View& view = parts.at(member);
      library_.prototypes[index].members.emplace_back(member, view.part);
      const auto& bindings = library_.prototypes[view.part].bindings;
      mapped &= !bindings.empty();
      readable &= view.readable;
      writable &= view.writable;
      const auto space_of = [&](const std::optional<Index>& prototype) {
        const auto& there = prototype ? library_.prototypes[*prototype].bindings : bindings;
        return there.empty() ? std::optional<Index>() : std::optional(there.front().space);
      };
      if (const auto space = space_of(view.read_as)) read.emplace_back(member, *space);
      if (const auto space = space_of(view.written_from)) written.emplace_back(member, *space);
    }
    if (mapped) {
      const PlainElements& elements = plain_elements_.at(index);
      bool whole_covered = true;
      for (std::size_t i = 0; i < elements.elements.size(); ++i) {
        whole_covered &= elements.elements[i].constant || covered_[index].count(i);
      }
      bind_members(index, whole_covered);
      continue;
    }
    const std::string domain_name = library_.prototypes[index].domain;
    const std::string semantic = library_.prototypes[index].semantic;
    if (readable && read.size() == parts.size()) {
      library_.prototypes[index].taken_apart = composed_space(domain_name, semantic, read);
    }
    if (writable && written.size() == parts.size()) {
      library_.prototypes[index].put_together = composed_space(domain_name, semantic, written);
    }
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
  const auto details = plain_elements_.find(whole);
  if (details == plain_elements_.end()) {
    return fail(view.place, fmt::format("'{}' is composed of prototypes", view.prototype),
                "its members are parts already; views are of plain prototypes");
  }
  if (!check_member(view, owner)) return std::nullopt;
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
