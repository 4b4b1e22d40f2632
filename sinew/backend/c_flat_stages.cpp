// Stages of a long flat function of one sample. What waits in memory is read in each stage that
// needs it, and by nothing that a compiler could carry in a register from one stage to the next.
//
// In memory lie inputs, sines and cosines, the values that keep_values() chooses, and constants: a
// constant of a table whose address is in a register takes three bytes less than one that is
// addressed from the instruction.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/backend/c_flat_emitter.h"
#include "sinew/backend/c_kept_array.h"

namespace sinew::backend {

using program::Node;
using program::Op;
using program::Ref;

namespace {

// Constants that one pointer reaches, half of them to either side. A node uses four at most.
constexpr std::size_t kWindow = 2 * kNearNumbers - 4;

// Fewer nodes use too few constants to make up for the pointer to their table.
constexpr std::size_t kLeastInStages = 60;

}  // namespace

// The steps are those of run(): one for each node, one for each group of angles, and the end.
void FlatEmitter::plan_stages(const AngleGroups& groups) {
  if (options_.form == FlatForm::kThread || groups.after.size() > options_.maximum_statements) {
    return;
  }
  ValueSteps steps(dag_.size());
  const auto read_node = [&](std::uint32_t i) {
    const Op op = dag_.node(i).op;
    if (program::arity(op) > 0 && op != Op::kSin && op != Op::kCos) steps.read(i);
  };
  const auto read = [&](Ref ref) { read_node(ref.node()); };
  const auto node = [&](std::uint32_t i) {
    const Node& n = dag_.node(i);
    if (n.op == Op::kSin || n.op == Op::kCos) return;
    const int operands = program::arity(n.op);
    if (n.op == Op::kSelect) {
      read(dag_.node(n.a).a);
      read(dag_.node(n.a).b);
    } else if (operands > 0) {
      read(n.a);
    }
    if (operands > 1) read(n.b);
    if (operands > 2) read(n.c);
    steps.define(i);
    steps.end();
  };
  for (const AngleGroup& group : groups.groups) {
    for (const std::uint32_t i : group.before) node(i);
    for (const std::uint32_t angle : group.angles) read_node(angle);
    steps.end();
  }
  for (const std::uint32_t i : groups.after) node(i);
  for (const std::uint32_t k : later_) read(computation_.results[k]);
  steps.end();
  kept_ = keep_values(steps);
  stages_ = !block_form_ && (kept_.any() || groups.after.size() >= kLeastInStages);
}

void FlatEmitter::declare_kept() {
  if (kept_.any()) declare_kept_array(kept_.size, upper_, scalar_, given_, pointers_, *block_);
  given_.take("number");
  if (layout_.in_size > kNearNumbers) {
    given_.take("inputs");
    touched_.insert("in");
    middle_of_inputs_ = kNearNumbers;
    line(fmt::format("const {} *inputs = in + {};", scalar_, middle_of_inputs_));
    point_to("inputs");
  }
  line(fmt::format("const {} *number;", scalar_));
  new_constants();
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
  if (window_ >= kWindow) new_constants();
}

void FlatEmitter::end_step() {
  if (!stages_) return;
  for (const std::uint32_t node : kept_.leaving[step_]) names_[node].clear();
  ++step_;
}

void FlatEmitter::new_constants() {
  window_ = 0;
  line(fmt::format("number = {}_{}_table + {};", prefix_, options_.of,
                   table_.size() + kNearNumbers));
  point_to("number");
}

// Each use has a place of its own: what two uses share, a compiler reads into a register first, by
// an instruction that is longer than the addresses in both of theirs.
std::string FlatEmitter::constant(double value) {
  std::string text = number(value);
  if (value == 2.0) return text;  // a sum
  const int place = static_cast<int>(window_++) - int{kNearNumbers};
  table_.push_back(text);
  return fmt::format("NUMBER({}, {})", place, text);
}

// Inputs are memory operands wherever they are used; states, which are written too, are not.
const std::string& FlatEmitter::input_again(std::uint32_t i, const Node& node) {
  std::string& place = in_memory_[i].place;
  if (place.empty()) place = element(layout_.inputs[node.index]);
  return place;
}

// Writes a value that has just been computed where it will be read.
void FlatEmitter::wait_in_memory(std::uint32_t node) {
  if (!stages_ || kept_.slot[node] == kNoSlot) return;
  const auto [pointer, offset] = kept_place(kept_.slot[node]);
  line(fmt::format("KEPT({}, {}) = {};", pointer, offset, names_[node]));
  in_memory_[node] = {names_[node], fmt::format("{}[{}]", pointer, offset)};
}

void FlatEmitter::read_again(std::uint32_t node) {
  const InMemory& from = in_memory_.at(node);
  names_[node] = given_.unique(from.name);
  declare(scalar_, names_[node], from.place, dag_.node(node).origin);
  named_.push_back(node);
}

// A product that waits in memory is rounded before it is added to anything; so it is in a block,
// whose values do not wait: a sample has the same bits in either.
bool FlatEmitter::rounds_product(std::uint32_t node) const {
  return block_form_ && kept_.any() && kept_.slot[node] != kNoSlot &&
         dag_.node(node).op == Op::kMultiply;
}

void FlatEmitter::declare_constants() {
  // Pointers may not leave the table.
  const std::size_t least = table_.size() - window_ + kNearNumbers;
  if (table_.size() < least) table_.resize(least, "0");
  const std::string table = options_.of + "_table";
  result_.part_names.push_back(table);
  std::string list;
  for (const std::string& text : table_) list += (list.empty() ? "" : ", ") + text;
  result_.parts.add("/* Constants of the function below, in the order of their use. */");
  result_.parts.add(
      fmt::format("static const {} {}_{}[] = {{ {} }};", scalar_, prefix_, table, list));
}

}  // namespace sinew::backend
