// The logger that ships (weaves/log-damping.rq) on two damping controllers.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fixture.h"
#include "sinew/program/lower.h"
#include "sinew/program/program_json.h"

namespace sinew::runtime::test {
namespace {

using algorithm::Role;
using testing::HasSubstr;

constexpr double kMaximumForce = 10, kMaximumVelocity = 0.1;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class DampingLog : public RuntimeTest {
 protected:
  // Of each joint: f = f_max - f_max / v_max v, for joints 1 and 2.
  std::unique_ptr<Model> damped() {
    auto result = std::make_unique<Model>();
    graph::Terms& terms = result->store.terms();
    const auto iri = [&](const std::string& name) {
      return terms.iri("https://example.org/" + name);
    };
    result->algorithm = iri("damping");
    graph::Transaction transaction = result->store.begin();
    algorithm::Builder builder(result->store, transaction, result->algorithm);
    for (const std::string number : {"1", "2"}) {
      const graph::Id joint = iri("joint" + number);
      const auto of_joint = [&](std::string_view slot, std::string_view quantity, Role role) {
        return builder.block({.slot = slot,
                              .represents = joint,
                              .quantity = quantity,
                              .of = iri("link" + number),
                              .wrt = iri("base"),
                              .seen_by = iri("link" + number),
                              .role = role});
      };
      const auto signal = [&](std::string_view slot, std::string_view unit,
                              std::vector<double> value = {}) {
        return builder.block({.slot = slot,
                              .represents = joint,
                              .quantity = "signal",
                              .role = value.empty() ? Role::kInternal : Role::kConstant,
                              .unit = unit,
                              .value = value});
      };
      of_joint("position", "joint-position", Role::kInput);
      const auto velocity = of_joint("velocity", "joint-velocity", Role::kInput);
      const auto force = of_joint("force", "joint-force", Role::kInternal);
      const auto speed = signal("speed", "RAD-PER-SEC"), push = signal("push", "N-M");
      builder.closure("signal-of-joint-velocity", {velocity, speed}, {});
      builder.closure("damping",
                      {speed, signal("v-max", "RAD-PER-SEC", {kMaximumVelocity}),
                       signal("f-max", "N-M", {kMaximumForce}), push},
                      {});
      builder.closure("joint-force-of-signal", {push, force}, {});
      builder.output(force);
    }
    builder.finish();
    transaction.commit();
    algorithm::attach_robot(result->store, result->algorithm, {kRobot, {0.0}});
    return result;
  }

  static void weave_logger(Model& model) {
    algorithm::weave(model.store, model.algorithm,
                     "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
                     "PREFIX so: <https://w3id.org/sinew/operators#>\n"
                     "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>\n"
                     "PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>\n" +
                         text_of(SINEW_SOURCE_DIR "/weaves/log-damping.rq"),
                     "log-damping.rq");
  }
};

TEST_F(DampingLog, RecordsWhatEveryControllerMeasuresAndCommands) {
  const auto m = damped();
  weave_logger(*m);
  const std::string path = testing::TempDir() + "sinew-damping-log.csv";
  bindings_.recorder = std::make_shared<Recorder>(RecorderOptions{{path}, 1024});
  HostOptions options;
  options.real_time = false;
  Host host(options);
  host.bindings() = bindings_;
  host.add_task({"main", 1}, executable(*m));
  host.configure();
  bindings_.recorder->start();
  for (const double velocity : {0.0, kMaximumVelocity, 2 * kMaximumVelocity}) {
    robot_->velocity = velocity;
    host.step();
  }
  bindings_.recorder->stop();
  std::istringstream lines(text_of(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "tick,time,speed.joint1,push.joint1,position.joint2,speed.joint2,push.joint2");
  std::vector<std::string> rows;
  while (std::getline(lines, line)) rows.push_back(line.substr(line.find(',', 2)));
  EXPECT_EQ(rows, (std::vector<std::string>{",0,10,0.5,0,10", ",0.1,0,0.5,0.1,0",
                                            ",0.2,-10,0.5,0.2,-10"}));
  std::filesystem::remove(path);
}

TEST_F(DampingLog, LeavesTheClosuresOfTheProgramAsTheyWere) {
  const auto plain = damped(), logged = damped();
  weave_logger(*logged);
  const program::Program before = program::lower(plain->store.view(), plain->algorithm, "x");
  program::Program after = program::lower(logged->store.view(), logged->algorithm, "x");
  EXPECT_NE(program::to_json(before), program::to_json(after)) << "what is logged is an output";
  for (program::Variable& variable : after.variables)
    if (variable.quantity == "signal") variable.output = false;
  EXPECT_EQ(program::to_json(before), program::to_json(after));
}

}  // namespace
}  // namespace sinew::runtime::test
