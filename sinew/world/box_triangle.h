// Whether a box and a triangle overlap, by the thirteen directions along one of which two that are
// apart are separated: the box's axes, the triangle's normal, and those across an edge of each
// (Akenine-Möller 2001, "Fast 3D triangle-box overlap testing"). Internal to `world`.
#pragma once

#include <array>

#include "sinew/world/shape.h"

namespace sinew::world {

class BoxTriangle {
 public:
  explicit BoxTriangle(const Shape& shape);
  explicit operator bool() const { return is_box_; }  // false: the shape is no box

  enum class Verdict {
    kApart,    // by more than `by`
    kOverlap,  // by more than what rounding makes of it
    kUnknown,  // for the nearest points to decide
  };
  // The corners are seen from where the shape is.
  Verdict judge(const std::array<Vector3, 3>& corners, double by) const;

 private:
  bool is_box_ = false;
  Pose X_box_;  // of what is seen, in the box's axes about its middle
  Vector3 half_;
};

}  // namespace sinew::world
