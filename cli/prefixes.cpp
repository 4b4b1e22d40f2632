#include "prefixes.h"

namespace sinew::cli {
namespace {

constexpr std::string_view kMetamodels = "https://comp-rob2b.github.io/metamodels/";

std::string metamodel(std::string_view rest) {
  return std::string(kMetamodels) + std::string(rest);
}

}  // namespace

const rdf::Prefixes& known_prefixes() {
  static const rdf::Prefixes prefixes = [] {
    rdf::Prefixes p;
    p.set("rdf", "http://www.w3.org/1999/02/22-rdf-syntax-ns#");
    p.set("rdfs", "http://www.w3.org/2000/01/rdf-schema#");
    p.set("xsd", "http://www.w3.org/2001/XMLSchema#");
    p.set("sh", "http://www.w3.org/ns/shacl#");
    p.set("qudt", "http://qudt.org/schema/qudt/");
    p.set("unit", "http://qudt.org/vocab/unit/");
    p.set("geom", metamodel("geometry/structural-entities#"));
    p.set("geom-rel", metamodel("geometry/spatial-relations#"));
    p.set("geom-coord", metamodel("geometry/coordinates#"));
    p.set("geom-op", metamodel("geometry/spatial-operators#"));
    p.set("kc", metamodel("kinematic-chain/structural-entities#"));
    p.set("kc-stat", metamodel("kinematic-chain/state#"));
    p.set("kc-op", metamodel("kinematic-chain/operators#"));
    p.set("dyn-ent", metamodel("newtonian-rigid-body-dynamics/structural-entities#"));
    p.set("dyn-coord", metamodel("newtonian-rigid-body-dynamics/coordinates#"));
    p.set("dyn-op", metamodel("newtonian-rigid-body-dynamics/operators#"));
    p.set("algo", metamodel("algorithm#"));
    p.set("tree", "https://w3id.org/sinew/kinematic-tree#");
    p.set("sa", "https://w3id.org/sinew/algorithm#");
    p.set("so", "https://w3id.org/sinew/operators#");
    p.set("sq", "https://w3id.org/sinew/query#");
    p.set("w", "https://w3id.org/sinew/world#");
    p.set("shape", "https://w3id.org/sinew/shape#");
    p.set("step", "https://w3id.org/sinew/steps#");
    return p;
  }();
  return prefixes;
}

}  // namespace sinew::cli
