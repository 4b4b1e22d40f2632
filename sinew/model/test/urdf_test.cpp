// What a URDF may say, what becomes of it, and how faults are reported.
#include "sinew/model/urdf.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "newton_euler.h"
#include "sinew/model/urdf_document.h"
#include "sinew/vocab/vocab.h"
#include "small_models.h"

namespace sinew::model::test {
namespace {

constexpr const char* kTwoLinks =
    "<link name=\"a\"/>\n<link name=\"b\">\n"
    "  <inertial><mass value=\"2\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\""
    " izz=\"1\"/></inertial>\n</link>\n";

std::string joint_text(const std::string& inside, const std::string& type = "continuous",
                       const std::string& name = "j") {
  return "<joint name=\"" + name + "\" type=\"" + type +
         "\">\n<parent link=\"a\"/><child link=\"b\"/>\n" + inside + "</joint>\n";
}

urdf::Document read(const std::string& body, Report& report, bool lenient = false) {
  return urdf::read(urdf(body).text, "robot.urdf", lenient, report);
}

TEST(Urdf, KeepsEveryDigit) {
  Report report;
  const auto document = read(
      kTwoLinks + joint_text("<origin xyz=\"0.1234567890123456 -1e-300 +5\" rpy=\"0 1e-400 0\"/>"),
      report);
  ASSERT_FALSE(report.has_errors());
  EXPECT_EQ(document.joints[0].origin.xyz[0], 0.1234567890123456);
  EXPECT_EQ(document.joints[0].origin.xyz[1], -1e-300);
  EXPECT_EQ(document.joints[0].origin.xyz[2], 5);
  EXPECT_EQ(document.joints[0].origin.rpy[1], 0);
}

TEST(Urdf, KeepsTheOrderAndTheLinesOfTheFile) {
  Report report;
  const auto document = read(
      "<link name=\"z\"/>\n<link name=\"a\"/>\n<joint name=\"j\" type=\"fixed\">"
      "<parent link=\"z\"/><child link=\"a\"/></joint>\n",
      report);
  ASSERT_EQ(document.links.size(), 2u);
  EXPECT_EQ(document.links[0].name, "z");
  EXPECT_EQ(document.links[1].line, 3u);
  EXPECT_EQ(document.joints[0].line, 4u);
}

TEST(Urdf, NamesElementsByTheirUrdfNames) {
  Model model;
  normalise_texts(model, {urdf(kTwoLinks + joint_text("", "continuous", "my joint"))});
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(model.store.terms().text(model.tree.joints[0].iri),
            "https://w3id.org/sinew/robots/r/joint/my%20joint");
  EXPECT_EQ(model.store.terms().text(model.tree.bodies[1].iri),
            "https://w3id.org/sinew/robots/r/link/b");
}

TEST(Urdf, TakesTheBaseIriFromTheOptions) {
  Model model;
  LoadOptions options;
  options.urdf_base_iri = "https://example.org/robot#";
  load_texts(model, {urdf(kTwoLinks + joint_text(""))}, options);
  EXPECT_TRUE(model.store.terms().find_iri("https://example.org/robot#link/a"));
}

TEST(Urdf, TurnsByExactQuartersIntoExactZerosAndOnes) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  options.snap_tolerance = 0;
  normalise_texts(model,
                  {urdf(kTwoLinks + joint_text("<axis xyz=\"0 0 1\"/><origin rpy=\""
                                               "1.5707963267948966 0 3.141592653589793\"/>"))},
                  options);
  ASSERT_EQ(first_error(model), "");
  const Matrix3& R = model.tree.joints[0].placement.R;
  EXPECT_EQ(R.xx, -1);
  EXPECT_EQ(R.xy, 0);
  EXPECT_EQ(R.yz, 1);
  EXPECT_EQ(R.zy, 1);
  EXPECT_EQ(R.zz, 0);
}

TEST(Urdf, DoesNotTakeRoundedQuartersForQuarters) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  normalise_texts(
      model, {urdf(kTwoLinks + joint_text("<axis xyz=\"0 0 1\"/><origin rpy=\"1.5708 0 0\"/>"))},
      options);
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(model.tree.joints[0].placement.R.yy, std::cos(1.5708));
  options.snap_tolerance = 1e-4;  // unless one asks for it
  Model coarse;
  normalise_texts(
      coarse, {urdf(kTwoLinks + joint_text("<axis xyz=\"0 0 1\"/><origin rpy=\"1.5708 0 0\"/>"))},
      options);
  EXPECT_EQ(coarse.tree.joints[0].placement.R.yy, 0);
  const auto says = std::ranges::find_if(coarse.tree.notes, [](const std::string& note) {
    return note.find("placement of <") != std::string::npos &&
           note.find("4 numbers within 0.0001 of 0 or ±1 snapped, by up to 3.67e-06") !=
               std::string::npos;
  });
  EXPECT_NE(says, coarse.tree.notes.end());
}

// 1 and the square root of 1 + 3e-8^2 are the same double.
TEST(Urdf, KeepsAnAxisThatIsNearlyAnAxisOfTheFrame) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  normalise_texts(model, {urdf(kTwoLinks + joint_text("<axis xyz=\"3e-8 0 1\"/>"))}, options);
  ASSERT_EQ(first_error(model), "");
  const Matrix3& R = model.tree.joints[0].placement.R;
  EXPECT_DOUBLE_EQ(R.xz, 3e-8);
  EXPECT_EQ(R.yz, 0);
  EXPECT_DOUBLE_EQ(R.zz, 1);
}

TEST(Urdf, MeasuresRoundOffByTheRobotWhereItIsSmallerThanAMetre) {
  for (const double size : {1.0, 1e-7}) {
    Model model;
    NormaliseOptions options;
    options.choose_frames = false;
    const std::string links = "<link name=\"a\"/><link name=\"b\"/>";
    const std::string origin = fmt::format("<axis xyz=\"0 0 1\"/><origin xyz=\"{} {} {}\"/>", size,
                                           1e-13 * size, 1e-15 * size);
    normalise_texts(model, {urdf(links + joint_text(origin))}, options);
    ASSERT_EQ(first_error(model), "");
    const Vector3& p = model.tree.joints[0].placement.p;
    EXPECT_EQ(p.x, size);
    EXPECT_EQ(p.y, 1e-13 * size);
    EXPECT_EQ(p.z, 0);
  }
}

// The common normal of two axes with an angle of 1e-6 between them is 200 km away from here.
TEST(Urdf, SlidesNoFrameFarAlongItsAxis) {
  const std::string links = std::string(kTwoLinks) + "<link name=\"c\"/>";
  const std::string joints =
      "<joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/>"
      "<axis xyz=\"0 0 1\"/><origin xyz=\"0.1 0.2 0.3\"/></joint>"
      "<joint name=\"k\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/>"
      "<axis xyz=\"0 1e-6 1\"/><origin xyz=\"0.3 0.2 0.1\"/></joint>";
  Model model;
  normalise_texts(model, {urdf(links + joints)});
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.tree.joints.size(), 2U);
  for (const Tree::Joint& joint : model.tree.joints)
    EXPECT_LT(std::sqrt(dot(joint.placement.p, joint.placement.p)), 20);
}

struct AxisCase {
  const char* xyz;
  Vector3 axis;
};

class UrdfAxis : public testing::TestWithParam<AxisCase> {};

TEST_P(UrdfAxis, IsTheLineThatTheLinkTurnsAbout) {
  Model model;
  normalise_texts(
      model, {urdf(kTwoLinks + joint_text("<axis xyz=\"" + std::string(GetParam().xyz) + "\"/>"))});
  ASSERT_EQ(first_error(model), "");
  const double q = 0.4;
  const Dynamics result = newton_euler(model.tree, {{q}, {0}, {0}});
  const Matrix3 R = pose_of(model.tree, result, model.frame("/frame/b")->iri).R;
  const Vector3& a = GetParam().axis;
  // Rodrigues: the axis stays, and the trace is 1 + 2 cos q; the skew part gives the sense.
  const Vector3 kept = R * a;
  EXPECT_NEAR(kept.x, a.x, 1e-15);
  EXPECT_NEAR(kept.y, a.y, 1e-15);
  EXPECT_NEAR(kept.z, a.z, 1e-15);
  EXPECT_NEAR(R.xx + R.yy + R.zz, 1 + 2 * std::cos(q), 1e-15);
  EXPECT_NEAR(0.5 * (R.zy - R.yz), std::sin(q) * a.x, 1e-15);
  EXPECT_NEAR(0.5 * (R.xz - R.zx), std::sin(q) * a.y, 1e-15);
  EXPECT_NEAR(0.5 * (R.yx - R.xy), std::sin(q) * a.z, 1e-15);
}

const double kHalf = std::sqrt(0.5), kThird = std::sqrt(1.0 / 3);
INSTANTIATE_TEST_SUITE_P(Axes, UrdfAxis,
                         testing::Values(AxisCase{"1 0 0", {1, 0, 0}},
                                         AxisCase{"0 -1 0", {0, -1, 0}},
                                         AxisCase{"0 0 -2", {0, 0, -1}},
                                         AxisCase{"1 1 0", {kHalf, kHalf, 0}},
                                         AxisCase{"0 1 -1", {0, kHalf, -kHalf}},
                                         AxisCase{"-3 3 3", {-kThird, kThird, kThird}}));

TEST(Urdf, MovesAPrismaticJointAlongItsAxis) {
  Model model;
  normalise_texts(model,
                  {urdf(kTwoLinks + joint_text("<origin xyz=\"1 2 3\"/><axis xyz=\"0 1 0\"/>"
                                               "<limit lower=\"-1\" upper=\"2\" effort=\"3\" "
                                               "velocity=\"4\"/>",
                                               "prismatic"))});
  ASSERT_EQ(first_error(model), "");
  const Dynamics result = newton_euler(model.tree, {{0.5}, {0}, {0}});
  const Pose X = pose_of(model.tree, result, model.frame("/frame/b")->iri);
  EXPECT_NEAR(X.p.x, 1, 1e-15);
  EXPECT_NEAR(X.p.y, 2.5, 1e-15);
  EXPECT_NEAR(X.p.z, 3, 1e-15);
  const JointLimits& limits = model.tree.joints[0].limits;
  EXPECT_EQ(limits.lower, -1);
  EXPECT_EQ(limits.upper, 2);
  EXPECT_EQ(limits.maximum_force, 3);
  EXPECT_EQ(limits.maximum_velocity, 4);
}

TEST(Urdf, GivesAContinuousJointNoPositionLimits) {
  Model model;
  normalise_texts(model, {urdf(kTwoLinks + joint_text("<limit effort=\"3\" velocity=\"4\"/>"))});
  ASSERT_EQ(first_error(model), "");
  EXPECT_TRUE(std::isnan(model.tree.joints[0].limits.lower));
  EXPECT_EQ(model.tree.joints[0].limits.maximum_force, 3);
}

TEST(Urdf, PutsAnInertiaWithItsOwnFrameIntoTheLinksFrame) {
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  normalise_texts(
      model,
      {urdf("<link name=\"a\"/><link name=\"b\"><inertial><origin xyz=\"1 0 0\" "
            "rpy=\"0 0 1.5707963267948966\"/><mass value=\"2\"/><inertia ixx=\"3\" ixy=\"0\" "
            "ixz=\"0\" iyy=\"4\" iyz=\"0\" izz=\"5\"/></inertial></link>" +
            joint_text("<axis xyz=\"0 0 1\"/>"))},
      options);
  ASSERT_EQ(first_error(model), "");
  const RigidBodyInertia& I = model.tree.bodies[1].inertia;
  EXPECT_EQ(I.mass, 2);
  EXPECT_EQ(I.first_moment.x, 2);
  EXPECT_EQ(I.rotational.xx, 4);      // x and y are exchanged
  EXPECT_EQ(I.rotational.yy, 3 + 2);  // and 2 kg are 1 m aside
  EXPECT_EQ(I.rotational.zz, 5 + 2);
}

TEST(Urdf, KeepsShapesAsReferences) {
  Model model;
  load_texts(model, {urdf("<link name=\"a\"><visual><geometry><mesh filename=\"package://x/a.stl\""
                          " scale=\"1 1 2\"/></geometry></visual><collision><geometry>"
                          "<sphere radius=\"0.5\"/></geometry></collision></link>")});
  ASSERT_EQ(first_error(model), "");
  const auto& terms = model.store.terms();
  const Id mesh = terms.find_iri("https://w3id.org/sinew/robots/r/visual/a/0");
  const Id sphere = terms.find_iri("https://w3id.org/sinew/robots/r/collision/a/0");
  const auto view = model.store.view();
  EXPECT_EQ(terms.text(view.object(mesh, terms.find_iri(vocab::shape::file))), "package://x/a.stl");
  EXPECT_EQ(terms.number(view.object(sphere, terms.find_iri(vocab::shape::radius))), 0.5);
}

TEST(Urdf, SaysWhatItLeavesOut) {
  Model model;
  load_texts(model, {urdf("<link name=\"a\"/>\n<gazebo/>\n<gazebo/>\n")});
  ASSERT_EQ(model.report.problems().size(), 1u);
  EXPECT_EQ(to_string(model.report.problems()[0]),
            "robot.urdf:3: warning: <gazebo> is left out, 2 times; it says nothing about the "
            "robot's mechanics");
}

TEST(Urdf, RefusesWhatStandsAfterTheRobotAndTextThatIsNoUtf8) {
  Model two, wide;
  load_texts(two, {{"robot.urdf", "<robot name=\"r\"><link name=\"a\"/></robot>\n<robot/>"}});
  EXPECT_EQ(first_error(two),
            "robot.urdf:2: <robot> stands after the robot's end; give one <robot>, with everything "
            "in it");
  load_texts(wide, {{"robot.urdf", "\xFF\xFE<robot"}});
  EXPECT_NE(first_error(wide).find("save the file as UTF-8"), std::string::npos);
}

struct FaultCase {
  const char* name;
  std::string body;
  const char* where;   // file and line
  const char* phrase;  // of what is said
};

const std::vector<FaultCase>& faults() {
  const std::string two = kTwoLinks;  // lines 2 to 5
  static const std::vector<FaultCase> kFaults = {
      {"NotClosed", "<link name=\"a\">", "robot.urdf:", "no well-formed XML"},
      {"NoLinks", "", "robot.urdf:1:", "no links"},
      {"LinkWithoutName", "<link/>", "robot.urdf:2:", "<link> has no name"},
      {"TwoLinksOfOneName", "<link name=\"a\"/>\n<link name=\"a\"/>",
       "robot.urdf:3:", "used already, in line 2"},
      {"TwoJointsOfOneName", two + joint_text("") + joint_text(""),
       "robot.urdf:9:", "used already, in line 6"},
      {"UnknownParent", "<link name=\"b\"/>\n" + joint_text(""),
       "robot.urdf:3:", "there is no link 'a'"},
      {"NoParent", two + "<joint name=\"j\" type=\"fixed\"><child link=\"b\"/></joint>",
       "robot.urdf:6:", "no <parent>"},
      {"TwoParents", two + joint_text("") + joint_text("", "fixed", "k"),
       "robot.urdf:9:", "child of 'j' already, in line 6"},
      {"Itself",
       "<link name=\"a\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/>"
       "<child link=\"a\"/></joint>",
       "robot.urdf:3:", "connects 'a' with itself"},
      {"TwoRoots", two, "robot.urdf:3:", "2 roots: 'a', 'b'"},
      {"Loop",
       "<link name=\"r\"/>\n" + two + joint_text("") +
           "<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>",
       "robot.urdf:", "form a loop: 'k', 'j'"},
      {"NoNumber", two + joint_text("<origin xyz=\"1 2 x\"/>"),
       "robot.urdf:8:", "is not 3 finite numbers"},
      {"TooFewNumbers", two + joint_text("<axis xyz=\"1 0\"/>"),
       "robot.urdf:8:", "is not 3 finite numbers"},
      {"TooManyNumbers", two + joint_text("<axis xyz=\"1 0 0 0\"/>"),
       "robot.urdf:8:", "is not 3 finite numbers"},
      {"NotFinite", two + joint_text("<axis xyz=\"1 0 nan\"/>"),
       "robot.urdf:8:", "is not 3 finite numbers"},
      {"TooLarge", two + joint_text("<axis xyz=\"1 0 1e999\"/>"),
       "robot.urdf:8:", "is not 3 finite numbers"},
      {"ZeroAxis", two + joint_text("<axis xyz=\"0 0 0\"/>"), "robot.urdf:8:", "axis is zero"},
      {"PlanarMimic", two + joint_text("<mimic joint=\"j\"/>", "planar"),
       "robot.urdf:6:", "several degrees of freedom mimics"},
      {"UnknownJoint", two + joint_text("", "spiral"), "robot.urdf:6:", "'spiral' is no type"},
      {"NoInertia", "<link name=\"a\"><inertial><mass value=\"1\"/></inertial></link>",
       "robot.urdf:2:", "no <inertia>"},
      {"NoMoment",
       "<link name=\"a\"><inertial><mass value=\"1\"/>\n<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
       "iyy=\"1\" iyz=\"0\"/></inertial></link>",
       "robot.urdf:3:", "<inertia> has no izz"},
      {"NoGeometry", "<link name=\"a\"><visual/></link>", "robot.urdf:2:", "no <geometry>"},
      {"UnknownGeometry", "<link name=\"a\"><visual><geometry><cone/></geometry></visual></link>",
       "robot.urdf:2:", "<cone> is no geometry"},
      {"SecondOrigin", two + joint_text("<origin/>\n<origin/>\n"),
       "robot.urdf:9:", "a second <origin>"},
      {"UnknownElement", two + joint_text("<spring/>"),
       "robot.urdf:8:", "<spring> is no element of a URDF <joint>"},
      {"Xacro", "<xacro:property name=\"a\"/>", "robot.urdf:2:", "xacro"},
      {"MisspeltAxis", two + joint_text("<axis xzy=\"0 0 1\"/>"),
       "robot.urdf:8:", "<axis> has no attribute xzy"},
      {"LaterOrigin", two + joint_text("<origin quat_xyzw=\"0 0 0 1\"/>"),
       "robot.urdf:8:", "<origin> has no attribute quat_xyzw"},
      {"MisspeltMimic", two + joint_text("<mimic joint=\"k\" ratio=\"2\"/>"),
       "robot.urdf:8:", "<mimic> has no attribute ratio"},
      {"InstructionInside", "<?include b?>\n" + two, "robot.urdf:2:", "no well-formed XML"},
      {"UnknownMimic", two + joint_text("<mimic joint=\"other\"/>"),
       "robot.urdf:6:", "mimics 'other'"},
  };
  return kFaults;
}

class UrdfFault : public testing::TestWithParam<std::size_t> {};

TEST_P(UrdfFault, IsRefusedWithItsLine) {
  const FaultCase& fault = faults()[GetParam()];
  Model model;
  load_texts(model, {urdf(fault.body)});
  const std::string error = first_error(model);
  EXPECT_EQ(error.find(fault.where), 0u) << error;
  EXPECT_NE(error.find(fault.phrase), std::string::npos) << error;
  EXPECT_EQ(model.store.view().size(), 0u);  // nothing was added
}

INSTANTIATE_TEST_SUITE_P(Each, UrdfFault, testing::Range<std::size_t>(0, faults().size()),
                         [](const auto& info) { return faults()[info.param].name; });

TEST(Urdf, LeavesOutUnknownElementsWhereOneAsksForIt) {
  Model model;
  LoadOptions options;
  options.lenient = true;
  load_texts(model, {urdf(kTwoLinks + joint_text("<spring/>"))}, options);
  EXPECT_FALSE(model.report.has_errors());
  EXPECT_EQ(model.report.problems().size(), 1u);
}

// As of the stereo camera of a PR2 as it was published: each moment is its own, but no body has
// them.
TEST(Urdf, ComputesWithImpossibleMomentsOnlyWhereOneAsksForIt) {
  std::string body = kTwoLinks + joint_text("");
  body.replace(body.find("izz=\"1\""), 7, "izz=\"5\"");
  Model strict;
  normalise_texts(strict, {urdf(body)});
  EXPECT_NE(first_error(strict).find("triangle inequality"), std::string::npos);
  NormaliseOptions options;
  options.lenient = true;
  Model lenient;
  normalise_texts(lenient, {urdf(body)}, options);
  ASSERT_EQ(first_error(lenient), "");
  const auto& moments = lenient.tree.bodies[1].inertia.rotational;
  EXPECT_DOUBLE_EQ(moments.xx + moments.yy + moments.zz, 7);
  EXPECT_EQ(lenient.report.problems().size(), 1u);
  // A moment below zero has no equations of motion.
  body.replace(body.find("izz=\"5\""), 7, "izz=\"-1\"");
  Model negative;
  normalise_texts(negative, {urdf(body)}, options);
  EXPECT_NE(first_error(negative).find("negative moment"), std::string::npos);
}

TEST(Urdf, RefusesATextBeyondTheLimit) {
  Report report;
  urdf::read(std::string(urdf::kMaximumUrdfBytes + 1, ' '), "big.urdf", false, report);
  EXPECT_TRUE(report.has_errors());
}

TEST(Urdf, RefusesNestingBeyondTheLimit) {
  std::string deep = "<robot name=\"r\">";
  for (int i = 0; i < 2000; ++i) deep += "<link>";
  Report report;
  urdf::read(deep, "deep.urdf", false, report);
  EXPECT_TRUE(report.has_errors());
}

}  // namespace
}  // namespace sinew::model::test
