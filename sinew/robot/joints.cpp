#include "sinew/robot/joints.h"

#include <cmath>
#include <limits>

#include "sinew/algorithm/names.h"
#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

[[noreturn]] void fail(const std::string& iri, std::string what, std::string remedy) {
  throw Error(Problem{{}, iri, std::move(what), std::move(remedy), {}, {}});
}

}  // namespace

Joints::Joints(const model::Tree& tree, const graph::Terms& terms) {
  for (const model::Tree::Joint& joint : tree.joints) {
    const std::string iri(terms.text(joint.iri));
    const double maximum = joint.limits.maximum_force;
    joints_.push_back({iri, std::string(algorithm::short_name(iri)),
                       std::isnan(maximum) ? std::numeric_limits<double>::infinity() : maximum});
  }
}

std::size_t Joints::of(const program::Variable& block) const {
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i].iri == block.represents) return i;
  fail(block.iri,
       block.name + " belongs to " + block.represents + ", which is no joint of the robot",
       "give the robot the model that the algorithm was made for");
}

runtime::Channel Joints::measurement(const program::Variable& block) const {
  const auto n = static_cast<runtime::Channel>(joints_.size());
  if (block.quantity == "joint-position") return static_cast<runtime::Channel>(of(block));
  if (block.quantity == "joint-velocity") return n + static_cast<runtime::Channel>(of(block));
  fail(block.iri, "the robot does not measure " + block.name + ", a " + block.quantity,
       "it measures joint positions and joint velocities");
}

runtime::Channel Joints::command(const program::Variable& block) const {
  if (block.quantity == "joint-force") return static_cast<runtime::Channel>(of(block));
  fail(block.iri, "the robot does not take " + block.name + ", a " + block.quantity,
       "it takes joint forces");
}

std::size_t Joints::find(const std::string& name) const {
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i].name == name || joints_[i].iri == name) return i;
  fail("", "the robot has no joint '" + name + "'", "name one by its IRI or its last segment");
}

}  // namespace sinew::robot
