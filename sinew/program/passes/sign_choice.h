// A sign for each of many values, so that few have to be negated: the problem that choose_signs()
// and limbs hand over, without what the values are.
//
// A value can be computed as it is or as its negative. What reads it takes that into account, most
// of all at no cost: a sum with one sign turned is a difference, a fused multiply-add exists with
// every sign, a constant factor turns its own. A negation is left where a sum needs both its
// operands negative, where a product has the wrong sign, and where a result does.
//
// The least number of negations is hard to find in general (each product is an equation of three
// signs). What is done: wherever one is left, a value is turned and then what follows from it, a
// few values far, as long as that may pay.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

enum class SignRule : std::uint8_t {
  kFixed,       // has the sign that it has
  kAny,         // can be computed with either sign: a fused multiply-add, a multiple of a constant
  kSum,         // of two operands, not both negative
  kFusedSum,    // the same, but compilers fuse a product into it: then all signs are free
  kProduct,     // of two operands: its sign is the product of theirs
  kEach,        // one of its operands, or all of them side by side, each with the value's own sign
  kEachOfFixed  // the same for a value whose sign is fixed
};

class SignChoice {
 public:
  explicit SignChoice(std::uint32_t values);

  // A Ref is a value with a sign here. A value of which nothing is said is kFixed.
  void set(std::uint32_t value, SignRule rule, std::span<const Ref> operands);
  void set(std::uint32_t value, SignRule rule, std::initializer_list<Ref> operands = {}) {
    set(value, rule, std::span<const Ref>(operands.begin(), operands.size()));
  }
  // A result is this.
  void want(Ref result) { wants_[result.node()] |= result.negative() ? kNegative : kPositive; }

  // How many negations are left. Of the results that are the negative of a value, the first counts.
  std::uint32_t negations() const;

  void run();

  // Turns a value unless its sign is fixed: says whether.
  bool turn_if_free(std::uint32_t value) {
    if (!is_fixed(value)) turned_[value] ^= 1U;
    return !is_fixed(value);
  }

  // Whether the value's negative is computed instead.
  bool is_turned(std::uint32_t value) const { return turned_[value] != 0; }

 private:
  static constexpr std::uint8_t kPositive = 1, kNegative = 2;

  struct Value {
    std::uint32_t first = 0;  // in operands_
    std::uint32_t count = 0;
    SignRule rule = SignRule::kFixed;
  };

  std::span<const Ref> operands(std::uint32_t value) const {
    return {operands_.data() + values_[value].first, values_[value].count};
  }
  std::span<const std::uint32_t> users(std::uint32_t value) const {
    return {users_.data() + users_from_[value], users_from_[value + 1] - users_from_[value]};
  }
  bool is_fixed(std::uint32_t value) const {
    return values_[value].rule == SignRule::kFixed || values_[value].rule == SignRule::kEachOfFixed;
  }
  void find_users();
  int cost(std::uint32_t value) const;
  int cost_of_results(std::uint32_t value) const;
  int turn(std::uint32_t value);
  bool pays_to_turn(std::uint32_t value, int balance, unsigned depth);
  bool pays_to_turn_some(std::uint32_t reader, int balance, unsigned depth);

  std::vector<Value> values_;
  std::vector<Ref> operands_;
  std::vector<std::uint32_t> users_, users_from_;
  std::vector<std::uint8_t> wants_, turned_;
  std::vector<std::uint32_t> path_;  // values that are being tried
  unsigned trials_ = 0;
};

}  // namespace sinew::program
