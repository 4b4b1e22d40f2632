#include "sinew/program/passes/polynomials.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "sinew/program/passes/associate.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/uses.h"

namespace sinew::program {
namespace {

class Reader {
 public:
  explicit Reader(Polynomials& system) : system_(system), uses_(use_counts(system.graph)) {}

  void run() {
    const std::uint32_t n = dag().size();
    contents_ = std::make_unique_for_overwrite<Contents[]>(n);
    system_.is_sum.assign(n, 0);
    system_.sums.assign(n, {});
    system_.terms.clear();
    system_.factors.clear();
    system_.terms.reserve(n);
    system_.factors.reserve(2 * std::size_t{n});
    for (std::uint32_t i = 0; i < n; ++i) {
      if (uses_[i] == 0) continue;
      const Node& node = dag().node(i);
      if (node.op == Op::kAdd) {
        read_sum(i, node);
      } else if (node.op == Op::kMultiply) {
        read_product(i, node);
      }
    }
  }

 private:
  const Dag& dag() const { return system_.graph.dag; }
  std::uint32_t end() const { return static_cast<std::uint32_t>(system_.terms.size()); }

  bool taken_up(std::uint32_t i) const { return uses_[i] == 1 && system_.is_sum[i] != 0; }

  void read_sum(std::uint32_t i, const Node& node) {
    std::uint32_t first = end();
    // What the first operand has is mostly what has been read last: then its terms stay in place.
    const std::uint32_t a = node.a.node();
    const Sum& inner = system_.sums[a];
    if (taken_up(a) && inner.first + inner.count == first) first = inner.first;
    const Contents of_a = append_terms(node.a, first);
    const std::uint32_t distinct = end();
    const Contents of_b = append_terms(node.b, end());
    if ((of_a & of_b) != 0 || has_zero(distinct)) system_.collect_last_terms(first, distinct);
    contents_[i] = of_a | of_b;
    system_.sums[i] = {first, end() - first, node.origin};
    system_.is_sum[i] = 1;
  }

  // What a sum may hold: each list of factors is one of 64 bits. Two sums without a common bit have
  // no factors in common, and nothing to collect.
  using Contents = std::uint64_t;
  static Contents bit(std::uint64_t of) {
    return Contents{1} << (of * 0x9e3779b97f4a7c15U >> 58U);  // 2^64 / golden ratio
  }

  bool has_zero(std::uint32_t from) const {
    for (std::uint32_t k = from; k < end(); ++k) {
      if (system_.terms[k].coefficient == 0.0) return true;
    }
    return false;
  }

  // The terms of an operand, behind the others; where they are there already, `from` is their
  // place.
  Contents append_terms(Ref ref, std::uint32_t from) {
    const std::uint32_t i = ref.node();
    if (dag().is_constant(ref)) {
      system_.terms.push_back({dag().constant_value(ref), 0, 0});
      return bit(0xffffffffU);
    }
    const double sign = ref.negative() ? -1.0 : 1.0;
    if (!taken_up(i)) {
      system_.terms.push_back({sign, static_cast<std::uint32_t>(system_.factors.size()), 1});
      system_.factors.push_back(i);
      return bit(i);
    }
    Sum& inner = system_.sums[i];
    if (inner.first == from && inner.count > 0) {
      if (ref.negative()) {
        for (Term& term : system_.terms_of(i)) term.coefficient = -term.coefficient;
      }
    } else {
      for (std::uint32_t k = 0; k < inner.count; ++k) {
        Term term = system_.terms[inner.first + k];
        term.coefficient *= sign;
        system_.terms.push_back(term);
      }
    }
    inner.count = 0;
    return contents_[i];
  }

  void read_product(std::uint32_t i, const Node& node) {
    Term product{1.0, static_cast<std::uint32_t>(system_.factors.size()), 0};
    append_factors(node.a, product);
    append_factors(node.b, product);
    const auto from = system_.factors.begin() + product.first;
    product.count = static_cast<std::uint32_t>(system_.factors.end() - from);
    if (product.count == 2) {
      if (from[1] < from[0]) std::swap(from[0], from[1]);
    } else {
      std::sort(from, system_.factors.end());
    }
    contents_[i] = contents_of(product);
    system_.sums[i] = {end(), 1, node.origin};
    system_.terms.push_back(product);
    system_.is_sum[i] = 1;
  }

  Contents contents_of(const Term& product) const {
    if (product.count == 0) return bit(0xffffffffU);
    const auto factors = system_.factors_of(product);
    return bit(std::uint64_t{factors.front()} +
               (std::uint64_t{factors.back()} << 32U) * (product.count > 1 ? 1 : 0));
  }

  void append_factors(Ref ref, Term& product) {
    const std::uint32_t i = ref.node();
    if (dag().is_constant(ref)) {
      product.coefficient *= dag().constant_value(ref);
      return;
    }
    if (ref.negative()) product.coefficient = -product.coefficient;
    if (taken_up(i) && system_.sums[i].count == 1) {
      const Term inner = system_.terms[system_.sums[i].first];
      product.coefficient *= inner.coefficient;
      for (std::uint32_t k = 0; k < inner.count; ++k) {
        system_.factors.push_back(std::uint32_t(system_.factors[inner.first + k]));
      }
      system_.sums[i].count = 0;
    } else {
      system_.factors.push_back(i);
    }
  }

  Polynomials& system_;
  std::vector<std::uint32_t> uses_;
  std::unique_ptr<Contents[]> contents_;  // of each sum
};

// Builds the graph again, operands first.
class Writer {
 public:
  Writer(const Polynomials& system, Association association)
      : system_(system),
        association_(association),
        associate_(result_.dag, association),
        copy_(system.sums.size()) {
    done_.assign(copy_.size(), 0);
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
    if (done_[i] == 0) {
      copy_[i] = system_.is_sum[i] != 0 ? copy_of_sum(i) : copy_of_operation(i);
      done_[i] = 1;
    }
    return copy_[i];
  }

  Ref copy_of_sum(std::uint32_t i) {
    const std::span<const Term> terms = system_.terms_of(i);
    for (const Term& term : terms) {
      for (const std::uint32_t factor : system_.factors_of(term)) copy(factor);
    }
    result_.dag.set_origin(system_.sums[i].origin);
    if (association_ == Association::kPlain) return plain_sum(terms);
    products_.resize(terms.size());
    for (std::size_t k = 0; k < terms.size(); ++k) {
      SignedProduct& product = products_[k];
      product.coefficient = terms[k].coefficient;
      product.factors.clear();
      for (const std::uint32_t factor : system_.factors_of(terms[k])) {
        product.factors.push_back(copy_[factor]);
      }
    }
    return associate_.sum(products_, i < deadline_.size() ? deadline_[i] : 0.0);
  }

  // All products first, then their sum, both from left to right.
  Ref plain_sum(std::span<const Term> terms) {
    Dag& dag = result_.dag;
    values_.clear();
    for (const Term& term : terms) {
      const std::span<const std::uint32_t> factors = system_.factors_of(term);
      const bool scaled = factors.empty() || std::abs(term.coefficient) != 1.0;
      Ref product = scaled ? dag.constant(term.coefficient)
                           : copy_[factors[0]].negated_if(term.coefficient < 0.0);
      for (std::size_t k = scaled ? 0 : 1; k < factors.size(); ++k) {
        product = dag.multiply(product, copy_[factors[k]]);
      }
      values_.push_back(product);
    }
    if (values_.empty()) return dag.constant(0.0);
    Ref sum = values_.front();
    for (std::size_t k = 1; k < values_.size(); ++k) sum = dag.add(sum, values_[k]);
    return sum;
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
  std::vector<std::uint8_t> done_;
  std::vector<Ref> values_;  // terms of the sum that is being written
  SignedProducts products_;  // the same, not yet multiplied
};

}  // namespace

void Polynomials::read() {
  if (!is_read_) Reader(*this).run();
  is_read_ = true;
}

void Polynomials::write(Association association) {
  graph = Writer(*this, association).run();
  is_read_ = false;
}

Term Polynomials::term(double coefficient, std::span<const std::uint32_t> of) {
  const Term result{coefficient, static_cast<std::uint32_t>(factors.size()),
                    static_cast<std::uint32_t>(of.size())};
  factors.insert(factors.end(), of.begin(), of.end());
  return result;
}

std::uint32_t Polynomials::add_sum(std::uint32_t first, std::uint32_t origin) {
  is_sum.push_back(1);
  sums.push_back({first, static_cast<std::uint32_t>(terms.size()) - first, origin});
  return static_cast<std::uint32_t>(sums.size() - 1);
}

void Polynomials::collect_last_terms(std::uint32_t first, std::uint32_t distinct) {
  // Mostly there is nothing to collect.
  const std::span<Term> all(terms.data() + first, terms.size() - first);
  bool done = true;
  for (std::size_t a = distinct - first; a < all.size() && done; ++a) {
    done = all[a].coefficient != 0.0;
    for (std::size_t b = 0; b < a && done; ++b) done = !same_factors(*this, all[a], all[b]);
  }
  if (done) return;
  std::size_t kept = 0;
  for (const Term& term : all) {
    const auto same = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept),
                                   [&](const Term& t) { return same_factors(*this, t, term); });
    if (same == all.begin() + static_cast<std::ptrdiff_t>(kept)) {
      all[kept++] = term;
    } else {
      same->coefficient = Dag::sum_of_constants(same->coefficient, term.coefficient);
    }
  }
  terms.resize(first + kept);
  terms.erase(std::remove_if(terms.begin() + first, terms.end(),
                             [](const Term& term) { return term.coefficient == 0.0; }),
              terms.end());
}

std::vector<std::uint32_t> use_counts(const Polynomials& system) {
  std::vector<std::uint32_t> uses(system.sums.size(), 0);
  std::vector<std::uint32_t> todo;
  todo.reserve(uses.size());
  const auto use = [&](std::uint32_t i) {
    if (uses[i]++ == 0) todo.push_back(i);
  };
  for (const Ref result : system.graph.results) use(result.node());
  while (!todo.empty()) {
    const std::uint32_t i = todo.back();
    todo.pop_back();
    if (system.is_sum[i] != 0) {
      for (const Term& term : system.terms_of(i)) {
        for (const std::uint32_t factor : system.factors_of(term)) use(factor);
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

}  // namespace sinew::program
