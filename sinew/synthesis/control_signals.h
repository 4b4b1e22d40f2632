// From a task's numbers, flags and wrenches to data blocks: each is made when it is first asked
// for, with all that it depends on before it. States are read as they were left by the last cycle
// and written at the end of this one.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/control.h"

namespace sinew::synthesis {

class ControlSignals {
 public:
  ControlSignals(Context& context, const Control& control);

  // The block of a number, of a wrench at its frame; Error where one depends on itself.
  BlockIndex number(Id quantity);
  BlockIndex wrench(Id coordinates);

  // Everything that the task has: controllers, monitors, evaluators. Then writes the states.
  void make_all();

 private:
  // What tells what the task did: flags, events and control signals.
  void hand_out();

  // control_signals.cpp
  BlockIndex make_number(const task::Quantity& quantity);
  BlockIndex view(const task::View& view);
  BlockIndex joint_view(const task::JointView& view);
  BlockIndex evaluator(const task::Evaluator& evaluator);
  BlockIndex commanded_wrench(Id coordinates);
  BlockIndex pose(Id coordinates);
  BlockIndex measured_pose(const task::Spatial& spatial, const SpatialPlace& place);

  // control_laws.cpp
  BlockIndex controller(const task::Controller& controller);
  BlockIndex pid(const task::Controller& controller, std::string_view slot);
  BlockIndex impedance(const task::Controller& controller, std::string_view slot);
  BlockIndex desired_twist(const task::Controller& controller, Id frame, Id wrt);
  void pose_impedance(const task::Controller& controller);
  // Through the handler's gate and rate: the last block is the control signal.
  BlockIndex hand_on(const task::Controller& controller, BlockIndex computed);
  std::string_view computed_slot(const task::Controller& controller, std::string_view last) const;

  // control_guards.cpp
  struct Watch {
    BlockIndex flag, event;  // event: kNoIndex where there is none
  };
  Watch watch(const task::Monitor& monitor);
  BlockIndex flag_of(const std::vector<Id>& constraints, bool all, Id handler,
                     std::string_view slot);
  BlockIndex active(const task::Handler& handler);  // only where it has a motion
  BlockIndex tick(const task::Handler& handler);    // only where it is slower than the fastest
  bool is_slow(const task::Handler* handler) const;

  // Parts of the algorithm.
  BlockIndex signal(std::string_view slot, Id element, std::string_view unit);
  BlockIndex constant(std::string_view slot, Id element, std::string_view unit, double value);
  BlockIndex state(std::string_view slot, Id element, std::string_view unit, double first);
  BlockIndex flag(std::string_view slot, Id element);
  BlockIndex constant_flag(bool set);
  BlockIndex flag_state(std::string_view slot, Id element);
  // What a state is to become: the candidate; `first` again while the handler's motion is not
  // active; itself between two ticks of a slow handler.
  void keep(const task::Handler* handler, BlockIndex state, BlockIndex candidate, BlockIndex first);
  void close(std::string_view operation, std::initializer_list<BlockIndex> arguments, Id about) {
    context_.closure(operation, arguments, about);
  }
  const std::string& unit_of(Id number) const { return task_.quantities.at(number).unit; }
  BlockIndex zero_like(Id number);

  using Origin = std::variant<const task::View*, const task::JointView*, const task::Evaluator*,
                              const task::Controller*>;

  Context& context_;
  const Control& control_;
  const task::Task& task_;
  std::unordered_map<Id, Origin> origins_;
  std::unordered_map<Id, BlockIndex> numbers_, wrenches_, active_, ticks_;
  std::unordered_map<Id, Watch> watches_;
  std::unordered_set<Id> open_;
  struct Kept {
    std::string operation;
    BlockIndex value, state;
    Id about;
  };
  std::vector<Kept> kept_;
};

}  // namespace sinew::synthesis
