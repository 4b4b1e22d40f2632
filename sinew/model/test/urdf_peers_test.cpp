// Every URDF of the test material, imported and normalised, against Orocos KDL built from what
// urdfdom reads of the same file: torques of inverse dynamics and poses of all links.
#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <map>
#include <random>

#include "models.h"
#include "newton_euler.h"

namespace sinew::model::test {
namespace {

constexpr double kRounding = 1e-13;

KDL::Frame to_kdl(const urdf::Pose& pose) {
  double x, y, z, w;
  pose.rotation.getQuaternion(x, y, z, w);
  return {KDL::Rotation::Quaternion(x, y, z, w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

KDL::RigidBodyInertia to_kdl(const urdf::Inertial& inertial) {
  const KDL::Frame origin = to_kdl(inertial.origin);
  const KDL::RigidBodyInertia about_com(
      inertial.mass, KDL::Vector::Zero(),
      KDL::RotationalInertia(inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy, inertial.ixz,
                             inertial.iyz));
  return origin * about_com;
}

void add_children(const urdf::Link& link, KDL::Tree& tree) {
  for (const auto& joint : link.child_joints) {
    const KDL::Frame F = to_kdl(joint->parent_to_joint_origin_transform);
    const KDL::Vector axis(joint->axis.x, joint->axis.y, joint->axis.z);
    KDL::Joint kdl_joint(joint->name, KDL::Joint::None);
    if (joint->type == urdf::Joint::REVOLUTE || joint->type == urdf::Joint::CONTINUOUS) {
      kdl_joint = KDL::Joint(joint->name, F.p, F.M * axis, KDL::Joint::RotAxis);
    } else if (joint->type == urdf::Joint::PRISMATIC) {
      kdl_joint = KDL::Joint(joint->name, F.p, F.M * axis, KDL::Joint::TransAxis);
    }
    const auto child =
        std::find_if(link.child_links.begin(), link.child_links.end(),
                     [&](const auto& l) { return l->name == joint->child_link_name; });
    ASSERT_NE(child, link.child_links.end());
    const auto inertia =
        (*child)->inertial ? to_kdl(*(*child)->inertial) : KDL::RigidBodyInertia::Zero();
    ASSERT_TRUE(tree.addSegment(KDL::Segment((*child)->name, kdl_joint, F, inertia), link.name));
    add_children(**child, tree);
  }
}

class UrdfAgainstKdl : public testing::TestWithParam<const char*> {};

TEST_P(UrdfAgainstKdl, GivesTheSameTorquesAndPoses) {
  const auto file = shared() / "robots" / GetParam();
  SINEW_NEEDS(file);
  const auto peer = urdf::parseURDFFile(file.string());
  ASSERT_TRUE(peer);
  KDL::Tree kdl(peer->getRoot()->name);
  add_children(*peer->getRoot(), kdl);

  for (const bool choose_frames : {false, true}) {
    Model model;
    NormaliseOptions options;
    options.choose_frames = choose_frames;
    options.snap_tolerance = 0;  // KDL clears nothing either
    options.gravity = Vector3{0.3, -0.4, -9.81};
    load_and_normalise(model, {file}, options);
    ASSERT_FALSE(model.report.has_errors()) << model.problems();
    const Tree& tree = model.tree;
    ASSERT_EQ(tree.joints.size(), kdl.getNrOfJoints());

    std::map<std::string, std::size_t> index;  // of our joints by name
    for (std::size_t k = 0; k < tree.joints.size(); ++k) {
      const std::string_view iri = model.store.terms().text(tree.joints[k].iri);
      index[std::string(iri.substr(iri.rfind('/') + 1))] = k;
    }
    KDL::TreeIdSolver_RNE solver(kdl, KDL::Vector(0.3, -0.4, -9.81));
    KDL::TreeFkSolverPos_recursive position_solver(kdl);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    for (int sample = 0; sample < 20; ++sample) {
      const auto n = static_cast<unsigned>(tree.joints.size());
      Motion motion{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
      KDL::JntArray q(n), qd(n), qdd(n), tau(n);
      for (const auto& [name, segment] : kdl.getSegments()) {
        if (segment.segment.getJoint().getType() == KDL::Joint::None) continue;
        const std::size_t k = index.at(segment.segment.getJoint().getName());
        q(segment.q_nr) = motion.q[k] = uniform(random);
        qd(segment.q_nr) = motion.qd[k] = uniform(random);
        qdd(segment.q_nr) = motion.qdd[k] = uniform(random);
      }
      ASSERT_EQ(solver.CartToJnt(q, qd, qdd, KDL::WrenchMap(), tau), 0);
      const Dynamics ours = newton_euler(tree, motion);
      for (const auto& [name, segment] : kdl.getSegments()) {
        KDL::Frame F;
        ASSERT_GE(position_solver.JntToCart(q, F, name), 0);
        const Tree::Frame* frame = model.frame("/frame/" + name);
        ASSERT_TRUE(frame) << name;
        const Pose X = pose_of(tree, ours, frame->iri);
        EXPECT_NEAR(X.p.x, F.p.x(), kRounding) << name;
        EXPECT_NEAR(X.p.z, F.p.z(), kRounding) << name;
        EXPECT_NEAR(X.R.xy, F.M(0, 1), kRounding) << name;
        EXPECT_NEAR(X.R.zx, F.M(2, 0), kRounding) << name;
        if (segment.segment.getJoint().getType() == KDL::Joint::None) continue;
        const double expected = tau(segment.q_nr);
        EXPECT_NEAR(ours.forces[index.at(segment.segment.getJoint().getName())], expected,
                    kRounding * (1 + std::abs(expected)))
            << name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, UrdfAgainstKdl,
                         testing::Values("gen3_7dof.urdf", "iiwa.urdf", "hyq.urdf", "panda.urdf",
                                         "ur5_robot.urdf", "baxter.urdf", "double_pendulum.urdf",
                                         "clean/gen3.urdf", "clean/iiwa.urdf", "clean/hyq.urdf",
                                         "clean/general_7r.urdf"));

}  // namespace
}  // namespace sinew::model::test
