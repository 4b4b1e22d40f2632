#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/algorithm/names.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/synthesis/control.h"

namespace sinew::synthesis {
namespace {

using task::Spatial;
using task::SpatialKind;

constexpr std::string_view kTree = "https://w3id.org/sinew/kinematic-tree#";
constexpr std::string_view kOrigin =
    "https://comp-rob2b.github.io/metamodels/geometry/structural-entities#origin";

using Pose = std::array<double, 12>;  // row-major [R p]
constexpr Pose kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

class Placer {
 public:
  Placer(const graph::View& view, const Robot& robot, Report& report, Control& control)
      : view_(view), robot_(robot), report_(report), control_(control) {}

  void place() {
    const task::Task& task = *control_.task;
    for (const auto& [id, spatial] : task.spatials) place(spatial);
    for (const task::JointView& view : task.joint_views) check_joint(view.joint);
    if (task.solver) {
      for (const auto* drivers : {&task.solver->joint_forces, &task.solver->joint_accelerations})
        for (const task::Driver& driver : *drivers) check_joint(driver.attached_to);
      check_root(*task.solver);
      for (const task::Driver& driver : task.solver->cartesian_forces) check_wrench(driver);
    }
    rates();
    needs();
  }

 private:
  Id word(std::string_view space, std::string_view name) const {
    return view_.terms().find_iri(std::string(space) + std::string(name));
  }
  std::string text(Id id) const { return std::string(view_.terms().text(id)); }

  void error(Id node, std::string what, std::string remedy) {
    report_.error({}, text(node), std::move(what), std::move(remedy));
  }

  // The body frame to which a frame is fixed, and its pose in it; null where the tree has no such
  // frame.
  Id fixed_to(Id frame, Pose& placement) const {
    placement = kIdentity;
    if (const Id property = word(kTree, "fixed-to")) {
      if (const Id body = view_.object(frame, property)) {
        placement = numbers(view_.object(frame, word(kTree, "placement")));
        return body;
      }
    }
    const Id property = word(kTree, "frame");
    bool is_body_frame = false;
    if (property)
      view_.match({}, property, frame, graph::Dataset::kUnion, [&](const graph::Quad&) {
        is_body_frame = true;
        return false;
      });
    return is_body_frame ? frame : Id{};
  }

  Pose numbers(Id coordinate) const {
    Pose result{};
    const Id value = word(kTree, "value");
    const Id first = view_.terms().find_iri(graph::kRdfFirst);
    const Id rest = view_.terms().find_iri(graph::kRdfRest);
    std::size_t at = 0;
    for (Id node = view_.object(coordinate, value); node && at < result.size();
         node = view_.object(node, rest))
      result[at++] = view_.terms().number(view_.object(node, first)).value_or(0);
    return result;
  }

  // The body of a link, and its frame.
  bool body_of(Id link, Id& body, Id& frame) const {
    const Id contains = word(kTree, "contains"), frame_of = word(kTree, "frame");
    body = {};
    if (contains)
      view_.match({}, contains, link, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        body = quad.subject;
        return false;
      });
    if (!body) return false;
    frame = view_.object(body, frame_of);
    return true;
  }

  // A frame whose origin is this point, fixed to this body; the link's own where several are.
  Id frame_at(Id point, Id body_frame, Id link) const {
    std::vector<Id> found;
    const Id origin = view_.terms().find_iri(kOrigin);
    if (!origin) return {};
    view_.match({}, origin, point, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      Pose placement;
      if (fixed_to(quad.subject, placement) == body_frame) found.push_back(quad.subject);
      return true;
    });
    const Id root_frame = word(kTree, "root-frame");
    const Id own = root_frame ? view_.object(link, root_frame) : Id{};
    if (std::find(found.begin(), found.end(), own) != found.end()) return own;
    const auto by_iri = [&](Id a, Id b) { return view_.terms().text(a) < view_.terms().text(b); };
    const auto first = std::min_element(found.begin(), found.end(), by_iri);
    return first == found.end() ? Id{} : *first;
  }

  static std::array<std::array<double, 3>, 3> columns(const Pose& X) {
    return {{{X[0], X[4], X[8]}, {X[1], X[5], X[9]}, {X[2], X[6], X[10]}}};
  }

  // The axes of the frame that coordinates are seen by.
  bool directions(const Spatial& spatial, SpatialPlace& place) {
    Pose seen, own;
    const Id seen_body = fixed_to(spatial.seen_by, seen);
    const Id own_body = fixed_to(place.frame, own);
    if (seen_body == robot_.root_frame) {
      place.seen_from_root = true;
      place.axes = columns(seen);
      return true;
    }
    if (seen_body && seen_body == own_body) {
      // R_FS = R_BF' R_BS
      place.seen_from_root = false;
      const auto a = columns(own), b = columns(seen);
      for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row)
          place.axes[column][row] =
              a[row][0] * b[column][0] + a[row][1] * b[column][1] + a[row][2] * b[column][2];
      return true;
    }
    error(spatial.id,
          seen_body ? fmt::format("it is seen by {}, which moves with another body",
                                  text(spatial.seen_by))
                    : fmt::format("it is seen by {}, which is no frame of the robot",
                                  text(spatial.seen_by)),
          fmt::format("a frame that is fixed to the base, such as {}, or to the body itself",
                      text(robot_.root_frame)));
    return false;
  }

  void place(const Spatial& spatial) {
    SpatialPlace place;
    if (spatial.kind == SpatialKind::kPose) {
      // A desired pose need not be of a frame of the robot.
      if (!spatial.value && !spatial.setpoint && !place_frame(spatial, place)) return;
      if (!reference_of(spatial, place)) return;
      control_.places.emplace(spatial.id, place);
      return;
    }
    Id body_frame;
    if (!body_of(spatial.of, place.body, body_frame)) {
      error(spatial.id, fmt::format("{} is no link of the robot", text(spatial.of)),
            "name a link that a joint or a constant pose connects to the base");
      return;
    }
    place.frame = frame_at(spatial.reference, body_frame, spatial.of);
    if (!place.frame) {
      error(spatial.id,
            fmt::format("its reference point {} is the origin of no frame that is fixed to {}",
                        text(spatial.reference), text(spatial.of)),
            "state the pose of a frame there with respect to a frame of the link");
      return;
    }
    if (spatial.wrt) {
      Id other_body, other_frame;
      if (!body_of(spatial.wrt, other_body, other_frame) || other_frame != robot_.root_frame) {
        error(spatial.id, fmt::format("it is with respect to {}", text(spatial.wrt)),
              fmt::format("with respect to {}, or what is fixed to it", text(robot_.root_body)));
        return;
      }
    }
    if (directions(spatial, place)) control_.places.emplace(spatial.id, place);
  }

  bool place_frame(const Spatial& spatial, SpatialPlace& place) {
    Pose placement;
    if (!fixed_to(spatial.of, placement)) {
      error(spatial.id, fmt::format("{} is no frame of the robot", text(spatial.of)),
            "name a frame that is fixed to a link, or state its pose in one");
      return false;
    }
    place.frame = spatial.of;
    return true;
  }

  // A pose is seen by the frame that it is with respect to.
  bool reference_of(const Spatial& spatial, SpatialPlace& place) {
    Pose X;
    if (fixed_to(spatial.wrt, X) != robot_.root_frame) {
      error(spatial.id, fmt::format("the pose is with respect to {}", text(spatial.wrt)),
            fmt::format("with respect to {}, or a frame that is fixed to it",
                        text(robot_.root_frame)));
      return false;
    }
    if (spatial.seen_by != spatial.wrt) {
      error(spatial.id,
            fmt::format("the pose is with respect to {} but seen by {}", text(spatial.wrt),
                        text(spatial.seen_by)),
            "a pose is seen by the frame that it is with respect to");
      return false;
    }
    place.axes = columns(kIdentity);
    if (spatial.wrt == robot_.root_frame) return true;
    place.wrt = spatial.wrt;
    const auto R = columns(X);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        place.root_in_wrt[4 * row + column] = R[row][column];
      place.root_in_wrt[4 * row + 3] = -(R[row][0] * X[3] + R[row][1] * X[7] + R[row][2] * X[11]);
    }
    return true;
  }

  void check_joint(Id joint) {
    for (const RobotJoint& one : robot_.joints)
      if (one.joint == joint && one.kind != "floating") return;
    std::string known;
    for (const RobotJoint& one : robot_.joints)
      known += (known.empty() ? "" : ", ") + std::string(algorithm::short_name(text(one.joint)));
    error(joint, "the task names it, but it is no moving joint of the robot", "one of " + known);
  }

  void check_root(const task::Solver& solver) {
    Pose placement;
    if (!solver.root || fixed_to(solver.root, placement) == robot_.root_frame) return;
    error(solver.id, fmt::format("its root {} is not fixed to the base", text(solver.root)),
          fmt::format("{}, or choose the base by --base", text(robot_.root_frame)));
  }

  void check_wrench(const task::Driver& driver) {
    const auto place = control_.places.find(driver.quantity);
    if (place == control_.places.end()) return;  // reported already
    Id body, frame;
    if (!body_of(driver.attached_to, body, frame) || body != place->second.body)
      error(driver.id,
            fmt::format("it is attached to {}, but its wrench acts on {}", text(driver.attached_to),
                        text(place->second.body)),
            "attach it to the link that the wrench acts on");
    else if (frame == robot_.root_frame)
      error(driver.id, "a wrench on the base moves no joint", "let it act on a link that moves");
  }

  // Handlers run every so many cycles of the fastest one.
  void rates() {
    const task::Task& task = *control_.task;
    std::optional<double> fastest;
    for (const task::Handler& handler : task.handlers)
      if (handler.period_s)
        fastest = std::min(fastest.value_or(*handler.period_s), *handler.period_s);
    control_.period_s = fastest;
    for (const task::Handler& handler : task.handlers) {
      const double ratio = handler.period_s ? *handler.period_s / *fastest : 1;
      const double whole = std::round(ratio);
      constexpr double kClose = 1e-9;
      if (std::abs(ratio - whole) > kClose * whole || whole > kMaximumCyclesOfAHandler)
        error(handler.id,
              fmt::format("its period is {} times the shortest one, {} s", ratio, *fastest),
              fmt::format("a whole number of times, at most {}", kMaximumCyclesOfAHandler));
      control_.cycles[handler.id] = static_cast<std::uint32_t>(whole);
    }
  }

  void need(std::string slot) {
    if (std::find(control_.needs.begin(), control_.needs.end(), slot) == control_.needs.end())
      control_.needs.push_back(std::move(slot));
  }
  void need_frame(const std::string& quantity, Id frame) {
    const std::pair<std::string, Id> one{quantity, frame};
    if (std::find(control_.frames.begin(), control_.frames.end(), one) == control_.frames.end())
      control_.frames.push_back(one);
  }

  void needs() {
    const task::Task& task = *control_.task;
    // In the order of the model's IRIs: the tables of tasks have none.
    std::vector<const Spatial*> all;
    for (const auto& [id, spatial] : task.spatials) all.push_back(&spatial);
    std::sort(all.begin(), all.end(), [&](const Spatial* a, const Spatial* b) {
      return view_.terms().text(a->id) < view_.terms().text(b->id);
    });
    for (const Spatial* spatial : all) {
      const auto place = control_.places.find(spatial->id);
      if (place == control_.places.end() || !place->second.frame) continue;
      need_frame("pose", place->second.frame);
      need("pose");
      need("frame-pose");
      if (spatial->kind == SpatialKind::kVelocityTwist) {
        need_frame("twist", place->second.frame);
        need("twist");
      }
      if (spatial->kind == SpatialKind::kAccelerationTwist) {
        need_frame("acceleration-twist", place->second.frame);
        need("acceleration-twist");
      }
    }
    for (const task::JointView& view : task.joint_views) {
      if (view.kind == task::JointKind::kPosition) need("position");
      if (view.kind == task::JointKind::kVelocity) need("velocity");
    }
  }

  const graph::View& view_;
  const Robot& robot_;
  Report& report_;
  Control& control_;
};

}  // namespace

Control place_task(const graph::View& view, const Robot& robot,
                   std::shared_ptr<const task::Task> task, Report& report) {
  Control control;
  control.task = std::move(task);
  Placer(view, robot, report, control).place();
  return control;
}

}  // namespace sinew::synthesis
