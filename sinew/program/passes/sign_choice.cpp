#include "sinew/program/passes/sign_choice.h"

#include <algorithm>

namespace sinew::program {
namespace {

constexpr int kNegation = 4;
// Of a sum whose product a compiler may leave alone after all.
constexpr int kPerhaps = 1;

// How far one goes from a negation, with how many more than before on the way, and how many values
// are tried for each.
constexpr unsigned kDepth = 5;
constexpr int kMostOnTheWay = kNegation;
constexpr unsigned kTrials = 64;
constexpr int kRounds = 3;

}  // namespace

SignChoice::SignChoice(std::uint32_t values)
    : values_(values), wants_(values, 0), turned_(values, 0) {
  operands_.reserve(std::size_t{values} * 3);
}

void SignChoice::set(std::uint32_t value, SignRule rule, std::span<const Ref> operands) {
  values_[value] = {static_cast<std::uint32_t>(operands_.size()),
                    static_cast<std::uint32_t>(operands.size()), rule};
  operands_.insert(operands_.end(), operands.begin(), operands.end());
}

// Of each value, the ones behind each other that pay something for its sign.
void SignChoice::find_users() {
  const auto for_each_use = [this](auto visit) {
    for (std::uint32_t i = 0; i < values_.size(); ++i) {
      const std::span<const Ref> all = operands(i);
      for (std::size_t k = 0; k < all.size(); ++k) {
        const auto before = all.first(k);
        const bool repeats = std::any_of(before.begin(), before.end(),
                                         [&](Ref other) { return other.node() == all[k].node(); });
        if (!repeats) visit(all[k].node(), i);
      }
    }
  };
  users_from_.assign(values_.size() + 1, 0);
  for_each_use([this](std::uint32_t used, std::uint32_t) { ++users_from_[used + 1]; });
  for (std::size_t i = 1; i < users_from_.size(); ++i) users_from_[i] += users_from_[i - 1];
  users_.resize(users_from_.back());
  std::vector<std::uint32_t> next(users_from_.begin(), users_from_.end() - 1);
  for_each_use([&](std::uint32_t used, std::uint32_t by) { users_[next[used]++] = by; });
}

// Of computing it from what there is.
int SignChoice::cost(std::uint32_t value) const {
  const SignRule rule = values_[value].rule;
  if (rule == SignRule::kFixed || rule == SignRule::kAny) return 0;
  const std::span<const Ref> all = operands(value);
  const auto negative = [&](Ref ref) { return ref.negative() != is_turned(ref.node()); };
  const bool turned = turned_[value] != 0;
  switch (rule) {
    case SignRule::kSum:
    case SignRule::kFusedSum: {
      const bool both = negative(all[0]) != turned && negative(all[1]) != turned;
      return !both ? 0 : rule == SignRule::kSum ? kNegation : kPerhaps;
    }
    case SignRule::kProduct:
      return (negative(all[0]) != negative(all[1])) != turned ? kNegation : 0;
    default: {
      const auto count =
          std::count_if(all.begin(), all.end(), [&](Ref ref) { return negative(ref) != turned; });
      return kNegation * static_cast<int>(count);
    }
  }
}

int SignChoice::cost_of_results(std::uint32_t value) const {
  const std::uint8_t costs = turned_[value] != 0 ? kPositive : kNegative;
  return (wants_[value] & costs) != 0 ? kNegation : 0;
}

std::uint32_t SignChoice::negations() const {
  int sum = 0;
  for (std::uint32_t i = 0; i < values_.size(); ++i) {
    sum += cost(i) / kNegation + cost_of_results(i) / kNegation;
  }
  return static_cast<std::uint32_t>(sum);
}

// Returns what it costs more.
int SignChoice::turn(std::uint32_t value) {
  const auto around = [&] {
    int sum = cost(value) + cost_of_results(value);
    for (const std::uint32_t user : users(value)) sum += cost(user);
    return sum;
  };
  const int before = around();
  turned_[value] ^= 1U;
  return around() - before;
}

// Turns a value and what follows, if there are fewer negations then. `balance`: how many more there
// are on the way.
bool SignChoice::pays_to_turn(std::uint32_t value, int balance, unsigned depth) {
  if (is_fixed(value) || trials_ == 0) return false;
  if (std::find(path_.begin(), path_.end(), value) != path_.end()) return false;
  --trials_;
  balance += turn(value);
  if (balance < 0) return true;
  if (depth > 0 && balance <= kMostOnTheWay) {
    path_.push_back(value);
    bool pays = pays_to_turn_some(value, balance, depth - 1);
    for (const std::uint32_t user : users(value)) {
      pays = pays || pays_to_turn_some(user, balance, depth - 1);
    }
    path_.pop_back();
    if (pays) return true;
  }
  turn(value);
  return false;
}

// The same for a value that needs a negation, or what it reads.
bool SignChoice::pays_to_turn_some(std::uint32_t reader, int balance, unsigned depth) {
  if (cost(reader) < kNegation) return false;
  if (pays_to_turn(reader, balance, depth)) return true;
  for (const Ref operand : operands(reader)) {
    if (pays_to_turn(operand.node(), balance, depth)) return true;
  }
  return false;
}

void SignChoice::run() {
  find_users();
  bool pays = true;
  for (int round = 0; pays && round < kRounds; ++round) {
    pays = false;
    for (auto value = static_cast<std::uint32_t>(values_.size()); value-- > 0;) {
      trials_ = kTrials;
      if (cost_of_results(value) > 0) pays = pays_to_turn(value, 0, kDepth) || pays;
      trials_ = kTrials;
      pays = pays_to_turn_some(value, 0, kDepth) || pays;
    }
  }
}

}  // namespace sinew::program
