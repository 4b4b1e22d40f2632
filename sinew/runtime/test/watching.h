// Small algorithms whose monitors raise events.
#pragma once

#include "fixture.h"

namespace sinew::runtime::test {

class WatchingTest : public RuntimeTest {
 protected:
  // force = given; an event each time that `watched` comes within 0.5 of zero. `count`: so many
  // monitors watch the same, each with an event of its own (event.NAME, event.NAME2, ...).
  static std::unique_ptr<Model> watching(const std::string& name, double safe = -7.0,
                                         int count = 1) {
    using algorithm::Role;
    auto result = std::make_unique<Model>();
    graph::Terms& terms = result->store.terms();
    const auto iri = [&](const std::string& of) { return terms.iri("https://example.org/" + of); };
    result->algorithm = iri("algorithm-" + name);
    graph::Transaction transaction = result->store.begin();
    algorithm::Builder builder(result->store, transaction, result->algorithm);
    const auto signal = [&](std::string_view slot, Role role, std::vector<double> value = {}) {
      return builder.block({.slot = slot,
                            .represents = iri(name),
                            .quantity = "signal",
                            .role = role,
                            .unit = "M",
                            .value = value});
    };
    const auto flag = [&](std::string_view slot, graph::Id of, Role role) {
      return builder.block(
          {.slot = slot,
           .represents = of,
           .quantity = "flag",
           .role = role,
           .value = role == Role::kState ? std::vector{0.0} : std::vector<double>{}});
    };
    const auto force = [&](std::string_view slot, Role role, std::vector<double> value = {}) {
      return builder.block({.slot = slot,
                            .represents = iri("joint1"),
                            .quantity = "joint-force",
                            .of = iri("link1"),
                            .wrt = iri("base"),
                            .seen_by = iri("link1"),
                            .role = role,
                            .value = value});
    };
    const auto watched = signal("watched", Role::kInput);
    const auto tolerance = signal("tolerance", Role::kConstant, {0.5});
    for (int i = 1; i <= count; ++i) {
      const graph::Id event = iri(i == 1 ? name : name + std::to_string(i));
      const auto level = flag("level", event, Role::kInternal);
      const auto before = flag("before", event, Role::kState);
      const auto raised = flag("event", event, Role::kInternal);
      builder.closure("level", {watched, tolerance, level}, {});
      builder.closure("rising-edge", {level, before, raised}, {});
      builder.closure("keep-flag", {level, before}, {});
      builder.output(raised);
    }
    // So that a task that starts anew can be told from one that goes on: it counts its cycles.
    const auto kept = force("kept", Role::kState, {0}), one = force("one", Role::kConstant, {1.0});
    const auto counted = force("counted", Role::kInternal), sum = force("total", Role::kInternal);
    builder.closure("add-joint-force", {kept, one, counted}, {});
    builder.closure("add-joint-force", {counted, force("given", Role::kInput), sum}, {});
    builder.closure("subtract-joint-force", {counted, force("nothing", Role::kConstant, {0}), kept},
                    {});
    builder.output(sum, "force.joint1");
    builder.finish();
    transaction.commit();
    algorithm::attach_robot(result->store, result->algorithm, {kRobot, {safe}});
    return result;
  }
};

}  // namespace sinew::runtime::test
