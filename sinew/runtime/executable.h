// A host plan made ready to run: storage for its blocks, code for its pure parts, its external
// closures bound to robots, recorder and checks. Everything that can fail or allocates is done when
// it is made, by any thread; `run` is real-time safe.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/program/host_plan.h"
#include "sinew/runtime/cycle.h"
#include "sinew/runtime/recorder.h"
#include "sinew/runtime/robot_interface.h"
#include "sinew/runtime/storage.h"

namespace sinew::runtime {

// What one external closure does in a cycle.
using Action = std::function<Verdict(const Cycle&)>;

// What external closures are bound to.
struct Bindings {
  std::map<std::string, std::shared_ptr<RobotInterface>> robots;  // by IRI (sa:interface)
  std::shared_ptr<Recorder> recorder;                             // of `log` and `probe-time`
};

struct PrepareOptions {
  bool interpret = false;  // closure by closure, instead of machine code
  bool fast = true;        // machine code in milliseconds, rather than the fastest
};

class Executable {
 public:
  // Throws Error: an interface that is not bound, a channel that the robot does not have, a check
  // without limits, a log without a recorder, code that cannot be made.
  static std::unique_ptr<Executable> prepare(program::HostPlan plan, const Bindings& bindings,
                                             const PrepareOptions& options = {});
  ~Executable();

  const std::string& name() const;
  Storage& storage();
  const Storage& storage() const;

  // Inputs that no `read` fills: the caller's to set.
  const std::vector<std::uint32_t>& set_points() const;
  // Blocks with the role `state`.
  const std::vector<std::uint32_t>& states() const;
  // What the models of its states declare for a swap to this program.
  const std::vector<program::SwapRule>& swap_rules() const;
  // Blocks that are 1 in the cycle in which a monitor's event happens ("event.NAME").
  const std::vector<std::uint32_t>& events() const;
  // The robots that it commands.
  const std::vector<const RobotInterface*>& commanded() const;
  // How often it must run, where its controllers integrate over time [s]; nothing: does not matter.
  std::optional<double> period_s() const;

  // One cycle: the plan's steps in order. After a fault the remaining steps do not run.
  Verdict run(const Cycle& cycle) noexcept;
  // Hands every `write` its declared safe command instead.
  void write_safe() noexcept;
  // Every state to its first value.
  void reset_states() noexcept;

  struct Parts;

 private:
  explicit Executable(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace sinew::runtime
