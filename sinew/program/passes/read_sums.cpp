// A graph as sums of products: what only one sum or product uses becomes part of it.
#include <algorithm>
#include <memory>
#include <utility>

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

// Uses of a node of a graph: how many, and whether sums and products are among the users.
constexpr std::uint32_t kBySum = 1U << 31U, kByProduct = 1U << 30U;
constexpr std::uint32_t kHowMany = kByProduct - 1;

class SumReader {
 public:
  explicit SumReader(Polynomials& system) : system_(system), dag_(system.graph.dag) {}

  void run() {
    const std::uint32_t n = dag_.size();
    count_uses();
    kinds_ = std::make_unique_for_overwrite<Kind[]>(n);
    coefficients_ = std::make_unique_for_overwrite<double[]>(n);
    waiting_ = std::make_unique_for_overwrite<Ref[]>(n + 1);
    sums_ = std::make_unique_for_overwrite<Ref[]>(n + 1);
    system_.kinds.assign(n, SumKind::kNone);
    system_.sums.assign(n, {});
    // No operand becomes more than one term and one factor.
    system_.terms.resize(2 * std::size_t{operations_});
    system_.factors.resize(2 * std::size_t{operations_} + 1);
    system_.nodes.clear();
    system_.long_sums.clear();
    system_.nodes.reserve(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (uses_[i] != 0) read(i, dag_.node(i));
    }
    system_.operations_ += operations_;
    system_.terms.resize(terms_);
    system_.factors.resize(factors_);
    hand_over_uses();
  }

 private:
  // What a node is for the one that uses it.
  enum class Kind : std::uint8_t {
    kFactor,          // a node of its own
    kConstant,        // a coefficient (nothing else comes before the kinds that are parts)
    kTerms,           // a sum that is part of a sum
    kTerm,            // a product that is part of a sum
    kFactors,         // a product that is part of a product
    kCollapsedFactor  // a sum of which one product is left, as part of a product
  };

  // Which sign it is nobody can guess: a branch would often be the wrong one.
  static double sign_of(Ref ref) {
    static constexpr double kSigns[] = {1.0, -1.0};
    return kSigns[ref.bits & 1U];
  }
  Kind kind(Ref ref) const { return kinds_[ref.node()]; }

  void count_uses() {
    system_.operations_ = 0;
    uses_.assign(dag_.size(), 0);
    std::uint32_t* const uses = uses_.data();
    for (const Ref result : system_.graph.results) ++uses[result.node()];
    // Operands have smaller indices than the nodes that use them, which are counted by then.
    for (std::uint32_t i = dag_.size(); i-- > 0;) {
      if (uses[i] == 0) continue;
      const Node& node = dag_.node(i);
      if (node.op == Op::kAdd || node.op == Op::kMultiply) {
        const bool adds = node.op == Op::kAdd;
        const std::uint32_t user = kByProduct << (adds ? 1U : 0U);
        uses[node.a.node()] = (uses[node.a.node()] + 1) | user;
        uses[node.b.node()] = (uses[node.b.node()] + 1) | user;
        ++operations_;
      } else {
        const int operands = arity(node.op);
        if (node.op == Op::kFma) system_.operations_ += 2;
        if (operands > 0) ++uses[node.a.node()];
        if (operands > 1) ++uses[node.b.node()];
        if (operands > 2) ++uses[node.c.node()];
      }
    }
  }

  void read(std::uint32_t i, const Node& node) {
    const bool in_sum = uses_[i] == (kBySum | 1U);
    const bool in_product = uses_[i] == (kByProduct | 1U);
    uses_[i] &= kHowMany;
    kinds_[i] = Kind::kFactor;
    coefficients_[i] = 1.0;
    switch (node.op) {
      case Op::kConstant:
        kinds_[i] = Kind::kConstant;
        coefficients_[i] = node.value;
        uses_[i] = 0;  // counted again where it is more than a coefficient
        system_.nodes.push_back(i);
        return;
      case Op::kAdd:
        if (in_sum) return become_part(i, Kind::kTerms);
        read_sum(i, node);
        if (in_product && system_.sums[i].count == 1) {
          kinds_[i] = Kind::kCollapsedFactor;
          coefficients_[i] = system_.terms[system_.sums[i].first].coefficient;
        }
        return;
      case Op::kMultiply: {
        const double a = sign_of(node.a) * coefficients_[node.a.node()];
        const double b = sign_of(node.b) * coefficients_[node.b.node()];
        if (in_sum || in_product) {
          coefficients_[i] = a * b;
          return become_part(i, in_sum ? Kind::kTerm : Kind::kFactors);
        }
        append_product(a * b, node);
        return add_node(i, terms_ - 1);
      }
      default:
        count_constants(node);
        system_.nodes.push_back(i);
    }
  }

  void become_part(std::uint32_t i, Kind kind) {
    kinds_[i] = kind;
    uses_[i] = 0;
  }

  void add_node(std::uint32_t i, std::uint32_t first) {
    const std::uint32_t count = terms_ - first;
    system_.sums[i] = {first, count, dag_.node(i).origin};
    system_.kinds[i] = SumKind::kSum;
    system_.nodes.push_back(i);
    if (count > 1) system_.long_sums.push_back(i);
  }

  // Appends a term of the factors from `first` on.
  const Term& append_term(double coefficient, std::uint32_t first) {
    return system_.terms[terms_++] = {coefficient, first, factors_ - first};
  }

  // Appends the term of a product with the factors of all that are part of it.
  const Term& append_product(double coefficient, const Node& node) {
    if (kind(node.a) > Kind::kConstant || kind(node.b) != Kind::kFactor) {
      return append_long_product(coefficient, node);
    }
    const bool scales = kind(node.a) == Kind::kConstant;
    const std::uint32_t b = node.b.node(), a = scales ? b : node.a.node();
    const std::uint32_t first = factors_;
    system_.factors[first] = std::min(a, b);
    system_.factors[first + 1] = std::max(a, b);
    factors_ += scales ? 1 : 2;
    return append_term(coefficient, first);
  }

  const Term& append_long_product(double coefficient, const Node& root) {
    const std::uint32_t first = factors_;
    std::uint32_t waiting = 0;
    for (const Node* node = &root;;) {
      waiting_[waiting++] = node->b;
      Ref at = node->a;
      while (kind(at) != Kind::kFactors) {
        append_factor(at.node());
        if (waiting == 0) {
          const auto from = system_.factors.begin();
          std::sort(from + first, from + factors_);
          return append_term(coefficient, first);
        }
        at = waiting_[--waiting];
      }
      node = &dag_.node(at);
    }
  }

  void append_factor(std::uint32_t i) {
    if (kinds_[i] == Kind::kConstant) return;
    if (kinds_[i] != Kind::kCollapsedFactor) {
      system_.factors[factors_++] = i;
      return;
    }
    const Term inner = system_.terms_of(i).front();
    system_.factors.resize(system_.factors.size() + inner.count);
    for (std::uint32_t k = 0; k < inner.count; ++k) {
      system_.factors[factors_++] = system_.factors[inner.first + k];
    }
    uses_[i] = 0;
  }

  // Appends what is no sum inside a sum as a term.
  const Term& append_leaf(Ref ref) {
    const std::uint32_t i = ref.node();
    const double coefficient = sign_of(ref) * coefficients_[i];
    if (kinds_[i] == Kind::kTerm) return append_product(coefficient, dag_.node(i));
    if (kinds_[i] == Kind::kConstant) return append_term(coefficient, factors_);
    system_.factors[factors_++] = i;
    return append_term(sign_of(ref), factors_ - 1);
  }

  // The terms of a sum and of those inside it, from left to right. Mostly there is nothing to
  // collect.
  void read_sum(std::uint32_t i, const Node& root) {
    const std::uint32_t first = terms_, first_factor = factors_;
    Contents contents = 0;
    bool may_repeat = false, has_zero = false;
    std::uint32_t waiting = 0;
    const Node* node = &root;
    for (bool negative = false;;) {
      sums_[waiting++] = node->b.negated_if(negative);
      Ref at = node->a.negated_if(negative);
      while (kind(at) != Kind::kTerms) {
        const Term& term = append_leaf(at);
        const Contents bit = contents_of(term);
        may_repeat |= (contents & bit) != 0;
        contents |= bit;
        has_zero |= term.coefficient == 0.0;
        if (waiting == 0) {
          if (has_zero || (may_repeat && repeats(first))) collect(i, first, first_factor);
          return add_node(i, first);
        }
        at = sums_[--waiting];
      }
      node = &dag_.node(at);
      negative = at.negative();
    }
  }

  // What a sum may hold: each list of factors is one of 64 bits. A sum of different ones has no
  // factors in common, and nothing to collect.
  using Contents = std::uint64_t;
  Contents contents_of(const Term& term) const {
    std::uint64_t of = 0xffffffffU;
    if (term.count > 0) of = system_.factors[term.first];
    if (term.count > 1) {
      of += std::uint64_t{system_.factors[term.first + term.count - 1]} << 32U;
    }
    return Contents{1} << (of * 0x9e3779b97f4a7c15U >> 58U);  // 2^64 / golden ratio
  }

  bool repeats(std::uint32_t first) const {
    for (std::uint32_t a = first + 1; a < terms_; ++a) {
      for (std::uint32_t b = first; b < a; ++b) {
        if (same_factors(system_, system_.terms[a], system_.terms[b])) return true;
      }
    }
    return false;
  }

  // Reads the last sum again, one sum inside it after the other: terms are collected in the order
  // in which they were added.
  void collect(std::uint32_t root, std::uint32_t first, std::uint32_t first_factor) {
    const auto begin = system_.factors.begin();
    released_.insert(released_.end(), begin + first_factor, begin + factors_);
    factors_ = first_factor;
    std::vector<std::uint32_t> inner = {root};
    for (std::size_t k = 0; k < inner.size(); ++k) {
      const Node& node = dag_.node(inner[k]);
      for (const Ref operand : {node.a, node.b}) {
        if (kind(operand) == Kind::kTerms) inner.push_back(operand.node());
      }
    }
    std::sort(inner.begin(), inner.end());
    const std::size_t room = system_.terms.size();
    std::vector<std::vector<Term>> terms(inner.size());
    for (std::size_t k = 0; k < inner.size(); ++k) {
      const Node& node = dag_.node(inner[k]);
      terms_ = first;
      std::uint32_t distinct = first;
      for (const Ref operand : {node.a, node.b}) {
        distinct = terms_;
        if (kind(operand) != Kind::kTerms) {
          append_leaf(operand);
          continue;
        }
        const auto at = std::lower_bound(inner.begin(), inner.end(), operand.node());
        for (Term term : terms[static_cast<std::size_t>(at - inner.begin())]) {
          term.coefficient *= sign_of(operand);
          system_.terms[terms_++] = term;
        }
      }
      system_.terms.resize(terms_);
      system_.collect_last_terms(first, distinct);
      terms_ = static_cast<std::uint32_t>(system_.terms.size());
      system_.terms.resize(room);
      terms[k].assign(system_.terms.begin() + first, system_.terms.begin() + terms_);
    }
    for (const Term& term : terms.back()) {
      const auto factors = system_.factors_of(term);
      retained_.insert(retained_.end(), factors.begin(), factors.end());
    }
  }

  // Uses of constants by what is neither sum nor product.
  void count_constants(const Node& node) {
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < arity(node.op); ++k) count_constant(operands[k]);
  }
  void count_constant(Ref ref) {
    if (kind(ref) == Kind::kConstant) ++uses_[ref.node()];
  }

  void hand_over_uses() {
    for (const Ref result : system_.graph.results) count_constant(result);
    system_.uses = std::move(uses_);
    for (const std::uint32_t factor : retained_) ++system_.uses[factor];
    for (const std::uint32_t factor : released_) system_.release(factor);
  }

  Polynomials& system_;
  const Dag& dag_;
  std::uint32_t operations_ = 0;           // sums and products that are live
  std::uint32_t terms_ = 0, factors_ = 0;  // that have been appended
  // Of each node: before it is read, by whom it is used (kBySum, kByProduct), then as the system
  // has it.
  std::vector<std::uint32_t> uses_;
  std::unique_ptr<Kind[]> kinds_;                   // of live nodes that have been read
  std::unique_ptr<double[]> coefficients_;          // what they give to that of a product
  std::unique_ptr<Ref[]> waiting_, sums_;           // operands that are still to be looked at
  std::vector<std::uint32_t> retained_, released_;  // factors of sums that were collected
};

void Polynomials::read() {
  if (!is_read_) SumReader(*this).run();
  is_read_ = true;
}

}  // namespace sinew::program
