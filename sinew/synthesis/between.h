// Poses and motions between any two frames, made on demand from what happens across the joints that
// lie between them. What is there already, because somebody asked for absolute motion, is used.
// Each function makes the data block and the closures for it, once, and returns the block.
#pragma once

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/motion.h"

namespace sinew::synthesis {

class Between {
 public:
  explicit Between(Context& context) : context_(context) {}

  BlockIndex pose(Id wrt, Id of);
  // From a body's frame outward to a frame that is reached from it.
  BlockIndex pose_from(Id base_frame, Id of);

  // Of the body of `of` with respect to that of `wrt`, at the origin of `of` and seen by it.
  BlockIndex twist(Id wrt, Id of);
  // The same as the derivative of that, for an observer who moves with `wrt`.
  BlockIndex acceleration(Id wrt, Id of, Motion motion);

  // With the directions of another frame. The block's quantity chooses among the operators
  // rotate-QUANTITY-to-proximal.
  void turn(BlockIndex from, Id of, Id seen_by, BlockIndex to);

 private:
  // With respect to a body further in, or to what all motion is with respect to; seen by the frame.
  BlockIndex twist_from(Id base_frame, Id of);
  BlockIndex acceleration_from(Id base_frame, Id of, Motion motion);
  BlockIndex relative_acceleration(Motion motion, const RobotJoint& joint);
  // Where the motions of both frames are known with respect to the same.
  Id base_of_motions(Id wrt, Id of, std::string_view absolute);
  Id reference_of(Id base_frame, std::string_view absolute);

  BlockIndex make(std::string_view slot, Id base_frame, Id frame, std::string_view quantity, Id of,
                  Id wrt, std::span<const double> constant = {});
  BlockIndex placement(Id frame);
  Id body(Id frame) const;
  const RobotJoint& joint_to(Id body_frame) const;

  Context& context_;
};

}  // namespace sinew::synthesis
