#include "sinew/program/limbs/limb_program.h"

#include <algorithm>
#include <chrono>

#include "sinew/program/interface.h"
#include "sinew/program/limbs/find_limbs.h"
#include "sinew/program/limbs/limb_signs.h"
#include "sinew/program/limbs/record_limbs.h"

namespace sinew::program {
namespace {

// More lanes than a vector register has would be several vectors: that saves little.
constexpr std::uint32_t kMaximumLanes = 8;
constexpr double kLeastSaving = 0.2;
// Every joint of a serial arm looks like the others as far as its position alone goes: limbs of so
// few closures do not pay, and are not worth recording to find that out.
constexpr std::size_t kLeastClosures = 4;

// Optimises every region, the last one first, without what nobody needs.
void optimise_regions(LimbProgram& program, OptimiseOptions options) {
  options.choose_signs = false;
  std::vector<std::vector<bool>> wanted;
  for (const LimbRegion& region : program.regions) {
    wanted.emplace_back(region.computation.results.size(), false);
  }
  const auto want = [&](const LimbSource& source) {
    if (source.kind == LimbSource::Kind::kRegion) wanted[source.region][source.index] = true;
  };
  for (const LimbSource& source : program.results) want(source);
  std::vector<std::vector<std::uint32_t>> moved(program.regions.size());
  for (std::size_t r = program.regions.size(); r-- > 0;) {
    LimbRegion& region = program.regions[r];
    std::vector<Ref> results;
    moved[r].resize(wanted[r].size());
    for (std::size_t k = 0; k < wanted[r].size(); ++k) {
      if (!wanted[r][k]) continue;
      moved[r][k] = static_cast<std::uint32_t>(results.size());
      results.push_back(region.computation.results[k]);
    }
    region.computation.results = std::move(results);
    region.computation.inputs = static_cast<std::uint32_t>(region.inputs.size());
    region.computation = optimise(std::move(region.computation), options);
    const std::vector<std::uint8_t> live = live_nodes(region.computation);
    for (std::uint32_t i = 0; i < region.computation.dag.size(); ++i) {
      const Node& node = region.computation.dag.node(i);
      if (!live[i] || node.op != Op::kInput) continue;
      for (const LimbSource& source : region.inputs[node.index]) want(source);
    }
  }
  const auto renumber = [&](LimbSource& source) {
    if (source.kind == LimbSource::Kind::kRegion) source.index = moved[source.region][source.index];
  };
  for (LimbSource& source : program.results) renumber(source);
  for (LimbRegion& region : program.regions) {
    for (auto& sources : region.inputs) {
      for (LimbSource& source : sources) renumber(source);
    }
  }
}

void choose_signs_of(LimbProgram& program, const OptimiseOptions& options) {
  if (!options.trace) return choose_signs(program);
  PassReport report;
  report.name = "choose signs of limbs";
  report.before = program.operations();
  report.negations_before = count_negations(program);
  const auto start = std::chrono::steady_clock::now();
  choose_signs(program);
  report.time_us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  report.after = program.operations();
  report.negations_after = count_negations(program);
  for (const LimbRegion& region : program.regions) {
    report.nodes_after += region.computation.dag.size();
  }
  options.trace(report);
}

void add(OperationCount& sum, const OperationCount& more) {
  sum.add += more.add;
  sum.multiply += more.multiply;
  sum.divide += more.divide;
  sum.sqrt += more.sqrt;
  sum.sincos += more.sincos;
  sum.select += more.select;
}

double weight(const OperationCount& n) { return n.add + n.multiply + 5.0 * (n.divide + n.sqrt); }

}  // namespace

OperationCount LimbProgram::operations() const {
  OperationCount sum;
  for (const LimbRegion& region : regions) add(sum, count_operations(region.computation));
  return sum;
}

std::optional<LimbProgram> side_by_side(const Program& program, const OptimiseOptions& options) {
  // A state has two values in one evaluation, before and after it is written: order matters.
  if (interface_of(program).state_size > 0) return std::nullopt;
  Limbs limbs = find_limbs(program);
  // Groups that a vector cannot hold, or that are too small, stay with the trunk.
  for (std::uint32_t& group : limbs.group) {
    if (group != kTrunk && (limbs.groups[group].lanes > kMaximumLanes ||
                            limbs.groups[group].closures.size() < kLeastClosures)) {
      group = kTrunk;
    }
  }
  if (std::all_of(limbs.group.begin(), limbs.group.end(),
                  [](std::uint32_t group) { return group == kTrunk; })) {
    return std::nullopt;
  }
  std::optional<LimbProgram> result = record_limbs(program, limbs);
  if (!result) return std::nullopt;
  optimise_regions(*result, options);
  choose_signs_of(*result, options);
  return result;
}

bool pays(const LimbProgram& limbs, const OperationCount& scalar) {
  return weight(limbs.operations()) <= (1 - kLeastSaving) * weight(scalar);
}

std::optional<LimbProgram> limb_program(const Program& program, const OperationCount& scalar,
                                        const OptimiseOptions& options) {
  std::optional<LimbProgram> limbs = side_by_side(program, options);
  return limbs && pays(*limbs, scalar) ? std::move(limbs) : std::nullopt;
}

std::vector<double> evaluate(const LimbProgram& program, const std::vector<double>& inputs) {
  std::vector<std::vector<std::vector<double>>> results;  // [region][lane][result]
  const auto value = [&](const LimbSource& source) {
    switch (source.kind) {
      case LimbSource::Kind::kCaller:
        return inputs[source.index];
      case LimbSource::Kind::kConstant:
        return source.value;
      default: {
        const double number = results[source.region][source.lane][source.index];
        return source.negative ? -number : number;
      }
    }
  };
  for (const LimbRegion& region : program.regions) {
    std::vector<std::vector<double>> lanes;
    for (std::uint32_t lane = 0; lane < region.lanes; ++lane) {
      std::vector<double> in;
      for (const auto& sources : region.inputs) in.push_back(value(sources[lane]));
      lanes.push_back(evaluate(region.computation, in));
    }
    results.push_back(std::move(lanes));
  }
  std::vector<double> out;
  for (const LimbSource& source : program.results) out.push_back(value(source));
  return out;
}

}  // namespace sinew::program
