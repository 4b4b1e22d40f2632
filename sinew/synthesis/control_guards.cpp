// Monitors, guarded motions, rates, and what is kept from one cycle to the next.
#include "sinew/synthesis/control_signals.h"

namespace sinew::synthesis {

using algorithm::kNoIndex;
using algorithm::Role;
using task::Handler;
using task::Monitor;

bool ControlSignals::is_slow(const Handler* handler) const {
  return handler != nullptr && control_.cycles.at(handler->id) > 1;
}

ControlSignals::Watch ControlSignals::watch(const Monitor& monitor) {
  if (const auto found = watches_.find(monitor.id); found != watches_.end()) return found->second;
  const Handler* handler = task_.handler_of(monitor.id);
  const bool slow = is_slow(handler);
  const bool remembers = slow || monitor.event || monitor.release_tolerance;
  const Id id = monitor.id;
  const Id named = monitor.flag ? monitor.flag : id;
  const BlockIndex error = number(monitor.error);
  const BlockIndex tolerance =
      monitor.tolerance ? number(monitor.tolerance) : zero_like(monitor.error);
  const BlockIndex before = remembers ? flag_state("flag-before", id) : kNoIndex;
  BlockIndex level = flag(slow ? "computed-flag" : "flag", named);
  if (monitor.release_tolerance)
    close("level-with-hysteresis",
          {error, tolerance, number(monitor.release_tolerance), before, level}, id);
  else
    close("level", {error, tolerance, level}, id);
  if (slow) {
    const BlockIndex out = flag("flag", named);
    close("choose-flag", {level, before, tick(*handler), out}, id);
    level = out;
  }
  Watch result{level, kNoIndex};
  if (monitor.event) {
    constexpr std::string_view kEdges[] = {"rising-edge", "falling-edge", "any-edge"};
    result.event = flag("event", monitor.event);
    close(kEdges[static_cast<std::size_t>(monitor.edge)], {level, before, result.event}, id);
  }
  if (remembers) kept_.push_back({"keep-flag", level, before, id});
  watches_[id] = result;
  return result;
}

// Whether all of some constraints hold, or any; of those that a monitor watches.
BlockIndex ControlSignals::flag_of(const std::vector<Id>& constraints, bool all, Id handler,
                                   std::string_view slot) {
  BlockIndex sum = kNoIndex;
  for (const Id constraint : constraints)
    for (const task::Evaluator& evaluator : task_.evaluators)
      for (const Monitor& monitor : task_.monitors) {
        if (evaluator.constraint != constraint || !evaluator.error ||
            evaluator.error != monitor.error)
          continue;
        const BlockIndex one = watch(monitor).flag;
        if (sum == kNoIndex) {
          sum = one;
          continue;
        }
        const BlockIndex next = flag(slot, context_.pair(handler, monitor.id));
        close(all ? "both" : "either", {sum, one, next}, handler);
        sum = next;
      }
  return sum != kNoIndex ? sum : constant_flag(all);
}

BlockIndex ControlSignals::active(const Handler& handler) {
  if (const auto found = active_.find(handler.id); found != active_.end()) return found->second;
  const task::GuardedMotion& motion = *handler.motion;
  const BlockIndex when = flag_of(motion.when, true, motion.id, "when");
  const BlockIndex holds = flag_of(motion.while_, true, motion.id, "while");
  const BlockIndex until = flag_of(motion.until, false, motion.id, "until");
  const BlockIndex before = state("phase-before", motion.id, "UNITLESS", 0);
  const bool slow = is_slow(&handler);
  BlockIndex phase = signal(slow ? "computed-phase" : "phase", motion.id, "UNITLESS");
  close("motion-phase", {before, when, holds, until, phase}, motion.id);
  if (slow) {
    const BlockIndex out = signal("phase", motion.id, "UNITLESS");
    close("choose-signal", {phase, before, tick(handler), out}, motion.id);
    phase = out;
  }
  const BlockIndex active = flag("active", motion.id);
  close("motion-is-active", {phase, active}, motion.id);
  kept_.push_back({"keep-signal", phase, before, motion.id});
  return active_[handler.id] = active;
}

BlockIndex ControlSignals::tick(const Handler& handler) {
  if (const auto found = ticks_.find(handler.id); found != ticks_.end()) return found->second;
  const Id id = handler.id;
  const BlockIndex count = state("count", id, "UNITLESS", 0);
  const BlockIndex cycles = constant("cycles", id, "UNITLESS", control_.cycles.at(id));
  const BlockIndex next = signal("count-next", id, "UNITLESS");
  const BlockIndex tick = flag("tick", id);
  close("count-is-zero", {count, tick}, id);
  close("count-up", {count, cycles, next}, id);
  kept_.push_back({"keep-signal", next, count, id});
  return ticks_[id] = tick;
}

void ControlSignals::keep(const Handler* handler, BlockIndex state, BlockIndex candidate,
                          BlockIndex first) {
  const algorithm::Block block = context_.builder.at(state);
  const bool is_flag = block.quantity->name == "flag";
  const std::string_view choose = is_flag ? "choose-flag" : "choose-signal";
  const Id about = block.represents;
  const auto next = [&](std::string_view slot) {
    const std::string name = block.slot + std::string(slot);
    return is_flag ? flag(name, about) : signal(name, about, block.unit);
  };
  if (handler && handler->motion) {
    const BlockIndex out = next("-if-active");
    close(choose, {candidate, first, active(*handler), out}, about);
    candidate = out;
  }
  if (is_slow(handler)) {
    const BlockIndex out = next("-at-tick");
    close(choose, {candidate, state, tick(*handler), out}, about);
    candidate = out;
  }
  kept_.push_back({is_flag ? "keep-flag" : "keep-signal", candidate, state, about});
}

BlockIndex ControlSignals::flag(std::string_view slot, Id element) {
  return context_.builder.block({.slot = slot, .represents = element, .quantity = "flag"});
}

BlockIndex ControlSignals::constant_flag(bool set) {
  const double value[] = {set ? 1.0 : 0.0};
  return context_.builder.block({.slot = set ? "always" : "never",
                                 .represents = context_.builder.algorithm().id,
                                 .quantity = "flag",
                                 .role = Role::kConstant,
                                 .value = value,
                                 .label = algorithm::kWholeRobot});
}

BlockIndex ControlSignals::flag_state(std::string_view slot, Id element) {
  constexpr double kReset[] = {0};
  return context_.builder.block({.slot = slot,
                                 .represents = element,
                                 .quantity = "flag",
                                 .role = Role::kState,
                                 .value = kReset});
}

}  // namespace sinew::synthesis
