// Sums of products as a graph again.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sinew/program/passes/associate.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/polynomials.h"

namespace sinew::program {
namespace {

// Builds the graph again, operands first.
class Writer {
 public:
  Writer(const Polynomials& system, Association association)
      : system_(system),
        association_(association),
        associate_(result_.dag, association),
        copy_(system.sums.size(), kNotYet) {
    result_.inputs = system.graph.inputs;
    result_.dag.reserve(static_cast<std::uint32_t>(copy_.size() + copy_.size() / 4));
  }

  Computation run() {
    if (association_ == Association::kFused) slack_from(system_.graph);
    // Old nodes in their order, so that recursion is no deeper than what passes have added.
    for (const std::uint32_t i : system_.nodes) {
      if (i < system_.graph.dag.size() && system_.uses[i] > 0) copy(i);
    }
    result_.results.reserve(system_.graph.results.size());
    for (const Ref result : system_.graph.results) {
      result_.results.push_back(copy(result.node()).negated_if(result.negative()));
    }
    return std::move(result_);
  }

 private:
  static constexpr Ref kNotYet{0xffffffffU};

  // When each node of the old graph has to be ready so that the longest path grows no longer.
  void slack_from(const Computation& old) {
    const std::vector<double> tails = times_to_the_end(old);
    ReadyTimes ready(old.dag);
    double longest = 0.0;
    for (const Ref result : old.results) longest = std::max(longest, ready.of(result));
    deadline_.resize(old.dag.size());
    for (std::uint32_t i = 0; i < deadline_.size(); ++i) deadline_[i] = longest - tails[i];
  }

  Ref copy(std::uint32_t i) {
    if (copy_[i] == kNotYet) {
      copy_[i] = system_.kinds[i] != SumKind::kNone ? copy_of_sum(i) : copy_of_operation(i);
    }
    return copy_[i];
  }

  Ref copy_of_sum(std::uint32_t i) {
    const std::span<const Term> terms = system_.terms_of(i);
    if (system_.kinds[i] == SumKind::kOfAdded) {
      for (const Term& term : terms) {
        for (const std::uint32_t factor : system_.factors_of(term)) copy(factor);
      }
    }
    result_.dag.set_origin(system_.sums[i].origin);
    if (association_ == Association::kPlain) return plain_sum(terms);
    associate_.begin();
    for (const Term& term : terms) {
      associate_.add(term.coefficient, system_.factors_of(term), terms.size() == 1,
                     [this](std::uint32_t factor) { return copy_[factor]; });
    }
    return associate_.end(i < deadline_.size() ? deadline_[i] : 0.0);
  }

  // All products first, then their sum, both from left to right.
  Ref plain_sum(std::span<const Term> terms) {
    Dag& dag = result_.dag;
    if (terms.size() == 1) return plain_product(terms[0]);
    if (terms.empty()) return dag.constant(0.0);
    values_.clear();
    for (const Term& term : terms) values_.push_back(plain_product(term));
    Ref sum = values_.front();
    for (std::size_t k = 1; k < values_.size(); ++k) sum = dag.add(sum, values_[k]);
    return sum;
  }

  Ref plain_product(const Term& term) {
    Dag& dag = result_.dag;
    const std::uint32_t* factor = system_.factors.data() + term.first;
    const std::uint32_t* const last = factor + term.count;
    const bool scaled = std::abs(term.coefficient) != 1.0;
    Ref product;
    if (!scaled & (term.count > 0)) {
      product = {copy_[*factor].bits ^ std::uint32_t{std::signbit(term.coefficient)}};
      if (++factor == last) return product;
    } else {
      product = dag.constant(term.coefficient);
    }
    for (; factor != last; ++factor) product = dag.multiply(product, copy_[*factor]);
    return product;
  }

  Ref copy_of_operation(std::uint32_t i) {
    const Node& node = system_.graph.dag.node(i);
    const int operands = arity(node.op);
    const auto operand = [this](Ref r) { return copy(r.node()).negated_if(r.negative()); };
    const Ref a = operands > 0 ? operand(node.a) : Ref{};
    const Ref b = operands > 1 ? operand(node.b) : Ref{};
    const Ref c = operands > 2 ? operand(node.c) : Ref{};
    result_.dag.set_origin(node.origin);
    return result_.dag.make(node, a, b, c);
  }

  const Polynomials& system_;
  Association association_;
  Computation result_;
  Associator associate_;
  std::vector<double> deadline_;
  std::vector<Ref> copy_;
  std::vector<Ref> values_;  // terms of the sum that is being written
};

}  // namespace

void Polynomials::write(Association association) {
  graph = Writer(*this, association).run();
  is_read_ = false;
}

}  // namespace sinew::program
