#include "sinew/program/limbs/find_limbs.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
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
      : program_(program), colour_(program.closures.size(), 0) {}

  // By what closures do and how their arguments came about, then also by what becomes of their
  // results: a spine looks like a leg as far as it goes, but it carries arms. Again as long as that
  // tells more of them apart (refinement of colours, after Weisfeiler and Leman, 1968).
  std::vector<Colour> refined() {
    constexpr int kMaximumRounds = 16;
    forward();
    for (int round = 0; round < kMaximumRounds; ++round) {
      const std::size_t before = members_.size();
      backward();
      forward();
      if (members_.size() == before) break;
    }
    return colour_;
  }

 private:
  // Calls visit(variable, is output, port).
  template <typename Visit>
  void for_arguments(const Closure& closure, Visit visit) const {
    const Kernel& kernel = *find_kernel(closure.operation);
    const std::size_t count = closure.arguments.size();
    for (std::size_t i = 0; i < count; ++i) {
      visit(closure.arguments[i], kernel.port(i, count).output, i);
    }
  }

  void forward() {
    std::vector<Colour> of_variable(program_.variables.size());
    for (std::size_t i = 0; i < of_variable.size(); ++i) {
      const Variable& v = program_.variables[i];
      of_variable[i] = mix(mix(of_text(v.quantity), v.size), static_cast<Colour>(v.role));
    }
    for (const std::uint32_t index : program_.schedule) {
      const Closure& closure = program_.closures[index];
      Colour colour = mix(mix(colour_[index], of_text(closure.operation)), of_text(closure.step));
      for_arguments(closure, [&](std::uint32_t variable, bool output, std::size_t) {
        if (!output) colour = mix(colour, of_variable[variable]);
      });
      colour_[index] = colour;
      for_arguments(closure, [&](std::uint32_t variable, bool output, std::size_t port) {
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
      const Closure& closure = program_.closures[index];
      const bool unique = members_[colour_[index]] < 2;
      Colour results = 0;
      for_arguments(closure, [&](std::uint32_t variable, bool output, std::size_t port) {
        if (output)
          results += is_sum(closure) ? of_variable[variable] : mix(of_variable[variable], port);
      });
      const Colour use = is_sum(closure) ? results
                         : unique        ? of_text(closure.operation)
                                         : mix(colour_[index], results);
      if (!unique) colour_[index] = mix(colour_[index], results);
      // Users come in any order.
      for_arguments(closure, [&](std::uint32_t variable, bool output, std::size_t port) {
        if (!output) of_variable[variable] += is_sum(closure) || unique ? use : mix(use, port);
      });
    }
    count();
  }

  static bool is_sum(const Closure& closure) {
    return closure.operation.starts_with("accumulate-") || closure.operation == "add-energy";
  }

  void count() {
    members_.clear();
    for (const std::uint32_t index : program_.schedule) ++members_[colour_[index]];
  }

  const Program& program_;
  std::vector<Colour> colour_;
  std::unordered_map<Colour, std::uint32_t> members_;
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
  const std::vector<Colour> colour = Colours(program).refined();
  std::unordered_map<Colour, std::uint32_t> members;
  for (const std::uint32_t index : program.schedule) ++members[colour[index]];
  const auto in_trunk = [&](std::uint32_t index) { return members[colour[index]] < 2; };

  // Whoever writes and whoever reads a variable are of the same limb, unless one is of the trunk.
  Sets sets(n);
  std::vector<std::uint32_t> writer(program.variables.size(), kTrunk);
  for (const std::uint32_t index : program.schedule) {
    if (in_trunk(index)) continue;
    const Closure& closure = program.closures[index];
    const Kernel& kernel = *find_kernel(closure.operation);
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
      keyed.push_back({colour[closures[at]], at});
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
