#include "sinew/world/declared_scene.h"

#include <algorithm>

#include "sinew/world/refuse.h"

namespace sinew::world {

std::string DeclaredScene::find(std::string_view iri_or_label) const {
  for (const DeclaredBody& body : bodies) {
    if (body.iri == iri_or_label) return body.iri;
  }
  std::string found;
  for (const auto& [iri, label] : labels) {
    if (label != iri_or_label) continue;
    if (!found.empty()) {
      refuse(iri_or_label, "is the label of " + found + " and of " + iri, "say which by its IRI");
    }
    found = iri;
  }
  return found;
}

void add_bodies(Space& space, const DeclaredScene& scene) {
  const World& world = space.world();
  for (const DeclaredBody& body : scene.bodies) {
    if (body.shapes.empty()) continue;
    std::vector<Shape> shapes;
    for (const DeclaredShape& declared : body.shapes) {
      if (declared.seen_by == body.frame) {
        shapes.push_back(declared.shape);
        continue;
      }
      PreparedPose between =
          world.prepare_pose({.of = declared.seen_by, .with_respect_to = body.frame});
      const PoseAnswer X = between.latest(Stamp());
      if (!X || between.measured_steps() > 0) {
        refuse(body.iri,
               "a shape is seen by " + world.name(declared.seen_by) + ", which is not fixed to " +
                   world.name(body.frame),
               "see it from the body's own frame, or from one with a static pose in it");
      }
      shapes.push_back(placed(X.pose, declared.shape));
    }
    switch (body.kind) {
      case DeclaredKind::kObject:
        space.add(world.find_object(body.iri), std::move(shapes));
        break;
      case DeclaredKind::kFrame:
        space.add(body.frame, std::move(shapes));
        break;
      case DeclaredKind::kArea:
        space.add_area(body.iri, body.frame, std::move(shapes));
        break;
    }
  }
}

Uncertainties uncertainties_of(const World& world, const DeclaredScene& scene) {
  Uncertainties known;
  for (const DeclaredCovariance& declared : scene.covariances) {
    if (const auto* deviation = std::get_if<double>(&declared.value)) {
      known.set_joint(world, declared.measurement, *deviation);
    } else if (const auto* S = std::get_if<Covariance>(&declared.value)) {
      known.set(world, declared.measurement, *S);
    } else {
      known.set_exact(declared.measurement);
    }
  }
  return known;
}

std::vector<Rule> rules_of(const DeclaredScene& scene) {
  std::vector<Rule> rules = usual_rules();
  for (const DeclaredRule& declared : scene.rules) {
    const auto same = std::find_if(rules.begin(), rules.end(), [&](const Rule& rule) {
      return rule.name == declared.rule.name;
    });
    if (same == rules.end()) {
      rules.push_back(declared.rule);
    } else {
      *same = declared.rule;
    }
  }
  return rules;
}

Relations relations_of(const Space& space, const DeclaredScene& scene) {
  Relations relations(space, rules_of(scene));
  for (const DeclaredBody& body : scene.bodies) {
    for (const DeclaredNumber& number : body.numbers) {
      relations.declare(space.find(body.iri), number.property, number.value);
    }
  }
  return relations;
}

}  // namespace sinew::world
