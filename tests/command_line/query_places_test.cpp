// Faults in a query's file: each is named by the file and line of the node that says what cannot
// be, by its IRI (the query's, where it has none), with the remedy. And what a query can say of
// rates.
#include <gtest/gtest.h>

#include <regex>

#include "arm_urdf.h"
#include "command.h"

namespace sinew::test {
namespace {

// One line for each part, so that the test knows where the fault is.
struct QueryText {
  std::string asked = R"("quantity": "joint-acceleration", "of": "every-joint")";  // line 6
  std::string driver = R"("quantity": "joint-force", "of": "every-joint")";        // line 11
  std::string constraint = R"("of": "tool", "directions": ["linear-z"])";          // line 12
  std::string more = R"("singular": "in-order", "tolerance": 1e-9)";               // line 14

  std::string text() const {
    return R"({
  "@context": "https://w3id.org/sinew/query.json",
  "@id": "https://example.org/hold",
  "@type": "Query", "name": "hold",
  "asks": [
    { "@type": "Asked", )" +
           asked + R"( }
  ],
  "gives": [
    { "@type": "Given", "quantity": "joint-position", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-velocity", "of": "every-joint" },
    { "@type": "Given", )" +
           driver + R"( },
    { "@type": "Given", "@id": "https://example.org/height", "quantity": "acceleration-constraint", )" +
           constraint + R"( }
  ],
  )" + more +
           R"(
})";
  }
};

class QueryFile : public testing::Test {
 protected:
  QueryFile() { write_file(folder_ / "arm.urdf", kArm); }

  Result run(const std::string& command, const std::string& query,
             std::vector<std::string> more = {}) const {
    write_file(folder_ / "query.json", query);
    std::vector<std::string> arguments = {command, (folder_ / "arm.urdf").string(), "--query",
                                          (folder_ / "query.json").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }

  Folder folder_;
};

void expect_match(const std::string& text, const std::string& expression) {
  EXPECT_TRUE(std::regex_search(text, std::regex(expression))) << text << "\nlacks " << expression;
}

TEST_F(QueryFile, HasItsFaultsAtTheirLines) {
  struct Fault {
    QueryText query;
    std::string expected;  // line, IRI, what is wrong, remedy
  };
  const std::string query = "https://example.org/hold: ", height = "https://example.org/height: ";
  const std::string in_order = R"("singular": "in-order", "tolerance": 1e-9)";
  const Fault faults[] = {
      {{.constraint = R"("of": "tool")"},
       ":12: " + height + "a constraint with no direction; state directions"},
      {{.constraint = R"("of": "tool", "unit-forces": [[0, 0, 0, 0, 0, 0]])"},
       ":12: " + height +
           "a unit force without a direction; six numbers, moment "
           "first, whose length is about 1"},
      {{.constraint = R"("of": "tool", "directions": ["linear-z", "linear-z"])"},
       ":12: " + height + "contradictory drivers: tool.linear-z imposes .*; impose it once"},
      {{.constraint = R"("of": "tool", "directions": ["upward"])"}, ":12: .*upward"},
      {{.constraint = R"("of": "gripper", "directions": ["linear-z"])"},
       ":12: " + height + "gripper: no frame or link of the tree has this name; .*tool"},
      {{.constraint = R"("of": "lamp", "directions": ["linear-z"])"},
       ":12: " + height + "lamp is fixed to the base: nothing moves it; choose a frame behind"},
      {{.driver = R"("quantity": "joint-acceleration", "of": "every-joint")"},
       ":14: " + query +
           "hold: the accelerations of all joints and of a frame are given: they "
           "contradict each other; give joint forces"},
      {{.driver = R"("quantity": "external-wrench", "of": "lamp")"},
       ":11: " + query + ".*lamp.*: a wrench on the base.*; leave it out, or let the base float"},
      {{.driver = R"("quantity": "external-wrench", "of": "claw")"},
       ":11: " + query + "claw: no frame or link of the tree has this name; .*tool"},
      {{.driver = R"("quantity": "joint-torque", "of": "every-joint")"},
       ":11: " + query + "there is no driver joint-torque; one of .*joint-force"},
      {{.asked = R"("quantity": "pose", "of": "finger")"},
       ":6: " + query + "finger: no frame or link of the tree has this name; .*tool"},
      {{.asked = R"("quantity": "speed", "of": "tool")"},
       ":6: " + query + "hold: nothing is known of speed; ask for one of"},
      {{.more = R"("singular": "damped", "damping": 0)"},
       ":14: " + query + "hold: 0 is no damping; a number from 1e-7"},
      {{.more = in_order + R"(, "limited": "wrist")"},
       ":14: " + query + "wrist: there is no driver of this name"},
      {{.more = in_order + R"(, "tips": ["finger"])"}, ":14: .*finger"},
      {{.more = in_order + R"(, "holds": [{ "@type": "Held", "quantity": "mass-matrix" }])"},
       ":14: " + query +
           "mass-matrix: it is to be held, but is neither given, nor asked, nor "
           "computed on the way; hold one of .*joint-position"},
  };
  for (const Fault& fault : faults) {
    const Result outcome = run("synth", fault.query.text(), {"--gravity", "0,0,-9.81"});
    EXPECT_EQ(outcome.exit_code, 1) << fault.expected;
    expect_match(outcome.err, R"(query\.json)" + fault.expected);
    EXPECT_TRUE(outcome.out.empty());
  }
}

// Both the force and the acceleration of the joints are given; and one that is needed is not.
TEST_F(QueryFile, HasContradictoryAndMissingDriversAtTheirLines) {
  const auto query = [](const std::string& last) {
    return R"({
  "@context": "https://w3id.org/sinew/query.json",
  "@id": "https://example.org/drive", "@type": "Query", "name": "drive",
  "asks": [
    { "@type": "Asked", "quantity": "pose", "of": "tool" },
    { "@type": "Asked", "quantity": "joint-force", "of": "every-joint" }
  ],
  "gives": [
    { "@type": "Given", "quantity": "joint-position", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-velocity", "of": "every-joint" })" +
           last + "\n  ]\n}";
  };
  const Result missing = run("synth", query(""));
  EXPECT_EQ(missing.exit_code, 1);
  expect_match(
      missing.err,
      R"(query\.json:6: https://example\.org/drive: joint-force cannot be computed without )"
      "joint-acceleration; add joint-acceleration to what the query gives");
  const Result both =
      run("synth", query(",\n    { \"@type\": \"Given\", \"quantity\": \"joint-force\", \"of\": "
                         "\"every-joint\" },\n    { \"@type\": \"Given\", \"@id\": "
                         "\"https://example.org/faster\", \"quantity\": \"joint-acceleration\", "
                         "\"of\": \"every-joint\" }"));
  EXPECT_EQ(both.exit_code, 1);
  expect_match(both.err, R"(query\.json:12: https://example\.org/faster: both the force and the )"
                         "acceleration of every joint are given: .*; give one of them");
}

// ---- what is held ----

constexpr const char* kDrive = R"({
  "@context": "https://w3id.org/sinew/query.json",
  "@id": "https://example.org/drive", "@type": "Query", "name": "drive",
  "asks": [ { "@type": "Asked", "quantity": "joint-acceleration", "of": "every-joint" },
            { "@type": "Asked", "quantity": "mass-matrix" } ],
  "gives": [
    { "@type": "Given", "quantity": "joint-position", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-velocity", "of": "every-joint" },
    { "@type": "Given", "quantity": "joint-force", "of": "every-joint" },
    { "@type": "Given", "quantity": "gravity", "varies": true }
  ])";
constexpr const char* kHolds = R"(,
  "holds": [ { "@type": "Held", "quantity": "gravity" }, { "@type": "Held", "quantity": "mass-matrix" } ])";

TEST_F(QueryFile, HoldsAsTheOptionsOfGenerateDo) {
  const std::string by_query = (folder_ / "by-query").string(),
                    by_option = (folder_ / "by-option").string(),
                    by_words = (folder_ / "by-words").string();
  EXPECT_EQ(run("generate", kDrive + std::string(kHolds) + "}", {"--name", "drive", "-o", by_query})
                .exit_code,
            0);
  EXPECT_EQ(run("generate", kDrive + std::string("}"),
                {"--name", "drive", "-o", by_option, "--slow", "gravity", "--held", "mass-matrix"})
                .exit_code,
            0);
  EXPECT_EQ(run("generate", kDrive + std::string("}"),
                {"--name", "drive", "-o", by_words, "--hold", "gravity", "--hold", "mass-matrix"})
                .exit_code,
            0);
  // The algorithm's IRI is derived from the query's words, so the JSON that names it differs.
  for (const char* file : {"/drive.c", "/drive.h"}) {
    const std::string text = read_file(by_query + file);
    EXPECT_NE(text.find("drive_update"), std::string::npos);
    EXPECT_EQ(text, read_file(by_option + file));
    EXPECT_EQ(text, read_file(by_words + file));
  }
}

// The policy stands in the algorithm model, whose code is the same.
TEST_F(QueryFile, WritesWhatIsHeldIntoTheAlgorithm) {
  const std::string algorithm = (folder_ / "drive.jsonld").string();
  const Result synth = run("synth", kDrive + std::string(kHolds) + "}", {"--why", "-o", algorithm});
  EXPECT_EQ(synth.exit_code, 0) << synth.err;
  expect_match(synth.err,
               "held: gravity .1 data block., as https://example.org/drive says: changes "
               "slowly; the update computes what depends on it alone");
  expect_match(synth.err, "held: mass-matrix .1 data block.* keeps its value from one update");
  expect_match(read_file(algorithm), "\"held\": true");
  EXPECT_EQ(run_sinew({"check", algorithm, "--only-shapes"}).exit_code, 0);
  const std::string code = (folder_ / "code").string();
  EXPECT_EQ(run_sinew({"generate", algorithm, "--name", "drive", "-o", code}).exit_code, 0);
  expect_match(read_file(code + "/drive.h"), "void drive_update");
}

// A row at a time there is no rate: everything is computed anew, and that is said.
TEST_F(QueryFile, IsRunWithoutHolding) {
  write_file(folder_ / "rows.csv",
             "position.shoulder,position.elbow,velocity.shoulder,velocity.elbow,force.shoulder,"
             "force.elbow,gravity[0],gravity[1],gravity[2]\n0.1,0.2,0.3,0.4,0.5,0.6,0,0,-9.81\n"
             "0.5,1.2,0.3,0.4,0.5,0.6,0,0,-9.81\n");
  const std::vector<std::string> rows = {"--input", (folder_ / "rows.csv").string()};
  const Result held = run("run", kDrive + std::string(kHolds) + "}", rows);
  const Result plain = run("run", kDrive + std::string("}"), rows);
  EXPECT_EQ(held.exit_code, 0) << held.err;
  EXPECT_EQ(held.out, plain.out);
  expect_match(held.err,
               "note: the query holds mass-matrix between updates: here it is computed "
               "anew each time");
  EXPECT_EQ(plain.err.find("note: the query holds"), std::string::npos);
}

}  // namespace
}  // namespace sinew::test
