#include "sinew/model/choose_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/model/inertia.h"
#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

// What a constant that is neither 0 nor 1 costs, roughly the products that it takes part in when
// torques are computed. Only comparisons matter.
constexpr double kRotationEntry = 3;
constexpr double kPositionEntry = 2;
constexpr double kInertiaEntry = 0.5;
// How far along its axis a frame may go, as a multiple of the lengths around it. Where axes are
// parallel but for an angle that somebody wrote as 1.5708, their common normal is kilometres away:
// an inertia about a point there has lost its digits (the square of this number times the
// round-off).
constexpr double kFarthestSlide = 16;
// Sweeps over all bodies; each ends when nothing gets better, in practice after two.
constexpr int kMaximumSweeps = 5;

bool plain(double entry, double tolerance) {
  const double size = std::abs(entry);
  return size <= tolerance || std::abs(size - 1) <= tolerance;
}

double cost(const Pose& X, double tolerance) {
  double sum = 0;
  for (const double r : {X.R.xx, X.R.xy, X.R.xz, X.R.yx, X.R.yy, X.R.yz, X.R.zx, X.R.zy, X.R.zz}) {
    if (!plain(r, tolerance)) sum += kRotationEntry;
  }
  for (const double p : {X.p.x, X.p.y, X.p.z}) {
    if (std::abs(p) > tolerance) sum += kPositionEntry;
  }
  return sum;
}

// The entries that differ from frame to frame about an axis; mass, h.z and the axial moment stay.
double cost(const RigidBodyInertia& I, double tolerance) {
  const double small = tolerance * (std::abs(I.rotational.xx) + std::abs(I.rotational.zz));
  double sum = 0;
  for (const double h : {I.first_moment.x, I.first_moment.y}) {
    if (std::abs(h) > tolerance * I.mass) sum += kInertiaEntry;
  }
  for (const double i : {I.rotational.xy, I.rotational.xz, I.rotational.yz}) {
    if (std::abs(i) > small) sum += kInertiaEntry;
  }
  return sum;
}

class Chooser {
 public:
  Chooser(Tree& tree, double tolerance)
      : tree_(tree), tolerance_(tolerance), children_(tree.bodies.size()) {
    for (std::uint32_t j = 0; j < tree.joints.size(); ++j) {
      children_[tree.joints[j].predecessor].push_back(j);
    }
    for (std::uint32_t body = 0; body < tree.bodies.size(); ++body) {
      farthest_.push_back(kFarthestSlide * length_around(body));
    }
  }

  void run() {
    for (int sweep = 0; sweep < kMaximumSweeps; ++sweep) {
      bool better = false;
      for (std::size_t body = tree_.bodies.size(); body-- > 1;) {
        if (!fixed_by_joint(body)) better |= improve(static_cast<std::uint32_t>(body));
      }
      if (!better) return;
    }
  }

 private:
  const Tree::Joint& joint_of(std::uint32_t body) const { return tree_.joints[body - 1]; }

  // The longest distance from the body's frame to its neighbours' and to its centre of mass.
  double length_around(std::uint32_t body) const {
    double longest = 0;
    const auto add = [&](const Vector3& p) { longest = std::max(longest, std::sqrt(dot(p, p))); };
    if (body > 0) add(joint_of(body).placement.p);
    for (const std::uint32_t child : children_[body]) add(tree_.joints[child].placement.p);
    const Tree::Body& b = tree_.bodies[body];
    if (b.has_inertia && b.inertia.mass > 0) add((1 / b.inertia.mass) * b.inertia.first_moment);
    return longest;
  }

  // The velocity of a free joint has coordinates in its successor's frame.
  bool fixed_by_joint(std::size_t body) const {
    const int compound = tree_.joints[body - 1].compound;
    return compound >= 0 && is_free(tree_.compounds[static_cast<std::size_t>(compound)].kind);
  }

  double cost_with(std::uint32_t body, const Pose& X) const {
    const Pose back = math::invert(X);
    double sum = cost(math::compose(joint_of(body).placement, X), tolerance_);
    for (const std::uint32_t child : children_[body]) {
      sum += cost(math::compose(back, tree_.joints[child].placement), tolerance_);
    }
    const Tree::Body& b = tree_.bodies[body];
    if (b.has_inertia) sum += cost(transformed(b.inertia, back.R, back.p), tolerance_);
    return sum;
  }

  bool improve(std::uint32_t body) {
    const std::vector<Pose> candidates = candidates_for(body);
    double best = cost_with(body, identity_pose());
    const Pose* choice = nullptr;
    for (const Pose& X : candidates) {
      const double sum = cost_with(body, X);
      if (sum < best) {
        best = sum;
        choice = &X;
      }
    }
    if (!choice) return false;
    move_frame(tree_, body, *choice);
    return true;
  }

  // Angles modulo a quarter turn, which only permutes axes.
  static void add_angle(std::vector<double>& angles, double y, double x) {
    if (std::hypot(x, y) < 1e-9) return;
    double angle = std::atan2(y, x);
    angle -= std::numbers::pi / 2 * std::round(angle / (std::numbers::pi / 2));
    for (const double known : angles) {
      if (std::abs(angle - known) < 1e-9) return;
    }
    angles.push_back(angle);
  }

  struct Slides {
    double farthest = 0;
    std::vector<double> slides = {0};

    void add(double slide) {
      if (!(std::abs(slide) <= farthest)) return;
      for (const double known : slides) {
        if (std::abs(slide - known) < 1e-9) return;
      }
      slides.push_back(slide);
    }
  };

  // Turns and slides that make entries of a placement plain. `X` leads from the body's frame to a
  // neighbour's: x becomes perpendicular to both axes, or points from one to the other.
  static void look_at(const Pose& X, std::vector<double>& angles, Slides& slides) {
    const Vector3 axis = {X.R.xz, X.R.yz, X.R.zz};  // the neighbour's z
    if (std::hypot(axis.x, axis.y) < 1e-9) {
      add_angle(angles, X.p.y, X.p.x);
      add_angle(angles, X.R.yx, X.R.xx);
    } else {
      add_angle(angles, axis.y, axis.x);
      // Feet of the common normal of the two axes: the neighbour's p + t axis is nearest to z.
      const double sine2 = axis.x * axis.x + axis.y * axis.y;
      const double t = -(axis.x * X.p.x + axis.y * X.p.y) / sine2;
      slides.add(X.p.z + t * axis.z);
    }
    slides.add(X.p.z);
  }

  std::vector<Pose> candidates_for(std::uint32_t body) const {
    std::vector<double> angles = {0};
    Slides slides{farthest_[body]};
    const Tree::Joint& joint = joint_of(body);
    const Pose back = math::invert(joint.placement);
    look_at(back, angles, slides);
    // Slides that clear one entry of the position in the predecessor.
    const Pose& in = joint.placement;
    for (const auto& [p, z] :
         {std::pair{in.p.x, in.R.xz}, std::pair{in.p.y, in.R.yz}, std::pair{in.p.z, in.R.zz}}) {
      if (std::abs(z) > 1e-3) slides.add(-p / z);
    }
    for (const std::uint32_t child : children_[body]) {
      look_at(tree_.joints[child].placement, angles, slides);
    }
    std::vector<Pose> candidates;
    for (const double angle : angles) {
      for (const double slide : slides.slides) {
        candidates.push_back({rotation_about_z(angle), {0, 0, slide}});
      }
      // A prismatic joint's axis has a direction but no place.
      if (joint.kind != JointKind::kPrismatic) continue;
      candidates.push_back({rotation_about_z(angle), back.p});
      for (const std::uint32_t child : children_[body]) {
        candidates.push_back({rotation_about_z(angle), tree_.joints[child].placement.p});
      }
    }
    return candidates;
  }

  Tree& tree_;
  double tolerance_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<double> farthest_;  // slide of each body's frame
};

}  // namespace

// Rounding in the search itself is dust even where the caller keeps all of it.
void choose_frames(Tree& tree, double tolerance) {
  Chooser(tree, std::max(tolerance, 1e-14)).run();
}

void move_frame(Tree& tree, std::uint32_t body, const Pose& X) {
  const Pose back = math::invert(X);
  for (Tree::Joint& joint : tree.joints) {
    if (joint.successor == body) joint.placement = math::compose(joint.placement, X);
    if (joint.predecessor == body) joint.placement = math::compose(back, joint.placement);
  }
  for (Tree::Frame& frame : tree.frames) {
    if (frame.body == body) frame.placement = math::compose(back, frame.placement);
  }
  Tree::Body& b = tree.bodies[body];
  if (b.has_inertia) b.inertia = transformed(b.inertia, back.R, back.p);
}

double longest_length(const Tree& tree) {
  double longest = 0;
  const auto add = [&](const Vector3& p) {
    longest = std::max({longest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (const Tree::Joint& joint : tree.joints) add(joint.placement.p);
  for (const Tree::Frame& frame : tree.frames) add(frame.placement.p);
  for (const Tree::Body& body : tree.bodies) {
    if (!body.has_inertia || !(body.inertia.mass > 0)) continue;
    add((1 / body.inertia.mass) * body.inertia.first_moment);
    const auto& S = body.inertia.rotational;
    longest = std::max(longest, std::sqrt(std::max({S.xx, S.yy, S.zz}) / body.inertia.mass));
  }
  return longest;
}

void snap(Tree& tree, double tolerance, double length_tolerance) {
  for (Tree::Joint& joint : tree.joints) snap(joint.placement, tolerance, length_tolerance);
  for (Tree::Frame& frame : tree.frames) snap(frame.placement, tolerance, length_tolerance);
  for (Tree::Body& body : tree.bodies) {
    if (body.has_inertia)
      snap(body.inertia, std::min(tolerance, kLengthTolerance), length_tolerance);
  }
}

}  // namespace sinew::model
