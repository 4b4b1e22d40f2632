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

}  // namespace

std::string content_hash(const program::Computation& computation, std::string_view machine) {
  Hash hash;
  for (const char c : machine) hash.add(static_cast<unsigned char>(c));
  hash.add(computation.inputs);
  hash.add(computation.dag.size());
  for (std::uint32_t i = 0; i < computation.dag.size(); ++i) {
    const program::Node& node = computation.dag.node(i);
    hash.add(static_cast<std::uint64_t>(node.op) << 32 | node.index);
    hash.add(std::uint64_t{node.a.bits} << 32 | node.b.bits);
    hash.add(node.c.bits);
    hash.add(std::bit_cast<std::uint64_t>(node.value));
  }
  for (const program::Ref result : computation.results) hash.add(result.bits);
  hash.add(computation.order.size());
  for (const std::uint32_t node : computation.order) hash.add(node);
  return hash.text();
}

}  // namespace sinew::backend
