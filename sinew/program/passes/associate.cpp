#include "sinew/program/passes/associate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::program {

namespace {

// As std::stable_sort, without a buffer: the lists are short.
template <typename List, typename Before>
void sort_stably(List& list, Before before) {
  for (std::size_t i = 1; i < list.size(); ++i) {
    for (std::size_t k = i; k > 0 && before(list[k], list[k - 1]); --k) {
      std::swap(list[k], list[k - 1]);
    }
  }
}

}  // namespace

// The product of factors first..last, from left to right; the coefficient belongs to the first.
Ref Associator::multiply(SignedProduct& term, std::size_t first, std::size_t last) {
  const double coefficient = first == 0 ? term.coefficient : 1.0;
  if (first == last || std::abs(coefficient) != 1.0) {
    Ref result = dag_.constant(coefficient);
    for (std::size_t k = first; k < last; ++k) result = dag_.multiply(result, term.factors[k]);
    return result;
  }
  Ref result = term.factors[first].negated_if(coefficient < 0.0);
  for (std::size_t k = first + 1; k < last; ++k) result = dag_.multiply(result, term.factors[k]);
  return result;
}

Ref Associator::sum(SignedProducts& terms, double deadline) {
  Values values;
  Products products;
  for (SignedProduct& term : terms) {
    auto& factors = term.factors;
    if (factors.size() > 1) {
      // The factors that are ready first are multiplied first.
      sort_stably(factors, [this](Ref a, Ref b) { return ready_.of(a) < ready_.of(b); });
    }
    const std::size_t n = factors.size();
    const bool scaled = term.coefficient != 1.0 && term.coefficient != -1.0;
    if (association_ == Association::kFused && terms.size() > 1 && n + (scaled ? 1 : 0) >= 2) {
      const Ref a = multiply(term, 0, n - 1);
      const Ref b = factors[n - 1];
      products.push_back({a, b, std::max(ready_.of(a), ready_.of(b))});
    } else {
      values.push_back(multiply(term, 0, n));
    }
  }
  if (association_ == Association::kFused) {
    return fused_sum(values, products, deadline);
  }
  return shallow_sum(values);
}

// Adds the two values that are ready first.
void Associator::combine_first_two(Values& values) {
  sort_stably(values, [this](Ref a, Ref b) { return ready_.of(a) > ready_.of(b); });
  const Ref a = values.back();
  values.pop_back();
  const Ref b = values.back();
  values.pop_back();
  values.push_back(dag_.add(b, a));
}

// As Huffman (1952) for codes: always the two that are ready first.
Ref Associator::shallow_sum(Values& values) {
  while (values.size() > 1) combine_first_two(values);
  return values.empty() ? dag_.constant(0.0) : values.front();
}

// When a chain is ready that adds one product after the other to the sum of the values.
double Associator::chain_time(const Values& values, const Products& products) {
  SmallList<double, 8> times;
  for (const Ref value : values) times.push_back(ready_.of(value));
  std::sort(times.begin(), times.end());
  double sum = times.empty() ? 0.0 : times.front();
  for (std::size_t k = 1; k < times.size(); ++k) {
    sum = std::max(sum, times[k]) + latency(Op::kAdd);
  }
  for (const Product& product : products) sum = std::max(sum, product.ready) + latency(Op::kFma);
  return sum;
}

Ref Associator::fused_sum(Values& values, Products& products, double deadline) {
  sort_stably(products, [](const Product& a, const Product& b) { return a.ready < b.ready; });
  const auto earliest = [&] {
    return std::min_element(values.begin(), values.end(),
                            [this](Ref a, Ref b) { return ready_.of(a) < ready_.of(b); });
  };
  if (values.empty() && !products.empty()) {
    values.push_back(dag_.multiply(products.front().a, products.front().b));
    products.erase(products.begin());
  }
  const bool chain = chain_time(values, products) <= deadline;
  if (chain) values = {shallow_sum(values)};
  for (const Product& product : products) {
    // A value that is not ready when this product could be is better left to a later one.
    const auto value = earliest();
    if (chain || ready_.of(*value) <= product.ready + latency(Op::kMultiply)) {
      *value = dag_.fma(product.a, product.b, *value);
    } else {
      values.push_back(dag_.multiply(product.a, product.b));
    }
  }
  return shallow_sum(values);
}

}  // namespace sinew::program
