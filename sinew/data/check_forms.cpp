// Algebraic forms, aliases between them, and units of their elements.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {

void LibraryBuilder::read_algebraics() {
  for (const AlgebraicDeclaration& declaration : declarations_.algebraics) {
    const Algebraic& algebraic = declaration.algebraic;
    std::set<std::string> names;
    for (const std::string& name : algebraic.names) {
      if (!names.insert(name).second) {
        error(declaration.place, declaration.name, fmt::format("'{}' is there twice", name),
              "every element needs a name of its own");
      }
    }
    if (algebraic.size() == 0 || algebraic.size() > kMaximumElements) {
      error(declaration.place, declaration.name,
            fmt::format("{} has {} elements", to_string(algebraic), algebraic.size()),
            fmt::format("it needs between 1 and {}", kMaximumElements));
      continue;
    }
    if (!algebraics_.emplace(declaration.name, algebraic).second) {
      error(declaration.place, declaration.name, "the algebraic form is declared twice",
            "rename one of them");
    }
  }
}

void LibraryBuilder::read_aliases() {
  // In order of the names, whatever the order of the file.
  std::vector<const AliasDeclaration*> sorted;
  for (const AliasDeclaration& declaration : declarations_.aliases) sorted.push_back(&declaration);
  std::sort(sorted.begin(), sorted.end(), [](const AliasDeclaration* a, const AliasDeclaration* b) {
    return std::tie(a->left, a->right, a->place.file, a->place.line) <
           std::tie(b->left, b->right, b->place.file, b->place.line);
  });
  for (const AliasDeclaration* declaration : sorted) {
    const std::string about = fmt::format("alias {} <-> {}", declaration->left, declaration->right);
    const Algebraic* sides[2] = {};
    for (int side = 0; side < 2; ++side) {
      const std::string& name = side == 0 ? declaration->left : declaration->right;
      const auto found = algebraics_.find(name);
      if (found == algebraics_.end()) {
        error(declaration->place, about, fmt::format("there is no algebraic form '{}'", name),
              did_you_mean(name, names_of(algebraics_), "declare it with 'algebraic'"));
      } else {
        sides[side] = &found->second;
      }
    }
    if (!sides[0] || !sides[1]) continue;
    if (declaration->left == declaration->right) {
      error(declaration->place, about, "an alias of a form with itself says nothing",
            "name two forms");
      continue;
    }
    ElementMap map;
    map.images.resize(sides[0]->size());
    std::vector<bool> left_given(sides[0]->size()), right_given(sides[1]->size());
    bool sound = true;
    const auto fail = [&](const MapEntry& entry, std::string what, std::string remedy) {
      error(entry.place, about, std::move(what), std::move(remedy));
      sound = false;
    };
    for (const MapEntry& entry : declaration->entries) {
      const auto left = element_of(*sides[0], entry.left);
      if (!left) {
        fail(entry,
             fmt::format("'{}' is no element of '{}'", to_string(entry.left), declaration->left),
             describe_accessors(*sides[0]));
        continue;
      }
      if (left_given[*left]) {
        fail(entry,
             fmt::format("'{}' of '{}' is given twice", to_string(entry.left), declaration->left),
             "give every element of each side once");
        continue;
      }
      left_given[*left] = true;
      if (entry.constant) {
        map.images[*left] = {std::nullopt, 1, *entry.constant};
        continue;
      }
      const auto right = element_of(*sides[1], entry.right);
      if (!right) {
        fail(entry,
             fmt::format("'{}' is no element of '{}'", to_string(entry.right), declaration->right),
             describe_accessors(*sides[1]));
        continue;
      }
      if (right_given[*right]) {
        fail(entry,
             fmt::format("'{}' of '{}' is given twice", to_string(entry.right), declaration->right),
             "give every element of each side once");
        continue;
      }
      right_given[*right] = true;
      map.images[*left] = {right, entry.negative ? -1.0 : 1.0, 0};
    }
    if (!sound) continue;
    for (int side = 0; side < 2; ++side) {
      const auto& given = side == 0 ? left_given : right_given;
      for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i]) continue;
        error(declaration->place, about,
              fmt::format("the map does not give '{}' of '{}'",
                          to_string(accessor_of(*sides[side], i)),
                          side == 0 ? declaration->left : declaration->right),
              "give every element of each side once");
        sound = false;
        break;
      }
    }
    if (!sound) continue;
    const auto known = aliases_.find(declaration->left, declaration->right, sides[0]->size());
    if (known && *known != map) {
      error(declaration->place, about, "the alias contradicts what other aliases say",
            "aliases that form a circle have to lead back to where they began");
      continue;
    }
    aliases_.add(declaration->left, declaration->right, map, sides[1]->size());
  }
}

void LibraryBuilder::read_units() {
  for (const UnitsDeclaration& declaration : declarations_.units) {
    if (units_.count(declaration.name)) {
      error(declaration.place, declaration.name, "the units are declared twice",
            "rename one of them");
      continue;
    }
    if (declaration.ontology != "qudt") {
      error(declaration.place, declaration.name,
            fmt::format("there is no table of units '{}'", declaration.ontology), "write qudt");
      continue;
    }
    const auto algebraic = algebraics_.find(declaration.algebraic);
    if (algebraic == algebraics_.end()) {
      error(declaration.place, declaration.name,
            fmt::format("there is no algebraic form '{}'", declaration.algebraic),
            did_you_mean(declaration.algebraic, names_of(algebraics_),
                         "declare it with 'algebraic'"));
      continue;
    }
    std::vector<std::optional<Unit>> found(algebraic->second.size());
    bool sound = true;
    for (const UnitEntry& entry : declaration.entries) {
      UnitProblem problem;
      const auto unit = UnitTable::shipped().find(entry.unit, &problem);
      const auto element = element_of(algebraic->second, entry.accessor);
      std::string what, remedy;
      if (!unit) {
        what = problem.what;
        remedy = problem.remedy;
      } else if (!element) {
        what = fmt::format("'{}' is no element of '{}'", to_string(entry.accessor),
                           declaration.algebraic);
        remedy = describe_accessors(algebraic->second);
      } else if (found[*element]) {
        what = fmt::format("'{}' has two units", to_string(entry.accessor));
        remedy = "give every element one";
      } else {
        found[*element] = unit;
        continue;
      }
      error(entry.place, declaration.name, what, remedy);
      sound = false;
    }
    Units units{&declaration, {}};
    for (std::size_t i = 0; i < found.size() && sound; ++i) {
      if (!found[i]) {
        error(declaration.place, declaration.name,
              fmt::format("'{}' of '{}' has no unit", to_string(accessor_of(algebraic->second, i)),
                          declaration.algebraic),
              "give every element one; 'unitless' where there is none");
        sound = false;
      } else {
        units.units.push_back(*found[i]);
      }
    }
    // Unsound units stay known, so that whoever refers to them is not blamed as well.
    if (!sound) units.units.clear();
    units_.emplace(declaration.name, std::move(units));
  }
}

}  // namespace sinew::data
