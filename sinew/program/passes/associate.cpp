#include "sinew/program/passes/associate.h"

#include <algorithm>
#include <utility>

namespace sinew::program {

namespace {

// Moves the last one to its place among the others, which are in their order; behind its equals.
template <typename T, typename Before>
void sort_last_in(std::span<T> list, Before before) {
  for (std::size_t k = list.size() - 1; k > 0 && before(list[k], list[k - 1]); --k) {
    std::swap(list[k], list[k - 1]);
  }
}

// As std::stable_sort, without a buffer: the lists are short.
template <typename T, typename Before>
void sort_stably(std::span<T> list, Before before) {
  for (std::size_t i = 2; i <= list.size(); ++i) sort_last_in(list.first(i), before);
}

constexpr auto kEarlier = [](const auto& a, const auto& b) { return a.ready < b.ready; };
constexpr auto kLater = [](const auto& a, const auto& b) { return a.ready > b.ready; };

}  // namespace

// The product of the factors, from left to right.
Ref Associator::multiply(double coefficient, std::span<const Timed> factors) {
  const bool scaled = factors.empty() || (coefficient != 1.0 && coefficient != -1.0);
  Ref result = scaled ? dag_.constant(coefficient) : factors[0].ref.negated_if(coefficient < 0.0);
  for (const Timed& factor : factors.subspan(scaled ? 0 : 1)) {
    result = dag_.multiply(result, factor.ref);
  }
  return result;
}

void Associator::add(double coefficient, bool alone) {
  // The factors that are ready first are multiplied first.
  const std::span<Timed> factors = factors_;
  sort_stably(factors, kEarlier);
  const bool scaled = coefficient != 1.0 && coefficient != -1.0;
  if (association_ == Association::kFused && !alone && factors.size() + (scaled ? 1 : 0) >= 2) {
    const Timed a = timed(multiply(coefficient, factors.first(factors.size() - 1)));
    const Timed& b = factors.back();
    products_.push_back({a.ref, b.ref, std::max(a.ready, b.ready)});
  } else {
    values_.push_back(timed(multiply(coefficient, factors)));
  }
}

Ref Associator::end(double deadline) {
  if (association_ == Association::kFused) return fused_sum(deadline);
  return shallow_sum();
}

// As Huffman (1952) for codes: always the two that are ready first.
Ref Associator::shallow_sum() {
  if (values_.empty()) return dag_.constant(0.0);
  sort_stably<Timed>(values_, kLater);
  while (values_.size() > 1) {
    const Ref a = values_.back().ref;
    values_.pop_back();
    values_.back() = timed(dag_.add(values_.back().ref, a));
    sort_last_in<Timed>(values_, kLater);
  }
  return values_.front().ref;
}

// When a chain is ready that adds one product after the other to the sum of the values.
double Associator::chain_time() {
  times_.clear();
  for (const Timed& value : values_) times_.push_back(value.ready);
  std::sort(times_.begin(), times_.end());
  double sum = times_.empty() ? 0.0 : times_.front();
  for (std::size_t k = 1; k < times_.size(); ++k) {
    sum = std::max(sum, times_[k]) + latency(Op::kAdd);
  }
  for (const Product& product : products_) sum = std::max(sum, product.ready) + latency(Op::kFma);
  return sum;
}

Ref Associator::fused_sum(double deadline) {
  if (products_.empty()) return shallow_sum();
  sort_stably<Product>(products_, kEarlier);
  std::span<const Product> products = products_;
  if (values_.empty()) {
    values_.push_back(timed(dag_.multiply(products.front().a, products.front().b)));
    products_.erase(products_.begin());
    products = products_;
  }
  const bool chain = chain_time() <= deadline;
  if (chain) {
    const Ref sum = shallow_sum();
    values_ = {timed(sum)};
  }
  for (const Product& product : products) {
    // A value that is not ready when this product could be is better left to a later one.
    const auto value = std::min_element(values_.begin(), values_.end(), kEarlier);
    if (chain || value->ready <= product.ready + latency(Op::kMultiply)) {
      *value = timed(dag_.fma(product.a, product.b, value->ref));
    } else {
      values_.push_back(timed(dag_.multiply(product.a, product.b)));
    }
  }
  return shallow_sum();
}

}  // namespace sinew::program
