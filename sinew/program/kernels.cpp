#include "sinew/program/kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "sinew/math/articulated_inertia.h"
#include "sinew/math/floating.h"
#include "sinew/math/hybrid_dynamics.h"
#include "sinew/math/inertia.h"
#include "sinew/math/jacobian.h"
#include "sinew/math/joint.h"
#include "sinew/math/momentum.h"
#include "sinew/program/kernel_row.h"
#include "sinew/program/kernels_constraints.h"
#include "sinew/program/kernels_control.h"
#include "sinew/program/kernels_joints.h"
#include "sinew/program/kernels_many.h"
#include "sinew/program/kernels_relative.h"

namespace sinew::program {
namespace {

using namespace sinew::math;

// Operators of the same name in the catalogue (algorithm/operators.h) have the same ports; a test
// compares the two tables.
std::vector<Kernel> make_kernels() {
  std::vector<Kernel> rows = {
      row("position-to-pose-revolute", []<typename S>(const S& q) { return revolute_pose(q); }),
      row("position-to-pose-prismatic", []<typename S>(const S& q) { return prismatic_pose(q); }),
      row("velocity-to-twist-revolute",
          []<typename S>(const S& qd) { return revolute_velocity(qd); }),
      row("velocity-to-twist-prismatic",
          []<typename S>(const S& qd) { return prismatic_velocity(qd); }),
      row("acceleration-to-twist-revolute",
          []<typename S>(const S& qdd) { return revolute_acceleration(qdd); }),
      row("acceleration-to-twist-prismatic",
          []<typename S>(const S& qdd) { return prismatic_acceleration(qdd); }),
      row("force-from-wrench-revolute",
          []<typename S>(const Wrench<S>& W) { return revolute_force(W); }),
      row("force-from-wrench-prismatic",
          []<typename S>(const Wrench<S>& W) { return prismatic_force(W); }),

      row("compose-pose",
          []<typename S>(const Pose<S>& X_AB, const Pose<S>& X_BC) { return compose(X_AB, X_BC); }),
      row("invert-pose", []<typename S>(const Pose<S>& X_AB) { return invert(X_AB); }),

      row("transform-velocity-twist-to-distal",
          []<typename S>(const Pose<S>& X_AB, const VelocityTwist<S>& V_A) {
            return transform_to_distal(X_AB, V_A);
          }),
      row("transform-acceleration-twist-to-distal",
          []<typename S>(const Pose<S>& X_AB, const VelocityTwist<S>& V_A,
                         const VelocityTwist<S>& V_rel, const AccelerationTwist<S>& A_A) {
            return transform_to_distal(X_AB, V_A, V_rel, A_A);
          }),
      row("transform-acceleration-twist-to-distal-fixed",
          []<typename S>(const Pose<S>& X_AB, const VelocityTwist<S>& V_A,
                         const AccelerationTwist<S>& A_A) {
            return transform_to_distal_fixed(X_AB, V_A, A_A);
          }),
      row("add-velocity-twist", []<typename S>(const VelocityTwist<S>& a,
                                               const VelocityTwist<S>& b) { return add(a, b); }),
      row("add-acceleration-twist",
          []<typename S>(const AccelerationTwist<S>& a, const AccelerationTwist<S>& b) {
            return add(a, b);
          }),
      row("transform-acceleration-twist-to-distal-at-rest",
          []<typename S>(const Pose<S>& X_AB, const AccelerationTwist<S>& A_A) {
            return transform_to_distal_at_rest(X_AB, A_A);
          }),
      row("rotate-velocity-twist-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const VelocityTwist<S>& V_B) {
            return rotate_to_proximal(X_AB, V_B);
          }),
      row("rotate-velocity-twist-to-distal",
          []<typename S>(const Pose<S>& X_AB, const VelocityTwist<S>& V_A) {
            return rotate_to_distal(X_AB, V_A);
          }),
      row("rotate-acceleration-twist-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const AccelerationTwist<S>& A_B) {
            return rotate_to_proximal(X_AB, A_B);
          }),
      row("rotate-acceleration-twist-to-distal",
          []<typename S>(const Pose<S>& X_AB, const AccelerationTwist<S>& A_A) {
            return rotate_to_distal(X_AB, A_A);
          }),

      row("base-acceleration-from-gravity",
          []<typename S>(const Vector3<S>& g) { return base_acceleration(g); }),
      row("free-fall-from-gravity",
          []<typename S>(const Pose<S>&, const Vector3<S>& g) { return free_fall(g); }),

      row("newton-euler-wrench",
          []<typename S>(const RigidBodyInertia<S>& I, const VelocityTwist<S>& V,
                         const AccelerationTwist<S>& A) { return newton_euler(I, V, A); }),
      row("newton-euler-wrench-across-revolute",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I, const VelocityTwist<S>& V,
                         const VelocityTwist<S>& V_relative, const AccelerationTwist<S>& A,
                         const AccelerationTwist<S>& A_relative) {
            return newton_euler_across_revolute(X, I, V, V_relative, A, A_relative);
          }),
      row("acceleration-twist-to-wrench",
          []<typename S>(const RigidBodyInertia<S>& I, const AccelerationTwist<S>& A) {
            return newton_euler_at_rest(I, A);
          }),
      row("acceleration-twist-to-wrench-across-revolute",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I,
                         const AccelerationTwist<S>& A, const AccelerationTwist<S>& A_relative) {
            return newton_euler_at_rest_across_revolute(X, I, A, A_relative);
          }),
      row("transform-wrench-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const Wrench<S>& W_B) {
            return transform_to_proximal(X_AB, W_B);
          }),
      row("accumulate-wrench",
          []<typename S>(const Wrench<S>& a, const Wrench<S>& b) { return add(a, b); }),
      row("rotate-wrench-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const Wrench<S>& W_B) {
            return rotate_to_proximal(X_AB, W_B);
          }),
      row("rotate-wrench-to-distal",
          []<typename S>(const Pose<S>& X_AB, const Wrench<S>& W_A) {
            return rotate_to_distal(X_AB, W_A);
          }),

      // Inertias of several bodies.
      row("transform-rigid-body-inertia-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const RigidBodyInertia<S>& I_B) {
            return transform_to_proximal(X_AB, I_B);
          }),
      row("accumulate-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& a, const RigidBodyInertia<S>& b) {
            return add(a, b);
          }),
      row("wrench-of-revolute-from-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& I) { return wrench_of_revolute(I); }),
      row("wrench-of-prismatic-from-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& I) { return wrench_of_prismatic(I); }),
      row("articulated-from-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& I) { return articulated(I); }),
      row("accumulate-articulated-body-inertia",
          []<typename S>(const ArticulatedInertia<S>& a, const ArticulatedInertia<S>& b) {
            return add(a, b);
          }),
      row("transform-articulated-body-inertia-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const ArticulatedInertia<S>& I_B) {
            return transform_to_proximal(X_AB, I_B);
          }),
      row("wrench-of-revolute-from-articulated-body-inertia",
          []<typename S>(const ArticulatedInertia<S>& I) { return wrench_of_revolute(I); }),
      row("wrench-of-prismatic-from-articulated-body-inertia",
          []<typename S>(const ArticulatedInertia<S>& I) { return wrench_of_prismatic(I); }),
      row("project-articulated-body-inertia",
          []<typename S>(const ArticulatedInertia<S>& I, const Wrench<S>& U, const S& D) {
            return project(I, U, D);
          }),
      row("project-wrench", []<typename S>(const Wrench<S>& W, const Wrench<S>& U, const S& D,
                                           const S& u) { return project(W, U, D, u); }),
      row("joint-acceleration-from-force",
          []<typename S>(const S& u, const Wrench<S>& U, const S& D,
                         const AccelerationTwist<S>& A) { return joint_acceleration(u, U, D, A); }),
      row("subtract-joint-force", []<typename S>(const S& a, const S& b) { return S(a - b); }),

      // A floating base.
      row("position-to-pose-floating",
          []<typename S>(const FloatingPosition<S>& q) { return floating_pose(q); }),
      row("velocity-to-twist-floating", []<typename S>(const VelocityTwist<S>& V) { return V; }),
      row("acceleration-to-twist-floating",
          []<typename S>(const AccelerationTwist<S>& derivative, const VelocityTwist<S>& V) {
            return floating_acceleration(derivative, V);
          }),
      row("force-from-wrench-floating", []<typename S>(const Wrench<S>& W) { return W; }),
      row("subtract-floating-force",
          []<typename S>(const Wrench<S>& a, const Wrench<S>& b) {
            return Wrench<S>{a.moment - b.moment, a.force - b.force};
          }),
      row("floating-acceleration-from-force",
          []<typename S>(const ArticulatedInertia<S>& I, const Wrench<S>& u) {
            return solve(I, u);
          }),

      // Momentum, energy, centre of mass.
      row("momentum-from-velocity-twist",
          []<typename S>(const RigidBodyInertia<S>& I, const VelocityTwist<S>& V) {
            return momentum(I, V);
          }),
      row("transform-momentum-to-proximal",
          []<typename S>(const Pose<S>& X_AB, const Momentum<S>& P_B) {
            return transform_to_proximal(X_AB, P_B);
          }),
      row("accumulate-momentum",
          []<typename S>(const Momentum<S>& a, const Momentum<S>& b) { return add(a, b); }),
      row("momentum-about-center-of-mass",
          []<typename S>(const Momentum<S>& P, const Vector3<S>& c) { return about(P, c); }),
      row("centroidal-momentum-column-revolute",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I, const Vector3<S>& c) {
            return centroidal_momentum_column_revolute(X, I, c);
          }),
      row("centroidal-momentum-column-prismatic",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I, const Vector3<S>& c) {
            return centroidal_momentum_column_prismatic(X, I, c);
          }),
      row("centroidal-momentum-columns-floating",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I, const Vector3<S>& c) {
            return centroidal_momentum_columns_floating(X, I, c);
          }),
      row("kinetic-energy-from-momentum",
          []<typename S>(const VelocityTwist<S>& V, const Momentum<S>& P) {
            return kinetic_energy(V, P);
          }),
      row("add-energy", []<typename S>(const S& a, const S& b) { return S(a + b); }),
      row("potential-energy-from-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& I, const AccelerationTwist<S>& A) {
            return potential_energy(I, A);
          }),
      row("center-of-mass-from-rigid-body-inertia",
          []<typename S>(const RigidBodyInertia<S>& I) { return center_of_mass(I); }),
      row("center-of-mass-velocity-from-momentum",
          []<typename S>(const RigidBodyInertia<S>& I, const Momentum<S>& P) {
            return center_of_mass_velocity(I, P);
          }),
      row("center-of-mass-column-revolute",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I,
                         const RigidBodyInertia<S>& total) {
            return center_of_mass_column_revolute(X, I, total);
          }),
      row("center-of-mass-column-prismatic",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I,
                         const RigidBodyInertia<S>& total) {
            return center_of_mass_column_prismatic(X, I, total);
          }),
      row("center-of-mass-columns-floating",
          []<typename S>(const Pose<S>& X, const RigidBodyInertia<S>& I,
                         const RigidBodyInertia<S>& total) {
            return center_of_mass_columns_floating(X, I, total);
          }),

      row("jacobian-columns-floating",
          []<typename S>(const Pose<S>& X_RC, const Pose<S>& X_RB) {
            return jacobian_columns_floating(X_RC, X_RB);
          }),
      row("jacobian-column-revolute",
          []<typename S>(const Pose<S>& X_RC, const Pose<S>& X_RB) {
            return jacobian_column_revolute(X_RC, X_RB);
          }),
      row("jacobian-column-prismatic",
          []<typename S>(const Pose<S>& X_RC, const Pose<S>& X_RB) {
            return jacobian_column_prismatic(X_RC, X_RB);
          }),

      // Hybrid dynamics.
      row("subtract-wrench",
          []<typename S>(const Wrench<S>& a, const Wrench<S>& b) { return subtract(a, b); }),
      row("add-joint-force", []<typename S>(const S& a, const S& b) { return S(a + b); }),
      row("add-floating-force",
          []<typename S>(const Wrench<S>& a, const Wrench<S>& b) { return add(a, b); }),
      row("joint-acceleration-from-drive",
          []<typename S>(const S& e, const S& D) { return S(e / D); }),
      row("release-wrench", []<typename S>(const Wrench<S>& F, const Wrench<S>& U,
                                           const S& qdd) { return release(F, U, qdd); }),
      row("acceleration-energy-of-wrench",
          []<typename S>(const Wrench<S>& F, const AccelerationTwist<S>& A) {
            return acceleration_energy(F, A);
          }),
      row("acceleration-energy-of-floating-force",
          []<typename S>(const Wrench<S>& F, const AccelerationTwist<S>& A) {
            return acceleration_energy(F, A);
          }),
      row("add-acceleration-energy", []<typename S>(const S& a, const S& b) { return S(a + b); }),
      row("subtract-acceleration-energy",
          []<typename S>(const S& a, const S& b) { return S(a - b); }),
  };
  for (const Kernel& kernel : kernels_of_control()) rows.push_back(kernel);
  for (const Kernel& kernel : kernels_of_relative_motion()) rows.push_back(kernel);
  for (const Kernel& kernel : kernels_of_joints()) rows.push_back(kernel);
  for (const Kernel& kernel : kernels_of_many()) rows.push_back(kernel);
  for (const Kernel& kernel : constraint_kernels()) rows.push_back(kernel);
  std::sort(rows.begin(), rows.end(),
            [](const Kernel& a, const Kernel& b) { return a.operation < b.operation; });
  return rows;
}

}  // namespace

namespace {

// A program asks for the rows of thousands of closures. Names differ in their lengths, or in the
// letters at their ends.
struct HashOfName {
  std::size_t operator()(std::string_view name) const {
    if (name.empty()) return 0;
    std::uint64_t first = 0, last = 0;
    const std::size_t n = std::min(name.size(), sizeof first);
    std::memcpy(&first, name.data(), n);
    std::memcpy(&last, name.data() + name.size() - n, n);
    const std::uint64_t h = (first ^ std::rotl(last, 23) ^ name.size()) * 0x9e3779b97f4a7c15U;
    return h ^ h >> 32U;
  }
};

}  // namespace

std::span<const Kernel> kernels() {
  static const std::vector<Kernel> rows = make_kernels();
  return rows;
}

const Kernel* find_kernel(std::string_view operation) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Kernel*, HashOfName> rows;
    for (const Kernel& kernel : kernels()) rows.emplace(kernel.operation, &kernel);
    return rows;
  }();
  const auto at = by_name.find(operation);
  return at == by_name.end() ? nullptr : at->second;
}

std::string support_function(std::string_view operation) {
  std::string name = "sinew_" + std::string(operation);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace sinew::program
