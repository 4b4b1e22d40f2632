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
  return array + (place < 0 ? " - " : " + ") + std::to_string(std::abs(place));
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
  for (const std::uint32_t value : kept_.leaving[step_]) waiting_.at(value)->clear();
  ++step_;
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
    body_.code.add(
        {"  KEPT(", place.pointer, ", ", std::to_string(place.offset), ") = ", name, ";"});
  }
  in_memory_[value] = {name, place.pointer, place.offset};
  waiting_[value] = &names_[at_][node];
}

// The name of a node of any region that has been computed, which may wait in memory.
const std::string& LimbEmitter::name_of(std::size_t region, std::uint32_t node) {
  std::string& name = names_[region][node];
  if (!name.empty()) return name;
  const auto& [base, array, place] = in_memory_.at(nodes_.of(region, node));
  name = given_.unique(base);
  if (const std::uint32_t lanes = program_.regions[region].lanes; lanes > 1) {
    body_.code.add({"  ", types_[region], " ", name, "; memcpy(&", name, ", ", offset(array, place),
                    ", sizeof ", name, ");"});
  } else {
    body_.code.add(
        {"  const ", scalar_, " ", name, " = ", array, "[", std::to_string(place), "];"});
  }
  named_.emplace_back(region, node);
  return name;
}

// One lane of it.
std::string LimbEmitter::lane_of(std::size_t region, std::uint32_t node, std::uint32_t lane) {
  if (program_.regions[region].lanes == 1) return name_of(region, node);
  if (!names_[region][node].empty()) return fmt::format("{}[{}]", names_[region][node], lane);
  const InMemory& from = in_memory_.at(nodes_.of(region, node));
  return fmt::format("{}[{}]", from.array, from.place + static_cast<int>(lane));
}

}  // namespace sinew::backend
