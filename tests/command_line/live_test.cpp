// sinew run with a robot, what is woven into its algorithm, and figures of what it logs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "command.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

std::vector<std::string> with_gen3(std::vector<std::string> before,
                                   const std::vector<std::string>& after) {
  for (const auto& file : gen3_models()) before.push_back(file.string());
  before.insert(before.end(), after.begin(), after.end());
  return before;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

constexpr const char* kScene = R"({
  "start": { "position.joint2": 0.5, "position.joint4": 1.0 }, "joint-damping": 0.5,
  "hand": { "frame": "link7-root", "stiffness": 3000, "damping": 150, "maximum-force": 100,
            "phases": [ { "name": "free", "until": 0.2 },
                        { "name": "pushed", "until": 0.6, "velocity": [0, 0, -0.1] } ] } })";

TEST(RunWithARobot, PrintsTheReferenceTorques) {
  const Result result = run_sinew(with_gen3({"run"}, {"--solver", "gravity", "--robot", "print",
                                                      "--start", "position=0.2", "--for", "0.05"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream words(result.out);
  std::string name;
  double value = 0;
  std::vector<double> torques;
  for (int i = 0; i < 7 && words >> name >> value; ++i) torques.push_back(value);
  const std::vector<double> reference = {0,
                                         -6.1049793161502901,
                                         0.12976516944306268,
                                         -2.9211559500853213,
                                         0.0034301511793215778,
                                         -0.53648150477306344,
                                         -0.028939511370873069};
  ASSERT_EQ(torques.size(), 7u) << result.out;
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(torques[i], reference[i], 1e-12);
  // A busy machine may miss some of the 50.
  std::smatch cycles;
  ASSERT_TRUE(std::regex_search(result.err, cycles, std::regex("cycles +(\\d+), missed (\\d+)")))
      << result.err;
  EXPECT_EQ(std::stoi(cycles[1]) + std::stoi(cycles[2]), 50);
}

TEST(RunWithARobot, SimulatesInLockstepAndDrawsItsLog) {
  const Folder folder;
  write_file(folder / "scene.json", kScene);
  const std::string log = (folder / "log.csv").string();
  const Result result = run_sinew(
      with_gen3({"run"}, {"--solver", "gravity", "--robot", "mujoco", "--lockstep", "--for", "0.8",
                          "--scene", (folder / "scene.json").string(), "--record", log}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("800 rows recorded, 0 dropped"));
  const Columns columns = columns_of(read_file(log));
  ASSERT_EQ(columns.at("phase").size(), 800u);
  EXPECT_EQ(columns.at("phase")[10], 1);
  EXPECT_EQ(columns.at("phase")[500], 2);
  EXPECT_EQ(columns.at("phase")[799], 0);
  EXPECT_LT(columns.at("hand.z")[500], 0);
  EXPECT_NEAR(columns.at("position.joint2")[100], 0.5, 1e-3);

  const Result plot =
      run_sinew({"plot", log, "--panel", "angle [rad]=position.joint2,position.joint4", "--panel",
                 "hand [N]=hand.z", "--phase-names", "free,pushed", "--title", "a < b"});
  ASSERT_EQ(plot.exit_code, 0) << plot.err;
  EXPECT_EQ(plot.out.rfind("<svg", 0), 0u);
  EXPECT_EQ(count(plot.out, "<polyline"), 3u);
  EXPECT_THAT(plot.out, HasSubstr(">pushed</text>"));
  EXPECT_THAT(plot.out, HasSubstr("a &lt; b"));
  EXPECT_THAT(run_sinew({"plot", log, "--panel", "nowhere"}).err, HasSubstr("no column nowhere"));
}

TEST(RunWithARobot, IsTheSameEveryTimeInLockstep) {
  const Folder folder;
  write_file(folder / "scene.json", kScene);
  std::vector<double> last;
  for (const char* name : {"a.csv", "b.csv"}) {
    const Result result =
        run_sinew(with_gen3({"run"}, {"--solver", "gravity", "--robot", "mujoco", "--lockstep",
                                      "--for", "0.3", "--scene", (folder / "scene.json").string(),
                                      "--record", (folder / name).string()}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    last.push_back(columns_of(read_file(folder / name)).at("position.joint2").back());
  }
  EXPECT_EQ(last[0], last[1]);
}

TEST(RunWithARobot, SaysWhatIsMissing) {
  EXPECT_THAT(run_sinew(with_gen3({"run"}, {"--solver", "gravity", "--robot", "print"})).err,
              HasSubstr("no measurement for position.joint"));
  EXPECT_THAT(run_sinew(with_gen3({"run"}, {"--solver", "rnea", "--robot", "print", "--start",
                                            "position=0", "--start", "velocity=0"}))
                  .err,
              HasSubstr("nothing gives these inputs a value: acceleration.joint1"));
  EXPECT_THAT(run_sinew(with_gen3({"run"}, {"--solver", "gravity", "--robot", "udp", "--remote",
                                            "127.0.0.1:9"}))
                  .err,
              HasSubstr("no safe command"));
  EXPECT_EQ(run_sinew(with_gen3({"run"}, {"--solver", "gravity"})).exit_code, 2);
  EXPECT_EQ(run_sinew(with_gen3({"run"}, {"--solver", "gravity", "--robot", "toaster"})).exit_code,
            2);
}

// --- weaves that ship ---

class ShippedWeave : public testing::Test {
 protected:
  void SetUp() override {
    algorithm_ = (folder_ / "algorithm.jsonld").string();
    const Result result = run_sinew(with_gen3(
        {"synth"}, {"--solver", "rnea", "--robot", "mujoco", "--safe", "0", "-o", algorithm_}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    write_file(folder_ / "scene.json", kScene);
  }

  std::string woven(const std::string& weave, const std::string& from = "") {
    const std::string to = (folder_ / (weave + ".jsonld")).string();
    std::vector<std::string> arguments = {"weave", from.empty() ? algorithm_ : from,
                                          SINEW_SOURCE_DIR "/weaves/" + weave + ".rq"};
    arguments.insert(arguments.end(), {"-o", to, "--model"});
    const Result result = run_sinew(with_gen3(arguments, {}));
    EXPECT_EQ(result.exit_code, 0) << weave << ": " << result.err;
    return to;
  }

  // Runs it in lockstep with these accelerations of all joints.
  Result run(const std::string& algorithm, double acceleration,
             const std::vector<std::string>& more = {}) {
    std::vector<std::string> after = {"--robot",
                                      "mujoco",
                                      "--lockstep",
                                      "--for",
                                      "0.3",
                                      "--scene",
                                      (folder_ / "scene.json").string()};
    for (int i = 1; i <= 7; ++i) {
      after.push_back("--set");
      after.push_back("acceleration.joint" + std::to_string(i) + "=" +
                      std::to_string(acceleration));
    }
    after.insert(after.end(), more.begin(), more.end());
    return run_sinew(with_gen3({"run", algorithm}, after));
  }

  Folder folder_;
  std::string algorithm_;
};

TEST_F(ShippedWeave, TorqueCheckerStopsTheHostBeforeALimitIsPassed) {
  const std::string checked = woven("torque-checker");
  EXPECT_EQ(count(read_file(checked), "\"so:check-range\""), 7u);
  const Result calm = run(checked, 0);
  EXPECT_EQ(calm.exit_code, 0) << calm.err;
  const Result wild = run(checked, 500);  // takes more than 39 N m
  EXPECT_EQ(wild.exit_code, 1);
  EXPECT_THAT(wild.err, HasSubstr("out of its range"));
  EXPECT_THAT(wild.err, HasSubstr("from now on the safe command"));
}

TEST_F(ShippedWeave, RangeMonitorsTellAndLetItRun) {
  const std::string monitored = woven("range-monitors");
  const Result wild = run(monitored, 30);
  EXPECT_EQ(wild.exit_code, 0) << wild.err;
  EXPECT_THAT(wild.err, HasSubstr("velocity.joint"));
  EXPECT_THAT(wild.err, HasSubstr("out of its range"));
}

TEST_F(ShippedWeave, TimeProbesAreColumnsOfTheLog) {
  const std::string probed = woven("time-probes", woven("torque-checker"));
  const std::string log = (folder_ / "log.csv").string();
  const Result result = run(probed, 0, {"--record", log});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Columns columns = columns_of(read_file(log));
  const auto &measured = columns.at("time.measured"), &computed = columns.at("time.computed"),
             &commanded = columns.at("time.commanded");
  ASSERT_EQ(measured.size(), 300u);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    EXPECT_GT(measured[i], 0);
    EXPECT_LE(measured[i], computed[i]);
    EXPECT_LE(computed[i], commanded[i]);
  }
}

TEST_F(ShippedWeave, LeavesTheProgramByteIdentical) {
  const auto program_of = [&](const std::string& algorithm, const std::string& name) {
    const Result result = run_sinew(
        {"generate", algorithm, "--name", "x", "--target", "c", "-o", (folder_ / name).string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string code = read_file(folder_ / (name + "/x.c"));
    return code.substr(std::min(code.find('\n'), code.size()));  // the banner names the file
  };
  const std::string plain = program_of(algorithm_, "plain");
  EXPECT_FALSE(plain.empty());
  EXPECT_TRUE(program_of(woven("torque-checker"), "checked") == plain);
  EXPECT_TRUE(program_of(woven("time-probes"), "probed") == plain);
}

TEST_F(ShippedWeave, AWeaveThatBreaksTheOrderIsRefusedAndWritesNothing) {
  // Puts `write` first: it would command what has not been computed yet.
  write_file(folder_ / "broken.rq", R"(
DELETE { ?schedule algo:trigger-chain ?first . ?before rdf:rest ?last . ?last rdf:rest rdf:nil }
INSERT { ?schedule algo:trigger-chain ?last . ?last rdf:rest ?first . ?before rdf:rest rdf:nil }
WHERE { ?schedule algo:trigger-chain ?first . ?first rdf:rest* ?before . ?before rdf:rest ?last .
        ?last rdf:rest rdf:nil })");
  const Result result = run_sinew({"weave", algorithm_, (folder_ / "broken.rq").string(), "-o",
                                   (folder_ / "broken.jsonld").string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("reads force.joint1 before"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "broken.jsonld"));
}

TEST(Run, RefusesAnOptionThatTheRobotHasNoUseFor) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--input", "rows.csv", "--rate", "100"},
       "--rate goes with --robot print or --robot mujoco or --robot udp"},
      {{"--input", "rows.csv", "--catch-up"}, "--catch-up goes with --robot"},
      {{"--robot", "mujoco", "-o", "rows.csv"}, "--output goes with --input ROWS.csv"},
      {{"--robot", "print", "--scene", "s.json"}, "--scene goes with --robot mujoco"},
      {{"--robot", "mujoco", "--remote", "127.0.0.1:9"}, "--remote goes with --robot udp"},
      {{"--robot", "udp", "--start", "position=0"},
       "--start goes with --robot print or --robot mujoco"},
  };
  for (const auto& [options, expected] : cases) {
    std::vector<std::string> all = {"--solver", "gravity"};
    all.insert(all.end(), options.begin(), options.end());
    const Result result = run_sinew(with_gen3({"run"}, all));
    EXPECT_EQ(result.exit_code, 2) << expected;
    EXPECT_THAT(result.err, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace sinew::test
