// Rigid-body dynamics by dense matrices in any precision: for each body its pose, its Jacobian and
// its motion in the base's directions, so that nothing of the recursions under test is in it. With
// numbers longer than double it tells whose round-off a difference is.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace sinew::test {

template <typename S>
struct ExactMotion {  // one turn or slide, in the directions that the joint's frames have at zero
  bool turns = true;
  Eigen::Matrix<S, 3, 1> axis = Eigen::Matrix<S, 3, 1>::UnitZ();
  int coordinate = 0;  // index of the velocity that moves it
  int position = 0;    // index of the position that moves it
  S ratio = S(1), offset = S(0);
};

enum class ExactKind { kMotions, kSpherical, kFloating };

template <typename S>
struct ExactJoint {  // leads from the link of index `parent` to the link of its own index + 1
  int parent = 0;
  Eigen::Matrix<S, 3, 3> rotation = Eigen::Matrix<S, 3, 3>::Identity();
  Eigen::Matrix<S, 3, 1> translation = Eigen::Matrix<S, 3, 1>::Zero();
  ExactKind kind = ExactKind::kMotions;
  std::vector<ExactMotion<S>> motions;  // of spherical and floating joints: none
  int velocity = 0, position = 0;       // of those: where their numbers start
  S reflected = S(0);                   // inertia of a rotor, as the joint's first coordinate feels
};

template <typename S>
struct ExactLink {
  std::string name;
  S mass = S(0);
  Eigen::Matrix<S, 3, 1> com = Eigen::Matrix<S, 3, 1>::Zero();
  Eigen::Matrix<S, 3, 3> inertia = Eigen::Matrix<S, 3, 3>::Zero();  // about the centre of mass
};

template <typename S>
struct ExactRobot {
  std::vector<ExactLink<S>> links;  // the first is the base
  std::vector<ExactJoint<S>> joints;
  int velocities = 0;
};

template <typename S>
class ExactDynamics {
 public:
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector3 = Eigen::Matrix<S, 3, 1>;
  using Matrix3 = Eigen::Matrix<S, 3, 3>;

  // Of a link, about its origin; acceleration: while those of all coordinates are zero.
  struct Body {
    Matrix3 R = Matrix3::Identity();
    Vector3 p = Vector3::Zero(), w = Vector3::Zero(), v = Vector3::Zero(), al = Vector3::Zero(),
            a = Vector3::Zero();
    Matrix J;  // 6 x n, turning first
  };

  ExactDynamics(ExactRobot<S> robot, const Eigen::Vector3d& gravity, const Vector& position,
                const Vector& velocity)
      : robot_(std::move(robot)), position_(position), velocity_(velocity) {
    const Vector3 falls = gravity.cast<S>();
    bodies_.resize(1);
    bodies_[0].J = Matrix::Zero(6, robot_.velocities);
    for (const ExactJoint<S>& joint : robot_.joints) {
      Body body = bodies_[static_cast<std::size_t>(joint.parent)];
      move(joint, body);
      bodies_.push_back(std::move(body));
    }
    sum_up(falls);
  }

  const Body& body(std::size_t link) const { return bodies_[link]; }
  const Matrix& mass_matrix() const { return mass_; }
  const Vector& bias() const { return bias_; }  // forces without acceleration

  Vector accelerations(const Vector& force) const { return mass_.ldlt().solve(force - bias_); }

 private:
  static Matrix3 cross(const Vector3& v) {
    Matrix3 m;
    m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
    return m;
  }

  // A point that the body carries along.
  static void shift(Body& body, const Vector3& by) {
    body.a += body.al.cross(by) + body.w.cross(body.w.cross(by));
    body.v += body.w.cross(by);
    body.J.bottomRows(3) -= cross(by) * body.J.topRows(3);
    body.p += by;
  }

  Matrix3 turn_of_quaternion(int at) const {
    Eigen::Matrix<S, 4, 1> q = position_.template segment<4>(at);  // x y z w
    q /= sqrt_of(q.squaredNorm());
    const Vector3 v = q.template head<3>();
    return Matrix3::Identity() + S(2) * q[3] * cross(v) + S(2) * cross(v) * cross(v);
  }

  static S sqrt_of(const S& number) {
    using std::sqrt;
    return sqrt(number);
  }

  // The child turns with w about axes that the parent carries along.
  static void turn(Body& body, const Vector3& rate) {
    body.al += body.w.cross(rate);
    body.w += rate;
  }

  void move(const ExactJoint<S>& joint, Body& body) const {
    shift(body, body.R * joint.translation);
    body.R = body.R * joint.rotation;
    if (joint.kind != ExactKind::kMotions) return move_freely(joint, body);
    for (const ExactMotion<S>& motion : joint.motions) {
      using std::cos;
      using std::sin;
      const S q = motion.ratio * position_[motion.position] + motion.offset;
      const S rate = motion.ratio * velocity_[motion.coordinate];
      const Vector3 axis = body.R * motion.axis;
      if (motion.turns) {
        const Matrix3 K = cross(motion.axis);
        body.R = body.R * (Matrix3::Identity() + sin(q) * K + (S(1) - cos(q)) * K * K);
        turn(body, rate * axis);
        body.J.template block<3, 1>(0, motion.coordinate) += motion.ratio * axis;
      } else {
        shift(body, q * axis);
        body.a += S(2) * rate * body.w.cross(axis);
        body.v += rate * axis;
        body.J.template block<3, 1>(3, motion.coordinate) += motion.ratio * axis;
      }
    }
  }

  // Velocities are seen from the child.
  void move_freely(const ExactJoint<S>& joint, Body& body) const {
    const bool floats = joint.kind == ExactKind::kFloating;
    if (floats) shift(body, body.R * position_.template segment<3>(joint.position));
    body.R = body.R * turn_of_quaternion(joint.position + (floats ? 3 : 0));
    const Vector3 w = body.R * velocity_.template segment<3>(joint.velocity);
    if (floats) {
      const Vector3 v = body.R * velocity_.template segment<3>(joint.velocity + 3);
      body.a += S(2) * body.w.cross(v) + w.cross(v);
      body.v += v;
      body.J.template block<3, 3>(3, joint.velocity + 3) += body.R;
    }
    turn(body, w);
    body.J.template block<3, 3>(0, joint.velocity) += body.R;
  }

  void sum_up(const Vector3& gravity) {
    mass_ = Matrix::Zero(robot_.velocities, robot_.velocities);
    bias_ = Vector::Zero(robot_.velocities);
    for (std::size_t k = 1; k < bodies_.size(); ++k) {
      const ExactLink<S>& link = robot_.links[k];
      const Body& body = bodies_[k];
      const Vector3 arm = body.R * link.com;
      const Matrix3 I = body.R * link.inertia * body.R.transpose();
      const Matrix J_w = body.J.topRows(3);
      const Matrix J_v = body.J.bottomRows(3) - cross(arm) * J_w;
      mass_ += link.mass * J_v.transpose() * J_v + J_w.transpose() * I * J_w;
      const Vector3 a = body.a + body.al.cross(arm) + body.w.cross(body.w.cross(arm)) - gravity;
      bias_ += J_v.transpose() * (link.mass * a) +
               J_w.transpose() * (I * body.al + body.w.cross(I * body.w));
    }
    for (const ExactJoint<S>& joint : robot_.joints)
      if (!joint.motions.empty()) {
        const int at = joint.motions.front().coordinate;
        mass_(at, at) += joint.reflected;
      }
  }

  ExactRobot<S> robot_;
  Vector position_, velocity_;
  std::vector<Body> bodies_;
  Matrix mass_;
  Vector bias_;
};

}  // namespace sinew::test
