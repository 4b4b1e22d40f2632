// A scalar that records what is done with it in a Dag. Instantiating a function of `math` with it,
// once, gives the function's data-flow graph. A number that has not yet met a graph is a plain
// constant.
#pragma once

#include <cmath>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

class Traced {
 public:
  Traced() = default;
  Traced(double value) : value_(value) {}  // NOLINT(google-explicit-constructor): S(0) in formulas
  Traced(Dag& dag, Ref ref) : dag_(&dag), ref_(ref) {}

  // The node in `dag` that holds this value.
  Ref in(Dag& dag) const { return dag_ != nullptr ? ref_ : dag.constant(value_); }

  friend Traced operator-(const Traced& a) {
    return a.dag_ != nullptr ? Traced(*a.dag_, -a.ref_) : Traced(-a.value_);
  }
  friend Traced operator+(const Traced& a, const Traced& b) {
    Dag* dag = either(a, b);
    return dag != nullptr ? Traced(*dag, dag->add(a.in(*dag), b.in(*dag)))
                          : Traced(Dag::sum_of_constants(a.value_, b.value_));
  }
  friend Traced operator-(const Traced& a, const Traced& b) { return a + -b; }
  friend Traced operator*(const Traced& a, const Traced& b) {
    Dag* dag = either(a, b);
    return dag != nullptr ? Traced(*dag, dag->multiply(a.in(*dag), b.in(*dag)))
                          : Traced(a.value_ * b.value_);
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    Dag* dag = either(a, b);
    return dag != nullptr ? Traced(*dag, dag->divide(a.in(*dag), b.in(*dag)))
                          : Traced(a.value_ / b.value_);
  }
  friend Traced sqrt(const Traced& a) {
    return a.dag_ != nullptr ? Traced(*a.dag_, a.dag_->sqrt(a.ref_)) : Traced(std::sqrt(a.value_));
  }
  friend Traced sin(const Traced& a) {
    return a.dag_ != nullptr ? Traced(*a.dag_, a.dag_->sin(a.ref_)) : Traced(std::sin(a.value_));
  }
  friend Traced cos(const Traced& a) {
    return a.dag_ != nullptr ? Traced(*a.dag_, a.dag_->cos(a.ref_)) : Traced(std::cos(a.value_));
  }
  // Whether it is known, while recording, to be this number.
  friend bool is_exactly(const Traced& a, double value) {
    return a.dag_ != nullptr ? a.dag_->is_constant(a.ref_, value) : a.value_ == value;
  }
  friend bool is_same(const Traced& a, const Traced& b) {
    Dag* dag = either(a, b);
    return dag != nullptr ? a.in(*dag) == b.in(*dag) : a.value_ == b.value_;
  }
  // `x` where a < b, otherwise `y`; formulas of `math` call it instead of branching.
  friend Traced select_less(const Traced& a, const Traced& b, const Traced& x, const Traced& y) {
    Dag* dag = either(a, b);
    if (dag == nullptr) return a.value_ < b.value_ ? x : y;
    return Traced(*dag, dag->select(dag->less(a.in(*dag), b.in(*dag)), x.in(*dag), y.in(*dag)));
  }

 private:
  static Dag* either(const Traced& a, const Traced& b) {
    return a.dag_ != nullptr ? a.dag_ : b.dag_;
  }

  Dag* dag_ = nullptr;
  Ref ref_;
  double value_ = 0.0;  // where dag_ is null
};

}  // namespace sinew::program
