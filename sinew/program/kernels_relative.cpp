#include "sinew/program/kernels_relative.h"

#include "sinew/math/relative_motion.h"
#include "sinew/program/kernel_row.h"

namespace sinew::program {

using namespace sinew::math;

std::vector<Kernel> kernels_of_relative_motion() {
  return {
      row("subtract-velocity-twist",
          []<typename S>(const VelocityTwist<S>& a, const VelocityTwist<S>& b) {
            return subtract(a, b);
          }),
      row("subtract-acceleration-twist",
          []<typename S>(const AccelerationTwist<S>& a, const AccelerationTwist<S>& b) {
            return subtract(a, b);
          }),
      row("spatial-acceleration-from-classical",
          []<typename S>(const AccelerationTwist<S>& A, const VelocityTwist<S>& V) {
            return spatial_acceleration(A, V);
          }),
      row("derivative-seen-by-observer",
          []<typename S>(const AccelerationTwist<S>& A, const VelocityTwist<S>& V,
                         const VelocityTwist<S>& O) { return derivative_seen_by(A, V, O); }),
      row("rotate-spatial-acceleration-twist-to-proximal",
          []<typename S>(const Pose<S>& X, const AccelerationTwist<S>& A) {
            return rotate_to_proximal(X, A);
          }),
      row("turning-seen-from-proximal",
          []<typename S>(const Pose<S>& X, const VelocityTwist<S>& V) {
            return turning_seen_from_proximal(X, V);
          }),
      row("add-linear-motion-of-column",
          []<typename S>(const VelocityTwist<S>& V, const VelocityTwist<S>& J, const S& qd) {
            return add_linear_motion_of_column(V, J, qd);
          }),
      row("jacobian-column-between",
          []<typename S>(const Pose<S>&, const VelocityTwist<S>& moved,
                         const VelocityTwist<S>& moving) { return subtract(moved, moving); }),
      row("jacobian-columns-between",
          []<typename S>(const Pose<S>&, const JacobianBlock<S>& moved,
                         const JacobianBlock<S>& moving) { return subtract(moved, moving); }),
      row("rotate-jacobian-column-to-distal",
          []<typename S>(const Pose<S>& X, const VelocityTwist<S>& J) {
            return rotate_to_distal(X, J);
          }),
      row("rotate-jacobian-columns-to-distal",
          []<typename S>(const Pose<S>& X, const JacobianBlock<S>& J) {
            return rotate_to_distal(X, J);
          }),
      row("position-and-quaternion-from-pose",
          []<typename S>(const Pose<S>& X) { return position_and_quaternion(X); }),
      row("quaternion-column-from-jacobian-column",
          []<typename S>(const FloatingPosition<S>& X, const VelocityTwist<S>& J) {
            return quaternion_rates(X, J);
          }),
      row("quaternion-columns-from-jacobian-columns",
          []<typename S>(const FloatingPosition<S>& X, const JacobianBlock<S>& J) {
            return quaternion_rates(X, J);
          }),
  };
}

}  // namespace sinew::program
