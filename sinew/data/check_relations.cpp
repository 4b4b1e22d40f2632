// Conventions that can change: how a domain computes with relations between frames, what a value
// becomes when it is told another frame or point, and the relations that a file gives.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {
namespace {

std::vector<FormulaParameter> parameters(const std::vector<Space::Slot>& slots,
                                         const std::string& prefix, bool constants) {
  std::vector<FormulaParameter> result;
  for (const Space::Slot& slot : slots) {
    if (constants || !slot.constant) result.push_back({prefix + slot.name, slot.dimension});
  }
  return result;
}

void append(std::vector<FormulaParameter>& all, const std::vector<FormulaParameter>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void LibraryBuilder::read_changes() {
  for (const auto& [name, domain] : domains_) {
    for (const RelationRuleDeclaration& rule : domain.declaration->relation_rules) {
      read_relation_rule(domain, rule);
    }
    for (const ChangeDeclaration& change : domain.declaration->changes) read_change(domain, change);
  }
}

void LibraryBuilder::read_relation_rule(const Domain& domain,
                                        const RelationRuleDeclaration& declaration) {
  const std::string& about = domain.declaration->name;
  const auto found = domain.coordinates.find({declaration.semantic, declaration.coordinates});
  if (found == domain.coordinates.end()) {
    return error(
        declaration.place, about,
        fmt::format("{} has no coordinates '{}'", declaration.semantic, declaration.coordinates),
        "relations are computed with in coordinates of the domain");
  }
  if (library_.relation_rules.count(about)) {
    return error(declaration.place, about, "the domain says twice how relations are put together",
                 "leave one out");
  }
  const std::vector<Space::Slot>& slots = found->second.slots;
  const auto outputs = parameters(slots, "", false);
  std::vector<FormulaParameter> both = parameters(slots, "first.", true);
  append(both, parameters(slots, "second.", true));
  const auto read = [&](const FormulaText& text, const std::vector<FormulaParameter>& inputs) {
    return read_formula(text.text, text.place, inputs, outputs, about);
  };
  const auto identity = read(declaration.identity, {});
  const auto inverse = read(declaration.inverse, parameters(slots, "", true));
  const auto product = read(declaration.product, both);
  if (!identity || !inverse || !product) return;
  library_.relation_rules.emplace(about, RelationRule{declaration.coordinates, declaration.semantic,
                                                      slots, *identity, *inverse, *product});
}

void LibraryBuilder::read_change(const Domain& domain, const ChangeDeclaration& declaration) {
  const std::string& about = domain.declaration->name;
  const auto rule = library_.relation_rules.find(about);
  if (!declaration.inputs.empty() && rule == library_.relation_rules.end()) {
    return error(declaration.place, about, "the domain does not say how relations are put together",
                 "declare a relation with its identity, inverse and product");
  }
  for (const std::string& semantic : declaration.semantics) {
    const auto conventions = domain.conventions_of(semantic);
    if (std::find(conventions.begin(), conventions.end(), declaration.convention) ==
        conventions.end()) {
      error(declaration.place, about,
            fmt::format("{} has no convention '{}'", semantic, declaration.convention),
            did_you_mean(declaration.convention, conventions, "declare it with 'convention'"));
      continue;
    }
    const auto found = domain.coordinates.find({semantic, declaration.coordinates});
    if (found == domain.coordinates.end()) {
      error(declaration.place, about,
            fmt::format("{} has no coordinates '{}'", semantic, declaration.coordinates),
            did_you_mean(declaration.coordinates, domain.coordinates_of(semantic),
                         "declare them with 'coordinates'"));
      continue;
    }
    ConventionChange change{declaration.convention, {}, declaration.inputs, declaration.needs, 0};
    std::vector<FormulaParameter> inputs = parameters(found->second.slots, "", true);
    bool sound = true;
    for (const ChangeInput& input : declaration.inputs) {
      for (const std::string& frame : {input.of, input.in}) {
        const bool known =
            frame == "old" || frame == "new" ||
            (frame != declaration.convention &&
             std::find(conventions.begin(), conventions.end(), frame) != conventions.end());
        if (known) continue;
        error(input.place, about, fmt::format("'{}' names no frame of the value", frame),
              "write old, new, or another of its conventions");
        sound = false;
      }
      append(inputs, parameters(rule->second.slots, input.name + ".", true));
    }
    if (sound && declaration.needs.empty()) {
      const auto formula = read_formula(declaration.formula.text, declaration.formula.place, inputs,
                                        parameters(found->second.slots, "", false), about);
      if (!formula) return;  // the same fault for each meaning is told once
      change.formula = *formula;
      change.cost = formula->graph.cost(formula->outputs);
    }
    const Library::ChangeKey key{about, semantic, declaration.coordinates, declaration.convention};
    if (!library_.changes.emplace(key, std::move(change)).second) {
      error(declaration.place, about,
            fmt::format("the change of {} for {} is there twice", declaration.convention, semantic),
            "leave one out");
    }
  }
}

void LibraryBuilder::read_relations() {
  std::map<std::pair<std::string, std::string>, const RelationDeclaration*> seen;
  for (const RelationDeclaration& declaration : declarations_.relations) {
    const std::string about =
        fmt::format("relation {} in {}", declaration.frame, declaration.reference);
    bool sound = true;
    const auto fail = [&](const Place& place, std::string what, std::string remedy) {
      error(place, about, std::move(what), std::move(remedy));
      sound = false;
    };
    if (declaration.frame == declaration.reference) {
      fail(declaration.place, "a frame is related to itself", "name two frames");
      continue;
    }
    const auto pair = std::minmax(declaration.frame, declaration.reference);
    if (!seen.emplace(std::pair<std::string, std::string>(pair), &declaration).second) {
      fail(declaration.place, "the two frames are related twice", "leave one out");
      continue;
    }
    const auto found = prototypes_.find(declaration.prototype);
    if (found == prototypes_.end()) {
      if (!unsound_prototypes_.count(declaration.prototype)) {
        fail(declaration.place, fmt::format("there is no prototype '{}'", declaration.prototype),
             did_you_mean(declaration.prototype, names_of(prototype_declarations_),
                          "declare it with 'dproto'"));
      }
      continue;
    }
    const Prototype& prototype = library_.prototypes[found->second];
    const auto rule = library_.relation_rules.find(prototype.domain);
    if (rule == library_.relation_rules.end() || rule->second.semantic != prototype.semantic) {
      fail(
          declaration.place,
          fmt::format("'{}' means {}, which relates no frames", prototype.name, prototype.semantic),
          rule == library_.relation_rules.end()
              ? fmt::format("the domain {} declares no relation", prototype.domain)
              : fmt::format("use a prototype of {}", rule->second.semantic));
      continue;
    }
    if (prototype.bindings.empty()) {
      fail(declaration.place,
           fmt::format("the numbers of '{}' are reached by functions only", prototype.name),
           "use a prototype with a map");
      continue;
    }
    Relation relation;
    relation.frame = declaration.frame;
    relation.reference = declaration.reference;
    relation.domain = prototype.domain;
    relation.prototype = found->second;
    relation.constant = declaration.constant;
    relation.place = declaration.place;
    for (const MapEntry& entry : declaration.entries) {
      std::string why;
      const auto access = find_access(*prototype.representation.type, entry.left, &why);
      if (!entry.constant) {
        fail(entry.place, fmt::format("'{}' is given no number", to_string(entry.left)),
             "write PART = const NUMBER");
      } else if (!access) {
        fail(entry.place,
             fmt::format("the representation has no '{}': {}", to_string(entry.left), why), "");
      } else if (!relation.values.emplace(access->source, *entry.constant).second) {
        fail(entry.place, fmt::format("'{}' is given twice", to_string(entry.left)),
             "give every number once");
      }
    }
    for (const Binding& binding : prototype.bindings) {
      for (const SlotBinding& slot : binding.slots) {
        if (!declaration.constant || !sound || relation.values.count(slot.access.source)) continue;
        fail(declaration.place,
             fmt::format("the numbers do not give '{}'", slot.access.source.substr(1)),
             "give every number of the prototype");
      }
    }
    if (!sound) continue;
    relation.space = plain_space(prototype.domain, rule->second.semantic, rule->second.coordinates,
                                 convention_of(library_, prototype.bindings.front().space));
    library_.relations.push_back(std::move(relation));
  }
}

}  // namespace sinew::data
