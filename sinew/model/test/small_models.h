// Models of a few links for tests, written as URDF or as Turtle in the published vocabulary.
#pragma once

#include <string>
#include <string_view>

#include "models.h"

namespace sinew::model::test {

inline void load_texts(Model& model, const std::vector<Source>& sources,
                       const LoadOptions& options = {}) {
  load(sources, options, model.store, model.places, model.report);
}

inline void normalise_texts(Model& model, const std::vector<Source>& sources,
                            const NormaliseOptions& options = {}) {
  load_texts(model, sources);
  if (model.report.has_errors()) return;
  model.tree = normalise(model.store, model.places, options, model.report);
}

inline Source urdf(const std::string& body) {
  return {"robot.urdf", "<robot name=\"r\">\n" + body + "</robot>\n"};
}

inline constexpr std::string_view kPrefixes = R"(
@prefix : <https://example.org/r#> .
@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .
@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .
@prefix coord: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .
@prefix kc: <https://comp-rob2b.github.io/metamodels/kinematic-chain/structural-entities#> .
@prefix skc: <https://w3id.org/sinew/kinematic-chain#> .
@prefix dyn: <https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/structural-entities#> .
@prefix dync: <https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/coordinates#> .
@prefix qudt: <http://qudt.org/schema/qudt/> .
@prefix unit: <http://qudt.org/vocab/unit/> .
)";

inline Source turtle(const std::string& body) {
  return {"model.ttl", std::string(kPrefixes) + body};
}

// A link NAME with a frame NAME-root and further frames, all with z axes and origins.
inline std::string link(const std::string& name, const std::vector<std::string>& frames = {}) {
  std::string simplices, text;
  const auto add = [&](const std::string& frame) {
    simplices += (simplices.empty() ? ":" : ", :") + frame + ", :" + frame + "-origin";
    text += ":" + frame + " a geom:Frame ; geom:origin :" + frame +
            "-origin ; geom:vector-z :" + frame + "-z .\n:" + frame +
            "-origin a geom:Point .\n:" + frame +
            "-z a geom:Vector, geom:BoundVector ; geom:start :" + frame + "-origin .\n";
  };
  add(name + "-root");
  for (const std::string& frame : frames) add(frame);
  return ":" + name + " a geom:SimplicialComplex ; geom:simplices " + simplices + " .\n" + text;
}

// A pose of frame `of` in frame `wrt`: turned a quarter about x (or not), and moved.
inline std::string pose(const std::string& of, const std::string& wrt, const std::string& xyz,
                        bool quarter_about_x = false, const std::string& length_unit = "M") {
  const std::string id = ":pose-" + of + "-" + wrt;
  const std::string y = quarter_about_x ? "(0 0 1)" : "(0 1 0)";
  const std::string z = quarter_about_x ? "(0 -1 0)" : "(0 0 1)";
  std::string x[3];
  std::size_t at = 0;
  for (std::string& number : x) {
    const std::size_t end = std::min(xyz.find(' ', at), xyz.size());
    number = xyz.substr(at, end - at);
    at = std::min(end + 1, xyz.size());
  }
  return id + " a rel:Pose ; rel:of :" + of + " ; rel:with-respect-to :" + wrt + " .\n" + id +
         "-coord a coord:PoseCoordinate ; coord:of-pose " + id + " ; coord:as-seen-by :" + wrt +
         " ; qudt:unit unit:UNITLESS, unit:" + length_unit +
         " ; coord:direction-cosine-x (1 0 0) ;" + " coord:direction-cosine-y " + y +
         " ; coord:direction-cosine-z " + z + " ; coord:x " + x[0] + " ; coord:y " + x[1] +
         " ; coord:z " + x[2] + " .\n";
}

// A joint between two frames, about (or along) their z, the first one's link being the parent.
inline std::string joint(const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& kind = "kc:RevoluteJoint",
                         bool directed = true) {
  std::string text = ":" + name + " a kc:Joint, " + kind + " ; kc:between-attachments :" + parent +
                     ", :" + child + " ; kc:common-axis :" + name + "-axis .\n:" + name +
                     "-axis a rel:LineCollinearity ; rel:lines :" + parent + "-z, :" + child +
                     "-z .\n";
  if (directed) {
    text += ":" + name + " kc:origin-offset :" + name + "-offset .\n:" + name +
            "-offset a rel:Position ; rel:of :" + child +
            "-origin ; rel:with-respect-to :" + parent + "-origin .\n";
  }
  return text;
}

// The first error's text, or nothing.
inline std::string first_error(const Model& model) {
  for (const Problem& problem : model.report.problems()) {
    if (problem.severity == Severity::kError) return to_string(problem);
  }
  return {};
}

}  // namespace sinew::model::test
