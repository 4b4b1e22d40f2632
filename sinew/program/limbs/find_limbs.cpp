#include "sinew/program/limbs/find_limbs.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "sinew/program/kernels.h"

namespace sinew::program {
namespace {

using Colour = std::uint64_t;

Colour mix(Colour colour, Colour more) {
  // splitmix64's finaliser (Steele, Lea and Flood, 2014)
  Colour x = colour * 0x9e3779b97f4a7c15U + more + 0x632be59bd9b4e019U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

Colour of_text(const std::string& text) { return std::hash<std::string>{}(text); }

// Colours of a program's closures: those that look alike have the same one.
class Colours {
 public:
  explicit Colours(const Program& program)
      : program_(program),
        colour_(program.closures.size(), 0),
        is_unique_(program.closures.size(), 0),
        firsts_(std::bit_ceil(2 * program.closures.size() + 1), 0) {
    facts_.reserve(program.closures.size());
    for (const Closure& closure : program.closures) {
      facts_.push_back({find_kernel(closure.operation), of_text(closure.operation),
                        of_text(closure.step), is_sum(closure)});
    }
    for (const Variable& v : program.variables)
      first_.push_back(mix(mix(of_text(v.quantity), v.size), static_cast<Colour>(v.role)));
  }

  // By what closures do and how their arguments came about, then also by what becomes of their
  // results: a spine looks like a leg as far as it goes, but it carries arms. Again as long as that
  // tells more of them apart (refinement of colours, after Weisfeiler and Leman, 1968).
  const std::vector<Colour>& refined() {
    constexpr int kMaximumRounds = 16;
    forward();
    for (int round = 0; round < kMaximumRounds; ++round) {
      const std::size_t before = colours_;
      backward();
      forward();
      if (colours_ == before) break;
    }
    return colour_;
  }

  // Whether no other closure has the closure's colour.
  bool is_unique(std::uint32_t closure) const { return is_unique_[closure] != 0; }
  const Kernel& kernel(std::uint32_t closure) const { return *facts_[closure].kernel; }

 private:
  // What does not change from round to round.
  struct Facts {
    const Kernel* kernel;
    Colour operation, step;
    bool is_sum;
  };

  // Calls visit(variable, is output, port).
  template <typename Visit>
  void for_arguments(std::uint32_t index, Visit visit) const {
    const Closure& closure = program_.closures[index];
    const Kernel& kernel = *facts_[index].kernel;
    const std::size_t count = closure.arguments.size();
    for (std::size_t i = 0; i < count; ++i) {
      visit(closure.arguments[i], kernel.port(i, count).output, i);
    }
  }

  void forward() {
    std::vector<Colour> of_variable = first_;
    for (const std::uint32_t index : program_.schedule) {
      Colour colour = mix(mix(colour_[index], facts_[index].operation), facts_[index].step);
      for_arguments(index, [&](std::uint32_t variable, bool output, std::size_t) {
        if (!output) colour = mix(colour, of_variable[variable]);
      });
      colour_[index] = colour;
      for_arguments(index, [&](std::uint32_t variable, bool output, std::size_t port) {
        if (output) of_variable[variable] = mix(colour, port);
      });
    }
    count();
  }

  // A closure like no other is of the trunk. Where several limbs end in the trunk, they are summed
  // up one after the other: what becomes of a term is what becomes of the sum, and of a closure of
  // the trunk only its operation counts, not the place.
  void backward() {
    std::vector<Colour> of_variable(program_.variables.size());
    for (std::size_t i = 0; i < of_variable.size(); ++i) {
      of_variable[i] = program_.variables[i].output ? 1 : 0;
    }
    for (std::size_t k = program_.schedule.size(); k-- > 0;) {
      const std::uint32_t index = program_.schedule[k];
      const bool sum = facts_[index].is_sum;
      const bool unique = is_unique_[index] != 0;
      Colour results = 0;
      for_arguments(index, [&](std::uint32_t variable, bool output, std::size_t port) {
        if (output) results += sum ? of_variable[variable] : mix(of_variable[variable], port);
      });
      const Colour use = sum      ? results
                         : unique ? facts_[index].operation
                                  : mix(colour_[index], results);
      if (!unique) colour_[index] = mix(colour_[index], results);
      // Users come in any order.
      for_arguments(index, [&](std::uint32_t variable, bool output, std::size_t port) {
        if (!output) of_variable[variable] += sum || unique ? use : mix(use, port);
      });
    }
    count();
  }

  static bool is_sum(const Closure& closure) {
    return closure.operation.starts_with("accumulate-") || closure.operation == "add-energy";
  }

  // By a table with open addressing: a place holds the first closure of a colour, and one more.
  void count() {
    std::fill(firsts_.begin(), firsts_.end(), 0);
    const std::size_t mask = firsts_.size() - 1;
    colours_ = 0;
    for (const std::uint32_t index : program_.schedule) {
      std::size_t at = colour_[index] & mask;
      while (firsts_[at] != 0 && colour_[firsts_[at] - 1] != colour_[index]) at = (at + 1) & mask;
      is_unique_[index] = firsts_[at] == 0 ? 1 : 0;
      if (firsts_[at] == 0) {
        firsts_[at] = index + 1;
        ++colours_;
      } else {
        is_unique_[firsts_[at] - 1] = 0;
      }
    }
  }

  const Program& program_;
  std::vector<Facts> facts_;             // of closures
  std::vector<Colour> first_;            // of variables that nobody has written
  std::vector<Colour> colour_;           // of closures
  std::vector<std::uint8_t> is_unique_;  // whether no other closure has a closure's colour
  std::vector<std::uint32_t> firsts_;    // with each colour
  std::size_t colours_ = 0;              // different ones
};

// Sets of closures, joined one by one.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Limbs find_limbs(const Program& program) {
  const std::size_t n = program.closures.size();
  Colours colours(program);
  const std::vector<Colour>& colour = colours.refined();
  const auto in_trunk = [&](std::uint32_t index) { return colours.is_unique(index); };

  // Whoever writes and whoever reads a variable are of the same limb, unless one is of the trunk.
  Sets sets(n);
  std::vector<std::uint32_t> writer(program.variables.size(), kTrunk);
  for (const std::uint32_t index : program.schedule) {
    if (in_trunk(index)) continue;
    const Closure& closure = program.closures[index];
    const Kernel& kernel = colours.kernel(index);
    const std::size_t count = closure.arguments.size();
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t& by = writer[closure.arguments[i]];
      if (kernel.port(i, count).output) {
        by = index;
      } else if (by != kTrunk) {
        sets.join(index, by);
      }
    }
  }

  // The closures of each set, corresponding ones at the same place; sets with the same colours
  // together, in the order of the schedule.
  std::map<std::uint32_t, std::vector<std::uint32_t>> limbs;
  std::vector<std::uint32_t> first_seen;
  for (const std::uint32_t index : program.schedule) {
    if (in_trunk(index)) continue;
    auto& closures = limbs[sets.of(index)];
    if (closures.empty()) first_seen.push_back(sets.of(index));
    closures.push_back(index);
  }
  std::map<std::vector<Colour>, std::vector<std::uint32_t>> alike;
  for (const std::uint32_t set : first_seen) {
    auto& closures = limbs[set];
    // The schedule's order among equals.
    std::vector<std::pair<Colour, std::uint32_t>> keyed;
    for (std::uint32_t at = 0; at < closures.size(); ++at)
      keyed.emplace_back(colour[closures[at]], at);
    std::sort(keyed.begin(), keyed.end());
    const std::vector<std::uint32_t> scheduled = std::exchange(closures, {});
    for (const auto& [unused, at] : keyed) closures.push_back(scheduled[at]);
    std::vector<Colour> key;
    for (const std::uint32_t index : closures) key.push_back(colour[index]);
    alike[key].push_back(set);
  }

  Limbs result;
  result.group.assign(n, kTrunk);
  result.row.assign(n, 0);
  result.lane.assign(n, 0);
  for (const auto& [key, sets_alike] : alike) {
    if (sets_alike.size() < 2) continue;
    LimbGroup group;
    group.lanes = static_cast<std::uint32_t>(sets_alike.size());
    group.closures.assign(key.size(), std::vector<std::uint32_t>(group.lanes));
    for (std::uint32_t lane = 0; lane < group.lanes; ++lane) {
      const auto& closures = limbs[sets_alike[lane]];
      for (std::uint32_t row = 0; row < closures.size(); ++row) {
        group.closures[row][lane] = closures[row];
        result.group[closures[row]] = static_cast<std::uint32_t>(result.groups.size());
        result.row[closures[row]] = row;
        result.lane[closures[row]] = lane;
      }
    }
    result.groups.push_back(std::move(group));
  }
  return result;
}

}  // namespace sinew::program
