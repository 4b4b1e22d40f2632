// Values of limbs and trunk that wait in memory, and the stages in which they are read (as
// c_flat_stages.cpp has them for functions without limbs).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "sinew/backend/c_flat_limb_emitter.h"
#include "sinew/backend/c_kept_array.h"

namespace sinew::backend {

namespace {

// "kept + 3"
std::string offset(const std::string& array, int place) {
  std::string text = array;
  text += place < 0 ? " - " : " + ";
  return text += Digits(std::abs(place));
}

}  // namespace

void LimbEmitter::declare_kept() {
  declare_kept_array(kept_.size, upper_, scalar_, given_, pointers_, body_.code);
}

void LimbEmitter::point_to(const std::string& pointer) { point_again(pointer, upper_, body_.code); }

void LimbEmitter::begin_step() {
  if (!kept_.any() || step_ == 0 || step_ % kStage != 0) return;
  body_.code.add("");
  for (const std::string& pointer : pointers_) point_to(pointer);
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
