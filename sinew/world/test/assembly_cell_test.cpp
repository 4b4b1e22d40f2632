// The source's scene, from models: a camera, a hose adaptor, a workbench and an arm; the pose of
// the adaptor with respect to the end effector, measured and computed.
#include <gtest/gtest.h>

#include "random_poses.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/world/edit.h"
#include "sinew/world/robot.h"
#include "sinew/world/scene.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

const std::string kCell = "https://w3id.org/sinew/examples/assembly_cell#";

struct CellWorld {
  explicit CellWorld(const std::vector<std::string>& files) {
    graph::Store store;
    graph::Places places;
    Report report;
    std::vector<std::filesystem::path> paths;
    for (const std::string& file : files) {
      paths.emplace_back(SINEW_SOURCE_DIR "/examples/assembly_cell/" + file);
    }
    model::load_files(paths, {}, store, places, report);
    report.throw_if_errors();
    load_scene(world, store, places, report);
    report.throw_if_errors();
  }
  FrameId frame(const std::string& name) const { return world.find_frame(kCell + name); }
  MeasurementId measurement(const std::string& name) const {
    return world.find_measurement(kCell + name);
  }
  World world;
};

// The camera sees the adaptor half a metre to its side.
const Pose kSeen = {{}, {0.1, -0.2, 1.1}};

TEST(AssemblyCell, TheSceneSaysWhatIsWhere) {
  CellWorld cell({"scene.jsonld"});
  World& world = cell.world;
  EXPECT_EQ(world.frame_of(world.find_object(kCell + "hose_adaptor")), cell.frame("F2"));
  // Static poses are known at once, in metres, whatever unit the model uses.
  const PoseAnswer camera = world.pose(cell.frame("F3"), cell.frame("F1"), at_s(0));
  ASSERT_EQ(camera.status, Status::kOk);
  EXPECT_NEAR(camera.pose.p.x, 0.1, 1e-15);
  EXPECT_NEAR(camera.pose.p.y, 0.1, 1e-15);
  EXPECT_NEAR(camera.pose.p.z, 1.2, 1e-15);
  // What the camera measures is declared, and not yet there.
  EXPECT_EQ(world.pose(cell.frame("F2"), cell.frame("F1"), at_s(0)).status, Status::kNoData);
  const auto model = world.model(cell.measurement("measured-F2-F3"));
  EXPECT_EQ(model->provenance, kCell + "camera-device");
  EXPECT_EQ(std::get<TimeDependent>(model->life_cycle).validity, std::chrono::milliseconds(500));
  EXPECT_EQ(model->period, std::chrono::milliseconds(100));
  EXPECT_EQ(model->used_by, std::vector<std::string>{kCell + "task-controller"});
  ASSERT_EQ(
      world.write(cell.measurement("measured-F2-F3"), at_s(1), kSeen, {kCell + "camera-device"}),
      Status::kOk);
  const PoseAnswer adaptor = world.pose(cell.frame("F2"), cell.frame("F1"), at_s(1.1));
  ASSERT_EQ(adaptor.status, Status::kOk);
  EXPECT_NEAR(adaptor.pose.p.z, 1.2 - 1.1, 1e-12);
  EXPECT_EQ(adaptor.freshness.expires, at_s(1.5));
}

// Both variants: the controller says where the end effector is, and the world computes it from the
// joint positions.
TEST(AssemblyCell, TheGraspIsTheSameMeasuredAndComputed) {
  graph::Store store;
  graph::Places places;
  Report report;
  const std::filesystem::path folder = SINEW_SOURCE_DIR "/robots/gen3";
  model::load_files(
      std::vector<std::filesystem::path>{folder / "chain.jsonld", folder / "dynamics.jsonld",
                                         folder / "geometry.jsonld"},
      {}, store, places, report);
  report.throw_if_errors();
  const model::Tree tree = model::normalise(store, places, {}, report);
  report.throw_if_errors();

  CellWorld computed({"scene.jsonld", "task.jsonld"});
  const RobotInWorld robot =
      add_robot(computed.world, tree, store.terms(), {.provenance = kCell + "robot-controller"});
  // The arm stands on F4; its last link carries F5.
  const FrameId flange = computed.world.find_frame(store.terms().text(tree.bodies.back().frame));
  computed.world.add_static(kCell + "arm-mounting", robot.root, computed.frame("F4"), Pose{},
                            kCell + "configuration");
  computed.world.add_static(kCell + "tool", computed.frame("F5"), flange, {{}, {0, 0, 0.12}},
                            kCell + "configuration");
  std::vector<double> q = {0.1, 0.4, -0.3, 1.2, 0.2, 0.7, -0.5};
  BatchWriter controller = computed.world.claim(robot.positions, {kCell + "robot-controller"});
  ASSERT_EQ(controller.write(at_s(1), q), Status::kOk);
  computed.world.write(computed.measurement("measured-F2-F3"), at_s(1), kSeen,
                       {kCell + "camera-device"});
  const PoseAnswer by_kinematics =
      computed.world.pose(computed.frame("F2"), computed.frame("F5"), at_s(1));
  ASSERT_EQ(by_kinematics.status, Status::kOk) << to_string(by_kinematics.status);

  CellWorld measured({"scene.jsonld", "task.jsonld", "measured.jsonld"});
  const Pose X_F4_F5 =
      computed.world.pose(computed.frame("F5"), computed.frame("F4"), at_s(1)).pose;
  measured.world.write(measured.measurement("measured-F5-F4"), at_s(1), X_F4_F5,
                       {kCell + "robot-controller"});
  measured.world.write(measured.measurement("measured-F2-F3"), at_s(1), kSeen,
                       {kCell + "camera-device"});
  PreparedPose query = measured.world.prepare_pose(
      {.of = measured.frame("F2"), .with_respect_to = measured.frame("F5")});
  const PoseAnswer by_controller = query.latest(at_s(1));
  ASSERT_EQ(by_controller.status, Status::kOk) << to_string(by_controller.status);
  EXPECT_LT(difference(by_controller.pose, by_kinematics.pose), 1e-14);
  // F5 -> F4 -> F0 -> F3 -> F2, as the operations that somebody else may compute.
  const auto steps = query.symbolic();
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_EQ(steps[0].relation, kCell + "pose-F5-F4");
  EXPECT_EQ(steps[0].operation, "compose-inverse");
  EXPECT_EQ(steps[3].measurement, kCell + "measured-F2-F3");
  EXPECT_EQ(steps[3].operation, "compose");
}

TEST(Scene, FaultsHaveAPlace) {
  const auto fault = [](const std::string& body) {
    graph::Store store;
    graph::Places places;
    Report report;
    const model::Source source{
        "fault.ttl",
        "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
        "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
        "@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .\n"
        "x:a a geom:Frame . x:b a geom:Frame .\n"
        "x:p a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:m .\n" +
            body};
    model::load({&source, 1}, {}, store, places, report);
    World world;
    load_scene(world, store, places, report);
    EXPECT_FALSE(world.find_frame("http://x/a") && report.has_errors());
    return report.problems().empty() ? std::string("none") : to_string(report.problems().front());
  };
  EXPECT_NE(fault("x:m a w:Measurement ; w:provenance x:camera .").find("http://x/m"),
            std::string::npos);
  EXPECT_NE(fault("x:m a w:Measurement ; w:life-cycle \"eternal\" ; w:provenance x:camera .")
                .find("there is no life-cycle 'eternal'"),
            std::string::npos);
  EXPECT_NE(
      fault("x:m a w:Measurement ; w:life-cycle \"time-dependent\" ; w:provenance x:camera ;\n"
            "  w:validity [ w:number 3.0 ] .")
          .find("unit"),
      std::string::npos);
  EXPECT_EQ(
      fault("x:m a w:Measurement ; w:life-cycle \"time-dependent\" ; w:provenance x:camera ."),
      "none");
}

}  // namespace
}  // namespace sinew::world
