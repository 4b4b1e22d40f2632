#include "sinew/data/machine_code.h"

#include <sys/mman.h>
#include <unistd.h>

#include <bit>
#include <cstring>

namespace sinew::data {
namespace {

struct Encoding {
  std::uint8_t prefix, opcode;
};

constexpr Encoding kEncodings[] = {
    {0xf2, 0x10},  // move: movsd
    {0xf2, 0x11},  // move store: movsd
    {0xf3, 0x11},  // move float store: movss
    {0x66, 0x28},  // move all: movapd
    {0xf2, 0x58},  // addsd
    {0xf2, 0x59},  // mulsd
    {0xf2, 0x5c},  // subsd
    {0xf2, 0x5e},  // divsd
    {0xf2, 0x51},  // sqrtsd
    {0x66, 0x54},  // andpd
    {0x66, 0x55},  // andnpd
    {0x66, 0x56},  // orpd
    {0x66, 0x57},  // xorpd
    {0xf3, 0x5a},  // cvtss2sd
    {0xf2, 0x5a},  // cvtsd2ss
};
static_assert(std::size(kEncodings) == std::size_t(Instruction::kDoubleToFloat) + 1);

constexpr unsigned number_of(General reg) { return static_cast<unsigned>(reg); }

constexpr std::size_t kPoolAlignment = 16;

}  // namespace

void MachineCode::number(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) byte((value >> (8 * i)) & 0xff);
}

// Prefix, REX (for registers from 8 on), opcode.
void MachineCode::opcode(Instruction which, unsigned reg, unsigned other) {
  const Encoding& encoding = kEncodings[std::size_t(which)];
  byte(encoding.prefix);
  const unsigned rex = 0x40 | ((reg >> 3) << 2) | (other >> 3);
  if (rex != 0x40) byte(rex);
  byte(0x0f);
  byte(encoding.opcode);
}

// ModRM for [base + offset]; base 4 (and 12) needs a SIB byte.
void MachineCode::memory(unsigned reg, General base, std::int32_t offset) {
  const bool near = offset >= -128 && offset < 128;
  byte((near ? 0x40 : 0x80) | ((reg & 7) << 3) | (number_of(base) & 7));
  if ((number_of(base) & 7) == 4) byte(0x24);
  number(static_cast<std::uint32_t>(offset), near ? 1 : 4);
}

void MachineCode::instruction(Instruction which, Vector target, Vector source) {
  opcode(which, target, source);
  byte(0xc0 | ((target & 7) << 3) | (source & 7));
}

void MachineCode::instruction(Instruction which, Vector target, General base, std::int32_t offset) {
  opcode(which, target, number_of(base));
  memory(target, base, offset);
}

void MachineCode::pooled(Instruction which, Vector target, std::uint64_t low, std::uint64_t high) {
  std::size_t at = 0;
  while (at < pool_.size() && (pool_[at].low != low || pool_[at].high != high)) ++at;
  if (at == pool_.size()) pool_.push_back({low, high});
  opcode(which, target, 0);
  byte(0x05 | ((target & 7) << 3));  // relative to the next instruction
  uses_.emplace_back(bytes_.size(), at);
  number(0, 4);
}

void MachineCode::with_constant(Instruction which, Vector target, double constant) {
  pooled(which, target, std::bit_cast<std::uint64_t>(constant), 0);
}

void MachineCode::with_bits(Instruction which, Vector target, std::uint64_t both_halves) {
  pooled(which, target, both_halves, both_halves);
}

void MachineCode::compare(Compare how, Vector target, Vector source) {
  byte(0xf2);
  const unsigned rex = 0x40 | ((target >> 3) << 2) | (source >> 3);
  if (rex != 0x40) byte(rex);
  byte(0x0f);
  byte(0xc2);
  byte(0xc0 | ((target & 7) << 3) | (source & 7));
  byte(static_cast<unsigned>(how));
}

void MachineCode::landing() { number(0xfa1e0ff3, 4); }  // endbr64

void MachineCode::push(General reg) {
  if (number_of(reg) > 7) byte(0x41);
  byte(0x50 | (number_of(reg) & 7));
}

void MachineCode::pop(General reg) {
  if (number_of(reg) > 7) byte(0x41);
  byte(0x58 | (number_of(reg) & 7));
}

void MachineCode::move(General target, General source) {
  byte(0x48 | ((number_of(source) >> 3) << 2) | (number_of(target) >> 3));
  byte(0x89);
  byte(0xc0 | ((number_of(source) & 7) << 3) | (number_of(target) & 7));
}

void MachineCode::load(General target, General base, std::int32_t offset) {
  byte(0x48 | ((number_of(target) >> 3) << 2) | (number_of(base) >> 3));
  byte(0x8b);
  memory(number_of(target), base, offset);
}

void MachineCode::load_number(General target, std::uint64_t value) {
  byte(0x48 | (number_of(target) >> 3));
  byte(0xb8 | (number_of(target) & 7));
  number(value, 8);
}

void MachineCode::call(const void* function, General through) {
  load_number(through, reinterpret_cast<std::uintptr_t>(function));
  if (number_of(through) > 7) byte(0x41);
  byte(0xff);
  byte(0xd0 | (number_of(through) & 7));
}

void MachineCode::leave_if_false() {
  byte(0x84);  // test al, al
  byte(0xc0);
  byte(0x0f);  // je
  byte(0x84);
  leaves_.push_back(bytes_.size());
  number(0, 4);
}

void MachineCode::mark_end() { end_ = bytes_.size(); }

void MachineCode::return_() { byte(0xc3); }

std::shared_ptr<const void> MachineCode::finish() {
  const auto set = [&](std::size_t at, std::size_t goal) {
    const auto distance = static_cast<std::int32_t>(static_cast<std::ptrdiff_t>(goal) -
                                                    static_cast<std::ptrdiff_t>(at + 4));
    std::memcpy(bytes_.data() + at, &distance, sizeof distance);
  };
  for (const std::size_t at : leaves_) set(at, end_);
  while (bytes_.size() % kPoolAlignment != 0) byte(0xcc);
  const std::size_t pool = bytes_.size();
  for (const Half& half : pool_) {
    number(half.low, 8);
    number(half.high, 8);
  }
  for (const auto& [at, which] : uses_) set(at, pool + 16 * which);

  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  // Before a function's code, clang's sanitizer for calls through pointers looks for its type: what
  // lies there has to be readable, and no type.
  constexpr std::size_t kBefore = 64;
  static_assert(kBefore % kPoolAlignment == 0);
  const std::size_t size = (kBefore + bytes_.size() + page - 1) / page * page;
  void* const place =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) return nullptr;
  char* const code = static_cast<char*>(place) + kBefore;
  std::memset(place, 0xcc, kBefore);
  std::memcpy(code, bytes_.data(), bytes_.size());
  if (mprotect(place, size, PROT_READ | PROT_EXEC) != 0) {
    munmap(place, size);
    return nullptr;
  }
  return {code, [place, size](void*) { munmap(place, size); }};
}

}  // namespace sinew::data
