// Models that leave something open, say it twice, or say it where nobody looks: each is refused (or
// warned of) where it stands, and what is only said in another way is read as it is meant.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "small_models.h"

namespace sinew::model::test {
namespace {

// A link on a joint, with an inertia of 2 kg about its centre of mass, 0.5 m along x.
std::string arm() {
  return link("base", {"mount"}) + link("arm") + pose("mount", "base-root", "0 0 1") +
         joint("j", "mount", "arm-root") + R"(
:arm geom:simplices :com .
:com-of-arm a rel:Position ; rel:of :com ; rel:with-respect-to :arm-root-origin .
:com-of-arm-coord a coord:PositionCoordinate ; coord:of-position :com-of-arm ;
  coord:as-seen-by :arm-root ; qudt:unit unit:M ; coord:x 0.5 ; coord:y 0 ; coord:z 0 .
:inertia a dyn:RigidBodyInertia ; dyn:of-body :arm ; dyn:about :com .
:inertia-coord a dync:RigidBodyInertiaCoordinate ; dync:of-inertia :inertia ;
  dync:as-seen-by :arm-root ; qudt:unit unit:KiloGM, unit:M-KiloGM, unit:KiloGM-M2 ;
  dync:mass 2 ; dync:first-moment-of-mass (0 0 0) ;
  dync:ixx 1 ; dync:iyy 1 ; dync:izz 1 ; dync:ixy 0 ; dync:ixz 0 ; dync:iyz 0 .
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string position_coordinates(const std::string& id, const std::string& of,
                                 const std::string& seen_by, const std::string& xyz) {
  return ":" + id + " a coord:PositionCoordinate ; coord:of-position :" + of +
         " ; coord:as-seen-by :" + seen_by + " ; qudt:unit unit:M ; " + xyz + " .\n";
}

// Three joints in a row, of which a chain lists some.
std::string three_joints(const std::string& listed) {
  return link("base") + link("upper", {"elbow"}) + link("lower", {"wrist"}) + link("hand") +
         pose("elbow", "upper-root", "0 0 1") + pose("wrist", "lower-root", "0 0 1") +
         joint("j1", "base-root", "upper-root") + joint("j2", "elbow", "lower-root") +
         joint("j3", "wrist", "hand-root") + ":chain a kc:KinematicChain ; kc:joints " + listed +
         " .\n";
}

struct Unclear {
  const char* name;
  std::string model;
  const char* iri;     // of the node that the first error names
  const char* phrase;  // of what it says
};

std::vector<Unclear> unclear_models() {
  const auto limit = [](const std::string& id, const std::string& upper) {
    return ":" + id +
           " a skc:JointPositionLimits ; "
           "<https://comp-rob2b.github.io/metamodels/kinematic-chain/state#of-joint> :j ; "
           "qudt:unit unit:RAD ; skc:lower -1.0 ; skc:upper " +
           upper + " .\n";
  };
  return {
      {"JointOfTwoKinds", arm() + ":j a skc:PrismaticJoint .", "r#j", "of 2 kinds"},
      {"KindOfJointThatIsNoJoint",
       replaced(arm(), ":j a kc:Joint, kc:RevoluteJoint", ":j a kc:RevoluteJoint"), "r#j",
       "is a RevoluteJoint, but the node is no Joint"},
      {"TwoPolarities", arm() + ":j kc:polarity kc:PositivePolarity, skc:NegativePolarity .", "r#j",
       "two polarities"},
      {"TwoOffsets", arm() + ":j kc:origin-offset :com-of-arm .", "r#j",
       "the joint's offset is stated 2 times"},
      {"TwoCoordinatesOfTheOffset",
       arm() +
           position_coordinates("o1", "j-offset", "mount", "coord:x 0 ; coord:y 0 ; coord:z 0.1") +
           position_coordinates("o2", "j-offset", "mount", "coord:x 0 ; coord:y 0 ; coord:z 0.2"),
       "r#o2", "has coordinates already, <https://example.org/r#o1>"},
      {"UnknownAxis", replaced(arm(), "kc:common-axis :j-axis", "kc:common-axis :elsewhere"), "r#j",
       "none of the lines of <https://example.org/r#elsewhere>"},
      {"FrameWithTwoOrigins", arm() + ":arm-root geom:origin :com .", "r#arm-root",
       "the frame's origin is stated 2 times"},
      {"InertiaOfTwoLinks", arm() + ":inertia dyn:of-body :base .", "r#inertia",
       "is of <https://example.org/r#arm> and of <https://example.org/r#base>"},
      {"InertiaWithoutItsType",
       replaced(arm(), "a dync:RigidBodyInertiaCoordinate", "a dync:MassScalar"), "r#inertia-coord",
       "no RigidBodyInertiaCoordinate"},
      {"InertiaWithoutMassAndMoment",
       replaced(replaced(arm(), "dync:mass 2 ;", ""), "dync:ixx 1 ;", ""), "r#inertia-coord",
       "coordinates#mass> is missing"},
      {"PoseWithoutItsType",
       replaced(arm(), "-coord a coord:PoseCoordinate", "-coord a coord:PoseReference"),
       "r#pose-mount-base-root-coord", "no PoseCoordinate"},
      {"PointAtTwoPlaces",
       arm() + position_coordinates("again", "com-of-arm", "arm-root",
                                    "coord:x 0.6 ; coord:y 0 ; coord:z 0"),
       "r#", "of it, 0.1 m apart"},
      {"OriginAtTwoPlaces",
       arm() + ":arm geom:simplices :grip . :grip a geom:Frame ; geom:origin :arm-root-origin .\n" +
           pose("grip", "arm-root", "0 0.2 0"),
       "r#grip", "of it, 0.2 m apart"},
      {"LimitsTwice", arm() + limit("l1", "1.0") + limit("l2", "2.0"), "r#l2", "stated already"},
      {"JointThatItsChainForgets", three_joints(":j1, :j3"), "r#j2",
       "moves <https://example.org/r#upper> and <https://example.org/r#lower> of "
       "<https://example.org/r#chain>, which does not list it"},
      {"ChainOfNoJoint", arm() + ":chain a kc:KinematicChain ; kc:joints :j, :k .", "r#chain",
       "<https://example.org/r#k> is no joint"},
  };
}

class UnclearModels : public testing::TestWithParam<Unclear> {};

TEST_P(UnclearModels, AreRefusedWhereTheyAreUnclear) {
  Model model;
  normalise_texts(model, {turtle(GetParam().model)});
  ASSERT_TRUE(model.report.has_errors()) << model.problems();
  const std::string error = first_error(model);
  EXPECT_EQ(error.find("model.ttl:"), 0u) << error;
  EXPECT_NE(error.find(GetParam().iri), std::string::npos) << error;
  EXPECT_NE(error.find(GetParam().phrase), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(, UnclearModels, testing::ValuesIn(unclear_models()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ClearModels, AreTheSameModelsWithoutTheFault) {
  Model model;
  normalise_texts(model, {turtle(arm())});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  ASSERT_EQ(model.tree.bodies.size(), 2u);
  EXPECT_EQ(model.tree.bodies[1].inertia.first_moment.x, 1.0);
}

TEST(ClearModels, ListAllJointsInChainsOrNone) {
  for (const char* listed :
       {":j1, :j2, :j3", ":j3, :j2 . :other a kc:KinematicChain ; kc:joints :j1"}) {
    Model model;
    normalise_texts(model, {turtle(three_joints(listed))});
    EXPECT_EQ(model.problems(), "");
    EXPECT_EQ(model.tree.joints.size(), 3u);
  }
}

// A hand that another model mounts may be of no chain.
TEST(UnclearModelsThatLoad, WarnOfAJointThatNoChainListsAtTheEndOfOne) {
  Model model;
  normalise_texts(model, {turtle(three_joints(":j1, :j2"))});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  EXPECT_EQ(model.tree.joints.size(), 3u);
  EXPECT_NE(
      model.problems().find("r#j3: warning: the joint moves <https://example.org/r#hand> against "
                            "<https://example.org/r#lower> of <https://example.org/r#chain>, "
                            "though no chain lists it"),
      std::string::npos)
      << model.problems();
}

// What only a MassCoordinate says is in no solver; that the arm counts as weightless is not silent.
TEST(UnclearModelsThatLoad, WarnOfAMassThatIsUsedNowhere) {
  Model model;
  normalise_texts(model, {turtle(link("base") + link("arm") + joint("j", "base-root", "arm-root") +
                                 ":m a dync:MassCoordinate ; dync:mass 2 .")});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  EXPECT_NE(model.problems().find("MassCoordinate states is used in no dynamics"),
            std::string::npos)
      << model.problems();
}

TEST(UnclearModelsThatLoad, WarnOfABaseThatDoesNotSayWhichFrameIsItsOwn) {
  Model model;
  // Placed the other way round: either frame of the base may be its own.
  normalise_texts(
      model, {turtle(link("base", {"mount"}) + link("arm") + pose("base-root", "mount", "0 0 -1") +
                     pose("mount", "base-root", "0 0 1") + joint("j", "mount", "arm-root"))});
  EXPECT_NE(model.problems().find("does not say which frame of the base is its own"),
            std::string::npos)
      << model.problems();
}

TEST(UnclearModelsThatLoad, WarnOfAnOrientationThatPlacesNothing) {
  Model model;
  normalise_texts(
      model, {turtle(link("base", {"mount", "tool"}) + link("arm") +
                     pose("mount", "base-root", "0 0 1") + joint("j", "mount", "arm-root") + R"(
:turn a rel:Orientation ; rel:of :tool ; rel:with-respect-to :base-root .
:turn-coord a coord:OrientationCoordinate ; coord:of-orientation :turn ; coord:as-seen-by :base-root ;
  qudt:unit unit:UNITLESS ; coord:direction-cosine-x (1 0 0) ; coord:direction-cosine-y (0 0 1) ;
  coord:direction-cosine-z (0 -1 0) .)")});
  EXPECT_NE(model.problems().find("the orientation places nothing"), std::string::npos)
      << model.problems();
}

// The pose of `tool` in base-root: turned a quarter about x, at (1 2 3).
constexpr const char* kTurned = R"(
:turn a rel:Orientation ; rel:of :tool ; rel:with-respect-to :base-root .
:turn-coord a coord:OrientationCoordinate ; coord:of-orientation :turn ; coord:as-seen-by :base-root ;
  qudt:unit unit:UNITLESS ; coord:direction-cosine-x (1 0 0) ; coord:direction-cosine-y (0 0 1) ;
  coord:direction-cosine-z (0 -1 0) .
)";

struct Said {
  const char* name;
  std::string position;
};

class OrientationAndPosition : public testing::TestWithParam<Said> {};

TEST_P(OrientationAndPosition, MakeAPoseWhicheverWayThePositionIsStated) {
  Model model;
  normalise_texts(model, {turtle(link("base", {"mount", "tool"}) + link("arm") +
                                 pose("mount", "base-root", "0 0 1") +
                                 joint("j", "mount", "arm-root") + kTurned + GetParam().position)});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  const Tree::Frame* tool = model.frame("#tool");
  ASSERT_NE(tool, nullptr) << model.problems();
  EXPECT_DOUBLE_EQ(tool->placement.p.x, 1);
  EXPECT_DOUBLE_EQ(tool->placement.p.y, 2);
  EXPECT_DOUBLE_EQ(tool->placement.p.z, 3);
  EXPECT_DOUBLE_EQ(tool->placement.R.zy, 1);
}

std::vector<Said> ways() {
  const std::string there =
      ":p a rel:Position ; rel:of :tool-origin ; rel:with-respect-to :base-root-origin .\n";
  const std::string back =
      ":p a rel:Position ; rel:of :base-root-origin ; rel:with-respect-to :tool-origin .\n";
  const auto seen = [](const std::string& by, const std::string& xyz) {
    return position_coordinates("pc", "p", by, xyz);
  };
  return {
      {"FromTheReference", there + seen("base-root", "coord:x 1 ; coord:y 2 ; coord:z 3")},
      {"FromTheFrameItself", there + seen("tool", "coord:x 1 ; coord:y 3 ; coord:z -2")},
      {"Backwards", back + seen("base-root", "coord:x -1 ; coord:y -2 ; coord:z -3")},
      {"BackwardsFromTheFrameItself", back + seen("tool", "coord:x -1 ; coord:y -3 ; coord:z 2")},
  };
}

INSTANTIATE_TEST_SUITE_P(, OrientationAndPosition, testing::ValuesIn(ways()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ClearModels, ReadDirectionCosinesInTheUnitThatTheyState) {
  Model model;
  std::string percent = pose("tool", "base-root", "0 0 1");
  percent = replaced(percent, "unit:UNITLESS", "unit:PERCENT");
  percent = replaced(percent, "-x (1 0 0)", "-x (100 0 0)");
  percent = replaced(percent, "-y (0 1 0)", "-y (0 100 0)");
  percent = replaced(percent, "-z (0 0 1)", "-z (0 0 100)");
  normalise_texts(model, {turtle(link("base", {"tool"}) + link("arm") + percent +
                                 joint("j", "tool", "arm-root"))});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  const Tree::Frame* tool = model.frame("#tool");
  ASSERT_NE(tool, nullptr);
  EXPECT_EQ(tool->placement.R.xx, 1);
}

TEST(ClearModels, PlaceTheChildOfAFixedJointWhereItsOffsetSays) {
  Model model;
  normalise_texts(model, {turtle(link("base") + link("plate", {"hinge"}) + link("arm") +
                                 pose("hinge", "plate-root", "0 0 1") +
                                 joint("f", "base-root", "plate-root", "skc:FixedJoint") +
                                 position_coordinates("o", "f-offset", "base-root",
                                                      "coord:x 1 ; coord:y 2 ; coord:z 3") +
                                 joint("j", "hinge", "arm-root"))});
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
  const Tree::Frame* plate = model.frame("#plate-root");
  ASSERT_NE(plate, nullptr) << model.problems();
  EXPECT_EQ(plate->placement.p.x, 1);
  EXPECT_EQ(plate->placement.p.y, 2);
  EXPECT_EQ(plate->placement.p.z, 3);
}

}  // namespace
}  // namespace sinew::model::test
