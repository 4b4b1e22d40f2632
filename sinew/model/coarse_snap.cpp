#include "sinew/model/coarse_snap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sinew/model/inertia.h"
#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

std::array<double, 12> numbers(const Pose& X) {
  return {X.R.xx, X.R.xy, X.R.xz, X.R.yx, X.R.yy, X.R.yz,
          X.R.zx, X.R.zy, X.R.zz, X.p.x,  X.p.y,  X.p.z};
}

std::array<double, 10> numbers(const RigidBodyInertia& I) {
  const Vector3& h = I.first_moment;
  const auto& S = I.rotational;
  return {I.mass, h.x, h.y, h.z, S.xx, S.xy, S.xz, S.yy, S.yz, S.zz};
}

class Snapper {
 public:
  Snapper(double tolerance, const graph::Terms& terms) : tolerance_(tolerance), terms_(terms) {}

  template <typename Value>
  void snap_one(Value& value, graph::Id iri, const char* what) {
    const auto before = numbers(value);
    snap(value, tolerance_, tolerance_);
    const auto after = numbers(value);
    std::size_t count = 0;
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] == after[i]) continue;
      ++count;
      largest = std::max(largest, std::abs(after[i] - before[i]));
    }
    if (count == 0) return;
    changes_.push_back(fmt::format(
        "{} of <{}>: {} {} within {:g} of 0 or ±1 snapped, by up to {:.3g}", what, terms_.text(iri),
        count, count == 1 ? "number" : "numbers", tolerance_, largest));
  }
  std::vector<std::string> changes() && { return std::move(changes_); }

 private:
  double tolerance_;
  const graph::Terms& terms_;
  std::vector<std::string> changes_;
};

}  // namespace

std::vector<std::string> snap_coarsely(Tree& tree, double tolerance, const graph::Terms& terms) {
  Snapper snapper(tolerance, terms);
  for (Tree::Joint& joint : tree.joints) snapper.snap_one(joint.placement, joint.iri, "placement");
  for (Tree::Frame& frame : tree.frames) snapper.snap_one(frame.placement, frame.iri, "placement");
  for (Tree::Body& body : tree.bodies)
    if (body.has_inertia) snapper.snap_one(body.inertia, body.iri, "inertia");
  return std::move(snapper).changes();
}

}  // namespace sinew::model
