#include "sinew/backend/jit/block_emitter.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sinew/backend/jit/block_memory.h"
#include "sinew/backend/jit/block_sines.h"
#include "sinew/backend/jit/block_steps.h"
#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/constant_rows.h"
#include "sinew/backend/jit/row_addresses.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

// Pointers to rows of inputs and of results.
constexpr std::size_t kInputPointers = 2;
constexpr std::size_t kResultPointers = 3;
// See is_short: operations besides sines, and values.
constexpr std::size_t kShort = 400;
constexpr std::uint32_t kFewWaiting = 32;

}  // namespace

class PlannedBlock::Emitter {
 public:
  Emitter(const Computation& computation, const Place& place, LLVMTypeRef type,
          std::uint32_t registers)
      : computation_(computation),
        place_(place),
        type_(type),
        results_of_(computation.dag.size()),
        emitter_(computation, place, type, [this](std::uint32_t node) { return fetched(node); }) {
    find_angles();
    sort_results();
    steps_ = plan_block({computation, emitter_, sines_held(), results_of_, later_}, registers);
  }

  bool is_short() const { return steps_.nodes.size() < kShort && steps_.waiting < kFewWaiting; }

  void emit() {
    BlockParameters parameters = {LLVMGetParam(place_.function, 0),
                                  LLVMGetParam(place_.function, 1), row_bytes()};
    BlockMemory memory(place_, type_, angle_rows_.size(), steps_.plan.size);
    memory_ = &memory;
    if (!angle_rows_.empty()) {
      sines_ = emit_block_sines(place_, type_, angle_rows_, memory.sines(), parameters);
    }
    const RowDistances distances(place_.builder, parameters.row_bytes);
    store_constant_rows(place_, type_, parameters.out, distances, constants_);
    memory.begin();
    RowAddresses inputs(place_.builder, distances, parameters.in, steps_.input_rows,
                        kInputPointers);
    RowAddresses results(place_.builder, distances, parameters.out, steps_.result_rows,
                         kResultPointers);
    inputs_ = &inputs;
    results_ = &results;
    for (const std::uint32_t node : steps_.begin) hold(node, held_sine(node));
    leave(0);
    for (std::size_t step = 0; step < steps_.nodes.size(); ++step) {
      const std::uint32_t node = steps_.nodes[step];
      hold(node, emitter_.compute(node));
      for (const std::uint32_t i : results_of_[node]) write(i);
      leave(step + 1);
    }
    for (const std::uint32_t i : later_) write(i);
    LLVMBuildRetVoid(place_.builder);
    memory.end();
  }

 private:
  const Node& node_of(std::uint32_t node) const { return computation_.dag.node(node); }

  LLVMValueRef row_bytes() const {
    const LLVMValueRef stride = LLVMGetParam(place_.function, 2);
    const unsigned bytes = bytes_of(LLVMGetElementType(type_));
    return LLVMBuildMul(place_.builder, stride, LLVMConstInt(LLVMTypeOf(stride), bytes, false), "");
  }

  // Angles that are inputs, in the order of their rows.
  void find_angles() {
    const std::vector<std::uint32_t> nodes = emitter_.angles_that_are_inputs();
    for (const std::uint32_t node : nodes) {
      emitter_.fetch_sine(node);
      angle_rows_.push_back(node_of(node).index);
    }
    std::sort(angle_rows_.begin(), angle_rows_.end());
    for (const std::uint32_t node : nodes) {
      const auto at = std::find(angle_rows_.begin(), angle_rows_.end(), node_of(node).index);
      angles_[node] = static_cast<std::size_t>(at - angle_rows_.begin());
    }
  }

  // Results are written when they are computed; what is no operation, at the end.
  void sort_results() {
    for (std::uint32_t i = 0; i < computation_.results.size(); ++i) {
      const Ref result = computation_.results[i];
      const bool is_constant = computation_.dag.is_constant(result);
      constants_.push_back(is_constant ? std::optional(computation_.dag.constant_value(result))
                                       : std::nullopt);
      if (is_constant) continue;
      (emitter_.is_statement(result.node()) ? results_of_[result.node()] : later_).push_back(i);
    }
  }

  // The angle of a sine or cosine that is computed before all else; null: it is another node.
  const std::size_t* angle_of(std::uint32_t node) const {
    const Op op = node_of(node).op;
    if (op != Op::kSin && op != Op::kCos) return nullptr;
    const auto angle = angles_.find(node_of(node).a.node());
    return angle == angles_.end() ? nullptr : &angle->second;
  }
  std::vector<std::uint32_t> sines_held() const {
    std::vector<std::uint32_t> nodes;
    if (!sines_are_in_registers(angle_rows_)) return nodes;
    const std::vector<std::uint8_t> live = program::live_nodes(computation_);
    for (std::uint32_t node = 0; node < computation_.dag.size(); ++node) {
      if (live[node] && angle_of(node) != nullptr) nodes.push_back(node);
    }
    return nodes;
  }
  LLVMValueRef held_sine(std::uint32_t node) const {
    const std::size_t angle = *angle_of(node);
    return node_of(node).op == Op::kCos ? sines_.cosine[angle]
                                        : signed_sine(node, sines_.sine[angle]);
  }
  LLVMValueRef signed_sine(std::uint32_t node, LLVMValueRef sine) const {
    return node_of(node).a.negative() ? LLVMBuildFNeg(place_.builder, sine, "") : sine;
  }

  void hold(std::uint32_t node, LLVMValueRef value) {
    emitter_.hold(node, value);
    const std::uint32_t slot = steps_.plan.slot[node];
    if (slot != kNoSlot) memory_->keep(value, slot);
  }
  void leave(std::size_t step) {
    for (const std::uint32_t node : steps_.plan.leaving[step]) emitter_.forget(node);
  }

  void write(std::uint32_t result) {
    const LLVMValueRef value = emitter_.signed_value(computation_.results[result]);
    LLVMSetAlignment(LLVMBuildStore(place_.builder, value, results_->of(result)),
                     bytes_of(LLVMGetElementType(type_)));
  }

  // What a node is in memory; null: nothing.
  LLVMValueRef fetched(std::uint32_t node) {
    const Node& of = node_of(node);
    if (of.op == Op::kConstant) return memory_->constant(of.value);
    if (of.op == Op::kInput) return input(of.index);
    const std::uint32_t slot = steps_.plan.slot[node];
    if (slot != kNoSlot) return memory_->waiting(slot);
    const std::size_t* const angle = angle_of(node);
    if (angle == nullptr) return nullptr;
    return of.op == Op::kCos ? memory_->cosine(*angle) : signed_sine(node, memory_->sine(*angle));
  }
  LLVMValueRef input(std::uint32_t row) {
    const LLVMValueRef value = LLVMBuildLoad2(place_.builder, type_, inputs_->of(row), "");
    LLVMSetAlignment(value, bytes_of(LLVMGetElementType(type_)));
    LLVMSetVolatile(value, true);
    return value;
  }

  const Computation& computation_;
  Place place_;
  LLVMTypeRef type_;
  std::vector<std::uint32_t> angle_rows_;
  std::map<std::uint32_t, std::size_t> angles_;  // of a node that is an angle: its place there
  std::vector<std::vector<std::uint32_t>> results_of_;
  std::vector<std::uint32_t> later_;
  std::vector<std::optional<double>> constants_;  // results
  ComputationEmitter emitter_;
  BlockSteps steps_;
  SincosValues sines_;  // in registers, if they are
  BlockMemory* memory_ = nullptr;
  RowAddresses* inputs_ = nullptr;
  RowAddresses* results_ = nullptr;
};

PlannedBlock::PlannedBlock(const Computation& computation, const Place& place, LLVMTypeRef type,
                           std::uint32_t registers)
    : emitter_(std::make_unique<Emitter>(computation, place, type, registers)) {}
PlannedBlock::~PlannedBlock() = default;

bool PlannedBlock::is_short() const { return emitter_->is_short(); }
void PlannedBlock::emit() { emitter_->emit(); }

}  // namespace sinew::backend
