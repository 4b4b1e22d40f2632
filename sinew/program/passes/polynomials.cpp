#include "sinew/program/passes/polynomials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sinew/program/passes/associate.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/uses.h"

namespace sinew::program {
namespace {

class Reader {
 public:
  explicit Reader(Computation graph) {
    uses_ = use_counts(graph);
    system_.graph = std::move(graph);
    system_.is_polynomial.assign(dag().size(), false);
    system_.polynomial.resize(dag().size());
  }

  Polynomials run() {
    for (std::uint32_t i = 0; i < dag().size(); ++i) {
      if (uses_[i] == 0) continue;
      const Node& node = dag().node(i);
      Polynomial& polynomial = system_.polynomial[i];
      if (node.op == Op::kAdd) {
        add_terms(node.a, polynomial);
        add_terms(node.b, polynomial);
        collect_terms(polynomial);
      } else if (node.op == Op::kMultiply) {
        Monomial& monomial = polynomial.terms.emplace_back();
        add_factors(node.a, monomial);
        add_factors(node.b, monomial);
        std::sort(monomial.factors.begin(), monomial.factors.end());
      } else {
        continue;
      }
      polynomial.origin = node.origin;
      system_.is_polynomial[i] = true;
    }
    return std::move(system_);
  }

 private:
  const Dag& dag() const { return system_.graph.dag; }

  bool taken_up(std::uint32_t i) const { return uses_[i] == 1 && system_.is_polynomial[i]; }

  void add_terms(Ref ref, Polynomial& polynomial) {
    const std::uint32_t i = ref.node();
    const double sign = ref.negative() ? -1.0 : 1.0;
    if (dag().is_constant(ref)) {
      polynomial.terms.push_back({dag().constant_value(ref), {}});
    } else if (taken_up(i)) {
      Monomials& inner = system_.polynomial[i].terms;
      for (Monomial& term : inner) term.coefficient *= sign;
      if (polynomial.terms.empty()) {
        polynomial.terms.swap(inner);
      } else {
        for (Monomial& term : inner) polynomial.terms.push_back(std::move(term));
      }
      inner.clear();
    } else {
      polynomial.terms.push_back({sign, {i}});
    }
  }

  void add_factors(Ref ref, Monomial& monomial) {
    const std::uint32_t i = ref.node();
    if (dag().is_constant(ref)) {
      monomial.coefficient *= dag().constant_value(ref);
      return;
    }
    if (ref.negative()) monomial.coefficient = -monomial.coefficient;
    if (taken_up(i) && system_.polynomial[i].terms.size() == 1) {
      const Monomial& inner = system_.polynomial[i].terms.front();
      monomial.coefficient *= inner.coefficient;
      monomial.factors.append(inner.factors.begin(), inner.factors.end());
      system_.polynomial[i].terms.clear();
    } else {
      monomial.factors.push_back(i);
    }
  }

  std::vector<std::uint32_t> uses_;
  Polynomials system_;
};

// Builds the graph again, operands first.
class Writer {
 public:
  Writer(const Polynomials& system, Association association)
      : system_(system),
        association_(association),
        associate_(result_.dag, association),
        copy_(system.polynomial.size()) {
    done_.assign(copy_.size(), false);
    result_.inputs = system.graph.inputs;
    result_.dag.reserve(static_cast<std::uint32_t>(copy_.size() + copy_.size() / 4));
  }

  Computation run() {
    if (association_ == Association::kFused) slack_from(system_.graph);
    // Old nodes in their order, so that recursion is no deeper than what passes have added.
    const std::vector<std::uint32_t> uses = use_counts(system_);
    for (std::uint32_t i = 0; i < system_.graph.dag.size(); ++i) {
      if (uses[i] > 0) copy(i);
    }
    for (const Ref result : system_.graph.results) {
      result_.results.push_back(copy(result.node()).negated_if(result.negative()));
    }
    return std::move(result_);
  }

 private:
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
    if (done_[i]) return copy_[i];
    if (system_.is_polynomial[i]) {
      const Polynomial& polynomial = system_.polynomial[i];
      SignedProducts terms;
      terms.reserve(polynomial.terms.size());
      for (const Monomial& term : polynomial.terms) {
        SignedProduct product{term.coefficient, {}};
        for (const std::uint32_t factor : term.factors) product.factors.push_back(copy(factor));
        terms.push_back(std::move(product));
      }
      result_.dag.set_origin(polynomial.origin);
      const bool known = i < deadline_.size();
      copy_[i] = associate_.sum(terms, known ? deadline_[i] : 0.0);
    } else {
      const Node& node = system_.graph.dag.node(i);
      const int operands = arity(node.op);
      const auto operand = [this](Ref r) { return copy(r.node()).negated_if(r.negative()); };
      const Ref a = operands > 0 ? operand(node.a) : Ref{};
      const Ref b = operands > 1 ? operand(node.b) : Ref{};
      const Ref c = operands > 2 ? operand(node.c) : Ref{};
      result_.dag.set_origin(node.origin);
      copy_[i] = result_.dag.make(node, a, b, c);
    }
    done_[i] = true;
    return copy_[i];
  }

  const Polynomials& system_;
  Association association_;
  Computation result_;
  Associator associate_;
  std::vector<double> deadline_;
  std::vector<Ref> copy_;
  std::vector<bool> done_;
};

}  // namespace

std::uint32_t Polynomials::add(Polynomial added) {
  is_polynomial.push_back(true);
  polynomial.push_back(std::move(added));
  return static_cast<std::uint32_t>(polynomial.size() - 1);
}

Polynomials read_polynomials(Computation graph) { return Reader(std::move(graph)).run(); }

std::vector<std::uint32_t> use_counts(const Polynomials& system) {
  std::vector<std::uint32_t> uses(system.polynomial.size(), 0);
  std::vector<std::uint32_t> todo;
  const auto use = [&](std::uint32_t i) {
    if (uses[i]++ == 0) todo.push_back(i);
  };
  for (const Ref result : system.graph.results) use(result.node());
  while (!todo.empty()) {
    const std::uint32_t i = todo.back();
    todo.pop_back();
    if (system.is_polynomial[i]) {
      for (const Monomial& term : system.polynomial[i].terms) {
        for (const std::uint32_t factor : term.factors) use(factor);
      }
      continue;
    }
    const Node& node = system.graph.dag.node(i);
    const int operands = arity(node.op);
    if (operands > 0) use(node.a.node());
    if (operands > 1) use(node.b.node());
    if (operands > 2) use(node.c.node());
  }
  return uses;
}

void collect_terms(Polynomial& polynomial) {
  Monomials& terms = polynomial.terms;
  // Mostly there is nothing to collect.
  bool distinct = true;
  for (std::size_t a = 0; a < terms.size() && distinct; ++a) {
    distinct = terms[a].coefficient != 0.0;
    for (std::size_t b = 0; b < a && distinct; ++b) distinct = terms[a].factors != terms[b].factors;
  }
  if (distinct) return;
  Monomials kept;
  for (Monomial& term : terms) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Monomial& other) {
      return other.factors == term.factors;
    });
    if (same == kept.end()) {
      kept.push_back(std::move(term));
    } else {
      same->coefficient = Dag::sum_of_constants(same->coefficient, term.coefficient);
    }
  }
  std::erase_if(kept, [](const Monomial& term) { return term.coefficient == 0.0; });
  terms = std::move(kept);
}

Computation write_polynomials(const Polynomials& system, Association association) {
  return Writer(system, association).run();
}

}  // namespace sinew::program
