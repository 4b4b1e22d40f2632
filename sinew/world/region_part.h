// Whether a shape is within a part of a region, decided by boxes alone where they are enough, which
// is nearly always: fifteen projections instead of a search for the nearest points. What they leave
// open, and every shape that is no box where it matters, is for distance() and protrusion().
//
// Two boxes are apart exactly when they are along an axis of one of them or across an edge of each
// (Gottschalk, Lin and Manocha 1996, "OBBTree", section 5).
#pragma once

#include <array>

#include "sinew/world/shape.h"

namespace sinew::world {

// A box about `middle` with the half sizes along its axes, the columns of R.
struct TurnedBox {
  math::Matrix3<double> R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector3 middle, half;
};
TurnedBox turned_box(const Bounds3& box);  // along the axes of the frame
TurnedBox turned_box(const Shape& shape);  // its bounds along its own axes

class RegionPart {
 public:
  explicit RegionPart(const Shape& part);

  enum class Verdict {
    kApart,    // farther away than what touches
    kWithin,   // inside the part
    kAcross,   // they overlap, and a corner of the box is outside by more than what touches
    kUnknown,  // not decided
  };
  // Of whatever the box holds: kApart, kWithin or kUnknown.
  Verdict judge(const TurnedBox& box) const { return judge(box, false); }
  // Of the shape.
  Verdict judge(const Shape& shape) const;

  bool touches(const Shape& shape) const;
  bool holds(const Shape& shape) const;

 private:
  Verdict judge(const TurnedBox& box, bool is_all_of_it) const;

  const Shape* part_;
  TurnedBox box_;
  bool is_box_;  // the box is the part, and not only around it
};

}  // namespace sinew::world
