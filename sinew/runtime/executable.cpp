#include "sinew/runtime/executable.h"

#include <algorithm>
#include <optional>

#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/base/error.h"
#include "sinew/program/scalar_program.h"
#include "sinew/program/validate.h"
#include "sinew/runtime/externals.h"

namespace sinew::runtime {
namespace {

// Values are named QUANTITY.ELEMENT; the slot of a monitor's event is `event`.
constexpr std::string_view kEventPrefix = "event.";

struct Copy {
  double* numbers;  // in the storage
  std::uint32_t offset, size;
};

// A pure part: its code, and the way of its inputs and outputs from and to the storage.
struct Pure {
  std::vector<double> in, out;
  std::vector<Copy> inputs, outputs;
  std::optional<backend::JitFunction> code;
  std::optional<backend::Interpreter> interpreter;

  void run() noexcept {
    for (const Copy& copy : inputs) std::copy_n(copy.numbers, copy.size, in.begin() + copy.offset);
    if (code) {
      (*code)(in.data(), out.data());
    } else {
      interpreter->evaluate(in.data(), out.data());
    }
    for (const Copy& copy : outputs)
      std::copy_n(out.begin() + copy.offset, copy.size, copy.numbers);
  }
};

std::vector<Copy> copies(const std::vector<program::Slot>& slots,
                         const std::vector<std::uint32_t>& blocks, Storage& storage) {
  std::vector<Copy> result;
  for (std::size_t i = 0; i < slots.size(); ++i)
    result.push_back(
        {storage.numbers(blocks[i]).data(), slots[i].offset, storage.about(blocks[i]).size});
  return result;
}

Pure pure_of(const program::Segment& segment, Storage& storage, const PrepareOptions& options) {
  Pure pure;
  const program::Interface interface = program::interface_of(segment.program);
  pure.in.resize(interface.in_size);
  pure.out.resize(interface.out_size);
  pure.inputs = copies(interface.inputs, segment.inputs, storage);
  pure.outputs = copies(interface.outputs, segment.outputs, storage);
  program::require_valid(segment.program);
  if (options.interpret || !backend::jit_available()) {
    pure.interpreter.emplace(segment.program);
    return pure;
  }
  pure.code = backend::jit_compile(
      program::scalar_program(segment.program),
      {options.fast ? backend::JitLevel::kFast : backend::JitLevel::kFull, "", false});
  return pure;
}

}  // namespace

struct Executable::Parts {
  explicit Parts(program::HostPlan from) : plan(std::move(from)), storage(plan.blocks) {}

  program::HostPlan plan;
  Storage storage;
  std::vector<Pure> pure;
  std::vector<BoundExternal> externals;
  std::vector<std::uint32_t> set_points, states, events;
  std::vector<const RobotInterface*> commanded;
};

Executable::Executable(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Executable::~Executable() = default;

std::unique_ptr<Executable> Executable::prepare(program::HostPlan plan, const Bindings& bindings,
                                                const PrepareOptions& options) {
  auto parts = std::make_unique<Parts>(std::move(plan));
  std::vector<bool> read(parts->plan.blocks.size(), false);
  for (const program::External& external : parts->plan.externals) {
    parts->externals.push_back(bind_external(external, parts->storage, bindings));
    if (const RobotInterface* robot = parts->externals.back().commands)
      parts->commanded.push_back(robot);
    if (external.operation != "read") continue;
    for (const std::uint32_t block : external.blocks) read[block] = true;
  }
  for (const program::Segment& segment : parts->plan.segments)
    parts->pure.push_back(pure_of(segment, parts->storage, options));
  for (std::uint32_t i = 0; i < parts->plan.blocks.size(); ++i) {
    const program::Role role = parts->plan.blocks[i].role;
    if (role == program::Role::kInput && !read[i]) parts->set_points.push_back(i);
    if (role == program::Role::kState) parts->states.push_back(i);
    const program::Variable& block = parts->plan.blocks[i];
    if (block.quantity == "flag" && block.output && block.name.starts_with(kEventPrefix))
      parts->events.push_back(i);
  }
  return std::unique_ptr<Executable>(new Executable(std::move(parts)));
}

const std::string& Executable::name() const { return parts_->plan.name; }
Storage& Executable::storage() { return parts_->storage; }
const Storage& Executable::storage() const { return parts_->storage; }
const std::vector<std::uint32_t>& Executable::set_points() const { return parts_->set_points; }
const std::vector<std::uint32_t>& Executable::states() const { return parts_->states; }
const std::vector<std::uint32_t>& Executable::events() const { return parts_->events; }
const std::vector<const RobotInterface*>& Executable::commanded() const {
  return parts_->commanded;
}
const std::vector<program::SwapRule>& Executable::swap_rules() const {
  return parts_->plan.swap_rules;
}
std::optional<double> Executable::period_s() const { return parts_->plan.period_s; }

Verdict Executable::run(const Cycle& cycle) noexcept {
  for (const program::HostStep& step : parts_->plan.steps) {
    if (!step.external) {
      parts_->pure[step.index].run();
    } else if (parts_->externals[step.index].action(cycle) == Verdict::kFault) {
      return Verdict::kFault;
    }
  }
  return Verdict::kContinue;
}

void Executable::write_safe() noexcept {
  for (const BoundExternal& external : parts_->externals)
    if (external.safe) external.safe({});
}

void Executable::reset_states() noexcept {
  for (const std::uint32_t block : parts_->states) {
    const std::vector<double>& first = parts_->storage.about(block).value;
    std::copy(first.begin(), first.end(), parts_->storage.numbers(block).begin());
  }
}

}  // namespace sinew::runtime
