// Programs for tests, written by hand: the inverse dynamics of a serial chain, as synthesis would
// make it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sinew/program/program.h"

namespace sinew::test {

struct ChainJoint {
  bool revolute = true;
  std::array<double, 12> placement{};  // pose of the joint frame in the predecessor's frame, [R p]
  std::array<double, 10> inertia{};    // of the successor: m, m c, Ixx Ixy Ixz Iyy Iyz Izz
};

// A placement: rotation about x by `twist`, then the offset.
std::array<double, 12> placement(double twist_rad, double x, double y, double z);

// Inputs position.jointK, velocity.jointK, acceleration.jointK; outputs force.jointK, and pose.tip
// if asked. Gravity along -z of the base.
program::Program inverse_dynamics(const std::vector<ChainJoint>& joints,
                                  bool with_tip_pose = false);

// Seven joints with every kind of placement: parallel, perpendicular and slanted axes, one
// prismatic.
std::vector<ChainJoint> mixed_chain();

// Adds the input `push` (6 numbers) to the state and output `total`, which begins as 1 2 3 4 5 6.
program::Program running_sum();

// The same chain in plain textbook form, with dense matrices in the base frame: for comparison.
std::vector<double> dense_inverse_dynamics(const std::vector<ChainJoint>& joints,
                                           const std::vector<double>& position,
                                           const std::vector<double>& velocity,
                                           const std::vector<double>& acceleration);

}  // namespace sinew::test
