// Drivers of hybrid dynamics that cannot be, and steps that are data, through the command line.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "arm_urdf.h"
#include "command.h"

namespace sinew::test {
namespace {

class Arm : public testing::Test {
 protected:
  Arm() { write("arm.urdf", kArm); }

  std::string write(const std::string& name, const std::string& text) const {
    write_file(folder_ / name, text);
    return (folder_ / name).string();
  }

  Result synth(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"synth", (folder_ / "arm.urdf").string(), "--gravity",
                                          "0,0,-9.81"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }

  Folder folder_;
};

struct Refusal {
  std::vector<std::string> arguments;
  std::string expected;  // what standard error must match: the driver, the fault, the remedy
};

TEST_F(Arm, RefusesDriversThatCannotBe) {
  const Refusal refusals[] = {
      {{"--constraint", "tool"}, "tool.*constraint with no direction.*state directions"},
      {{"--constraint", "tool:linear-z,sideways"},
       "tool.*sideways is no direction.*one of.*linear-x"},
      {{"--constraint", "gripper:linear-z"}, "gripper.*no frame or link.*one of"},
      {{"--constraint", "lamp:linear-z"}, "lamp.*fixed to the base.*behind a joint"},
      {{"--constraint", "tool:linear-z,linear-z"}, "tool.*contradictory drivers.*impose it once"},
      {{"--constraint", "tool:linear-z", "--constraint", "tool:linear-z"},
       "tool.*contradictory drivers.*impose it once"},
      {{"--constraint", "tool:angular-y", "--constraint", "lower:angular-y"},
       "lower.*contradictory drivers.*impose it once"},
      {{"--constraint", "tool:7"}, "tool.*more than six directions"},
      {{"--constraint", "tool:linear-z@sky"}, "tool.*@base or @itself"},
      {{"--constraint", "tool:linear-z", "--singular", "damped:0"}, "damping.*number from 1e-7"},
      {{"--constraint", "tool:linear-z", "--singular", "maybe"}, "in-order:TOLERANCE"},
      {{"--constraint", "tool:linear-z", "--limit", "gravity"}, "gravity.*no driver.*tool"},
      {{"--constraint", "tool:linear-z", "--limit", "tool"}, "tool.*no joint has a limit.*state"},
      {{}, "nothing is constrained.*acceleration-constraint"},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> arguments = {"--solver", "hybrid"};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    const Result outcome = synth(arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(std::regex_search(outcome.err, std::regex(refusal.expected)))
        << refusal.expected << "\n"
        << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
}

// Joints that follow others are solved by factors of the mass matrix; which step it is, --why says.
TEST_F(Arm, ImposesAccelerationsWhereJointsFollowOthers) {
  std::string text = kArm;
  const std::string elbow = "<origin xyz=\"1 0 0\"/><axis xyz=\"0 1 0\"/>";
  text.insert(text.find(elbow), "<mimic joint=\"shoulder\" multiplier=\"-2\" offset=\"0.1\"/>");
  write("arm.urdf", text);
  const Result done = synth({"--solver", "hybrid", "--constraint", "tool:linear-z", "--why"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE((done.out + done.err).find("coupled-effects"), std::string::npos) << done.err;
}

TEST_F(Arm, RefusesConstraintsThatNothingDependsOn) {
  const Result outcome =
      synth({"--solver", "fpk", "--constraint", "tool:linear-z", "--singular", "in-order:1e-9"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(std::regex_search(outcome.err, std::regex("nothing that is asked depends on it")))
      << outcome.err;
}

// A query model: the constraint is named by its IRI, and the query must say what happens where
// constraints depend on each other.
TEST_F(Arm, NamesTheConstraintOfAQueryByItsIri) {
  const auto query = [](const std::string& given, const std::string& more) {
    return R"({ "@context": "https://w3id.org/sinew/query.json",
      "@id": "https://example.org/query", "@type": "Query", "name": "hold",
      "asks": [{ "@type": "Asked", "quantity": "joint-acceleration", "of": "every-joint" }],
      "gives": [{ "@type": "Given", "quantity": "joint-position", "of": "every-joint" },
        { "@type": "Given", "quantity": "joint-velocity", "of": "every-joint" },
        { "@type": "Given", "quantity": "joint-force", "of": "every-joint" },
        { "@type": "Given", "quantity": "gravity" },
        { "@type": "Given", "@id": "https://example.org/hold-height",
          "quantity": "acceleration-constraint", "of": "tool")" +
           given + "}]" + more + "}";
  };
  const std::string in_order = R"(, "singular": "in-order", "tolerance": 1e-9)";
  const Result nowhere = synth({"--query", write("a.json", query("", in_order))});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_TRUE(std::regex_search(
      nowhere.err, std::regex("https://example.org/hold-height: a constraint with no direction")))
      << nowhere.err;
  const Result zero = synth(
      {"--query", write("b.json", query(R"(, "unit-forces": [[0, 0, 0, 0, 0, 0]])", in_order))});
  EXPECT_EQ(zero.exit_code, 1);
  EXPECT_TRUE(std::regex_search(
      zero.err, std::regex("https://example.org/hold-height: a unit force without a direction")))
      << zero.err;
  const std::string down = R"(, "unit-forces": [[0, 0, 0, 0.6, 0, -0.8]], "seen-by": "itself")";
  const Result silent = synth({"--query", write("c.json", query(down, ""))});
  EXPECT_EQ(silent.exit_code, 1);
  EXPECT_TRUE(std::regex_search(silent.err, std::regex("state singular: in-order"))) << silent.err;
  const Result fine = synth({"--query", write("d.json", query(down, in_order))});
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
}

// ---- steps as data ----

const std::string kHeight = SINEW_SOURCE_DIR "/solvers/steps/height.json";

// The tool is 1 m along x, the elbow as far again; angles turn about y.
TEST_F(Arm, AnswersWithAStepThatIsData) {
  const std::string rows = write("rows.csv", "position.shoulder,position.elbow\n0.3,0.5\n0,0\n");
  const Result outcome = run_sinew(
      {"run", (folder_ / "arm.urdf").string(), "--steps", kHeight, "--solver", "fpk", "--ask",
       "height of tool", "--ask", "height of upper", "--ask", "height of lower", "--input", rows});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string head, first, second;
  std::getline(lines, head);
  std::getline(lines, first);
  std::getline(lines, second);
  const auto tail = [](const std::string& line, int fields) {
    std::vector<std::string> all;
    std::istringstream in(line);
    for (std::string one; std::getline(in, one, ',');) all.push_back(one);
    return std::vector<std::string>(all.end() - fields, all.end());
  };
  EXPECT_EQ(tail(head, 3),
            (std::vector<std::string>{"height.tool", "height.upper", "height.lower"}));
  const double expected[] = {-std::sin(0.3) - std::sin(0.8), 0, -std::sin(0.3)};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::stod(tail(first, 3)[static_cast<std::size_t>(i)]), expected[i], 1e-12);
    EXPECT_NEAR(std::stod(tail(second, 3)[static_cast<std::size_t>(i)]), 0, 1e-12);
  }
}

// Among the models, and chosen by the planner for what it gives.
TEST_F(Arm, SaysWhyAStepThatIsDataIsThere) {
  const Result with = synth(
      {kHeight, "--ask", "height of tool", "--give", "joint-position of every-joint", "--why"});
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_TRUE(std::regex_search(
      with.err, std::regex("height gives height \\(asked: height\\): how high a frame is")))
      << with.err;
  EXPECT_NE(with.out.find("position-along"), std::string::npos);
  EXPECT_EQ(with.out.find("slots#height\""), std::string::npos);  // the blackboard is gone
  const Result without =
      synth({"--ask", "height of tool", "--give", "joint-position of every-joint"});
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_TRUE(std::regex_search(without.err, std::regex("nothing is known of height")))
      << without.err;
}

TEST_F(Arm, RefusesBadStepsWithTheirPlace) {
  const std::string text = read_file(kHeight);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string result = text;
    const std::size_t at = result.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return result.replace(at, from.size(), to);
  };
  struct Fault {
    std::string from, to, expected;
  };
  const Fault faults[] = {
      {"INSERT { []", "INSERT { [", "bad.json:[0-9]+: .*configure, line 1"},
      {"ASK {", "ASK {{", "bad.json:[0-9]+: .*conditions, line 1"},
      {"\"across-joints\"", "\"SELECT ?node WHERE { ?node ?p ?o }\"",
       "bad.json:[0-9]+: .*does not select \\?child"},
      {"\"local\"", "\"sideways\"", "bad.json:[0-9]+: .*sideways"},
      {"'signal'", "'noise'", "bad.json:[0-9]+: .*no quantity noise.*quantities"},
      {"so:position-along", "so:position-above", "bad.json:[0-9]+: .*no operator .*position-above"},
      {"so:axis ?axis", "so:axes ?axis", "bad.json:[0-9]+: .*axis is missing"},
      {"so:axis ?axis", "so:axis ?axis ; so:colour 'red'", "bad.json:[0-9]+: .*means nothing here"},
      {"sa:seen-by ?root", "sa:seen-by ?node", "bad.json:[0-9]+: .*seen-by"},
      {"unit:M ", "unit:SEC ", "bad.json:[0-9]+: .*units do not fit"},
      {"[\"height\", \"height-axis\"]", "[\"height\"]",
       "bad.json:[0-9]+: .*height-axis, which the step does not declare"},
      {"\"name\": \"height\"", "\"name\": \"pose\"", "bad.json:[0-9]+: .*choose another name"},
      {"\"needs\": [\"pose\", \"frame-pose\"]", "\"needs\": [\"pose\", \"charm\"]",
       "height cannot be computed without charm, which no step gives"},
  };
  for (const Fault& fault : faults) {
    const std::string bad = write("bad.json", changed(fault.from, fault.to));
    const Result outcome = synth(
        {"--steps", bad, "--ask", "height of tool", "--give", "joint-position of every-joint"});
    EXPECT_EQ(outcome.exit_code, 1) << fault.to;
    EXPECT_TRUE(std::regex_search(outcome.err, std::regex(fault.expected)))
        << fault.expected << "\n"
        << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
}

}  // namespace
}  // namespace sinew::test
