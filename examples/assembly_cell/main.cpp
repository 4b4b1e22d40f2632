// The assembly cell: the source's scene from models, Table 3.1 enforced, the grasp asked for in
// both variants, and what follows. Each line that it prints has been checked; exits 1 where a
// figure fails.
//   assembly_cell SOURCE_FOLDER
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/world/audit.h"
#include "sinew/world/declared_rights.h"
#include "sinew/world/qualitative.h"
#include "sinew/world/robot.h"
#include "sinew/world/scene.h"
#include "sinew/world/space.h"

using namespace sinew;
using namespace sinew::world;

namespace {

const std::string kCell = "https://w3id.org/sinew/examples/assembly_cell#";
const std::string kCamera = kCell + "camera-device";
const std::string kController = kCell + "robot-controller";
const std::string kTask = kCell + "task-controller";

int failures = 0;

void expect(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  fmt::print("FAILED: {}\n", what);
}

Stamp at_s(double seconds) { return Stamp(duration_of_seconds(seconds)); }

// What a component is told when it is refused; empty when it is not.
template <typename Do>
std::string refusal(Do&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// The largest difference of two poses, of an axis or a coordinate.
double difference(const Pose& a, const Pose& b) {
  const Pose d = compose(invert(a), b);
  return std::max({std::abs(d.q.x), std::abs(d.q.y), std::abs(d.q.z), std::abs(d.p.x),
                   std::abs(d.p.y), std::abs(d.p.z)});
}

// A world of the example's models, with the rights that they declare.
struct CellWorld {
  CellWorld(const std::filesystem::path& folder, const std::vector<std::string>& files,
            const model::Tree* arm = nullptr, const graph::Terms* terms = nullptr) {
    if (arm) robot = add_robot(world, *arm, *terms, {.provenance = kController});
    std::vector<std::filesystem::path> paths;
    for (const std::string& file : files) paths.push_back(folder / file);
    graph::Store store;
    graph::Places places;
    Report report;
    model::load_files(paths, {}, store, places, report);
    report.throw_if_errors();
    load_scene(world, store, places, report);
    report.throw_if_errors();
    scene = read_scene(world, store, places, report);
    declared = read_rights(store, places, report);
    check_configuration(world, declared.rights, declared.writers, configuration);
    report.throw_if_errors();
    enforce(world, declared.rights, audit);
  }
  FrameId frame(const std::string& name) const { return world.find_frame(kCell + name); }
  MeasurementId measurement(const std::string& name) const {
    return world.find_measurement(kCell + name);
  }
  Pose pose(const std::string& of, const std::string& with_respect_to, Stamp now) const {
    const PoseAnswer answer = world.pose(frame(of), frame(with_respect_to), now);
    expect(answer.status == Status::kOk, "Pose(" + of + ", " + with_respect_to + ") is known");
    return answer.pose;
  }

  World world;
  RobotInWorld robot;
  DeclaredScene scene;
  DeclaredRights declared;
  Report configuration;
  std::shared_ptr<Audit> audit =
      std::make_shared<Audit>(kUsualAuditEntries, [] { return Stamp(); });  // the same each time
};

std::string names_in(const Space& space, const std::string& area) {
  std::string names;
  for (const BodyId body : space.within(area, Match::kInside).bodies) {
    names += (names.empty() ? "" : ", ") + space.name(body).substr(kCell.size());
  }
  return names.empty() ? "nothing" : names;
}

// What the controller writes of the arm.
struct Arm {
  BatchWriter joints;
  std::vector<double> q = {0.1, 0.4, -0.3, 1.2, 0.2, 0.7, -0.5};
};

const Pose kSeen = {{}, {0.1, -0.2, 1.1}};  // the adaptor, by the camera
constexpr const char* kMagazine = "storage magazine";

// What `who` is told when it is refused; empty when it is not.
std::string write(CellWorld& cell, const char* what, const Pose& X, const std::string& who,
                  double when) {
  return refusal([&] {
    expect(cell.world.write(cell.measurement(what), at_s(when), X, {who}) == Status::kOk,
           std::string(what) + " is written");
  });
}

void see_rights(CellWorld& measured) {
  fmt::print("-- who may write what\n");
  for (const char* fixed : {"measured-F1-F0", "measured-F3-F0", "measured-F4-F0"}) {
    expect(!write(measured, fixed, Pose{}, kCamera, 1).empty(), "the camera moves nothing static");
  }
  const std::string refused = write(measured, "measured-F5-F4", Pose{}, kCamera, 1);
  fmt::print("{}\n", refused);
  expect(
      refused.find(kCamera) != std::string::npos && refused.find(kController) != std::string::npos,
      "the camera is refused the controller's measurement, and both are named");
  expect(!write(measured, "measured-F2-F3", kSeen, kController, 1).empty(),
         "the controller is refused the camera's");
}

void compare_variants(CellWorld& measured, CellWorld& computed, Arm& arm) {
  fmt::print("-- Pose(F2, F5), measured and computed\n");
  expect(arm.joints.write(at_s(1), arm.q) == Status::kOk, "the joint positions are written");
  write(computed, "measured-F2-F3", kSeen, kCamera, 1);
  write(measured, "measured-F2-F3", kSeen, kCamera, 1);
  write(measured, "measured-F5-F4", computed.pose("F5", "F4", at_s(1)), kController, 1);
  const Pose by_controller = measured.pose("F2", "F5", at_s(1));
  const Pose by_kinematics = computed.pose("F2", "F5", at_s(1));
  fmt::print("{:.6f} {:.6f} {:.6f} m, and the same by forward kinematics to {:.1g}\n",
             by_controller.p.x, by_controller.p.y, by_controller.p.z, 1e-14);
  expect(difference(by_controller, by_kinematics) < 1e-14, "both variants agree to 1e-14");
  PreparedPose way = computed.world.prepare_pose(
      {.of = computed.frame("F2"), .with_respect_to = computed.frame("F5")});
  expect(way.measured_steps() == 8, "seven joints and the camera are on the way");
}

void look_around(const CellWorld& computed, Space& space) {
  fmt::print("-- what is where\n");
  const Relations relations = relations_of(space, computed.scene);
  space.update(at_s(1));
  const std::string magazine = computed.scene.find(kMagazine);
  const std::string surface = computed.scene.find("working surface");
  fmt::print("in the storage magazine: {}\n", names_in(space, magazine));
  expect(names_in(space, magazine) == "hose_adaptor", "the adaptor is in the storage magazine");
  expect(names_in(space, surface) == "nothing", "nothing is on the working surface");
  const auto body = [&](const char* name) { return space.find(kCell + name); };
  const Judgement on = relations.judge(
      {.relation = "on", .first = body("hose_adaptor"), .second = body("workbench")});
  fmt::print("{}\n", explain(on));
  expect(on.holds, "the adaptor is on the workbench");
  const Judgement reachable = relations.judge(
      {.relation = "reachable", .first = body("hose_adaptor"), .second = body("robot_base")});
  expect(reachable.holds, "the adaptor is within the reach of the arm");
}

void see_freshness(CellWorld& computed) {
  fmt::print("-- how fresh it is\n");
  const PoseAnswer late =
      computed.world.pose(computed.frame("F2"), computed.frame("F0"), at_s(1.75));
  fmt::print("0.75 s after the camera's last look: {} updates missed, expired {:.2f} s ago\n",
             late.freshness.obsolescence, seconds_of(at_s(1.75) - late.freshness.expires));
  expect(late.status == Status::kOk && late.freshness.obsolescence == 7 &&
             late.freshness.expires == at_s(1.5),
         "an outdated pose says so: 7 updates of 0.1 s missed, held until 1.5 s");
  PreparedPose strict = computed.world.prepare_pose({.of = computed.frame("F2"),
                                                     .with_respect_to = computed.frame("F0"),
                                                     .policy = Policy::kFilter});
  expect(strict.latest(at_s(1.75)).status == Status::kExpired, "and whoever filters gets none");
}

// `before`: where the adaptor stands in the base's frame.
void grasp_and_carry(CellWorld& computed, Actor& task, Arm& arm, Space& space, const Pose& before) {
  fmt::print("-- grasped, carried, released\n");
  Actor camera(computed.world, computed.declared.rights, kCamera, computed.audit);
  expect(!refusal([&] {
            camera.attach(computed.frame("F2"), computed.frame("F5"), at_s(1.2));
          }).empty(),
         "the camera may not attach the adaptor");
  task.attach(computed.frame("F2"), computed.frame("F5"), at_s(1.2));
  expect(difference(computed.pose("F2", "F0", at_s(1.2)), before) < 1e-14,
         "grasping does not move the adaptor");
  // A quarter turn of the first joint, whose axis is vertical through F4: what the arm carries goes
  // round that axis.
  arm.q[0] += std::acos(-1) / 2;
  arm.joints.write(at_s(1.3), arm.q);
  const Pose carried = computed.pose("F2", "F4", at_s(1.3));
  const Pose lifted = compose(invert(computed.pose("F4", "F0", at_s(1.3))), before);
  fmt::print("carried by a quarter turn: from {:.3f} {:.3f} {:.3f} m to {:.3f} {:.3f} {:.3f} m\n",
             lifted.p.x, lifted.p.y, lifted.p.z, carried.p.x, carried.p.y, carried.p.z);
  const double turned = std::atan2(lifted.p.x * carried.p.y - lifted.p.y * carried.p.x,
                                   lifted.p.x * carried.p.x + lifted.p.y * carried.p.y);
  expect(std::abs(std::abs(turned) - std::acos(-1) / 2) < 1e-9 &&
             std::abs(lifted.p.z - carried.p.z) < 1e-12,
         "the adaptor goes round with the arm");
  space.update(at_s(1.3));
  expect(names_in(space, computed.scene.find(kMagazine)) == "nothing", "the magazine is empty now");
  arm.q[0] -= std::acos(-1) / 2;
  arm.joints.write(at_s(1.4), arm.q);
  space.update(at_s(1.4));
  expect(names_in(space, computed.scene.find(kMagazine)) == "hose_adaptor",
         "and full when the arm has come back");
}

void ask_what_if(CellWorld& computed, const Arm& arm, const Pose& before) {
  fmt::print("-- what if\n");
  World clone = computed.world.clone();
  const MeasurementId first_joint = computed.robot.positions.front();
  expect(clone.write(first_joint, at_s(1.5), std::vector<double>{arm.q[0] + 1}, {kController}) ==
             Status::kOk,
         "the clone's arm is moved");
  const Pose there = clone.pose(computed.frame("F2"), computed.frame("F0"), at_s(1.5)).pose;
  const Pose here = computed.pose("F2", "F0", at_s(1.5));
  fmt::print("the arm's first joint 1 rad further: the adaptor would move by {:.3f} m\n",
             std::hypot(there.p.x - here.p.x, there.p.y - here.p.y));
  expect(std::abs(std::hypot(there.p.x - here.p.x, there.p.y - here.p.y) -
                  2 * std::sin(0.5) * std::hypot(here.p.x, here.p.y)) < 1e-9,
         "by the chord of one radian about the base");
  expect(difference(here, before) < 1e-12, "and has not: the original knows nothing of it");
}

void release(CellWorld& computed, Actor& task, Arm& arm, const Pose& before) {
  task.detach(computed.frame("F2"), computed.frame("F3"), at_s(1.5));
  arm.q[0] += 0.3;
  arm.joints.write(at_s(1.6), arm.q);
  expect(difference(computed.pose("F2", "F0", at_s(1.6)), before) < 1e-12,
         "the released adaptor stays where it was, and the arm goes");
  expect(write(computed, "measured-F2-F3", {{}, {0.1, -0.1, 1.1}}, kCamera, 1.65).empty(),
         "the camera sees it again");
  expect(std::abs(computed.pose("F2", "F0", at_s(1.65)).p.x - 0.8) < 1e-12,
         "and what it sees counts again");
}

void read_audits(const CellWorld& measured, const CellWorld& computed) {
  fmt::print("-- the audit of the second variant\n");
  for (const AuditEntry& entry : computed.audit->entries()) {
    fmt::print("{:2} {} {} {} {}\n", entry.number, entry.accepted ? "allowed" : "refused",
               entry.who.substr(kCell.size()), to_string(entry.act),
               entry.what.starts_with(kCell) ? entry.what.substr(kCell.size()) : entry.what);
  }
  expect(computed.audit->counts().refused == 1, "one act was refused in the second variant");
  expect(measured.audit->counts().refused == 5, "and five in the first");
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) {
    std::cerr << "usage: assembly_cell SOURCE_FOLDER\n";
    return 2;
  }
  const std::filesystem::path source = arguments[1], folder = source / "examples/assembly_cell";
  graph::Store robot_store;
  graph::Places robot_places;
  Report report;
  model::load_files(std::vector<std::filesystem::path>{source / "robots/gen3/chain.jsonld",
                                                       source / "robots/gen3/dynamics.jsonld",
                                                       source / "robots/gen3/geometry.jsonld"},
                    {}, robot_store, robot_places, report);
  const model::Tree robot = model::normalise(robot_store, robot_places, {}, report);
  report.throw_if_errors();

  // First variant: the controller says where the end effector is. Second: the world computes it.
  CellWorld measured(folder,
                     {"scene.jsonld", "task.jsonld", "measured.jsonld", "components.jsonld"});
  CellWorld computed(
      folder, {"scene.jsonld", "task.jsonld", "arm.jsonld", "shapes.jsonld", "components.jsonld"},
      &robot, &robot_store.terms());
  expect(!measured.configuration.has_errors(), "the first variant's configuration has no conflict");

  see_rights(measured);
  Arm arm{computed.world.claim(computed.robot.positions, {kController})};
  compare_variants(measured, computed, arm);
  Space space(computed.world, computed.frame("F0"));
  add_bodies(space, computed.scene);
  look_around(computed, space);
  see_freshness(computed);
  Actor task(computed.world, computed.declared.rights, kTask, computed.audit);
  const Pose before = computed.pose("F2", "F0", at_s(1.2));
  grasp_and_carry(computed, task, arm, space, before);
  ask_what_if(computed, arm, before);
  release(computed, task, arm, before);
  read_audits(measured, computed);
  if (failures == 0) fmt::print("every figure holds\n");
  return failures == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
