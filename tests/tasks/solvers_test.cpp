// Tasks on the arm: what they measure, and what becomes of what they command.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "loop.h"
#include "nodes.h"

namespace sinew::test {
namespace {

cli::QueryOptions asked(const std::string& solver) {
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  return query;
}

// The arm by hand, in its plane: position and velocity of the tool, and the Jacobian's two columns.
struct Plane {
  double x, z, vx, vz, wy;
  double jx[2], jz[2];

  Plane(double q1, double q2, double d1, double d2) {
    const double a = q1, b = q1 + q2, l1 = 0.4, l2 = 0.3;
    x = l1 * std::sin(a) + l2 * std::sin(b);
    z = 0.3 + l1 * std::cos(a) + l2 * std::cos(b);
    jx[0] = l1 * std::cos(a) + l2 * std::cos(b);
    jx[1] = l2 * std::cos(b);
    jz[0] = -l1 * std::sin(a) - l2 * std::sin(b);
    jz[1] = -l2 * std::sin(b);
    vx = jx[0] * d1 + jx[1] * d2;
    vz = jz[0] * d1 + jz[1] * d2;
    wy = d1 + d2;
  }
};

const double kStates[][4] = {{0.3, -0.7, 0.2, 0.5}, {-1.1, 0.4, -0.8, 0.3}, {0.0, 0.0, 1.0, -1.0}};

Values state(const double (&s)[4]) {
  return {{"position.shoulder", s[0]},
          {"position.elbow", s[1]},
          {"velocity.shoulder", s[2]},
          {"velocity.elbow", s[3]}};
}

// A damper along z of the base, whose force acts on the tool.
std::string damper(const std::string& wrench_seen_by = "arm:frame/base") {
  return kToolTwist + "," + tool_wrench(wrench_seen_by) + "," + quantity("speed", "M-PER-SEC") +
         "," + constant("top-speed", "M-PER-SEC", 0.1) + "," + constant("top-force", "N", 10) +
         "," + quantity("force", "N") + "," +
         view("VelocityTwistCoordinateView", "t:twist-coordinates", "speed", "linear-velocity",
              "z") +
         "," + view("WrenchCoordinateView", "t:wrench-coordinates", "force", "force", "z") + R"(,
    { "@id": "t:damper", "@type": ["Controller", "DampingController"],
      "measured-velocity": "t:speed", "maximum-velocity": "t:top-speed",
      "maximum-force": "t:top-force", "control-signal": "t:force" })";
}

TEST(TaskSolvers, InverseDynamicsAddsTheTasksWrench) {
  Loop with(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush), {});
  Loop without(constant("unused", "M", 1), asked("bias"));
  Loop gravity_alone(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush),
                     asked("bias"));
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    Values out = with.cycle(state(s));
    const double force = 10 - 100 * plane.vz;
    EXPECT_NEAR(out["signal.force"], force, 1e-10);
    Values bias = without.cycle(state(s)), both = gravity_alone.cycle(state(s));
    EXPECT_NEAR(both["bias-force.shoulder"], bias["bias-force.shoulder"] + plane.jz[0] * force,
                1e-10);
    EXPECT_NEAR(both["bias-force.elbow"], bias["bias-force.elbow"] + plane.jz[1] * force, 1e-10);
  }
}

TEST(TaskSolvers, AWrenchMayBeSeenFromTheFrameItself) {
  Loop loop(damper("arm:frame/tool") + "," + solver("RecursiveNewtonEulerAlgorithm", kPush),
            asked("bias"));
  Loop bare(constant("unused", "M", 1), asked("bias"));
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    const double force = 10 - 100 * plane.vz, turn = s[0] + s[1];
    const double fx = force * std::sin(turn), fz = force * std::cos(turn);
    Values out = loop.cycle(state(s));
    Values still = bare.cycle(state(s));
    for (const auto& [joint, j] : {std::pair{"shoulder", 0}, std::pair{"elbow", 1}}) {
      const std::string name = std::string("bias-force.") + joint;
      EXPECT_NEAR(out[name], still[name] + plane.jx[j] * fx + plane.jz[j] * fz, 1e-10);
    }
  }
}

TEST(TaskSolvers, ForceDistributionIsTheTransposeOfTheJacobian) {
  Loop loop(damper() + R"(, { "@id": "t:solver", "@type": "ForceDistributionSolver",
      "force": "t:wrench-coordinates", "configuration": "t:q" })");
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    Values out = loop.cycle(state(s));
    EXPECT_NEAR(out["control-force.shoulder"], plane.jz[0] * (10 - 100 * plane.vz), 1e-11);
    EXPECT_NEAR(out["control-force.elbow"], plane.jz[1] * (10 - 100 * plane.vz), 1e-11);
  }
}

// What inverse dynamics needs for the accelerations that forward dynamics gives is the task's
// force.
TEST(TaskSolvers, ForwardDynamicsIsDrivenByTheTask) {
  Loop forward(damper() + "," + solver("ArticulatedBodyAlgorithm", kPush), {});
  cli::QueryOptions query = asked("rnea");
  query.gravity = "0,0,0";  // the model has none
  Loop weightless(constant("unused", "M", 1), query);
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    Values accelerations = forward.cycle(state(s));
    Values in = state(s);
    in["acceleration.shoulder"] = accelerations["acceleration.shoulder"];
    in["acceleration.elbow"] = accelerations["acceleration.elbow"];
    Values out = weightless.cycle(in);
    EXPECT_NEAR(out["force.shoulder"], plane.jz[0] * (10 - 100 * plane.vz), 1e-9);
    EXPECT_NEAR(out["force.elbow"], plane.jz[1] * (10 - 100 * plane.vz), 1e-9);
  }
}

TEST(TaskSolvers, ViewsTakeEachAxis) {
  std::string nodes =
      kToolTwist + "," + quantity("vx", "M-PER-SEC") + "," + quantity("wy", "RAD-PER-SEC") + "," +
      quantity("height", "M") + "," +
      view("VelocityTwistCoordinateView", "t:twist-coordinates", "vx", "linear-velocity", "x") +
      "," +
      view("VelocityTwistCoordinateView", "t:twist-coordinates", "wy", "angular-velocity", "y") +
      R"(,
    { "@id": "t:pose", "@type": "Pose", "of": "arm:frame/tool",
      "with-respect-to": "arm:frame/base" },
    { "@id": "t:pose-coordinates", "@type": ["PoseReference", "PoseCoordinate"],
      "of-pose": "t:pose", "as-seen-by": "arm:frame/base" },)" +
      view("PoseCoordinateView", "t:pose-coordinates", "height", "position", "z");
  // Each is watched, so that each comes out as an error with the opposite sign.
  for (const auto& [id, unit] :
       {std::pair{"vx", "M-PER-SEC"}, std::pair{"wy", "RAD-PER-SEC"}, std::pair{"height", "M"}}) {
    const std::string name = id;
    nodes += "," + constant(name + "-top", unit, 0) + "," + constant(name + "-kp", "UNITLESS", 1) +
             "," + constant(name + "-none", "PER-SEC", 0) + "," + constant(name + "-no", "SEC", 0) +
             "," + quantity(name + "-error", unit) + "," + quantity(name + "-out", unit) + R"(,
    { "@id": "t:)" +
             name + R"(-c", "@type": ["Constraint", "EqualityConstraint"],
      "quantity": "t:)" +
             name + R"(", "reference-value": "t:)" + name + R"(-top" },
    { "@id": "t:)" +
             name + R"(-e", "@type": ["ConstraintEvaluator", "ErrorEvaluator"],
      "constraint": "t:)" +
             name + R"(-c", "error": "t:)" + name + R"(-error" },
    { "@id": "t:)" +
             name + R"(-p", "@type": ["Controller", "ProportionalIntegralDerivative"],
      "error-signal": "t:)" +
             name + R"(-error", "control-signal": "t:)" + name + R"(-out",
      "proportional-gain": { "@id": "t:)" +
             name + R"(-kp" },
      "integral-gain": { "@id": "t:)" +
             name + R"(-none" },
      "derivative-gain": { "@id": "t:)" +
             name + R"(-no" } })";
  }
  nodes += "," + constant("period", "SEC", 0.001) + R"(,
    { "@id": "t:handler", "@type": "ConstraintHandler", "period": "t:period",
      "controllers": ["t:vx-p", "t:wy-p", "t:height-p"] })";
  Loop loop(nodes, asked("rnea"));
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    Values out = loop.cycle(state(s));
    EXPECT_NEAR(out["signal.vx-out"], -plane.vx, 1e-12);
    EXPECT_NEAR(out["signal.wy-out"], -plane.wy, 1e-12);
    EXPECT_NEAR(out["signal.height-out"], -plane.z, 1e-12);
  }
}

// An impedance between the tool and a goal, with what else is said of it.
std::string pose_impedance(const std::string& more = "") {
  return kToolTwist + "," + tool_wrench("arm:frame/tool") + R"(,
    { "@id": "t:measured", "@type": "Pose", "of": "arm:frame/tool",
      "with-respect-to": "arm:frame/base" },
    { "@id": "t:measured-coordinates", "@type": ["PoseReference", "PoseCoordinate"],
      "of-pose": "t:measured", "as-seen-by": "arm:frame/base" },
    { "@id": "t:goal", "@type": "Frame" },
    { "@id": "t:desired", "@type": "Pose", "of": "t:goal", "with-respect-to": "arm:frame/base" },
    { "@id": "t:desired-coordinates", "@type": ["PoseReference", "PoseCoordinate",
      "DirectionCosineXYZ", "VectorXYZ"], "of-pose": "t:desired", "as-seen-by": "arm:frame/base",
      "unit": ["UNITLESS", "M"], "direction-cosine-x": [1.0, 0.0, 0.0],
      "direction-cosine-y": [0.0, 1.0, 0.0], "direction-cosine-z": [0.0, 0.0, 1.0],
      "x": 0.3, "y": 0.0, "z": 0.5 },
    { "@id": "t:k", "@type": "SpatialGain", "angular": [1.0, 20.0, 3.0],
      "linear": [100.0, 200.0, 300.0], "unit": ["N-M-PER-RAD", "N-PER-M"] },
    { "@id": "t:d", "@type": "SpatialGain", "angular": [0.1, 0.2, 0.3],
      "linear": [1.0, 2.0, 3.0], "unit": ["N-M-SEC-PER-RAD", "N-SEC-PER-M"] },
    { "@id": "t:impedance", "@type": ["Controller", "ImpedanceController",
      "PoseImpedanceController"], "measured-pose": "t:measured-coordinates",
      "desired-pose": "t:desired-coordinates", "measured-twist": "t:twist-coordinates",
      "stiffness": "t:k", "damping": "t:d", "control-signal": "t:wrench-coordinates")" +
         more + R"( },)" + solver("RecursiveNewtonEulerAlgorithm", kPush);
}

// A pose impedance against Eigen: the error by angle and axis, and the closed form of log.
TEST(TaskSolvers, PoseImpedancePullsTowardsTheDesiredPose) {
  Loop loop(pose_impedance(), asked("bias"));
  for (const auto& s : kStates) {
    const Plane plane(s[0], s[1], s[2], s[3]);
    const double turn = s[0] + s[1];
    Eigen::Isometry2d measured = Eigen::Isometry2d::Identity();
    // In the plane seen along y, with x to the right of z: an angle about y turns z towards x.
    measured.linear() = Eigen::Rotation2Dd(turn).toRotationMatrix();
    measured.translation() = Eigen::Vector2d(plane.z, plane.x);
    Eigen::Isometry2d goal = Eigen::Isometry2d::Identity();
    goal.translation() = Eigen::Vector2d(0.5, 0.3);
    const Eigen::Isometry2d way = measured.inverse() * goal;
    const double angle = -turn;  // of the way
    // V^-1 in the plane: half the angle times its cotangent, and half the angle.
    const double half = angle / 2, c = std::abs(half) < 1e-9 ? 1 : half / std::tan(half);
    Eigen::Matrix2d V_inverse;
    V_inverse << c, half, -half, c;
    const Eigen::Vector2d move = V_inverse * way.translation();
    const Eigen::Vector2d velocity =
        measured.linear().transpose() * Eigen::Vector2d(plane.vz, plane.vx);
    Values out = loop.cycle(state(s));
    EXPECT_NEAR(out["wrench.wrench-coordinates[1]"], 20 * angle - 0.2 * plane.wy, 1e-10);
    EXPECT_NEAR(out["wrench.wrench-coordinates[5]"], 300 * move(0) - 3 * velocity(0), 1e-9);
    EXPECT_NEAR(out["wrench.wrench-coordinates[3]"], 100 * move(1) - 1 * velocity(1), 1e-9);
  }
}

// W = K log(X^-1 X_d) + D (V_d - V): the twist that is wanted acts through the damping alone.
TEST(TaskSolvers, PoseImpedanceFollowsADesiredTwist) {
  for (const std::string seen_by : {"arm:frame/base", "arm:frame/tool"}) {
    const std::string twist = R"(, { "@id": "t:wanted-twist", "@type":
      ["VelocityReference", "VelocityTwistCoordinate", "Setpoint"], "of-velocity": "t:twist",
      "as-seen-by": ")" + seen_by +
                              "\" }";
    Loop still(pose_impedance(), asked("bias"));
    Loop moving(pose_impedance(R"(, "desired-twist": "t:wanted-twist")") + twist, asked("bias"));
    for (const auto& s : kStates) {
      const double turn = s[0] + s[1], wy = 0.7, vx = -0.4, vz = 0.9;
      Values in = state(s), out = still.cycle(in);
      in["setpoint.wanted-twist[1]"] = wy;
      in["setpoint.wanted-twist[3]"] = vx;
      in["setpoint.wanted-twist[5]"] = vz;
      Values with = moving.cycle(in);
      // Seen from the tool: turned back about y.
      const bool own = seen_by == "arm:frame/tool";
      const double x = own ? vx : std::cos(turn) * vx - std::sin(turn) * vz;
      const double z = own ? vz : std::sin(turn) * vx + std::cos(turn) * vz;
      const auto more = [&](int i) {
        const std::string name = "wrench.wrench-coordinates[" + std::to_string(i) + "]";
        return with[name] - out[name];
      };
      EXPECT_NEAR(more(1), 0.2 * wy, 1e-10) << seen_by;
      EXPECT_NEAR(more(3), 1 * x, 1e-9) << seen_by;
      EXPECT_NEAR(more(5), 3 * z, 1e-9) << seen_by;
    }
  }
}

// A spring at a joint, by views of the joint's position and velocity.
const std::string kJointSpring = quantity("angle", "RAD") + "," + quantity("speed", "RAD-PER-SEC") +
                                 "," + constant("goal", "RAD", 0.5) + "," +
                                 quantity("error", "RAD") + "," + quantity("torque", "N-M") + "," +
                                 constant("k", "N-M-PER-RAD", 30) + "," +
                                 constant("d", "N-M-SEC-PER-RAD", 2) + R"(,
  { "@id": "t:position", "@type": "JointPositionCoordinate", "of-joint": "arm:joint/elbow" },
  { "@id": "t:velocity", "@type": "JointVelocityCoordinate", "of-joint": "arm:joint/elbow" },
  { "@id": "t:joint-torque", "@type": "JointForceCoordinate", "of-joint": "arm:joint/elbow" },
  { "@id": "t:v1", "@type": ["View", "JointCoordinateView"], "superobject": "t:position",
    "subobject": "t:angle" },
  { "@id": "t:v2", "@type": ["View", "JointCoordinateView"], "superobject": "t:velocity",
    "subobject": "t:speed" },
  { "@id": "t:v3", "@type": ["View", "JointCoordinateView"], "superobject": "t:joint-torque",
    "subobject": "t:torque" },
  { "@id": "t:c", "@type": ["Constraint", "EqualityConstraint"], "quantity": "t:angle",
    "reference-value": "t:goal" },
  { "@id": "t:e", "@type": ["ConstraintEvaluator", "ErrorEvaluator"], "constraint": "t:c",
    "error": "t:error" },
  { "@id": "t:spring", "@type": ["Controller", "ImpedanceController"], "error-signal": "t:error",
    "measured-velocity": "t:speed", "stiffness": "t:k", "damping": "t:d",
    "control-signal": "t:torque" },)";

TEST(TaskSolvers, JointForcesAddToThoseOfTheMotion) {
  Loop loop(kJointSpring + solver("RecursiveNewtonEulerAlgorithm", R"(, "joint-force":
      { "@id": "t:drive", "@type": "JointForceSpecification", "force": "t:joint-torque",
        "attached-to": "arm:joint/elbow" })"));
  cli::QueryOptions query = asked("bias");
  query.gravity = "0,0,0";
  Loop bias(constant("unused", "M", 1), query);
  for (const auto& s : kStates) {
    Values out = loop.cycle(state(s)), alone = bias.cycle(state(s));
    EXPECT_NEAR(out["command.shoulder"], alone["bias-force.shoulder"], 1e-11);
    EXPECT_NEAR(out["command.elbow"], alone["bias-force.elbow"] + 30 * (0.5 - s[1]) - 2 * s[3],
                1e-11);
  }
}

TEST(TaskSolvers, JointAccelerationsDriveInverseDynamics) {
  Loop loop(setpoint("wanted", "RAD-PER-SEC2") + R"(,
    { "@id": "t:acceleration", "@type": "JointAccelerationCoordinate",
      "of-joint": "arm:joint/elbow" },
    { "@id": "t:v", "@type": ["View", "JointCoordinateView"], "superobject": "t:acceleration",
      "subobject": "t:wanted" },)" +
            solver("RecursiveNewtonEulerAlgorithm", R"(, "joint-acceleration":
      { "@id": "t:drive", "@type": "JointAccelerationSpecification",
        "acceleration": "t:acceleration", "attached-to": "arm:joint/elbow" })"));
  cli::QueryOptions query = asked("rnea");
  query.gravity = "0,0,0";
  Loop reference(constant("unused", "M", 1), query);
  for (const auto& s : kStates) {
    Values in = state(s), other = in;
    in["setpoint.wanted"] = other["acceleration.elbow"] = 1.5;
    Values out = loop.cycle(in), expected = reference.cycle(other);
    EXPECT_NEAR(out["force.shoulder"], expected["force.shoulder"], 1e-11);
    EXPECT_NEAR(out["force.elbow"], expected["force.elbow"], 1e-11);
  }
}

TEST(TaskSolvers, WhySaysWhatTheTaskAskedFor) {
  Loop loop(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush));
  std::string all;
  for (const std::string& line : loop.why()) all += line + "\n";
  EXPECT_NE(all.find("twist (needed by control)"), std::string::npos) << all;
  EXPECT_NE(all.find("control-wrench (asked: the task's wrenches)"), std::string::npos) << all;
}

TEST(TaskSolvers, ARobotInterfaceReadsFirstAndWritesLast) {
  Loop loop(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush) + "," +
            constant("nothing", "N-M", 0) + R"(,
    { "@id": "t:robot", "@type": "RobotInterface", "safe-command": "t:nothing",
      "interface": "https://w3id.org/sinew/robot#print" })");
  EXPECT_NE(loop.why().front().find("read"), std::string::npos);
  EXPECT_NE(loop.why().back().find("write"), std::string::npos);
  const double at_rest[4] = {};
  EXPECT_NEAR(loop.cycle(state(at_rest))["signal.force"], 10, 1e-12);
}

void expect_refused(const std::string& nodes, const cli::QueryOptions& query,
                    std::initializer_list<const char*> says) {
  try {
    Loop loop(nodes, query);
    FAIL() << "accepted";
  } catch (const Error& error) {
    for (const char* words : says)
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(TaskSolvers, RefuseWhatIsNotOnTheRobot) {
  const std::string task = damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush);
  expect_refused(replaced(task, R"("as-seen-by": "arm:frame/base")", R"("as-seen-by": "t:moon")"),
                 {},
                 {"task.jsonld:", "task/twist-coordinates", "task/moon", "no frame of the robot"});
  expect_refused(
      replaced(task, R"("as-seen-by": "arm:frame/base")", R"("as-seen-by": "arm:frame/upper")"), {},
      {"task/twist-coordinates", "moves with another body"});
  expect_refused(replaced(task, R"("reference-point": "arm:origin/tool")",
                          R"("reference-point": "arm:origin/upper")"),
                 {}, {"task/twist-coordinates", "arm/origin/upper", "the origin of no frame"});
  expect_refused(replaced(task, R"("of": "arm:link/tool")", R"("of": "arm:link/hammer")"), {},
                 {"arm/link/hammer", "no link of the robot"});
  expect_refused(
      replaced(task, R"("attached-to": "arm:link/tool")", R"("attached-to": "arm:link/upper")"), {},
      {"task/push", "acts on"});
}

TEST(TaskSolvers, RefuseAJointThatTheRobotDoesNotHave) {
  const std::string drive = R"(, "joint-force": { "@id": "t:drive",
      "@type": "JointForceSpecification", "force": "t:joint-torque",
      "attached-to": "arm:joint/elbow" })";
  expect_refused(replaced(kJointSpring, R"("of-joint": "arm:joint/elbow")",
                          R"("of-joint": "arm:joint/knee")") +
                     solver("RecursiveNewtonEulerAlgorithm", drive),
                 {}, {"arm/joint/knee", "no moving joint of the robot", "shoulder, elbow"});
}

TEST(TaskSolvers, SayWhatTheTaskMustBeGiven) {
  expect_refused(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush), asked("gravity"),
                 {"the task cannot be computed without joint-velocity"});
}

TEST(TaskSolvers, RefuseAQueryOnWhichTheTaskCannotAct) {
  expect_refused(damper() + "," + solver("RecursiveNewtonEulerAlgorithm", kPush), asked("fpk"),
                 {"task/solver", "on which the task's forces could act", "ask for joint-force"});
}

}  // namespace
}  // namespace sinew::test
