#include "sinew/program/dag/dag.h"

#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::program {
namespace {

constexpr std::uint64_t kMix =
    0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio: spreads consecutive keys

// Of a sum or product, of which all else is zero. Numbers of nodes leave room for the operation.
std::uint64_t hash(Op op, Ref a, Ref b) {
  const std::uint64_t operands = std::uint64_t{a.bits} << 32U | b.bits;
  const std::uint64_t h = (operands ^ std::uint64_t{static_cast<std::uint8_t>(op)} << 28U) * kMix;
  return h ^ h >> 32U;
}

std::uint64_t hash(const Node& node) {
  if (node.op == Op::kAdd || node.op == Op::kMultiply) return hash(node.op, node.a, node.b);
  const std::uint64_t operands = std::uint64_t{node.a.bits} << 32U | node.b.bits;
  const std::uint64_t rest = std::uint64_t{node.c.bits ^ node.index} << 8U;
  std::uint64_t h = (operands ^ std::bit_cast<std::uint64_t>(node.value)) * kMix;
  h = (h ^ h >> 32U ^ rest ^ static_cast<std::uint64_t>(node.op)) * kMix;
  return h ^ h >> 32U;
}

// A place of the table.
constexpr unsigned kNodeBits = 24;
constexpr std::uint32_t kNodeMask = (1U << kNodeBits) - 1;
static_assert(Dag::kMaximumNodes <= kNodeMask);
std::uint32_t entry(std::uint32_t node, std::uint64_t hash) {
  return static_cast<std::uint32_t>(hash >> 56U) << kNodeBits | (node + 1);
}

Error too_many_nodes() {
  return Error(Problem{{},
                       {},
                       "the program expands to more than " + std::to_string(Dag::kMaximumNodes) +
                           " scalar operations",
                       "ask for fewer results at once",
                       Severity::kError,
                       {}});
}

bool same(const Node& x, const Node& y) {
  return x.op == y.op && x.a == y.a && x.b == y.b && x.c == y.c && x.index == y.index &&
         std::bit_cast<std::uint64_t>(x.value) == std::bit_cast<std::uint64_t>(y.value);
}

}  // namespace

Dag::Dag() : table_(1U << 10U, 0) {}

void Dag::reserve(std::uint32_t nodes) {
  nodes_.reserve(nodes);
  if (table_.size() < std::size_t{nodes} * 2) rehash(std::size_t{nodes} * 2);
}

// Size: a power of two, at least twice the number of nodes.
void Dag::rehash(std::size_t least) {
  std::size_t size = table_.size();
  while (size < least || size < nodes_.size() * 2) size *= 2;
  table_.assign(size, 0);
  const std::uint64_t mask = table_.size() - 1;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const std::uint64_t h = hash(nodes_[i]);
    std::uint64_t at = h & mask;
    while (table_[at] != 0) at = (at + 1) & mask;
    table_[at] = entry(i, h);
  }
}

template <typename Same, typename Make>
Ref Dag::find_or_add(std::uint64_t hash, Same same, Make make) {
  const std::uint64_t mask = table_.size() - 1;
  std::uint32_t* const table = table_.data();
  std::uint64_t at = hash & mask;
  for (std::uint32_t there; (there = table[at]) != 0; at = (at + 1) & mask) {
    // Nodes whose hashes differ in the bits that are kept need not be looked at.
    if (there >> kNodeBits != hash >> 56U) continue;
    const std::uint32_t found = (there & kNodeMask) - 1;
    if (same(nodes_[found])) return Ref::of(found);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  if (index >= kMaximumNodes) throw too_many_nodes();
  make();
  table[at] = entry(index, hash);
  if (std::uint64_t{index} * 2 + 2 > mask) rehash((mask + 1) * 2);
  return Ref::of(index);
}

Ref Dag::append(const Node& node) {
  if (nodes_.size() >= kMaximumNodes) throw too_many_nodes();
  nodes_.push_back(node);
  return Ref::of(static_cast<std::uint32_t>(nodes_.size() - 1));
}

Ref Dag::intern(const Node& node) {
  return find_or_add(
      hash(node), [&](const Node& other) { return same(other, node); },
      [&] {
        Node& made = nodes_.emplace_back(node);
        if (arity(made.op) > 0) made.origin = origin_;
      });
}

Ref Dag::intern(Op op, Ref a, Ref b) {
  return find_or_add(
      hash(op, a, b),
      [=](const Node& other) { return other.op == op && other.a == a && other.b == b; },
      [=, this] {
        Node& made = nodes_.emplace_back();
        made.op = op;
        made.a = a;
        made.b = b;
        made.origin = origin_;
      });
}

double Dag::sum_of_constants(double x, double y) {
  const double sum = x + y;
  return std::abs(sum) <= kCancellation * std::fmax(std::abs(x), std::abs(y)) ? 0.0 : sum;
}

Ref Dag::constant(double value) {
  const bool negative = value < 0.0;
  Node node;
  node.value = value == 0.0 ? 0.0 : (negative ? -value : value);  // also turns -0 into 0
  return intern(node).negated_if(negative);
}

Ref Dag::input(std::uint32_t index) {
  Node node;
  node.op = Op::kInput;
  node.index = index;
  return intern(node);
}

std::uint32_t Dag::unscaled(Ref ref) const {
  const Node& n = node(ref);
  // Both are asked, of the first node where there is no operand: no branch has to be guessed.
  const bool is_product = n.op == Op::kMultiply, has_constant = is_constant(n.a);
  const std::uint32_t scaled = 0U - static_cast<std::uint32_t>(is_product & has_constant);
  return (n.b.node() & scaled) | (ref.node() & ~scaled);
}

// Operands by index; the first one positive.
Ref Dag::new_sum(Ref a, Ref b) {
  if (a.node() > b.node()) std::swap(a, b);
  const bool flip = a.negative();
  return intern(Op::kAdd, a.negated_if(flip), b.negated_if(flip)).negated_if(flip);
}

Ref Dag::new_product(Ref a, Ref b) { return intern(Op::kMultiply, a, b); }

Ref Dag::add(Ref a, Ref b) {
  // What most additions are: of two nodes that are neither constants nor multiples of the same one.
  if (!is_constant(a) && !is_constant(b) && unscaled(a) != unscaled(b)) return new_sum(a, b);
  return special_sum(a, b);
}

Ref Dag::special_sum(Ref a, Ref b) {
  if (is_constant(a) && is_constant(b)) {
    return constant(sum_of_constants(constant_value(a), constant_value(b)));
  }
  if (is_constant(a, 0.0)) return b;
  if (is_constant(b, 0.0)) return a;
  if (a == -b) return constant(0.0);
  if (a == b) return multiply(constant(2.0), a);

  // c1 + (c2 + x) = (c1 + c2) + x
  if (is_constant(b)) std::swap(a, b);
  if (is_constant(a) && node(b).op == Op::kAdd && is_constant(node(b).a)) {
    const Node inner = node(b);
    const bool flip = b.negative();
    return add(add(a, inner.a.negated_if(flip)), inner.b.negated_if(flip));
  }
  if (is_constant(a) && node(b).op == Op::kAdd && is_constant(node(b).b)) {
    const Node inner = node(b);
    const bool flip = b.negative();
    return add(add(a, inner.b.negated_if(flip)), inner.a.negated_if(flip));
  }

  // c1 x + c2 x = (c1 + c2) x, also where one of the factors is 1
  const auto scaled = [this](Ref r) -> std::pair<double, Ref> {
    const Node& n = node(r);
    if (n.op == Op::kMultiply && is_constant(n.a)) {
      return {r.negative() ? -constant_value(n.a) : constant_value(n.a), n.b};
    }
    return {r.negative() ? -1.0 : 1.0, r.magnitude()};
  };
  const auto [ca, xa] = scaled(a);
  const auto [cb, xb] = scaled(b);
  if (xa == xb) return multiply(add(constant(ca), constant(cb)), xa);
  return new_sum(a, b);
}

Ref Dag::multiply(Ref a, Ref b) {
  if (!is_constant(a) && !is_constant(b)) {
    const bool flip = a.negative() != b.negative();
    if (a.node() > b.node()) std::swap(a, b);
    return new_product(a.magnitude(), b.magnitude()).negated_if(flip);
  }
  return special_product(a, b);
}

Ref Dag::special_product(Ref a, Ref b) {
  if (is_constant(a) && is_constant(b)) return constant(constant_value(a) * constant_value(b));
  if (is_constant(b)) std::swap(a, b);
  if (is_constant(a, 0.0)) return a;
  if (is_constant(a, 1.0)) return b;
  if (is_constant(a, -1.0)) return -b;
  const bool flip = a.negative() != b.negative();
  a = a.magnitude();
  b = b.magnitude();

  // c1 (c2 x) = (c1 c2) x
  if (is_constant(a) && node(b).op == Op::kMultiply && is_constant(node(b).a)) {
    const Node inner = node(b);
    return multiply(multiply(a, inner.a), inner.b).negated_if(flip);
  }
  return new_product(a, b).negated_if(flip);  // a constant factor comes first
}

Ref Dag::fma(Ref a, Ref b, Ref c) {
  const bool trivial = is_constant(a, 0.0) || is_constant(b, 0.0) || is_constant(c, 0.0) ||
                       is_constant(a, 1.0) || is_constant(b, 1.0) || is_constant(a, -1.0) ||
                       is_constant(b, -1.0) || (is_constant(a) && is_constant(b));
  if (trivial) return add(multiply(a, b), c);
  const bool product_negative = a.negative() != b.negative();
  a = a.magnitude();
  b = b.magnitude();
  if (is_constant(b) || (!is_constant(a) && a.node() > b.node())) std::swap(a, b);
  // The product is positive; the sign of the addend tells a b + c from a b - c.
  Node node;
  node.op = Op::kFma;
  node.a = a;
  node.b = b;
  node.c = c.negated_if(product_negative);
  return intern(node).negated_if(product_negative);
}

Ref Dag::divide(Ref a, Ref b) {
  if (is_constant(b)) return multiply(a, constant(1.0 / constant_value(b)));
  if (is_constant(a, 0.0)) return a;
  const bool flip = a.negative() != b.negative();
  a = a.magnitude();
  b = b.magnitude();
  if (a == b) return constant(flip ? -1.0 : 1.0);
  Node node;
  node.op = Op::kDivide;
  node.a = a;
  node.b = b;
  return intern(node).negated_if(flip);
}

Ref Dag::sqrt(Ref a) {
  if (is_constant(a)) return constant(std::sqrt(constant_value(a)));
  Node node;
  node.op = Op::kSqrt;
  node.a = a;
  return intern(node);
}

Ref Dag::sin(Ref a) {
  if (is_constant(a)) return constant(std::sin(constant_value(a)));
  Node node;
  node.op = Op::kSin;
  node.a = a.magnitude();
  return intern(node).negated_if(a.negative());
}

Ref Dag::cos(Ref a) {
  if (is_constant(a)) return constant(std::cos(constant_value(a)));
  Node node;
  node.op = Op::kCos;
  node.a = a.magnitude();
  return intern(node);
}

Ref Dag::less(Ref a, Ref b) {
  if (is_constant(a) && is_constant(b)) {
    return constant(constant_value(a) < constant_value(b) ? 1.0 : 0.0);
  }
  Node node;
  node.op = Op::kLess;
  node.a = a;
  node.b = b;
  return intern(node);
}

Ref Dag::select(Ref condition, Ref if_true, Ref if_false) {
  if (is_constant(condition)) return constant_value(condition) != 0.0 ? if_true : if_false;
  if (if_true == if_false) return if_true;
  Node node;
  node.op = Op::kSelect;
  node.a = condition;
  node.b = if_true;
  node.c = if_false;
  return intern(node);
}

Ref Dag::make(const Node& like, Ref a, Ref b, Ref c) {
  switch (like.op) {
    case Op::kConstant:
      return constant(like.value);
    case Op::kInput:
      return input(like.index);
    case Op::kAdd:
      return add(a, b);
    case Op::kMultiply:
      return multiply(a, b);
    case Op::kFma:
      return fma(a, b, c);
    case Op::kDivide:
      return divide(a, b);
    case Op::kSqrt:
      return sqrt(a);
    case Op::kSin:
      return sin(a);
    case Op::kCos:
      return cos(a);
    case Op::kLess:
      return less(a, b);
    case Op::kSelect:
      return select(a, b, c);
  }
  return {};
}

}  // namespace sinew::program
