#include "sinew/program/limbs/record_limbs.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>
#include <vector>

#include "sinew/program/interface.h"
#include "sinew/program/kernels.h"
#include "sinew/program/limbs/limb_signs.h"

namespace sinew::program {
namespace {

using Sources = std::vector<LimbSource>;  // one for each lane

LimbSource constant(double value) {
  LimbSource source;
  source.value = value;
  return source;
}

// Numbers by their hashes, with open addressing.
class SourceIndex {
 public:
  // The number of this hash that `is` the one, or the place for it: kTrunk.
  template <typename Is>
  std::uint32_t& find(std::uint64_t hash, Is is) {
    if (2 * (taken_ + 1) > places_.size()) grow();
    for (std::size_t at = hash & (places_.size() - 1);; at = (at + 1) & (places_.size() - 1)) {
      Place& place = places_[at];
      if (place.number == kTrunk) {
        ++taken_;
        place.hash = hash;
        return place.number;
      }
      if (place.hash == hash && is(place.number)) return place.number;
    }
  }

 private:
  struct Place {
    std::uint64_t hash = 0;
    std::uint32_t number = kTrunk;
  };
  void grow() {
    std::vector<Place> old(2 * places_.size());
    std::swap(old, places_);
    for (const Place& place : old) {
      if (place.number == kTrunk) continue;
      std::size_t at = place.hash & (places_.size() - 1);
      while (places_[at].number != kTrunk) at = (at + 1) & (places_.size() - 1);
      places_[at] = place;
    }
  }

  std::vector<Place> places_ = std::vector<Place>(64);
  std::size_t taken_ = 0;
};

// A closure of the trunk, or corresponding closures of limbs.
struct Unit {
  std::uint32_t group = kTrunk;
  std::vector<std::uint32_t> closures;  // one for each lane
  std::uint32_t level = 0;
};

class Recorder {
 public:
  Recorder(const Program& program, const Limbs& limbs)
      : program_(program), limbs_(limbs), home_(program.variables.size()) {
    kernels_.reserve(program.closures.size());
    for (const Closure& closure : program.closures) {
      kernels_.push_back(find_kernel(closure.operation));
    }
  }

  LimbProgram run() {
    arrange();
    const Interface interface = interface_of(program_);
    result_.inputs = interface.in_size;
    place_inputs(interface.inputs);
    for (const Unit& unit : units_) record(unit);
    for (const Slot& slot : interface.outputs) {
      for (std::uint32_t k = 0; k < program_.variables[slot.variable].size; ++k) {
        result_.results.push_back(source_of(slot.variable, k));
      }
    }
    return std::move(result_);
  }

  // Whether some limb needs a result of another one on the way: then they are not side by side.
  bool circular() const { return circular_; }

 private:
  // Where the numbers of a variable are.
  struct Home {
    std::uint32_t region = kTrunk;  // kTrunk: not computed
    std::uint32_t lane = 0;
    std::vector<Ref> refs;          // in the region's graph
    std::vector<LimbSource> given;  // of inputs
  };

  // Units in the order of the schedule, each in the first region of its kind that can have it:
  // levels count how often the way to it changes between trunk and limbs.
  void arrange() {
    std::vector<std::uint32_t> writer(program_.variables.size(), kTrunk);  // unit
    std::vector<bool> done(program_.closures.size(), false);
    // A row is in place when all its closures are.
    std::vector<std::vector<std::uint32_t>> missing;
    for (const LimbGroup& group : limbs_.groups) {
      missing.emplace_back(group.closures.size(), group.lanes);
    }
    for (const std::uint32_t index : program_.schedule) {
      const std::uint32_t group = limbs_.group[index];
      Unit unit;
      unit.group = group;
      if (group == kTrunk) {
        unit.closures = {index};
      } else {
        if (--missing[group][limbs_.row[index]] > 0) continue;
        unit.closures = limbs_.groups[group].closures[limbs_.row[index]];
      }
      units_.push_back(std::move(unit));
    }
    for (std::uint32_t u = 0; u < units_.size(); ++u) {
      for_arguments(units_[u], [&](std::uint32_t variable, bool output, std::uint32_t) {
        if (output) writer[variable] = u;
      });
    }
    // A limb's closures may have been scheduled far apart: order the units by what they need.
    std::vector<std::uint32_t> order;
    std::vector<std::uint8_t> state(units_.size(), 0);
    const auto visit = [&](std::uint32_t u, const auto& self) -> void {
      if (state[u] == 2) return;
      if (state[u] == 1) {
        circular_ = true;
        return;
      }
      state[u] = 1;
      for_arguments(units_[u], [&](std::uint32_t variable, bool output, std::uint32_t) {
        if (output || writer[variable] == kTrunk) return;
        const std::uint32_t by = writer[variable];
        self(by, self);
        const std::uint32_t step = units_[by].group != units_[u].group ? 1 : 0;
        units_[u].level = std::max(units_[u].level, units_[by].level + step);
      });
      state[u] = 2;
      order.push_back(u);
    };
    for (std::uint32_t u = 0; u < units_.size(); ++u) visit(u, visit);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> levels;  // and place in `order`
    for (std::uint32_t at = 0; at < order.size(); ++at) {
      levels.emplace_back(units_[order[at]].level, at);
    }
    std::sort(levels.begin(), levels.end());
    std::vector<Unit> sorted;
    for (const auto& [unused, at] : levels) sorted.push_back(std::move(units_[order[at]]));
    units_ = std::move(sorted);
  }

  template <typename Visit>
  void for_arguments(const Unit& unit, Visit visit) const {
    for (std::uint32_t lane = 0; lane < unit.closures.size(); ++lane) {
      const Closure& closure = program_.closures[unit.closures[lane]];
      const Kernel& kernel = *kernels_[unit.closures[lane]];
      for (std::size_t i = 0; i < closure.arguments.size(); ++i) {
        visit(closure.arguments[i], kernel.port(i, closure.arguments.size()).output, lane);
      }
    }
  }

  void place_inputs(const std::vector<Slot>& slots) {
    for (const Slot& slot : slots) {
      for (std::uint32_t k = 0; k < program_.variables[slot.variable].size; ++k) {
        LimbSource source;
        source.kind = LimbSource::Kind::kCaller;
        source.index = slot.offset + k;
        home_[slot.variable].given.push_back(source);
      }
    }
  }

  // The region of this level and kind.
  std::uint32_t region_of(const Unit& unit) {
    const auto [at, is_new] = region_index_.try_emplace(
        {unit.level, unit.group}, static_cast<std::uint32_t>(result_.regions.size()));
    if (is_new) {
      LimbRegion region;
      region.lanes = static_cast<std::uint32_t>(unit.closures.size());
      result_.regions.push_back(std::move(region));
      input_index_.emplace_back();
      result_index_.emplace_back();
    }
    return at->second;
  }

  // A number of a variable, for whoever does not compute in the variable's own region.
  LimbSource source_of(std::uint32_t variable, std::uint32_t k) {
    const Variable& v = program_.variables[variable];
    if (v.role == Role::kConstant) return constant(v.value[k]);
    const Home& home = home_[variable];
    if (home.region == kTrunk) return home.given[k];
    LimbRegion& region = result_.regions[home.region];
    const Ref ref = home.refs[k];
    const Dag& dag = region.computation.dag;
    if (dag.is_constant(ref)) return constant(dag.constant_value(ref));
    if (dag.node(ref).op == Op::kInput) {
      const LimbSource& source = region.inputs[dag.node(ref).index][home.lane];
      // What the caller hands over has no sign: then the region hands it on.
      if (!ref.negative()) return source;
      if (source.kind != LimbSource::Kind::kCaller) return negated(source);
    }
    auto& results = region.computation.results;
    std::vector<std::uint32_t>& index = result_index_[home.region];
    if (index.size() <= ref.node()) index.resize(dag.size(), kTrunk);
    std::uint32_t& at = index[ref.node()];
    if (at == kTrunk) {
      at = static_cast<std::uint32_t>(results.size());
      results.push_back(ref.magnitude());
    }
    LimbSource source;
    source.kind = LimbSource::Kind::kRegion;
    source.index = at;
    source.region = home.region;
    source.lane = home.lane;
    source.negative = ref.negative();
    return source;
  }

  // Bit for bit: 0 and -0 are two constants.
  static bool same(const Sources& a, const Sources& b) {
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [](const LimbSource& x, const LimbSource& y) {
          return x == y &&
                 std::bit_cast<std::uint64_t>(x.value) == std::bit_cast<std::uint64_t>(y.value);
        });
  }
  static std::uint64_t hash(const Sources& sources) {
    std::uint64_t h = 0;
    const auto mix = [&](std::uint64_t part) {
      h = (h ^ part) * 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio
      h ^= h >> 29U;
    };
    for (const LimbSource& s : sources) {
      mix(static_cast<std::uint64_t>(s.kind) << 1U | (s.negative ? 1U : 0U));
      mix(std::uint64_t{s.index} << 32U | s.region);
      mix(s.lane);
      mix(std::bit_cast<std::uint64_t>(s.value));
    }
    return h;
  }

  // The number, one source for each lane, in a region's graph. Changes their signs.
  Traced in_region(std::uint32_t region, Sources& sources) {
    Dag& dag = result_.regions[region].computation.dag;
    const auto equal = [&](const LimbSource& source) { return source == sources[0]; };
    const bool all_constant = std::all_of(sources.begin(), sources.end(), [](const LimbSource& s) {
      return s.kind == LimbSource::Kind::kConstant;
    });
    if (all_constant && std::all_of(sources.begin(), sources.end(), equal)) {
      return Traced(sources[0].value);
    }
    // Vectors that differ in the sign of all lanes are one input.
    const auto first = std::find_if(sources.begin(), sources.end(), [](const LimbSource& s) {
      return s.kind != LimbSource::Kind::kConstant || s.value != 0.0;
    });
    const bool turn = all_constant ? first->value < 0
                                   : std::all_of(sources.begin(), sources.end(),
                                                 [](const LimbSource& s) { return s.negative; });
    if (turn) {
      for (LimbSource& source : sources) source = negated(source);
    }
    std::vector<std::vector<LimbSource>>& inputs = result_.regions[region].inputs;
    std::uint32_t input = static_cast<std::uint32_t>(inputs.size());
    std::uint32_t& known = input_index_[region].find(
        hash(sources), [&](std::uint32_t other) { return same(inputs[other], sources); });
    if (known == kTrunk) {
      known = input;
      inputs.push_back(sources);
    }
    input = known;
    const Ref ref = dag.input(input);
    return Traced(dag, turn ? -ref : ref);
  }

  void record(const Unit& unit) {
    const std::uint32_t region = region_of(unit);
    const Closure& closure = program_.closures[unit.closures[0]];
    const Kernel& kernel = *kernels_[unit.closures[0]];
    const std::size_t count = closure.arguments.size();
    if (values_.size() < count) values_.resize(count);
    sizes_.clear();
    arguments_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t size = program_.variables[closure.arguments[i]].size;
      sizes_.push_back(size);
      values_[i].assign(size, Traced());
      arguments_.push_back(values_[i].data());
      if (kernel.port(i, count).output) continue;
      for (std::uint32_t k = 0; k < size; ++k) values_[i][k] = read(unit, region, i, k);
    }
    Dag& dag = result_.regions[region].computation.dag;
    dag.set_origin(unit.closures[0]);
    if (kernel.many()) {
      kernel.trace_many(arguments_.data(), sizes_);
    } else {
      kernel.trace(arguments_.data());
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!kernel.port(i, count).output) continue;
      for (std::uint32_t lane = 0; lane < unit.closures.size(); ++lane) {
        Home& home = home_[program_.closures[unit.closures[lane]].arguments[i]];
        home.region = region;
        home.lane = lane;
        home.refs.clear();
        for (const Traced& number : values_[i]) home.refs.push_back(number.in(dag));
      }
    }
  }

  Traced read(const Unit& unit, std::uint32_t region, std::size_t argument, std::uint32_t k) {
    // In its own region, lane by lane: the number itself.
    bool own = true;
    for (std::uint32_t lane = 0; lane < unit.closures.size(); ++lane) {
      const std::uint32_t variable = program_.closures[unit.closures[lane]].arguments[argument];
      const Home& home = home_[variable];
      own = own && home.region == region && home.lane == lane;
    }
    if (own) {
      Dag& dag = result_.regions[region].computation.dag;
      return Traced(dag, home_[program_.closures[unit.closures[0]].arguments[argument]].refs[k]);
    }
    sources_.clear();
    for (const std::uint32_t closure : unit.closures) {
      const std::uint32_t variable = program_.closures[closure].arguments[argument];
      if (home_[variable].region == region) circular_ = true;
      sources_.push_back(source_of(variable, k));
    }
    return in_region(region, sources_);
  }

  const Program& program_;
  const Limbs& limbs_;
  std::vector<const Kernel*> kernels_;  // of closures
  std::vector<Unit> units_;
  std::vector<Home> home_;  // by variable
  LimbProgram result_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> region_index_;
  std::vector<SourceIndex> input_index_;                  // of each region
  std::vector<std::vector<std::uint32_t>> result_index_;  // by node; kTrunk: no result yet
  bool circular_ = false;
  // Of the unit, or the number, that is being recorded.
  std::vector<std::vector<Traced>> values_;
  std::vector<std::uint32_t> sizes_;
  std::vector<Traced*> arguments_;
  Sources sources_;
};

}  // namespace

std::optional<LimbProgram> record_limbs(const Program& program, const Limbs& limbs) {
  Recorder recorder(program, limbs);
  LimbProgram result = recorder.run();
  if (recorder.circular()) return std::nullopt;
  return result;
}

}  // namespace sinew::program
