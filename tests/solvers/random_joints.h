// Trees with joints of every kind, as a model in Turtle and as plain numbers for a reference.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew::test {

// One turn or slide, in the frames that its joint's attachments are at position zero.
struct TestMotion {
  bool turns = true;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  int coordinate = 0;  // index of the velocity that moves it
  double ratio = 1, offset = 0;
};

struct TestJoint {
  std::string name, kind;  // "revolute", "spherical", …
  int parent = 0;          // link; the child is the link of the same index + 1
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();  // in the parent link's frame
  std::vector<TestMotion> motions;   // of spherical and floating joints: none
  int velocity = 0, velocities = 0;  // first index and number of its coordinates; 0 if it follows
  int position = 0, positions = 0;
  int leader = -1;  // joint that it follows
  double multiplier = 1, offset = 0;
  double pitch = 0;
  double gear = 0, rotor = 0;
};

struct TestLink {
  double mass = 1;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();  // about the centre of mass
};

struct TestRobot {
  std::vector<TestLink> links;  // the first is the base
  std::vector<TestJoint> joints;
  int positions = 0, velocities = 0;
};

struct RandomJoints {
  unsigned joints = 10;
  double branching = 0.3;
  bool couplings = true;  // joints that follow others (helical ones do so inside)
  bool rotors = true;
  std::uint32_t seed = 1;
  std::vector<std::string> kinds = {"revolute",  "prismatic", "helical",  "cylindrical", "planar",
                                    "universal", "spherical", "floating", "composite"};
};

TestRobot random_joints(const RandomJoints& options);

// The same on a floating base: a first joint, "base", floats between a new link 0 and the old one.
TestRobot behind_a_floating_joint(const TestRobot& robot);

// The robot as a model; link K is linkK, its frame linkK-root.
std::string turtle(const TestRobot& robot);

}  // namespace sinew::test
