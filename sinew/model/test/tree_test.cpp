// From a model to a tree: roots, directions, order, tips, frames, units.
#include <gtest/gtest.h>

#include "newton_euler.h"
#include "small_models.h"

namespace sinew::model::test {
namespace {

// base - j1 - upper - j2 - lower, each joint a quarter turn about x from the one before it.
std::string two_joints() {
  return link("base", {"base-j1"}) + link("upper", {"upper-j2"}) + link("lower", {"tip"}) +
         pose("base-j1", "base-root", "0 0 1") + pose("upper-j2", "upper-root", "0.5 0 0", true) +
         pose("tip", "lower-root", "0.25 0 0") + joint("j1", "base-j1", "upper-root") +
         joint("j2", "upper-j2", "lower-root");
}

std::string names(const Model& model, const auto& elements) {
  std::string text;
  for (const auto& element : elements) {
    const std::string_view iri = model.store.terms().text(element.iri);
    text += std::string(iri.substr(iri.find('#') + 1)) + " ";
  }
  return text;
}

TEST(Tree, StartsAtTheOnlyRootAndFollowsTheJoints) {
  Model model;
  normalise_texts(model, {turtle(two_joints())});
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(names(model, model.tree.bodies), "base upper lower ");
  EXPECT_EQ(names(model, model.tree.joints), "j1 j2 ");
}

TEST(Tree, GoesDepthFirstInTheOrderOfTheModelsJoints) {
  Model model;
  normalise_texts(
      model, {turtle(link("base", {"a", "b"}) + link("one", {"c"}) + link("two") + link("three") +
                     pose("a", "base-root", "0 0 0") + pose("b", "base-root", "1 0 0") +
                     pose("c", "one-root", "0 0 1") + joint("jb", "b", "two-root") +
                     joint("ja", "a", "one-root") + joint("jc", "c", "three-root"))});
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(names(model, model.tree.joints), "jb ja jc ");
  EXPECT_EQ(names(model, model.tree.bodies), "base two one three ");
}

TEST(Tree, MayBeRootedAtAnyLinkAndGivesTheSameRelativePoses) {
  Model forward, backward;
  normalise_texts(forward, {turtle(two_joints())});
  NormaliseOptions options;
  options.base = "lower";
  normalise_texts(backward, {turtle(two_joints())}, options);
  ASSERT_EQ(first_error(backward), "");
  EXPECT_EQ(names(backward, backward.tree.bodies), "lower upper base ");
  EXPECT_EQ(names(backward, backward.tree.joints), "j2 j1 ");
  EXPECT_TRUE(backward.tree.joints[0].against_its_direction);

  const Dynamics there = newton_euler(forward.tree, {{0.3, -0.7}, {0, 0}, {0, 0}});
  const Dynamics back = newton_euler(backward.tree, {{-0.7, 0.3}, {0, 0}, {0, 0}});
  const Pose X_base_tip = pose_of(forward.tree, there, forward.frame("#tip")->iri);
  const Pose X_lower_base = pose_of(backward.tree, back, backward.frame("#base-root")->iri);
  const Pose X_lower_tip = pose_of(backward.tree, back, backward.frame("#tip")->iri);
  const Pose X = math::compose(math::invert(X_lower_base), X_lower_tip);
  EXPECT_NEAR(X.p.x, X_base_tip.p.x, 1e-15);
  EXPECT_NEAR(X.p.y, X_base_tip.p.y, 1e-15);
  EXPECT_NEAR(X.p.z, X_base_tip.p.z, 1e-15);
  EXPECT_NEAR(X.R.xy, X_base_tip.R.xy, 1e-15);
  EXPECT_NEAR(X.R.zx, X_base_tip.R.zx, 1e-15);
}

TEST(Tree, TakesAFrameAsItsBaseToo) {
  Model model;
  NormaliseOptions options;
  options.base = "tip";
  normalise_texts(model, {turtle(two_joints())}, options);
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(model.store.terms().text(model.tree.bodies[0].frame), "https://example.org/r#tip");
}

TEST(Tree, RefusesSeveralRootsAndListsThem) {
  Model model;
  normalise_texts(model, {turtle(two_joints() + link("stray"))});
  EXPECT_NE(first_error(model).find("2 roots: <https://example.org/r#base>, "
                                    "<https://example.org/r#stray>"),
            std::string::npos)
      << first_error(model);
}

TEST(Tree, KeepsOnlyWhatLeadsToTheTips) {
  Model model;
  NormaliseOptions options;
  options.tips = {"upper"};
  normalise_texts(model, {turtle(two_joints())}, options);
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(names(model, model.tree.bodies), "base upper ");
  EXPECT_FALSE(model.frame("#tip"));
}

TEST(Tree, RefusesATipThatNoJointsLeadTo) {
  Model model;
  NormaliseOptions options;
  options.base = "base";
  options.tips = {"stray"};
  normalise_texts(model, {turtle(two_joints() + link("stray"))}, options);
  EXPECT_NE(first_error(model).find("no joints lead from the base"), std::string::npos)
      << first_error(model);
}

TEST(Tree, RefusesNamesThatAreNothingInTheModel) {
  Model model;
  NormaliseOptions options;
  options.base = "bese";
  normalise_texts(model, {turtle(two_joints())}, options);
  EXPECT_NE(first_error(model).find("'bese' is nothing"), std::string::npos) << first_error(model);
}

TEST(Tree, RefusesALoopAndNamesItsJoints) {
  Model model;
  normalise_texts(model, {turtle(link("base", {"a", "b"}) + link("one", {"c"}) +
                                 link("two", {"d"}) + pose("a", "base-root", "0 0 0") +
                                 pose("b", "base-root", "1 0 0") + pose("c", "one-root", "0 0 1") +
                                 pose("d", "two-root", "0 1 0") + joint("ja", "a", "one-root") +
                                 joint("jb", "b", "two-root") + joint("jc", "c", "d"))});
  const std::string error = first_error(model);
  EXPECT_NE(error.find("form a loop"), std::string::npos) << error;
  for (const char* name : {"#ja", "#jb", "#jc"}) {
    EXPECT_NE(error.find(name), std::string::npos) << error;
  }
}

TEST(Tree, MakesOneBodyOfLinksThatAreFixedToEachOther) {
  Model model;
  normalise_texts(model, {turtle(two_joints() + link("tool") +
                                 joint("mount", "tip", "tool-root", "skc:FixedJoint"))});
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.tree.bodies.size(), 3u);
  EXPECT_EQ(model.tree.bodies[2].links.size(), 2u);
  EXPECT_EQ(model.frame("#tool-root")->body, 2u);
}

TEST(Tree, WalksAnUndirectedJointAwayFromTheBaseAndSaysSo) {
  Model model;
  NormaliseOptions options;
  options.base = "base";
  normalise_texts(model,
                  {turtle(link("base", {"a"}) + link("one") + pose("a", "base-root", "0 0 1") +
                          joint("j", "one-root", "a", "kc:RevoluteJoint", false))},
                  options);
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.report.problems().size(), 1u);
  EXPECT_NE(model.report.problems()[0].what.find("which attachment the position is of"),
            std::string::npos);
}

TEST(Tree, ReadsMillimetresAsMetres) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  normalise_texts(
      model,
      {turtle(link("base", {"a"}) + link("one") +
              pose("a", "base-root", "250 0 0", false, "MilliM") + joint("j", "a", "one-root"))},
      options);
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(model.tree.joints[0].placement.p.x, 0.25);
}

TEST(Tree, ComposesChainsOfStaticPosesInEitherDirection) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  // a <- middle -> base-root: one pose is to be inverted.
  normalise_texts(
      model,
      {turtle(link("base", {"middle", "a"}) + link("one") + pose("a", "middle", "1 0 0", true) +
              pose("base-root", "middle", "0 0 -2") + joint("j", "a", "one-root"))},
      options);
  ASSERT_EQ(first_error(model), "");
  NormaliseOptions at_base;
  at_base.base = "base-root";
  const Pose& X = model.tree.joints[0].placement;
  const Tree::Frame* root = model.frame("#base-root");
  const Pose in_root = math::compose(math::invert(root->placement), X);
  EXPECT_EQ(in_root.p.x, 1);
  EXPECT_EQ(in_root.p.z, 2);
  EXPECT_EQ(in_root.R.yz, -1);
}

TEST(Tree, PutsZOnTheAxisThatTheJointNames) {
  // The joint turns about the y of its attachments, against it.
  Model model;
  normalise_texts(
      model, {turtle(link("base", {"a"}) + link("one") + pose("a", "base-root", "0 0 1") +
                     ":a geom:vector-y :a-y . :a-y a geom:Vector ; geom:start :a-origin .\n"
                     ":one-root geom:vector-y :one-y . :one-y a geom:Vector .\n"
                     ":j a kc:Joint, kc:RevoluteJoint ; kc:between-attachments :a, :one-root ;\n"
                     "  kc:common-axis :j-axis ; kc:polarity skc:NegativePolarity ;\n"
                     "  kc:origin-offset :j-offset .\n"
                     ":j-axis a rel:LineCollinearity ; rel:lines :a-y, :one-y .\n"
                     ":j-offset a rel:Position ; rel:of :one-root-origin ;\n"
                     "  rel:with-respect-to :a-origin .\n")});
  ASSERT_EQ(first_error(model), "");
  const Matrix3& R = model.tree.joints[0].placement.R;
  EXPECT_EQ(R.xz, 0);
  EXPECT_EQ(R.yz, -1);
  EXPECT_EQ(R.zz, 0);
  // Turned by q, the link has turned by -q about y.
  const Dynamics result = newton_euler(model.tree, {{0.3}, {0}, {0}});
  const Pose X = pose_of(model.tree, result, model.frame("#one-root")->iri);
  EXPECT_NEAR(X.R.xz, std::sin(-0.3), 1e-16);
  EXPECT_NEAR(X.R.zx, -std::sin(-0.3), 1e-16);
}

TEST(Tree, KeepsAConstantOffsetAlongTheAxis) {
  Model model;
  normalise_texts(model,
                  {turtle(link("base", {"a"}) + link("one") + pose("a", "base-root", "0 0 1") +
                          joint("j", "a", "one-root") +
                          ":offset-coord a coord:PositionCoordinate ;\n"
                          "  coord:of-position :j-offset ; coord:as-seen-by :a ;\n"
                          "  qudt:unit unit:CentiM ; coord:x 0 ; coord:y 0 ; coord:z 5 .\n")});
  ASSERT_EQ(first_error(model), "");
  const Dynamics result = newton_euler(model.tree, {{1}, {0}, {0}});
  EXPECT_NEAR(pose_of(model.tree, result, model.frame("#one-root")->iri).p.z, 1.05, 1e-15);
}

TEST(Tree, RefusesAConstantPoseAcrossAMovingJoint) {
  Model model;
  normalise_texts(model, {turtle(two_joints() + pose("upper-j2", "base-root", "0 0 3"))});
  EXPECT_NE(first_error(model).find("same rigid body"), std::string::npos) << first_error(model);
}

TEST(Tree, SaysThatThereIsNoGravityWhereNoneIsStated) {
  Model model;
  normalise_texts(model, {turtle(two_joints())});
  const auto& notes = model.tree.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note) { return note.find("no gravity") == 0; }));
  EXPECT_EQ(model.tree.base_acceleration.linear.z, 0);
}

TEST(Tree, TakesGravityFromTheOptionsBeforeTheModels) {
  Model model;
  NormaliseOptions options;
  options.gravity = Vector3{0, 1, -2};
  normalise_texts(model, {turtle(two_joints())}, options);
  EXPECT_EQ(model.tree.base_acceleration.linear.y, -1);
  EXPECT_EQ(model.tree.base_acceleration.linear.z, 2);
}

TEST(Tree, KnowsTheWayToABody) {
  Model model;
  normalise_texts(model, {turtle(two_joints())});
  EXPECT_EQ(model.tree.path(2), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(model.tree.path(0).empty());
}

}  // namespace
}  // namespace sinew::model::test
