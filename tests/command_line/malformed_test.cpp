// What an adversary, or a tired engineer, feeds the command line: every model and query here is
// refused with exit code 1, the file and line (and where there is one the IRI) of the fault, and
// the remedy; nothing comes out. One fault is reported as one.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "command.h"

namespace sinew::test {
namespace {

std::string link(const std::string& name, const std::string& mass = "1",
                 const std::string& moments = "ixx='0.01' iyy='0.01' izz='0.01'") {
  return "<link name='" + name + "'><inertial><origin xyz='0.1 0 0'/><mass value='" + mass +
         "'/><inertia " + moments + " ixy='0' ixz='0' iyz='0'/></inertial></link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& more = "<axis xyz='0 0 1'/>",
                  const std::string& type = "continuous") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + more + "</joint>\n";
}

std::string limited(const std::string& limits) {
  return "<axis xyz='0 0 1'/><limit " + limits + "/>";
}

const std::string kLinks = link("a") + link("b") + link("c");  // lines 2 to 4
const std::string kFirst = joint("j1", "a", "b"), kSecond = joint("j2", "b", "c");

struct Fault {
  std::string name, robot, expected;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const Fault kFaults[] = {
    {"NegativeMass", link("a") + link("b", "-1") + kFirst,
     "urdf:3: .*/b: the mass is -1 kg; give a positive mass"},
    {"MassThatIsNone", link("a") + link("b", "nan") + kFirst,
     "urdf:3: link 'b': value=\"nan\" of <mass> is not a finite number; write one number"},
    {"MassInWords", link("a") + link("b", "heavy") + kFirst, "urdf:3: .*is not a finite number"},
    {"NoMass", link("a") + link("b", "0") + kFirst,
     "urdf:3: .*no mass, but moments of it; give its mass, or leave its inertia out"},
    {"NegativeMoment", link("a") + link("b", "1", "ixx='-0.01' iyy='0.01' izz='0.01'") + kFirst,
     "urdf:3: .*has a negative moment"},
    {"Triangle", link("a") + link("b", "1", "ixx='1' iyy='0.1' izz='0.1'") + kFirst,
     "urdf:3: .*triangle inequality by 0.4 of the largest; each principal moment is at most the "
     "sum of the two others"},
    {"Loop", kLinks + kFirst + kSecond + joint("j3", "c", "a"),
     "urdf:7: joint 'j3': the joints form a loop: 'j3', 'j2', 'j1'; remove one of them"},
    {"TwoParents", kLinks + kFirst + kSecond + joint("j3", "a", "c"),
     "urdf:7: joint 'j3': 'c' is the child of 'j2' already, in line 6"},
    {"TwoRoots", kLinks + link("d") + kFirst + kSecond, "urdf:5: there are 2 roots: 'a', 'd'"},
    {"OneJointTwice", kLinks + kFirst + joint("j1", "b", "c"),
     "urdf:6: joint 'j1': the name is used already, in line 5"},
    {"OneLinkTwice", kLinks + link("b") + kFirst + kSecond,
     "urdf:5: link 'b': the name is used already, in line 3"},
    {"NoSuchLink", link("a") + link("b") + kFirst + kSecond,
     "urdf:5: joint 'j2': there is no link 'c'; name a link of this robot, or add that link"},
    {"ItselfAsChild", link("a") + joint("j1", "a", "a"), "urdf:3: joint 'j1': it connects 'a'"},
    {"LimitsReversed",
     link("a") + link("b") +
         joint("j1", "a", "b", limited("lower='1' upper='-1' effort='1' velocity='1'"), "revolute"),
     "urdf:4: .*j1: the lower limit 1 is above the upper limit -1; exchange them"},
    {"NegativeEffort",
     link("a") + link("b") +
         joint("j1", "a", "b", limited("lower='0' upper='1' effort='-1' velocity='1'"), "revolute"),
     "urdf:4: .*limit is negative; give the largest size"},
    {"MimicOfItself",
     link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 0 1'/><mimic joint='j1'/>"),
     "urdf:4: .*j1> follows itself by way of others; let one joint of the line follow none"},
    {"MimicInACircle",
     kLinks + joint("j1", "a", "b", "<axis xyz='0 0 1'/><mimic joint='j2'/>") +
         joint("j2", "b", "c", "<axis xyz='0 0 1'/><mimic joint='j1'/>"),
     "urdf:5: .*follows itself"},
    {"MimicOfNothing",
     link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 0 1'/><mimic joint='j9'/>"),
     "urdf:4: joint 'j1': it mimics 'j9', which is no joint; name a joint of this robot"},
    {"MimicOfAFixedJoint",
     kLinks + joint("j1", "a", "b", "<axis xyz='0 0 1'/><mimic joint='j2'/>") +
         joint("j2", "b", "c", "", "fixed"),
     "urdf:5: .*is no joint with one degree of freedom"},
    {"MimicByNoNumber",
     kLinks + kFirst +
         joint("j2", "b", "c", "<axis xyz='0 0 1'/><mimic joint='j1' multiplier='nan'/>"),
     "urdf:6: joint 'j2': multiplier=\"nan\" of <mimic> is not a finite number"},
    {"ZeroAxis", link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 0 0'/>"),
     "urdf:4: joint 'j1': the joint's axis is zero; give it a direction"},
    {"AxisOfTwoNumbers", link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 1'/>"),
     "urdf:4: joint 'j1': xyz=\"0 1\" of <axis> is not 3 finite numbers"},
    {"AxisTooShort", link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 0 1e-200'/>"),
     "urdf:4: joint 'j1': the joint's axis has length 1e-200; give a unit vector"},
    {"AxisTooLong", link("a") + link("b") + joint("j1", "a", "b", "<axis xyz='0 1e200 0'/>"),
     "urdf:4: joint 'j1': the joint's axis has length 1e\\+200; give a unit vector"},
    {"UnknownType", link("a") + link("b") + joint("j1", "a", "b", "", "hinge"),
     "urdf:4: joint 'j1': 'hinge' is no type of joint; write revolute, continuous"},
    {"InfiniteTurn",
     link("a") + link("b") + joint("j1", "a", "b", "<origin rpy='0 inf 0'/><axis xyz='0 0 1'/>"),
     "urdf:4: joint 'j1': rpy=\"0 inf 0\" of <origin> is not 3 finite numbers"},
    {"LinkWithoutName", "<link/>\n" + link("a"), "urdf:2: link: <link> has no name"},
    {"NoParent",
     link("a") + link("b") + "<joint name='j1' type='fixed'><child link='b'/></joint>\n",
     "urdf:4: joint 'j1': the joint has no <parent>; write <parent"},
    {"MimicOfAPlanarJoint",
     kLinks + kFirst + joint("j2", "b", "c", "<axis xyz='0 0 1'/><mimic joint='j1'/>", "planar"),
     "urdf:6: joint 'j2': a joint of several degrees of freedom mimics another"},
    {"NothingAtAll", "", "urdf:1: the robot has no links; give it at least one"},
};

class MalformedUrdf : public testing::TestWithParam<Fault> {};

TEST_P(MalformedUrdf, IsRefusedWithPlaceAndRemedy) {
  const Folder folder;
  write_file(folder / "bad.urdf", "<robot name='r'>\n" + GetParam().robot + "</robot>\n");
  const Result result = run_sinew(
      {"synth", (folder / "bad.urdf").string(), "--solver", "rnea", "--gravity", "0,0,-9.81"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(result.out.empty());
  EXPECT_TRUE(std::regex_search(result.err, std::regex(GetParam().expected)))
      << result.err << "\nlacks " << GetParam().expected;
}

INSTANTIATE_TEST_SUITE_P(Each, MalformedUrdf, testing::ValuesIn(kFaults),
                         [](const auto& info) { return info.param.name; });

TEST(MalformedUrdf, ThatIsNoXmlOrNoUrdfIsRefused) {
  const Folder folder;
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 20000; ++i) deep += "<a>";
  for (int i = 0; i < 20000; ++i) deep += "</a>";
  const std::pair<std::string, std::string> texts[] = {
      {"", "bad.urdf: no well-formed XML: .*; give a URDF file, which is not empty"},
      {"hello", "bad.urdf:1: no well-formed XML"},
      {"<robot name='r'>\n<link name='a'", "bad.urdf:2: no well-formed XML"},
      {"<model/>", "bad.urdf:1: the document is no <robot>"},
      {deep + "</robot>", "bad.urdf:1: no well-formed XML: .*; nest elements less"}};
  for (const auto& [text, expected] : texts) {
    write_file(folder / "bad.urdf", text);
    const Result result = run_sinew({"synth", (folder / "bad.urdf").string(), "--solver", "fpk"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(std::regex_search(result.err, std::regex(expected))) << result.err;
  }
}

// It moves nothing, which is hardly meant.
TEST(MalformedUrdf, WithAFollowerThatNeverMovesIsWarnedOf) {
  const Folder folder;
  write_file(folder / "still.urdf",
             "<robot name='r'>\n" + kLinks + kFirst +
                 joint("j2", "b", "c", "<axis xyz='0 0 1'/><mimic joint='j1' multiplier='0'/>") +
                 "</robot>\n");
  const Result result = run_sinew({"stats", (folder / "still.urdf").string(), "--solver", "rnea"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::regex_search(
      result.err, std::regex("still.urdf:6: joint 'j2': warning: it mimics another joint with "
                             "multiplier 0, so it never moves; make it a fixed joint")))
      << result.err;
}

// ---- models in JSON-LD ----

class MalformedModel : public testing::Test {
 protected:
  MalformedModel() {
    write_file(folder_ / "arm.urdf",
               "<robot name='r'>\n" + link("a") + link("b") +
                   joint("j1", "a", "b", limited("lower='-1' upper='1' effort='1' velocity='1'"),
                         "revolute") +
                   "</robot>\n");
    // An oblique axis is stated by coordinates.
    std::string urdf = read_file(folder_ / "arm.urdf");
    const std::string along = "0 0 1";
    urdf.replace(urdf.find(along), along.size(), "0 0.6 0.8");
    write_file(folder_ / "arm.urdf", urdf);
    const Result imported = run_sinew({"import", (folder_ / "arm.urdf").string()});
    EXPECT_EQ(imported.exit_code, 0) << imported.err;
    model_ = imported.out;
  }

  // With the numbers of the first `count` of the axis' two coordinates replaced.
  Result with_axis(const std::string& y, const std::string& z, int count) const {
    std::string text = model_;
    std::size_t at = 0;
    for (int i = 0; i < count; ++i) {
      at = text.find("\"y\": 0.6", at);
      text.replace(at, 8, "\"y\": " + y);
      at = text.find("\"z\": 0.8", at);
      text.replace(at, 8, "\"z\": " + z);
    }
    write_file(folder_ / "bad.jsonld", text);
    return run_sinew({"synth", (folder_ / "bad.jsonld").string(), "--solver", "fpk"});
  }

  // The line on which the numbers of the coordinate of the parent's line begin.
  std::string line_of_axis() const {
    const std::size_t node = model_.find("parent-axis-coordinates/j1\",");
    const std::size_t x = model_.find("\"x\":", node);
    return std::to_string(
        1 + std::count(model_.begin(), model_.begin() + static_cast<std::ptrdiff_t>(x), '\n'));
  }

  Folder folder_;
  std::string model_;
};

TEST_F(MalformedModel, WithAnAxisOfNoLengthIsRefused) {
  for (const int attachments : {1, 2}) {
    const Result result = with_axis("0.0", "0.0", attachments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(result.out.empty());
    const std::string expected =
        "bad.jsonld:" + line_of_axis() +
        ": https://w3id.org/sinew/robots/r/parent-axis-coordinates/j1: the axis of "
        "<https://w3id.org/sinew/robots/r/joint/j1> has no length; give a unit vector: the "
        "direction about or along which the joint moves\n";
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err << "lacks " << expected;
    // The joint's limits have no fault of their own.
    EXPECT_EQ(result.err.find("is no joint"), std::string::npos) << result.err;
  }
}

TEST_F(MalformedModel, WithAnAxisThatIsNoUnitVectorIsRefused) {
  const Result result = with_axis("1.2", "1.6", 2);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(std::regex_search(result.err, std::regex("has length 2; give a unit vector")))
      << result.err;
}

TEST_F(MalformedModel, WithAnAxisThatDiffersBetweenTheLinksIsRefused) {
  const Result result = with_axis("-0.6", "0.8", 1);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(std::regex_search(
      result.err, std::regex("bad.jsonld:\\d+: .*joint-axis/j1: the axis is another direction in "
                             "one attachment than in the other, .*; use the same axis")))
      << result.err;
}

// ---- queries ----

class MalformedQuery : public MalformedModel {
 protected:
  Result ask(const std::string& asked, const std::string& more = "") const {
    write_file(folder_ / "query.json", R"({
  "@context": "https://w3id.org/sinew/query.json",
  "@id": "https://example.org/q",
  "@type": "Query",
  "asks": [
    { "@type": "Asked", )" + asked + R"( } ],
  "gives": [ { "@type": "Given", "quantity": "joint-position" } ])" +
                                           more + "\n}\n");
    return run_sinew(
        {"synth", (folder_ / "arm.urdf").string(), "--query", (folder_ / "query.json").string()});
  }

  void expect_refused(const Result& result, const std::string& expected) const {
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(result.out.empty());
    EXPECT_TRUE(std::regex_search(result.err, std::regex(expected)))
        << result.err << "\nlacks " << expected;
  }
};

TEST_F(MalformedQuery, IsRefusedWithTheLineOfTheFault) {
  EXPECT_EQ(ask(R"("quantity": "pose", "of": "b")").exit_code, 0);
  const std::string q = "query.json:6: https://example.org/q: ";
  expect_refused(ask(R"("quantity": "pose", "of": "")"),
                 q + "has nothing in of; name an element, or leave it out");
  expect_refused(ask(R"("quantity": "pose", "of": ["a", "b"])"),
                 q + "has two values of of; state one");
  expect_refused(ask(R"("quantiti": "pose", "of": "b")"),
                 "query.json:6: .*no context defines \"quantiti\"; did you mean \"quantity\"");
  expect_refused(ask(R"("quantity": "pose", "of": "z")"),
                 q + "z: no frame or link of the tree has this name; .* one of a, b");
  expect_refused(ask(R"("quantity": "momentums")"), q + ".*nothing is known of momentums; ask for");
  expect_refused(ask(R"("quantity": "joint-force")"),
                 q + "joint-force cannot be computed without joint-velocity; add joint-velocity");
  expect_refused(ask(R"("quantity": "pose", "of": "b")", R"(, "forces": "both")"),
                 "query.json:7: https://example.org/q: no context defines the value \"both\"");
  expect_refused(ask(R"("quantity": "pose", "of": "b")", R"(, "colour": "red")"),
                 "query.json:7: https://example.org/q: no context defines \"colour\"");
  expect_refused(ask(R"("quantity": "pose", "of": "b")", R"(, "tips": ["z"])"),
                 "query.json:7: https://example.org/q: the tip 'z' is nothing in this model; name "
                 "one of its links");
}

TEST_F(MalformedQuery, OnTheCommandLineIsRefusedWithTheRemedy) {
  const std::pair<std::vector<std::string>, std::string> lines[] = {
      {{"--solver", "rneax"}, "rneax: there is no solver of this name; one of aba, bias"},
      {{"--ask", "torque of j1"}, "nothing is known of torque; ask for one of pose"},
      {{"--ask", "pose of b"}, "pose cannot be computed without joint-position; add"},
      {{"--ask", "pose of b wrt z", "--give", "joint-position"}, "z: no frame or link of the tree"},
      {{"--solver", "rnea", "--gravity", "0,0"}, "write three numbers, for example 0,0,-9.81"},
      {{"--solver", "rnea", "--gravity", "nan,0,0"}, "write three numbers"},
      {{"--solver", "fpk", "--tip", "z"}, "the tip 'z' is nothing in this model"},
      {{"--solver", "rnea", "--base", "z"}, "the base 'z' is nothing in this model"},
      {{"--solver", "rnea", "--give", "external-wrench of a"},
       "arm.urdf:2: .*a wrench on the base, which does not move.*let the base float"},
      {{"--solver", "aba", "--give", "joint-acceleration"},
       "both the force and the acceleration of every joint are given: they contradict"},
      {{"--solver", "hybrid", "--constraint", "b"}, "a constraint with no direction; state"},
      {{"--solver", "hybrid", "--constraint", "b:linear-w"}, "linear-w is no direction; one of"},
      {{"--solver", "hybrid", "--constraint", "a:linear-x"}, "a is fixed to the base"},
      {{"--solver", "hybrid", "--constraint", "b:linear-x,linear-x"}, "contradictory drivers"},
      {{"--solver", "hybrid", "--constraint", "b:linear-x", "--singular", "in-order:2"},
       "2 is no tolerance; a number from 1e-15"},
  };
  for (const auto& [options, expected] : lines) {
    std::vector<std::string> arguments = {"synth", (folder_ / "arm.urdf").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(run_sinew(arguments), expected);
  }
}

}  // namespace
}  // namespace sinew::test
