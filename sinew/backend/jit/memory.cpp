#include "sinew/backend/jit/memory.h"

#include <algorithm>
#include <cstring>

#include "sinew/backend/jit/ir.h"

namespace sinew::backend {
namespace {

// An address has one byte: so many lie to either side of a pointer.
constexpr std::size_t kNearBytes = 128;
// Pointers to values that wait; each takes a register.
constexpr std::size_t kMostPointers = 5;
// Registers for addresses, but for those of the stack and one that is left to the generator.
constexpr std::size_t kAddressRegisters = 13;

unsigned lanes(LLVMTypeRef type) {
  return LLVMGetTypeKind(type) == LLVMVectorTypeKind ? LLVMGetVectorSize(type) : 1;
}

LLVMTypeRef number_of(LLVMTypeRef type) {
  return LLVMGetTypeKind(type) == LLVMVectorTypeKind ? LLVMGetElementType(type) : type;
}

}  // namespace

Memory::Memory(const Place& place, LLVMTypeRef number, const MemorySizes& sizes)
    : place_(place),
      number_(number),
      double_(LLVMDoubleTypeInContext(LLVMGetTypeContext(number))),
      context_(LLVMGetTypeContext(number)),
      sizes_(sizes),
      in_(LLVMGetParam(place.function, 0)),
      out_(LLVMGetParam(place.function, 1)) {}

std::size_t Memory::near(LLVMTypeRef number) const { return kNearBytes / bytes_of(number); }

LLVMValueRef Memory::offset(std::size_t to, std::size_t from) const {
  const auto distance = static_cast<std::ptrdiff_t>(to) - static_cast<std::ptrdiff_t>(from);
  return LLVMConstInt(LLVMInt64TypeInContext(context_), static_cast<unsigned long long>(distance),
                      true);
}

LLVMValueRef Memory::address(LLVMTypeRef number, const Pointer& pointer, std::size_t index) const {
  LLVMValueRef distance = offset(index, pointer.at);
  return LLVMBuildGEP2(place_.builder, number, pointer.value, &distance, 1, "");
}

LLVMValueRef Memory::load(LLVMTypeRef type, LLVMValueRef from) const {
  const LLVMValueRef value = LLVMBuildLoad2(place_.builder, type, from, "");
  LLVMSetAlignment(value, lanes(type) * bytes_of(number_of(type)));
  LLVMSetVolatile(value, true);
  return value;
}

Memory::Pointer Memory::hidden(LLVMTypeRef number, const Pointer& from, std::size_t at) const {
  return {backend::hidden(place_.builder, address(number, from, at)), at};
}

Memory::Pointer Memory::hidden_middle(LLVMTypeRef number, LLVMValueRef array,
                                      std::size_t size) const {
  return hidden(number, {array, 0}, size > near(number) ? near(number) : 0);
}

LLVMValueRef Memory::array(LLVMTypeRef number, std::size_t size) const {
  const LLVMValueRef array = Ir(place_.builder, number, false).entry_array(place_.function, size);
  LLVMSetAlignment(array, 64);
  return array;
}

void Memory::write_sines(const std::vector<LLVMValueRef>& packs) {
  sine_lanes_ = lanes(LLVMTypeOf(packs.front()));
  cosines_ = packs.size() * sine_lanes_;
  sines_ = array(double_, 3 * cosines_);
  early_ = emit_sincos_to(place_, packs, sines_, in_, out_);
}

void Memory::begin() {
  inputs_at_ = {in_, 0};
  if (sizes_.inputs > near(number_)) inputs_at_ = hidden_middle(number_, in_, sizes_.inputs);
  reach_results();
  if (sines_ != nullptr) sines_at_ = hidden_middle(double_, sines_, 2 * cosines_);
  if (sizes_.waiting == 0) return;
  const LLVMValueRef slots = array(number_, sizes_.waiting);
  for (std::size_t k = 0; k < waiting_pointers(); ++k) {
    waiting_at_.push_back(hidden(number_, {slots, 0}, (2 * k + 1) * near(number_)));
  }
}

LLVMValueRef Memory::input(std::size_t index) const {
  return load(number_, address(number_, inputs_at_, index));
}

const Memory::Pointer& Memory::near_slot(std::size_t slot) const {
  return waiting_at_[std::min(slot / (2 * near(number_)), waiting_at_.size() - 1)];
}

LLVMValueRef Memory::waiting(std::size_t slot, LLVMTypeRef type) const {
  return load(type, address(number_, near_slot(slot), slot));
}

void Memory::keep(LLVMValueRef value, std::size_t slot) const {
  const LLVMTypeRef type = LLVMTypeOf(value);
  const LLVMValueRef store =
      LLVMBuildStore(place_.builder, value, address(number_, near_slot(slot), slot));
  LLVMSetAlignment(store, lanes(type) * bytes_of(number_));
  LLVMSetVolatile(store, true);
}

std::size_t Memory::waiting_pointers() const {
  const std::size_t each = 2 * near(number_);
  return std::min((sizes_.waiting + each - 1) / each, kMostPointers);
}

void Memory::reach_results() {
  const std::size_t others = 3 + waiting_pointers();  // inputs, sines and constants have one each
  const std::size_t registers = place_.indexes ? kAddressRegisters - others : 1;
  results_plan_ =
      plan_addresses(sizes_.results, static_cast<std::int32_t>(near(number_)), registers);
  const Pointer begin = {out_, 0};
  for (const std::int32_t base : results_plan_.bases) {
    results_at_.push_back(base == 0 ? begin : hidden(number_, begin, base));
  }
  const LLVMTypeRef integer = LLVMInt64TypeInContext(context_);
  for (const std::int32_t index : results_plan_.indices) {
    results_index_.push_back(backend::hidden(
        place_.builder, LLVMConstInt(integer, std::uint64_t{bytes_of(number_)} * index, false)));
  }
}

LLVMValueRef Memory::result_address(std::size_t index) const {
  const PlannedAddress planned = address_of(results_plan_, static_cast<std::int32_t>(near(number_)),
                                            static_cast<std::uint32_t>(index));
  Pointer from = results_at_[planned.base];
  if (planned.scale != 0) {
    const LLVMTypeRef byte = LLVMInt8TypeInContext(context_);
    const LLVMTypeRef integer = LLVMInt64TypeInContext(context_);
    LLVMValueRef distance = LLVMBuildMul(place_.builder, results_index_[planned.index],
                                         LLVMConstInt(integer, planned.scale, false), "");
    from.value = LLVMBuildGEP2(place_.builder, byte, from.value, &distance, 1, "");
    from.at = index - planned.distance;
  }
  return address(number_, from, index);
}

void Memory::write_result(LLVMValueRef value, std::size_t index) const {
  const LLVMValueRef store = LLVMBuildStore(place_.builder, value, result_address(index));
  LLVMSetAlignment(store, bytes_of(number_));
}

LLVMTypeRef Memory::of_doubles(LLVMTypeRef type) const {
  return lanes(type) == 1 ? double_ : LLVMVectorType(double_, lanes(type));
}

LLVMValueRef Memory::saved_sine(std::size_t place, LLVMTypeRef type) const {
  const LLVMValueRef value = load(of_doubles(type), address(double_, sines_at_, place));
  return Ir(place_.builder, type, false).from_double(value);
}

LLVMValueRef Memory::sine(std::size_t angle, LLVMTypeRef type) const {
  return saved_sine(angle, type);
}
LLVMValueRef Memory::cosine(std::size_t angle, LLVMTypeRef type) const {
  return saved_sine(cosines_ + angle, type);
}

LLVMValueRef Memory::lanes_of(const std::vector<LLVMValueRef>& packs, std::size_t angle,
                              LLVMTypeRef type) const {
  const LLVMValueRef pack = packs[angle / sine_lanes_];
  const LLVMTypeRef index = LLVMInt32TypeInContext(context_);
  const auto lane = [&](std::size_t k) {
    return LLVMConstInt(index, angle % sine_lanes_ + k, false);
  };
  LLVMValueRef value = nullptr;
  if (lanes(type) == 1) {
    value = LLVMBuildExtractElement(place_.builder, pack, lane(0), "");
  } else {
    std::vector<LLVMValueRef> chosen;
    for (unsigned k = 0; k < lanes(type); ++k) chosen.push_back(lane(k));
    value = LLVMBuildShuffleVector(place_.builder, pack, LLVMGetUndef(LLVMTypeOf(pack)),
                                   LLVMConstVector(chosen.data(), lanes(type)), "");
  }
  return Ir(place_.builder, type, false).from_double(value);
}

bool Memory::is_in_register(std::size_t angle) const {
  return early_.sine[angle / sine_lanes_] != nullptr;
}

LLVMValueRef Memory::early_sine(std::size_t angle, LLVMTypeRef type) const {
  if (!is_in_register(angle)) return sine(angle, type);
  return lanes_of(early_.sine, angle, type);
}
LLVMValueRef Memory::early_cosine(std::size_t angle, LLVMTypeRef type) const {
  if (!is_in_register(angle)) return cosine(angle, type);
  return lanes_of(early_.cosine, angle, type);
}

// The table is filled in the order of use, and the pointer moves on when its end is out of reach.
LLVMValueRef Memory::constant(const std::vector<double>& lanes) {
  const std::size_t width = lanes.size();
  const auto is_at = [&](std::size_t at) {
    return std::memcmp(&constants_[at], lanes.data(), width * sizeof(double)) == 0;
  };
  std::size_t at = (window_ + width - 1) / width * width;
  while (at + width <= constants_.size() && !is_at(at)) at += width;
  if (at + width > constants_.size()) {
    at = (constants_.size() + width - 1) / width * width;
    constants_.resize(at, 0.0);
    constants_.insert(constants_.end(), lanes.begin(), lanes.end());
  }
  if (table_ == nullptr || at + width > window_ + 2 * near(number_)) {
    if (table_ == nullptr) {
      table_ = LLVMAddGlobal(LLVMGetGlobalParent(place_.function), number_, "constants_begin");
      constants_at_ = {table_, 0};
    }
    window_ = at;
    constants_at_ = hidden(number_, constants_at_, at + near(number_));
  }
  const LLVMTypeRef type =
      width == 1 ? number_ : LLVMVectorType(number_, static_cast<unsigned>(width));
  return load(type, address(number_, constants_at_, at));
}

void Memory::end() {
  if (table_ == nullptr) return;
  std::vector<LLVMValueRef> numbers;
  for (const double value : constants_) numbers.push_back(LLVMConstReal(number_, value));
  constexpr unsigned kLine = 64;
  LLVMSetAlignment(become_table(table_, numbers, "constants"), kLine);
}

}  // namespace sinew::backend
