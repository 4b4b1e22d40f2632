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

// Closures that look alike get the same colour: what they do, and how their arguments came about.
std::vector<Colour> colours(const Program& program) {
  std::vector<Colour> of_variable(program.variables.size());
  for (std::size_t i = 0; i < of_variable.size(); ++i) {
    const Variable& v = program.variables[i];
    of_variable[i] = mix(mix(of_text(v.quantity), v.size), static_cast<Colour>(v.role));
  }
  std::vector<Colour> result(program.closures.size(), 0);
  for (const std::uint32_t index : program.schedule) {
    const Closure& closure = program.closures[index];
    const Kernel& kernel = *find_kernel(closure.operation);
    Colour colour = mix(of_text(closure.operation), of_text(closure.step));
    const std::size_t count = closure.arguments.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (!kernel.port(i, count).output) colour = mix(colour, of_variable[closure.arguments[i]]);
    }
    result[index] = colour;
    for (std::size_t i = 0; i < count; ++i) {
      if (kernel.port(i, count).output) of_variable[closure.arguments[i]] = mix(colour, i);
    }
  }
  return result;
}

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
  const std::vector<Colour> colour = colours(program);
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
