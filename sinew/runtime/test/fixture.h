// A small algorithm, a robot that only remembers, and a host around them.
//
// force = given - kept; kept' = force - given: `kept` starts at `first` and changes its sign in
// every cycle. The pose of the link comes from the measured position.
#pragma once

#include <gtest/gtest.h>

#include <atomic>

#include "sinew/algorithm/attach.h"
#include "sinew/algorithm/builder.h"
#include "sinew/algorithm/weave.h"
#include "sinew/base/error.h"
#include "sinew/runtime/host.h"

namespace sinew::runtime::test {

inline constexpr const char* kRobot = "https://example.org/robot";

// One joint: measures what it is told, remembers the last command.
class Memory final : public RobotInterface {
 public:
  Channel measurement(const program::Variable& block) const override {
    if (block.quantity == "joint-position") return 0;
    if (block.quantity == "joint-velocity") return 1;
    throw Error(Problem{{}, block.iri, "does not measure " + block.name, "", {}, {}});
  }
  Channel command(const program::Variable&) const override { return 0; }
  Nanoseconds read(std::span<const Transfer> measurements) noexcept override {
    for (const Transfer& transfer : measurements)
      transfer.numbers[0] = transfer.channel == 0 ? position.load() : velocity.load();
    return stalled.load() ? taken.load() : now();
  }
  void write(std::span<const Transfer> commands) noexcept override {
    for (const Transfer& transfer : commands) command_ = transfer.numbers[0];
    ++writes;
  }

  std::atomic<double> position = 0.5, velocity = 0, command_ = 0;
  std::atomic<std::uint64_t> writes = 0;
  std::atomic<bool> stalled = false;
  std::atomic<Nanoseconds> taken = 0;  // when it stalled
};

class RuntimeTest : public testing::Test {
 protected:
  // An algorithm of that name with its own store.
  struct Model {
    graph::Store store;
    graph::Id algorithm;
  };
  // `other_prototype`: of a prismatic joint, so that forces are in newtons.
  static std::unique_ptr<Model> model(double first = 2.0, bool other_prototype = false) {
    using algorithm::Role;
    auto result = std::make_unique<Model>();
    graph::Terms& terms = result->store.terms();
    const auto iri = [&](const std::string& name) {
      return terms.iri("https://example.org/" + name);
    };
    result->algorithm = iri("algorithm");
    graph::Transaction transaction = result->store.begin();
    algorithm::Builder builder(result->store, transaction, result->algorithm);
    const auto joint_block = [&](std::string_view slot, std::string_view quantity, Role role,
                                 std::vector<double> value = {}) {
      return builder.block({.slot = slot,
                            .represents = iri("joint1"),
                            .quantity = quantity,
                            .of = iri("link1"),
                            .wrt = iri("base"),
                            .seen_by = iri("link1"),
                            .role = role,
                            .prismatic = other_prototype,
                            .value = value});
    };
    const auto given = joint_block("given", "joint-force", Role::kInput);
    const auto kept = joint_block("kept", "joint-force", Role::kState, {first});
    const auto force = joint_block("total", "joint-force", Role::kInternal);
    builder.closure("subtract-joint-force", {given, kept, force}, {});
    builder.closure("subtract-joint-force", {force, given, kept}, {});
    builder.output(force, "force.joint1");
    const auto position = builder.block({.slot = "position",
                                         .represents = iri("joint1"),
                                         .quantity = "joint-position",
                                         .of = iri("link1"),
                                         .wrt = iri("base"),
                                         .seen_by = iri("link1"),
                                         .role = Role::kInput});
    const auto pose = builder.block({.slot = "pose",
                                     .represents = iri("link1"),
                                     .quantity = "pose",
                                     .of = iri("link1"),
                                     .wrt = iri("base")});
    builder.closure("position-to-pose-revolute", {position, pose}, {});
    builder.output(pose);
    builder.finish();
    transaction.commit();
    algorithm::attach_robot(result->store, result->algorithm, {kRobot, {-7.0}});
    return result;
  }

  // Puts a closure before the last one of the schedule, which is `write`.
  static void weave(Model& model, const std::string& name, const std::string& says) {
    algorithm::weave(
        model.store, model.algorithm,
        "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
        "PREFIX so: <https://w3id.org/sinew/operators#>\n"
        "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#>\n"
        "PREFIX algo: <https://comp-rob2b.github.io/metamodels/algorithm#>\n"
        "PREFIX ex: <https://example.org/>\n"
        "DELETE { ?before rdf:rest ?last } INSERT { ?before rdf:rest [ rdf:first ex:" +
            name + " ; rdf:rest ?last ] . ?algorithm sa:closure ex:" + name + " . ex:" + name +
            " " + says +
            " } WHERE { ?algorithm a sa:Algorithm ; "
            "sa:schedule/algo:trigger-chain/rdf:rest* ?before . ?before rdf:rest ?last . "
            "?last rdf:first ?write . ?write a so:write . ?force sa:name \"force.joint1\" . "
            "?kept sa:name \"kept.joint1\" . ?pose sa:name \"pose.link1\" }",
        name);
  }

  static program::HostPlan plan(const Model& model) {
    return program::plan_for_host(model.store.view(), model.algorithm, "test");
  }
  std::unique_ptr<Executable> executable(const Model& model, bool interpret = true) {
    return Executable::prepare(plan(model), bindings_, {.interpret = interpret});
  }

  // A host that runs that model as its task "main", with 3 N m given; configured.
  std::unique_ptr<Host> host(const Model& model, HostOptions options = {}) {
    options.real_time = false;
    auto result = std::make_unique<Host>(options);
    result->bindings() = bindings_;
    result->add_task({"main", 1}, executable(model));
    result->set("main", "given.joint1", std::array{3.0});
    result->configure();
    return result;
  }

  std::shared_ptr<Memory> robot_ = std::make_shared<Memory>();
  Bindings bindings_{{{kRobot, robot_}}, {}};
};

}  // namespace sinew::runtime::test
