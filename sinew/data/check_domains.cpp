// Domains: annotations, composites, coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {
namespace {

// The annotations that a prototype can carry; what is not among them has no syntax.
const std::vector<std::string> kAnnotations = {"semantic", "coord", "units",      "algebraic",
                                               "ddr",      "dr",    "convention", "composes"};

}  // namespace

bool Domain::has_coordinates_for(const std::string& semantic) const {
  return !coordinates_of(semantic).empty();
}

std::vector<std::string> Domain::coordinates_of(const std::string& semantic) const {
  std::vector<std::string> names;
  for (const auto& [key, ignored] : coordinates) {
    if (key.first == semantic) names.push_back(key.second);
  }
  return names;
}

std::vector<std::string> Domain::conventions_of(const std::string& semantic) const {
  std::vector<std::string> names;
  for (const ConventionDeclaration& convention : declaration->conventions) {
    for (const std::string& of : convention.semantics) {
      if (of == semantic) names.push_back(convention.name);
    }
  }
  return names;
}

bool Domain::is_optional(const std::string& name, const std::string& semantic) const {
  for (const ConventionDeclaration& convention : declaration->conventions) {
    if (convention.name != name || !convention.optional) continue;
    const auto& of = convention.semantics;
    if (std::find(of.begin(), of.end(), semantic) != of.end()) return true;
  }
  return false;
}

const AnnotationDeclaration* Domain::annotation(const std::string& name) const {
  for (const AnnotationDeclaration& annotation : declaration->annotations) {
    if (annotation.name == name) return &annotation;
  }
  return nullptr;
}

void LibraryBuilder::read_domains() {
  for (const DomainDeclaration& declaration : declarations_.domains) {
    if (domains_.count(declaration.name)) {
      error(declaration.place, declaration.name, "the domain is declared twice",
            "rename one of them");
      continue;
    }
    read_domain(declaration);
  }
  for (auto& [name, domain] : domains_) check_composites(domain);
}

void LibraryBuilder::read_domain(const DomainDeclaration& declaration) {
  Domain& domain = domains_[declaration.name];
  domain.declaration = &declaration;
  for (const std::string& older : declaration.older_names) {
    older_domain_names_[older] = declaration.name;
  }
  std::set<std::string> seen;
  for (const AnnotationDeclaration& annotation : declaration.annotations) {
    if (std::find(kAnnotations.begin(), kAnnotations.end(), annotation.name) ==
        kAnnotations.end()) {
      error(annotation.place, declaration.name,
            fmt::format("prototypes have no annotation '{}'", annotation.name),
            did_you_mean(annotation.name, kAnnotations,
                         fmt::format("use one of {}", fmt::join(kAnnotations, ", "))));
    }
    if (!seen.insert(annotation.name).second) {
      error(annotation.place, declaration.name,
            fmt::format("annotation '{}' is there twice", annotation.name), "leave one out");
    }
    if (annotation.name == "semantic") {
      domain.semantics.insert(annotation.values.begin(), annotation.values.end());
    }
  }
  for (const CompositeDeclaration& composite : declaration.composites) {
    if (!domain.composites.emplace(composite.name, composite.members).second) {
      error(composite.place, declaration.name,
            fmt::format("composite '{}' is declared twice", composite.name), "leave one out");
    }
    domain.semantics.insert(composite.name);
  }
  for (const CoordinatesDeclaration& coordinates : declaration.coordinates) {
    read_coordinates(domain, coordinates);
  }
  for (const ConventionDeclaration& convention : declaration.conventions) {
    for (const std::string& semantic : convention.semantics) {
      if (domain.semantics.count(semantic)) continue;
      error(
          convention.place, declaration.name,
          fmt::format("convention '{}' is of the unknown meaning '{}'", convention.name, semantic),
          did_you_mean(semantic,
                       std::vector<std::string>(domain.semantics.begin(), domain.semantics.end()),
                       "list it under 'semantic'"));
    }
  }
}

void LibraryBuilder::read_coordinates(Domain& domain, const CoordinatesDeclaration& declaration) {
  const std::string& about = domain.declaration->name;
  Coordinates coordinates;
  coordinates.declaration = &declaration;
  std::set<std::string> names;
  for (const ParameterDeclaration& parameter : declaration.parameters) {
    if (!names.insert(parameter.name).second) {
      error(parameter.place, about,
            fmt::format("coordinates '{}' have the parameter '{}' twice", declaration.name,
                        parameter.name),
            "rename one of them");
    }
    Space::Slot slot{parameter.name, {}, parameter.unit, parameter.constant};
    if (!parameter.constant) {
      UnitProblem problem;
      const auto unit = UnitTable::shipped().find(parameter.unit, &problem);
      if (!unit) {
        error(parameter.place, about, problem.what, problem.remedy);
      } else if (unit->scale != 1 || unit->offset != 0) {
        error(parameter.place, about,
              fmt::format("parameter '{}' is in '{}'", parameter.name, parameter.unit),
              "formulas are in coherent SI units: give the SI unit, and the prototype its own");
      } else {
        slot.dimension = unit->dimension;
      }
    }
    coordinates.slots.push_back(std::move(slot));
  }
  if (coordinates.slots.empty()) {
    error(declaration.place, about,
          fmt::format("coordinates '{}' have no parameters", declaration.name), "name them");
  }
  if (declaration.shape && declaration.shape->size() != coordinates.slots.size()) {
    error(declaration.place, about,
          fmt::format("coordinates '{}' have {} parameters but the shape {}", declaration.name,
                      coordinates.slots.size(), to_string(*declaration.shape)),
          "give one parameter for each element");
  }
  for (const std::string& semantic : declaration.semantics) {
    if (!domain.semantics.count(semantic)) {
      error(declaration.place, about,
            fmt::format("coordinates '{}' are of the unknown meaning '{}'", declaration.name,
                        semantic),
            did_you_mean(semantic,
                         std::vector<std::string>(domain.semantics.begin(), domain.semantics.end()),
                         "list it under 'semantic'"));
    }
    if (!domain.coordinates.emplace(std::pair(semantic, declaration.name), coordinates).second) {
      error(declaration.place, about,
            fmt::format("coordinates '{}' of {} are declared twice", declaration.name, semantic),
            "leave one out");
    }
  }
}

void LibraryBuilder::check_composites(const Domain& domain) {
  const std::string& about = domain.declaration->name;
  std::set<std::string> finished, open;
  const std::function<bool(const std::string&)> cyclic = [&](const std::string& name) {
    const auto composite = domain.composites.find(name);
    if (composite == domain.composites.end() || finished.count(name)) return false;
    if (!open.insert(name).second) return true;
    for (const std::string& member : composite->second) {
      if (cyclic(member)) return true;
    }
    open.erase(name);
    finished.insert(name);
    return false;
  };
  for (const CompositeDeclaration& composite : domain.declaration->composites) {
    std::set<std::string> members;
    for (const std::string& member : composite.members) {
      if (!domain.semantics.count(member)) {
        error(
            composite.place, about,
            fmt::format("composite '{}' has the unknown member '{}'", composite.name, member),
            did_you_mean(member,
                         std::vector<std::string>(domain.semantics.begin(), domain.semantics.end()),
                         "list it under 'semantic'"));
      }
      if (!members.insert(member).second) {
        error(composite.place, about,
              fmt::format("composite '{}' has the member '{}' twice", composite.name, member),
              "leave one out");
      }
    }
    if (cyclic(composite.name)) {
      error(composite.place, about, fmt::format("composite '{}' contains itself", composite.name),
            "a composite is made of simpler meanings");
      return;
    }
  }
}

const Domain* LibraryBuilder::find_domain(const Field& name, const std::string& about) {
  const auto found = domains_.find(name.value);
  if (found != domains_.end()) return &found->second;
  const auto older = older_domain_names_.find(name.value);
  if (older != older_domain_names_.end()) {
    report_.warning(name.place, about, fmt::format("'{}' is an older name", name.value),
                    fmt::format("write '{}'", older->second));
    return &domains_.at(older->second);
  }
  error(name.place, about, fmt::format("there is no domain '{}'", name.value),
        did_you_mean(name.value, names_of(domains_), "declare it with 'domain'"));
  return nullptr;
}

}  // namespace sinew::data
