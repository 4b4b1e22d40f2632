// Stages of a long flat function of one sample. What waits in memory is read in each stage that
// needs it, and by nothing that a compiler could carry in a register from one stage to the next.
//
// In memory lie inputs, sines and cosines, the values that keep_values() chooses, and constants
// (c_constant_table.h).
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/backend/c_flat_emitter.h"
#include "sinew/backend/c_kept_array.h"

namespace sinew::backend {

using program::Node;
using program::Op;

namespace {

constexpr std::size_t kConstantsOfNode = 4;  // at most

}  // namespace

void FlatEmitter::declare_kept() {
  if (plan_.kept.any())
    declare_kept_array(plan_.kept.size, upper_, scalar_, given_, pointers_, *block_);
  given_.take("number");
  if (layout_.in_size > kNearNumbers) {
    given_.take("inputs");
    touch("in");
    middle_of_inputs_ = kNearNumbers;
    line(fmt::format("const {} *inputs = in + {};", scalar_, middle_of_inputs_));
    point_to("inputs");
  }
  table_.declare_pointer(*block_);
}

void FlatEmitter::point_to(const std::string& pointer) { point_again(pointer, upper_, *block_); }

void FlatEmitter::begin_step() {
  if (!stages_) return;
  if (step_ > 0 && step_ % kStage == 0) {
    block_->add("");
    for (const std::string& pointer : pointers_) point_to(pointer);
    for (const std::uint32_t node : named_) names_[node].clear();
    named_.clear();
  }
  table_.make_room(kConstantsOfNode, *block_);
}

void FlatEmitter::end_step() {
  if (!stages_) return;
  for (const std::uint32_t node : plan_.kept.leaving(step_)) names_[node].clear();
  ++step_;
}

const std::string& FlatEmitter::constant(std::uint32_t i, double value) {
  auto& [text, place] = in_memory(i);
  if (text.empty()) text = number(value);
  if (!stages_ || value == 2.0) return text;  // a sum
  place = "NUMBER(";
  place += Digits(table_.place({&text, 1}));
  ((place += ", ") += text) += ')';
  return place;
}

// Inputs are memory operands wherever they are used; states, which are written too, are not.
const std::string& FlatEmitter::input_again(std::uint32_t i, const Node& node) {
  std::string& place = in_memory(i).place;
  if (place.empty()) place = element(layout_.inputs[node.index]);
  return place;
}

// Writes a value that has just been computed where it will be read.
void FlatEmitter::wait_in_memory(std::uint32_t node) {
  if (!stages_ || plan_.kept.slot[node] == kNoSlot) return;
  const auto [pointer, offset] = kept_place(plan_.kept.slot[node]);
  const Digits digits(offset);
  block_->add({"  KEPT(", pointer, ", ", digits, ") = ", names_[node], ";"});
  auto& [name, place] = in_memory(node);
  name = names_[node];
  place = pointer;
  ((place += '[') += digits) += ']';
}

void FlatEmitter::read_again(std::uint32_t node) {
  const InMemory& from = in_memory(node);
  names_[node] = given_.unique(from.name);
  declare(scalar_, names_[node], from.place, dag_.node(node).origin);
  named_.push_back(node);
}

// A product that waits in memory is rounded before it is added to anything; so it is in a block,
// whose values do not wait: a sample has the same bits in either.
bool FlatEmitter::rounds_product(std::uint32_t node) const {
  return block_form_ && plan_.kept.any() && plan_.kept.slot[node] != kNoSlot &&
         dag_.node(node).op == Op::kMultiply;
}

void FlatEmitter::declare_constants() {
  result_.part_names.push_back(table_.part());
  table_.declare_table(1, result_.parts);
}

}  // namespace sinew::backend
