#include "hold.h"

#include <array>

#include "sinew/algorithm/builder.h"

namespace sinew::examples {
namespace {

using algorithm::Role;
using graph::Id;

class Writer {
 public:
  Writer(graph::Store& store, graph::Transaction& transaction, Id algorithm)
      : terms_(store.terms()), builder_(store, transaction, algorithm) {}

  void joint(const model::Tree& tree, const model::Tree::Joint& joint, const HoldGains& gains) {
    of_ = tree.bodies[joint.successor].iri;
    wrt_ = tree.bodies[joint.predecessor].iri;
    seen_ = tree.bodies[joint.successor].frame;
    joint_ = joint.iri;
    const auto position = quantity("position", "joint-position", Role::kInput);
    const auto velocity = quantity("velocity", "joint-velocity", Role::kInput);
    const auto reference = quantity("reference", "joint-position", Role::kInput);
    const auto acceleration = quantity("acceleration", "joint-acceleration", Role::kInternal);
    const auto at = signal("position-signal", "RAD"), wanted = signal("reference-signal", "RAD"),
               speed = signal("velocity-signal", "RAD-PER-SEC"), error = signal("error", "RAD"),
               control = signal("control", "RAD-PER-SEC2");
    add("signal-of-joint-position", {position, at});
    add("signal-of-joint-position", {reference, wanted});
    add("signal-of-joint-velocity", {velocity, speed});
    add("error-of-equality", {at, wanted, error});
    add("spring-damper", {error, speed, gain("stiffness", "PER-SEC2", gains.stiffness),
                          gain("damping", "PER-SEC", gains.damping), control});
    add("joint-acceleration-of-signal", {control, acceleration});
    builder_.output(acceleration);
  }
  void finish() { builder_.finish(); }

 private:
  std::uint32_t quantity(std::string_view slot, std::string_view kind, Role role) {
    return builder_.block({.slot = slot,
                           .represents = joint_,
                           .quantity = kind,
                           .of = of_,
                           .wrt = wrt_,
                           .seen_by = seen_,
                           .role = role});
  }
  std::uint32_t signal(std::string_view slot, std::string_view unit) {
    return builder_.block({.slot = slot, .represents = joint_, .quantity = "signal", .unit = unit});
  }
  std::uint32_t gain(std::string_view slot, std::string_view unit, double value) {
    const std::array<double, 1> values = {value};
    return builder_.block({.slot = slot,
                           .represents = joint_,
                           .quantity = "signal",
                           .role = Role::kConstant,
                           .unit = unit,
                           .value = values});
  }
  void add(std::string_view operation, std::initializer_list<std::uint32_t> arguments) {
    builder_.closure(operation, arguments, {{}, joint_});
  }

  graph::Terms& terms_;
  algorithm::Builder builder_;
  Id of_, wrt_, seen_, joint_;
};

}  // namespace

Id write_hold(graph::Store& store, const model::Tree& tree, const HoldGains& gains) {
  const Id algorithm = store.terms().iri("https://w3id.org/sinew/examples/gen3-adaptation/hold");
  graph::Transaction transaction = store.begin();
  Writer writer(store, transaction, algorithm);
  for (const model::Tree::Joint& joint : tree.joints) writer.joint(tree, joint, gains);
  writer.finish();
  transaction.commit();
  return algorithm;
}

}  // namespace sinew::examples
