#include "sinew/backend/jit/content_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

namespace sinew::backend {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      const std::uint64_t value = word >> (8 * byte) & 0xff;
      first_ = (first_ ^ value) * kPrime;
      second_ = (second_ ^ value ^ 0x55) * kPrime;
    }
  }
  std::string text() const { return fmt::format("{:016x}{:016x}", first_, second_); }

 private:
  static constexpr std::uint64_t kPrime = 1099511628211u;
  std::uint64_t first_ = 14695981039346656037u;
  std::uint64_t second_ = 0x9e3779b97f4a7c15u;
};

void add(Hash& hash, const program::Computation& computation) {
  hash.add(computation.inputs);
  hash.add(computation.dag.size());
  for (std::uint32_t i = 0; i < computation.dag.size(); ++i) {
    const program::Node& node = computation.dag.node(i);
    hash.add(static_cast<std::uint64_t>(node.op) << 32 | node.index);
    hash.add(std::uint64_t{node.a.bits} << 32 | node.b.bits);
    hash.add(node.c.bits);
    hash.add(std::bit_cast<std::uint64_t>(node.value));
  }
  hash.add(computation.results.size());
  for (const program::Ref result : computation.results) hash.add(result.bits);
  hash.add(computation.order.size());
  for (const std::uint32_t node : computation.order) hash.add(node);
}

void add(Hash& hash, const program::LimbSource& source) {
  hash.add(static_cast<std::uint64_t>(source.kind) << 32 | source.index);
  hash.add(std::uint64_t{source.region} << 32 | source.lane << 1U | (source.negative ? 1U : 0U));
  hash.add(std::bit_cast<std::uint64_t>(source.value));
}

}  // namespace

std::string content_hash(const program::Computation& computation, const program::LimbProgram* limbs,
                         std::string_view machine) {
  Hash hash;
  for (const char c : machine) hash.add(static_cast<unsigned char>(c));
  add(hash, computation);
  if (limbs != nullptr) {
    for (const program::LimbRegion& region : limbs->regions) {
      hash.add(region.lanes);
      add(hash, region.computation);
      for (const auto& sources : region.inputs) {
        for (const program::LimbSource& source : sources) add(hash, source);
      }
    }
    for (const program::LimbSource& source : limbs->results) add(hash, source);
  }
  return hash.text();
}

}  // namespace sinew::backend
