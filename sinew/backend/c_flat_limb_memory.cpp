// Values of limbs and trunk that wait in memory, and the stages in which they are read (as
// c_flat_stages.cpp has them for functions without limbs).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string_view>

#include "sinew/backend/c_flat_limb_emitter.h"
#include "sinew/backend/c_kept_array.h"

namespace sinew::backend {

using program::Node;
using program::Op;
using program::Ref;

namespace {

constexpr std::size_t kConstantsOfNode = 2;  // at most, in a sum or product
// Numbers of the table that uses share: limbs side by side say the same of one link several times.
constexpr std::size_t kShared = 16;

// A pointer to inputs reaches at least so many reads more than the caller's does.
constexpr std::uint32_t kLeastReads = 8;

// "kept + 3"
std::string offset(const std::string& array, int place) {
  std::string text = array;
  text += place < 0 ? " - " : " + ";
  return text += Digits(std::abs(place));
}

}  // namespace

void LimbEmitter::declare_kept(const std::vector<std::vector<std::uint32_t>>& orders) {
  declare_kept_array(kept_.size, upper_, scalar_, given_, pointers_, body_.code);
  given_.take("number");
  table_.declare_pointer(body_.code);
  if (layout_.in_size > kNearNumbers) point_to_inputs(orders);
}

// A pointer into the caller's numbers, where the shortest addresses reach most of what is read.
void LimbEmitter::point_to_inputs(const std::vector<std::vector<std::uint32_t>>& orders) {
  std::vector<std::uint32_t> reads(layout_.in_size, 0);
  for (at_ = 0; at_ < program_.regions.size(); ++at_) {
    const auto read = [&](Ref operand) {
      const Node& input = dag().node(operand);
      if (input.op != Op::kInput) return;
      for (const Source& source : region().inputs[input.index]) {
        if (source.kind != Source::Kind::kCaller) continue;
        const FlatPlace& place = layout_.inputs[source.index];
        if (std::string_view(place.array) == "in") ++reads[place.index];
      }
    };
    for (const std::uint32_t i : orders[at_]) {
      const Node& node = dag().node(i);
      const Ref operands[] = {node.a, node.b, node.c};
      if (node.op == Op::kSin || node.op == Op::kCos) continue;
      for (int k = 0; k < program::arity(node.op); ++k) read(operands[k]);
    }
  }
  const std::size_t reach = std::min<std::size_t>(reads.size(), 2 * kNearNumbers);
  std::uint32_t reached = std::accumulate(reads.begin(), reads.begin() + reach, 0U);
  std::uint32_t most = reached;
  std::size_t first = 0;
  for (std::size_t end = reach; end < reads.size(); ++end) {
    reached += reads[end];
    reached -= reads[end - reach];
    if (reached > most) {
      most = reached;
      first = end - reach + 1;
    }
  }
  const std::uint32_t near = std::accumulate(reads.begin(), reads.begin() + kNearNumbers, 0U);
  if (most < near + kLeastReads) return;
  given_.take("inputs");
  middle_of_inputs_ = static_cast<int>(first + kNearNumbers);
  line(fmt::format("const {} *inputs = in + {};", scalar_, middle_of_inputs_));
  point_to("inputs");
}

void LimbEmitter::point_to(const std::string& pointer) { point_again(pointer, upper_, body_.code); }

void LimbEmitter::begin_step() {
  if (!kept_.any()) return;
  table_.make_room(kConstantsOfNode * (at_ < types_.size() ? lanes() : 1), body_.code);
  if (step_ == 0 || step_ % kStage != 0) return;
  body_.code.add("");
  line(upper_ + "_STAGE();");
  for (const auto& [region, node] : named_) names_[region][node].clear();
  named_.clear();
}

void LimbEmitter::end_step() {
  if (!kept_.any()) return;
  for (const std::uint32_t value : kept_.leaving(step_)) waiting_.at(value)->clear();
  ++step_;
}

LimbEmitter::InMemory& LimbEmitter::put_in_memory(std::uint32_t value) {
  if (!is_in_memory(value)) {
    memory_of_[value] = static_cast<std::uint32_t>(memory_.size());
    memory_.emplace_back();
  }
  return memory_[memory_of_[value]];
}

// Whether it is the same in each call: a constant, or an input that is one in each lane.
bool LimbEmitter::is_constant(const Node& node) const {
  if (node.op == Op::kConstant) return true;
  if (node.op != Op::kInput || !kept_.any()) return false;
  const Sources& sources = region().inputs[node.index];
  return std::all_of(sources.begin(), sources.end(),
                     [](const Source& source) { return source.kind == Source::Kind::kConstant; });
}

// Its texts, a number for each lane.
const std::vector<std::string>& LimbEmitter::numbers(std::uint32_t i, const Node& node) {
  std::vector<std::string>& texts = constants_[nodes_.of(at_, i)];
  if (!texts.empty()) return texts;
  if (node.op == Op::kConstant) {
    texts.assign(lanes(), number(node.value));
    return texts;
  }
  const Sources& sources = region().inputs[node.index];
  for (unsigned lane = 0; lane < lanes(); ++lane) {
    texts.push_back(number(sources[lane < sources.size() ? lane : 0].value));
  }
  return texts;
}

// Where values wait in memory so do constants; elsewhere a compiler chooses.
void LimbEmitter::constant(std::uint32_t i, const Node& node, std::string& text) {
  const std::vector<std::string>& of_lanes = numbers(i, node);
  const bool twice = node.op == Op::kConstant && node.value == 2.0;  // a sum
  if (!kept_.any() || twice) {
    text = of_lanes[0];
    return;
  }
  const int place = table_.place(of_lanes, kShared);
  text = "NUMBER";
  if (in_lanes()) (text += 'S') += Digits(lanes());
  (text += '(') += Digits(place);
  for (const std::string& number : of_lanes) (text += ", ") += number;
  text += ')';
}

void LimbEmitter::declare_constants() {
  body_.part_names.push_back(table_.part());
  table_.declare_table(body_.widths.empty() ? 1 : body_.widths.back(), body_.parts);
}

// Writes a value that has just been computed where it will be read.
void LimbEmitter::wait_in_memory(std::uint32_t node) {
  const std::uint32_t value = nodes_.of(at_, node);
  if (!kept_.any() || kept_.slot[value] == kNoSlot) return;
  const std::string& name = names_[at_][node];
  const KeptPlace place = kept_place(kept_.slot[value]);
  if (in_lanes()) {
    body_.code.add(
        {"  memcpy(", offset(place.pointer, place.offset), ", &", name, ", sizeof ", name, ");"});
  } else {
    body_.code.add({"  KEPT(", place.pointer, ", ", Digits(place.offset), ") = ", name, ";"});
  }
  put_in_memory(value) = {name, place.pointer, place.offset};
  waiting_[value] = &names_[at_][node];
}

// The name of a node of any region that has been computed, which may wait in memory.
const std::string& LimbEmitter::name_of(std::size_t region, std::uint32_t node) {
  std::string& name = names_[region][node];
  if (!name.empty()) return name;
  const auto& [base, array, place] = in_memory(nodes_.of(region, node));
  name = given_.unique(base);
  if (const std::uint32_t lanes = program_.regions[region].lanes; lanes > 1) {
    body_.code.add({"  ", types_[region], " ", name, "; memcpy(&", name, ", ", offset(array, place),
                    ", sizeof ", name, ");"});
  } else {
    body_.code.add({"  const ", scalar_, " ", name, " = ", array, "[", Digits(place), "];"});
  }
  named_.emplace_back(region, node);
  return name;
}

// One lane of it.
std::string LimbEmitter::lane_of(std::size_t region, std::uint32_t node, std::uint32_t lane) {
  if (program_.regions[region].lanes == 1) return name_of(region, node);
  const std::string& name = names_[region][node];
  const InMemory* from = name.empty() ? &in_memory(nodes_.of(region, node)) : nullptr;
  std::string text = from == nullptr ? name : from->array;
  text += '[';
  text += Digits(static_cast<int>(lane) + (from == nullptr ? 0 : from->place));
  return text += ']';
}

}  // namespace sinew::backend
