// Reading a plan as pose, twist and acceleration: the recursion of forward kinematics (Featherstone
// 2008, section 4; classical accelerations) along the way, with every relation's own motion.
#include "sinew/world/plan_reading.h"

namespace sinew::world {
namespace {

// Motion of the frame reached so far with respect to the start, seen from itself.
struct Motion {
  Pose pose;
  Twist twist = {};
  Acceleration acceleration = {};
};

// A relation's own motion: of B with respect to A, seen from B.
struct Step {
  Pose X;
  Twist V;
  Acceleration A;
};

// The same of A with respect to B, seen from A. With s = R^T p, the way from A's origin to B's seen
// from B: p' = -s, v' = -ds/dt, a' = -d2s/dt2, where ds/dt = v - w x s and
// d2s/dt2 = a - al x s + w x (w x s) - 2 w x v.
Step reversed(const Step& step) {
  const auto R = to_matrix(step.X).R;
  const Vector3 s = math::transpose_times(R, step.X.p);
  const Vector3& w = step.V.angular;
  const Vector3 ds = step.V.linear - math::cross(w, s);
  const Vector3 dds = step.A.linear - math::cross(step.A.angular, s) +
                      math::cross(w, math::cross(w, s)) - 2.0 * math::cross(w, step.V.linear);
  return {invert(step.X), {-(R * w), -(R * ds)}, {-(R * step.A.angular), -(R * dds)}};
}

void move(Motion& at, const Step& step) {
  const math::Pose<double> X = to_matrix(step.X);
  const Acceleration carried = math::transform_to_distal(X, at.twist, step.V, at.acceleration);
  at.twist = math::add(math::transform_to_distal(X, at.twist), step.V);
  at.acceleration = math::add(carried, step.A);
  at.pose = compose(at.pose, step.X);
}

Step joint_step(const PlanStep& step, double q, double qd, double qdd) {
  if (step.kind == RelationKind::kRevolute) {
    return {revolute(q), {{0, 0, qd}, {}}, {{0, 0, qdd}, {}}};
  }
  return {prismatic(q), {{}, {0, 0, qd}}, {{}, {0, 0, qdd}}};
}

template <When kWhen>
void compose_motions(const Plan& plan, Stamp time, PlanReading& reading, MotionAnswer& answer,
                     Gathered& gathered) {
  gathered = {};
  Motion at;
  double position[kMaximumValues];
  for (const PlanStep& step : plan.steps) {
    if (step.has_before) move(at, {step.before, {}, {}});
    answer.status = read_step<kWhen>(plan, step, time, reading, position, gathered, answer.bounds);
    if (answer.status != Status::kOk) return;
    double velocity[kMaximumValues] = {0, 0, 0, 0, 0, 0};
    double acceleration[kMaximumValues] = {0, 0, 0, 0, 0, 0};
    if (step.velocity == kNone) {
      answer.status = Status::kNoMotion;
      return;
    }
    answer.status = read_one<kWhen>(plan, step.velocity, time, reading, velocity, gathered);
    if (answer.status == Status::kOk && step.acceleration != kNone) {
      answer.status =
          read_one<kWhen>(plan, step.acceleration, time, reading, acceleration, gathered);
    }
    if (answer.status != Status::kOk) return;
    Step own;
    if (step.kind == RelationKind::kFree) {
      own = {load_pose(position),
             {{velocity[0], velocity[1], velocity[2]}, {velocity[3], velocity[4], velocity[5]}},
             {{acceleration[0], acceleration[1], acceleration[2]},
              {acceleration[3], acceleration[4], acceleration[5]}}};
    } else {
      own = joint_step(step, position[0], velocity[0], acceleration[0]);
    }
    move(at, step.inverse ? reversed(own) : own);
  }
  if (plan.has_tail) move(at, {plan.tail, {}, {}});
  answer.pose = at.pose;
  answer.twist = at.twist;
  answer.acceleration = at.acceleration;
  answer.status = Status::kOk;
}

}  // namespace

void read_motion(const Plan& plan, Stamp time, bool latest, Policy policy, ReaderPlace* reader,
                 MotionAnswer& answer) {
  answer.status = plan.status;
  if (plan.status != Status::kOk) return;
  PlanReading reading;
  reading.reader = reader;
  Gathered gathered;
  if (!at_one_instant(plan, reading, [&] {
        if (latest) {
          compose_motions<When::kLatest>(plan, time, reading, answer, gathered);
        } else {
          compose_motions<When::kAt>(plan, time, reading, answer, gathered);
        }
      })) {
    answer.status = Status::kBusy;
    return;
  }
  finish(gathered, time, policy, answer);
}

}  // namespace sinew::world
