// The scalar data-flow graph: what a program computes, number by number, once every operator has
// been expanded and every constant is known. The passes and the code generators work on it.
//
// A node is made once: asking for the same operation on the same operands returns the same node
// (value numbering). Its constructor folds constants, drops operations with 0 and 1, and moves
// signs out: a Ref is a node with a sign, so that a negation costs nothing and x - y, y - x, -x + y
// are one node.
#pragma once

#include <cstdint>
#include <vector>

namespace sinew::program {

enum class Op : std::uint8_t {
  kConstant,  // value, never negative before choose_signs() (passes/choose_signs.h)
  kInput,     // index
  kAdd,       // a + b
  kMultiply,  // a * b
  kFma,       // a * b + c, rounded once where the machine can
  kDivide,    // a / b
  kSqrt,      // sqrt(a)
  kSin,       // sin(a)
  kCos,       // cos(a)
  kLess,      // 1 if a < b, else 0; only the condition of kSelect
  kSelect,    // b if a, else c
};

// A node, or its negative.
struct Ref {
  std::uint32_t bits = 0;

  static Ref of(std::uint32_t node, bool negative = false) {
    return {node << 1U | static_cast<std::uint32_t>(negative)};
  }
  std::uint32_t node() const { return bits >> 1U; }
  bool negative() const { return (bits & 1U) != 0; }
  Ref magnitude() const { return {bits & ~1U}; }
  Ref operator-() const { return {bits ^ 1U}; }
  Ref negated_if(bool negate) const { return {bits ^ static_cast<std::uint32_t>(negate)}; }
  bool operator==(const Ref&) const = default;
};

// The closure that asked for a node first; kNoOrigin where there is none (constants, inputs).
inline constexpr std::uint32_t kNoOrigin = 0xffffffffU;

struct Node {
  Op op = Op::kConstant;
  Ref a, b, c;                       // operands, as many as the operation takes
  double value = 0.0;                // kConstant
  std::uint32_t index = 0;           // kInput
  std::uint32_t origin = kNoOrigin;  // index of a closure of the program
};

// Number of operands that an operation takes. A table: which operation it is nobody can guess, and
// a branch would often be the wrong one.
inline constexpr std::uint8_t kOperands[] = {0, 0, 2, 2, 3, 2, 1, 1, 1, 2, 3};
constexpr int arity(Op op) { return kOperands[static_cast<std::uint8_t>(op)]; }
static_assert(arity(Op::kInput) == 0 && arity(Op::kAdd) == 2 && arity(Op::kFma) == 3 &&
              arity(Op::kSqrt) == 1 && arity(Op::kLess) == 2 && arity(Op::kSelect) == 3);

class Dag {
 public:
  static constexpr std::uint32_t kMaximumNodes = (1U << 24U) - 1;  // beyond it: Error
  // A sum of constants smaller than this share of its largest term is rounding noise and becomes
  // zero.
  static constexpr double kCancellation = 1e-13;

  Dag();
  // Room for so many nodes.
  void reserve(std::uint32_t nodes);

  // The sum of two constants, without rounding noise.
  static double sum_of_constants(double x, double y);

  Ref constant(double value);
  Ref input(std::uint32_t index);
  Ref add(Ref a, Ref b);
  Ref subtract(Ref a, Ref b) { return add(a, -b); }
  Ref multiply(Ref a, Ref b);
  Ref fma(Ref a, Ref b, Ref c);
  Ref divide(Ref a, Ref b);
  Ref sqrt(Ref a);
  Ref sin(Ref a);
  Ref cos(Ref a);
  Ref less(Ref a, Ref b);
  Ref select(Ref condition, Ref if_true, Ref if_false);
  // The operation of `like` on other operands.
  Ref make(const Node& like, Ref a, Ref b, Ref c);

  // A node as it stands, signs and all, though there may be the same one: for the pass that chooses
  // signs, and for none that folds or shares anything afterwards.
  Ref append(const Node& node);
  void reserve_nodes(std::size_t nodes) { nodes_.reserve(nodes); }

  // Nodes that are made from now on come from this closure.
  void set_origin(std::uint32_t closure) { origin_ = closure; }

  const Node& node(Ref ref) const { return nodes_[ref.node()]; }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  bool is_constant(Ref ref) const { return node(ref).op == Op::kConstant; }
  bool is_constant(Ref ref, double value) const {
    return is_constant(ref) && constant_value(ref) == value;
  }
  // Precondition: is_constant(ref).
  double constant_value(Ref ref) const {
    const double value = node(ref).value;
    return ref.negative() ? -value : value;
  }

 private:
  Ref intern(const Node& node);
  [[gnu::always_inline]] inline Ref intern(Op op, Ref a, Ref b);  // of a sum or product
  // The node of this hash that is the `same`, or one more that `make` appends.
  template <typename Same, typename Make>
  [[gnu::always_inline]] inline Ref find_or_add(std::uint64_t hash, Same same, Make make);
  // The node of which this one is a constant multiple, or itself.
  std::uint32_t unscaled(Ref ref) const;
  [[gnu::always_inline]] inline Ref new_sum(Ref a, Ref b);
  // Preconditions: the operands are positive and in their order.
  [[gnu::always_inline]] inline Ref new_product(Ref a, Ref b);
  Ref special_sum(Ref a, Ref b);
  Ref special_product(Ref a, Ref b);
  void rehash(std::size_t least);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> table_;  // open addressing: node + 1 and 8 bits of its hash; 0 is free
  std::uint32_t origin_ = kNoOrigin;
};

// A graph and what is wanted from it.
struct Computation {
  Dag dag;
  std::uint32_t inputs = 0;          // number of inputs; some may be unused
  std::vector<Ref> results;          // in the order in which the caller wants them
  std::vector<std::uint32_t> order;  // nodes to compute, operands first; empty: by index
};

}  // namespace sinew::program
