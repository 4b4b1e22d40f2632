// sinew run --robot with a host model: tasks at different rates, events, and programs that are
// swapped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "command.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

const std::string kCascade = SINEW_SOURCE_DIR "/examples/gen3_cascade/";

// The cascade that ships, with one text of one file replaced by another.
class HostModel : public testing::Test {
 protected:
  HostModel() {
    for (const char* name : {"outer", "inner", "host"})
      texts_[name] = read_file(kCascade + name + ".jsonld");
  }
  void replace(const std::string& file, const std::string& what, const std::string& with) {
    std::string& text = texts_[file];
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), with);
  }
  std::string write(const std::string& file, const std::string& as) {
    write_file(folder_ / as, texts_.at(file));
    return (folder_ / as).string();
  }
  Result run(const std::vector<std::string>& more,
             const std::vector<std::string>& files = {"outer", "inner", "host"}) {
    std::vector<std::string> arguments = {"run"};
    for (const auto& file : gen3_models()) arguments.push_back(file.string());
    for (const std::string& file : files) arguments.push_back(write(file, file + ".jsonld"));
    for (const char* word : {"--robot", "mujoco", "--lockstep", "--start", "position.joint4=0.2"})
      arguments.emplace_back(word);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }
  Result run_to(double goal, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--for", "4", "--set",
                                          "setpoint.goal=" + std::to_string(goal)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  Folder folder_;
  std::map<std::string, std::string> texts_;
};

TEST_F(HostModel, RunsTheOuterLoopAtATenthOfTheRateAndStopsWhenItHasArrived) {
  const std::string log = (folder_ / "log.csv").string();
  const Result result = run_to(1.0, {"--record", log});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("event.arrived"));
  EXPECT_THAT(result.err, HasSubstr("ends the run"));
  EXPECT_THAT(result.err, HasSubstr("1 queued, 0 lost"));
  Columns columns = columns_of(read_file(log));
  const auto& wanted = columns.at("outer-task/signal.wanted-speed");
  const auto& given = columns.at("inner-task/setpoint.wanted-speed");
  const auto& angle = columns.at("outer-task/position.joint4");
  ASSERT_GT(wanted.size(), 100u);
  ASSERT_LT(wanted.size(), 4000u) << "it stops before the time is up";
  std::size_t changes = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(given[i], wanted[i]) << "the same number, in the same cycle: " << i;
    // The formula of the outer loop, on what it has measured itself.
    const double top = 30 * std::acos(-1) / 180;
    if (columns.at("outer-task/phase-before.moving")[i] == 1) {
      EXPECT_NEAR(wanted[i], std::min(2.0 * (1.0 - angle[i]), top), 1e-12) << i;
    }
    if (i == 0 || wanted[i] == wanted[i - 1]) continue;
    ++changes;
    EXPECT_EQ(i % 10, 0u) << "the outer loop runs in every tenth cycle";
  }
  EXPECT_GT(changes, 5u);
  EXPECT_NEAR(angle.back(), 1.0, 0.5 * std::acos(-1) / 180 + 1e-9);
}

TEST_F(HostModel, PeriodsThatAreNoWholeMultiplesAreRefused) {
  replace("outer", R"("unit": "MilliSEC", "value": 10.0)", R"("unit": "MilliSEC", "value": 2.5)");
  const Result result = run_to(1.0);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("gen3-cascade/outer-task: its period is 2.5 times the shortest"));
  EXPECT_THAT(result.err, HasSubstr("a whole number of times"));
}

TEST_F(HostModel, APeriodThatIsNotTheControllersOwnIsRefused) {
  replace("host", R"("models": "app:outer")", R"("models": "app:outer",
      "period": { "@id": "app:p", "@type": "Quantity", "unit": "MilliSEC", "value": 20.0 })");
  const Result result = run_to(1.0);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("integrates over steps of 0.01 s, but would run every 0.02 s"));
}

TEST_F(HostModel, ARateOnTheCommandLineContradictsThePeriodsOfTasks) {
  const Result result = run_to(1.0, {"--rate", "500"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("leave out --rate"));
}

// Without a host, the one task runs as often as its controllers say, not at the default.
TEST_F(HostModel, ASingleTaskRunsAsOftenAsItsControllersSay) {
  replace("inner", R"("unit": "MilliSEC", "value": 1.0)", R"("unit": "MilliSEC", "value": 4.0)");
  const Result own = run({"--for", "0.2", "--set", "setpoint.wanted-speed=0"}, {"inner"});
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_THAT(own.err, HasSubstr("cycles     50,"));
  const Result other =
      run({"--for", "0.2", "--set", "setpoint.wanted-speed=0", "--rate", "1000"}, {"inner"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err,
              HasSubstr("integrates over steps of 0.004 s, but would run every 0.001 s"));
}

struct Fault {
  const char* name;
  const char* file;
  const char* what;
  const char* with;
  std::vector<std::string> says;
};
class FaultyHost : public HostModel, public testing::WithParamInterface<Fault> {};

TEST_P(FaultyHost, IsRefusedByItsIriWithTheRemedy) {
  replace(GetParam().file, GetParam().what, GetParam().with);
  const Result result = run_to(1.0);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  for (const std::string& words : GetParam().says) EXPECT_THAT(result.err, HasSubstr(words));
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultyHost,
    testing::Values(
        Fault{"a_model_that_no_file_holds",
              "host",
              R"("models": "app:outer")",
              R"("models": "app:outside")",
              {"outer-task: no file holds its model", "gen3-cascade/outside", "the files hold"}},
        Fault{"a_model_of_two_tasks",
              "host",
              R"("models": "app:inner")",
              R"("models": ["app:inner", "app:outer"])",
              {"inner-task", "belongs to", "a model belongs to one task"}},
        Fault{"an_event_that_nobody_raises",
              "host",
              "app:arrived",
              "app:departed",
              {"gen3-cascade/departed", "no task raises it; the tasks raise event.arrived"}},
        Fault{"an_action_that_there_is_not",
              "host",
              R"("stop")",
              R"("ho:explode")",
              {"is no action; stop, fault, start or halt"}},
        Fault{"a_task_that_is_none",
              "host",
              R"("action": "stop")",
              R"("action": "halt", "task": "app:outer")",
              {"is no task of the host", "name one of its"}},
        Fault{"a_connection_to_nowhere",
              "host",
              R"("reactions": [)",
              R"("connections": { "@id": "app:wire", "@type": "Connection",
                 "from": "app:wanted-speed", "to": "app:goal" }, "reactions": [)",
              {"gen3-cascade/wire: it connects", "no two tasks have such an output"}},
        Fault{"a_host_without_tasks",
              "host",
              R"(["app:outer-task", "app:inner-task"])",
              "[]",
              {"a host without tasks"}},
        Fault{
            "a_number_in_another_unit",
            "inner",
            R"("@id": "app:wanted-speed", "@type": ["Quantity", "Setpoint"], "unit": "RAD-PER-SEC")",
            R"("@id": "app:wanted-speed", "@type": ["Quantity", "Setpoint"], "unit": "M-PER-SEC")",
            {"gen3-cascade/"}}),
    [](const auto& info) { return info.param.name; });

TEST_F(HostModel, NumbersThatAreCalledOtherwiseAreConnectedAsDeclared) {
  // The inner model is somebody else's: its set point has another name.
  std::string& text = texts_["inner"];
  for (std::size_t at; (at = text.find("app:wanted-speed")) != std::string::npos;)
    text.replace(at, 16, "app:demand");
  const Result unconnected = run_to(1.0);
  EXPECT_EQ(unconnected.exit_code, 1);
  EXPECT_THAT(unconnected.err, HasSubstr("nothing gives these inputs a value: setpoint.demand"));
  replace("host", R"("reactions": [)", R"("connections": { "@id": "app:wire", "@type": "Connection",
                 "from": "app:wanted-speed", "to": "app:demand" }, "reactions": [)");
  const Result result = run_to(1.0);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("event.arrived"));
}

// One event halts the one controller and starts the other, in the same cycle.
TEST_F(HostModel, AnEventSwitchesFromOneTaskToAnother) {
  texts_["brake"] = texts_["inner"];
  std::string& brake = texts_["brake"];
  for (std::size_t at = 0; (at = brake.find("\"app:", at)) != std::string::npos; at += 10)
    brake.replace(at, 5, "\"app:brake-");
  replace("brake", R"("@type": ["Quantity", "Setpoint"], "unit": "RAD-PER-SEC")",
          R"("@type": "Quantity", "unit": "RAD-PER-SEC", "value": 0.0)");
  replace("host", R"("tasks": ["app:outer-task", "app:inner-task"])",
          R"("tasks": ["app:outer-task", "app:inner-task", "app:brake-task"])");
  replace("host", R"("reactions": ["app:when-arrived"])",
          R"("reactions": ["app:when-arrived", "app:then-hold"])");
  replace("host", R"("action": "stop" })",
          R"("action": "halt", "task": "app:inner-task" },
    { "@id": "app:then-hold", "@type": "Reaction", "event": "app:arrived", "action": "start",
      "task": "app:brake-task" },
    { "@id": "app:brake-task", "@type": "HostTask", "models": "app:brake-inner", "halted": true })");
  const std::string log = (folder_ / "log.csv").string();
  const Result result = run({"--for", "4", "--set", "setpoint.goal=1", "--record", log},
                            {"outer", "inner", "brake", "host"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the task inner-task halts"));
  EXPECT_THAT(result.err, HasSubstr("the task brake-task starts"));
  Columns columns = columns_of(read_file(log));
  EXPECT_EQ(columns.at("tick").size(), 4000u) << "the run goes on";
  EXPECT_NEAR(columns.at("brake-task/velocity.joint4").back(), 0, 0.02) << "and holds the elbow";
  // What halted keeps what it has computed last, while the other computes anew.
  const auto& halted = columns.at("inner-task/command.joint4");
  const auto& holds = columns.at("brake-task/command.joint4");
  EXPECT_EQ(halted.back(), halted[halted.size() - 100]);
  EXPECT_NE(holds.back(), 0);
}

// --- swaps ---

class SwapOfAProgram : public HostModel {
 protected:
  // The algorithm of the inner task as it stands.
  std::string algorithm(const std::string& name) {
    std::vector<std::string> arguments = {"synth"};
    for (const auto& file : gen3_models()) arguments.push_back(file.string());
    const std::string output = (folder_ / (name + ".algo.jsonld")).string();
    arguments.insert(arguments.end(), {write("inner", name + ".jsonld"), "-o", output});
    const Result result = run_sinew(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return output;
  }
  std::string woven(const std::string& from, const std::string& update) {
    write_file(folder_ / "update.rq", update);
    const std::string output = from + ".woven.jsonld";
    const Result result =
        run_sinew({"weave", from, (folder_ / "update.rq").string(), "-o", output});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return output;
  }
  // The speed controller becomes one of the angle: its integral is in rad s instead of rad.
  void control_the_angle_instead() {
    std::string& text = texts_["inner"];
    const auto all = [&](const std::string& what, const std::string& with) {
      for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
    };
    all("\"RAD-PER-SEC\"", "\"RAD\"");
    all("JointVelocityCoordinate", "JointPositionCoordinate");
    all("N-M-PER-RAD", "N-M-PER-RAD-SEC");
    all("N-M-SEC-PER-RAD", "N-M-PER-RAD");
    all("N-M-SEC2-PER-RAD", "N-M-SEC-PER-RAD");
  }
  Result swapped(const std::string& before, const std::string& after,
                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run"};
    for (const auto& file : gen3_models()) arguments.push_back(file.string());
    arguments.insert(arguments.end(),
                     {before, "--robot", "mujoco", "--lockstep", "--for", "0.4", "--set",
                      "setpoint.wanted-speed=0.2", "--swap", after, "--swap-at", "0.2"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_sinew(arguments);
  }
};

const std::string kDeclare = "INSERT { ?state sa:at-swap ";
const std::string kOfTheIntegral = " } WHERE { ?state sa:name \"integral.speed-controller\" }";

TEST_F(SwapOfAProgram, CarriesTheIntegralOverWhenOnlyAGainHasChanged) {
  const std::string before = algorithm("before");
  replace("inner", R"("value": 50.0)", R"("value": 60.0)");
  const std::string log = (folder_ / "log.csv").string();
  const Result result = swapped(before, algorithm("after"), {"--record", log});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("states carried over: integral.speed-controller"));
  EXPECT_THAT(result.err, HasSubstr("set points kept: setpoint.wanted-speed"));
  const auto integral = columns_of(read_file(log)).at("integral.speed-controller");
  EXPECT_GT(std::abs(integral[199]), 1e-5);
  EXPECT_NEAR(integral[200], integral[199], 0.1 * std::abs(integral[199]));
}

TEST_F(SwapOfAProgram, RefusesAStateOfAnotherPrototypeWhenNothingIsDeclared) {
  const std::string before = algorithm("before");
  control_the_angle_instead();
  const Result result = swapped(before, algorithm("after"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("integral.speed-controller"));
  EXPECT_THAT(result.err, HasSubstr("state sa:at-swap: sa:initialise, or a conversion"));
  EXPECT_THAT(result.err, HasSubstr("goes on as before"));
  EXPECT_THAT(result.err, HasSubstr("cycles     400,"));
}

TEST_F(SwapOfAProgram, InitialisesOrConvertsTheStateAsDeclared) {
  const std::string before = algorithm("before");
  control_the_angle_instead();
  const std::string after = algorithm("after");
  // The set point is another number now, so the new program's is set as well.
  const Result unset = swapped(before, woven(after, kDeclare + "sa:initialise" + kOfTheIntegral));
  EXPECT_EQ(unset.exit_code, 1);
  EXPECT_THAT(unset.err, HasSubstr("nothing gives these inputs a value: setpoint.wanted-speed"));
  const std::string constant =
      "DELETE { ?point sa:role sa:input ; sa:index ?index } INSERT { ?point sa:role sa:constant ; "
      "tree:value ( 0.3e0 ) } WHERE { ?point sa:name \"setpoint.wanted-speed\" ; sa:index ?index }";
  const std::string fixed = woven(after, constant);
  const Result initialised =
      swapped(before, woven(fixed, kDeclare + "sa:initialise" + kOfTheIntegral));
  EXPECT_EQ(initialised.exit_code, 0) << initialised.err;
  EXPECT_THAT(initialised.err, HasSubstr("initialised: integral.speed-controller"));
  const Result converted = swapped(
      before, woven(fixed, kDeclare + "[ sa:factor [ qudt:value 0.5 ; qudt:unit unit:SEC ] ]" +
                               kOfTheIntegral));
  EXPECT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_THAT(converted.err, HasSubstr("converted: integral.speed-controller"));
  const Result wrong = swapped(
      before, woven(fixed, kDeclare + "[ sa:factor [ qudt:value 0.5 ; qudt:unit unit:M ] ]" +
                               kOfTheIntegral));
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("times a factor in M"));
}

TEST_F(SwapOfAProgram, SaysWhatIsMissing) {
  const std::string before = algorithm("before");
  std::vector<std::string> arguments = {"run"};
  for (const auto& file : gen3_models()) arguments.push_back(file.string());
  arguments.insert(arguments.end(), {before, "--robot", "mujoco", "--lockstep", "--for", "0.1",
                                     "--set", "setpoint.wanted-speed=0.2", "--swap", before});
  Result result = run_sinew(arguments);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("add --swap-at SECONDS"));
  arguments.insert(arguments.end(), {"--swap-at", "7"});
  result = run_sinew(arguments);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("the run ended before --swap-at"));
}

}  // namespace
}  // namespace sinew::test
