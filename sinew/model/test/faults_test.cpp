// One fault put into the published Gen3 files is refused, with the file's name and line and the
// node.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "models.h"

namespace sinew::model::test {
namespace {

using Json = nlohmann::ordered_json;
using Files = std::map<std::string, Json>;

bool has_type(const Json& node, const std::string& type) {
  const Json& types = node.at("@type");
  return types.is_array() ? std::find(types.begin(), types.end(), type) != types.end()
                          : types == type;
}

// The nth node of a type.
Json& node(Json& file, const std::string& type, int index) {
  for (Json& candidate : file["@graph"]) {
    if (has_type(candidate, type) && index-- == 0) return candidate;
  }
  throw std::out_of_range(type);
}

void each(Json& file, const std::string& type, const std::function<void(Json&)>& change) {
  for (Json& candidate : file["@graph"]) {
    if (has_type(candidate, type)) change(candidate);
  }
}

struct Fault {
  const char* name;
  std::function<void(Files&)> put;
  const char* file;    // that the first error names
  const char* iri;     // of the node it names
  const char* phrase;  // of what it says
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kFaults = {
      {"JointWithoutAttachments",
       [](Files& f) { node(f["robot.kin-chain.json"], "Joint", 3).erase("between-attachments"); },
       "robot.kin-chain.json", "joint4", "0 attachments"},
      {"NegativeMass",
       [](Files& f) { node(f["robot.dyn.json"], "RigidBodyInertiaCoordinate", 2)["mass"] = -1.0; },
       "robot.dyn.json", "link2-rbi-com-coord", "mass is -1"},
      {"TriangleInequality",
       [](Files& f) { node(f["robot.dyn.json"], "RigidBodyInertiaCoordinate", 2)["izz"] = 9.0; },
       "robot.dyn.json", "link2-rbi-com-coord", "triangle inequality"},
      {"WrongUnit",
       [](Files& f) {
         each(f["robot.geom.json"], "PoseCoordinate", [](Json& n) { n["unit"] = "KiloGM"; });
       },
       "robot.geom.json", "pose-coord-link0-joint1-wrt-link0-root", "KiloGM"},
      {"MissingUnit",
       [](Files& f) {
         each(f["robot.geom.json"], "PoseCoordinate", [](Json& n) { n.erase("unit"); });
       },
       "robot.geom.json", "pose-coord-link0-joint1-wrt-link0-root", "has no unit"},
      {"NoRotation",
       [](Files& f) {
         each(f["robot.geom.json"], "PoseCoordinate", [](Json& n) {
           n["direction-cosine-x"] = {2.0, 0, 0};
         });
       },
       "robot.geom.json", "pose-coord-link0-joint1-wrt-link0-root", "direction cosines"},
      {"UnknownTerm",
       [](Files& f) { node(f["robot.dyn.json"], "RigidBodyInertiaCoordinate", 1)["masss"] = 1.0; },
       "robot.dyn.json", "link1-rbi-com-coord", "masss"},
      {"UnknownContext",
       [](Files& f) {
         Json& context = f["robot.dyn.json"]["@context"];
         context.insert(context.begin(), "https://example.org/nowhere.json");
       },
       "robot.dyn.json", "nowhere.json", "no such document"},
      {"AttachmentThatIsNowhere",
       [](Files& f) {
         node(f["robot.kin-chain.json"], "Joint", 0)["between-attachments"][1] = "rob:nothing";
       },
       "robot.kin-chain.json", "joint1", "no frame of any link"},
      {"TwoCoordinatesForOnePose",
       [](Files& f) {
         Json copy = node(f["robot.geom.json"], "PoseCoordinate", 1);
         copy["@id"] = "rob:another";
         copy["x"] = 0.5;
         f["robot.geom.json"]["@graph"].push_back(copy);
       },
       "robot.geom.json", "another", "differs by 0.5"},
      {"ReflectedFrame",
       [](Files& f) {
         node(f["robot.geom.json"], "PoseCoordinate", 0)["direction-cosine-z"] = {0, 0, 1.0};
       },
       "robot.geom.json", "pose-coord-link0-joint1-wrt-link0-root", "right-handed"},
      {"SeenByAnotherFrame",
       [](Files& f) {
         node(f["robot.geom.json"], "PoseCoordinate", 0)["as-seen-by"] = "rob:link0-joint1";
       },
       "robot.geom.json", "pose-coord-link0-joint1-wrt-link0-root", "seen by"},
      {"InertiaAboutAnUnknownPlace",
       [](Files& f) {
         Json& graph = f["robot.geom.json"]["@graph"];
         for (auto at = graph.begin(); at != graph.end(); ++at) {
           if ((*at)["@id"] != "rob:position-coord-link3-com-wrt-link3-root-origin") continue;
           graph.erase(at);
           break;
         }
       },
       "robot.dyn.json", "link3-rbi-com-coord", "link3-com"},
      {"TwoInertiasOfOneLink",
       [](Files& f) {
         Json copy = node(f["robot.dyn.json"], "RigidBodyInertiaCoordinate", 1);
         copy["@id"] = "rob:another";
         f["robot.dyn.json"]["@graph"].push_back(copy);
       },
       "robot.dyn.json", "another", "has an inertia already"},
      {"LineInNeitherAttachment",
       [](Files& f) {
         node(f["robot.kin-chain.json"], "LineCollinearity", 1)["lines"] = {
             "rob:link0-joint1-vector-z", "rob:link1-root-vector-z"};
       },
       "robot.kin-chain.json", "joint2-common-axis", "known direction"},
  };
  return kFaults;
}

class Gen3Fault : public testing::TestWithParam<std::size_t> {};

TEST_P(Gen3Fault, IsRefusedWithItsPlace) {
  SINEW_NEEDS(published_gen3().front());
  const Fault& fault = faults()[GetParam()];
  Files files;
  for (const auto& path : published_gen3()) {
    std::ifstream in(path);
    files[path.filename().string()] = Json::parse(in);
  }
  fault.put(files);
  std::vector<Source> sources;
  for (const auto& [name, json] : files) sources.push_back({name, json.dump(1)});

  Model model;
  load(sources, {}, model.store, model.places, model.report);
  if (!model.report.has_errors()) {
    model.tree = normalise(model.store, model.places, {}, model.report);
  }
  ASSERT_TRUE(model.report.has_errors());
  EXPECT_TRUE(model.tree.bodies.empty());
  const auto first =
      std::find_if(model.report.problems().begin(), model.report.problems().end(),
                   [](const Problem& problem) { return problem.severity == Severity::kError; });
  EXPECT_EQ(first->place.file, fault.file) << model.problems();
  EXPECT_GT(first->place.line, 0u) << model.problems();
  EXPECT_TRUE(first->iri.ends_with(fault.iri)) << model.problems();
  EXPECT_NE(first->what.find(fault.phrase), std::string::npos) << model.problems();
  EXPECT_FALSE(first->remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(Each, Gen3Fault, testing::Range<std::size_t>(0, faults().size()),
                         [](const auto& info) { return faults()[info.param].name; });

}  // namespace
}  // namespace sinew::model::test
