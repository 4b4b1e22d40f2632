#include "sinew/backend/jit/sample_steps.h"

#include <algorithm>

namespace sinew::backend {

using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Node;
using program::Op;
using program::Ref;

RegionInput kind_of_input(const LimbRegion& region, std::uint32_t input) {
  const std::vector<LimbSource>& sources = region.inputs[input];
  const auto all_are = [&](LimbSource::Kind kind) {
    return std::all_of(sources.begin(), sources.end(),
                       [kind](const LimbSource& source) { return source.kind == kind; });
  };
  if (all_are(LimbSource::Kind::kConstant)) return RegionInput::kConstant;
  if (region.lanes == 1 && all_are(LimbSource::Kind::kCaller)) return RegionInput::kCaller;
  return RegionInput::kGathered;
}

namespace {

std::vector<std::uint32_t> first_values(const LimbProgram& program) {
  std::vector<std::uint32_t> first = {0};
  for (const LimbRegion& region : program.regions) {
    first.push_back(first.back() + region.computation.dag.size());
  }
  return first;
}

}  // namespace

SampleSteps::SampleSteps(const LimbProgram& program,
                         const std::vector<ComputationEmitter>& emitters,
                         const std::vector<ResultPair>& pairs,
                         const std::vector<std::uint32_t>& later)
    : program_(program),
      emitters_(emitters),
      first_(first_values(program)),
      defined_(first_.back(), false),
      registers_(first_.back()) {
  for (const ResultPair& pair : pairs) {
    stored_with_[value(pair.region, pair.later)].push_back(value(pair.region, pair.earlier()));
  }
  for (std::uint32_t region = 0; region < program.regions.size(); ++region) {
    for (const std::uint32_t node : emitters[region].order()) {
      if (emitters[region].is_statement(node)) add(region, node);
    }
  }
  for (const std::uint32_t result : later) read_source(program.results[result]);
  registers_.end();
}

RegionNode SampleSteps::node_of(std::uint32_t value) const {
  const auto behind = std::upper_bound(first_.begin(), first_.end(), value);
  const auto region = static_cast<std::uint32_t>(behind - first_.begin() - 1);
  return {region, value - first_[region]};
}

void SampleSteps::add(std::uint32_t region, std::uint32_t node) {
  const ComputationEmitter& emitter = emitters_[region];
  emitter.for_each_operand(node, [&](std::uint32_t operand) { gather(region, operand); });
  emitter.for_each_operand(node,
                           [&](std::uint32_t operand) { registers_.read(value(region, operand)); });
  define(region, node);
}

void SampleSteps::define(std::uint32_t region, std::uint32_t node) {
  const std::uint32_t defined = value(region, node);
  const auto earlier = stored_with_.find(defined);
  if (earlier != stored_with_.end()) {
    for (const std::uint32_t read : earlier->second) registers_.read(read);
  }
  registers_.define(defined);
  registers_.set_width(
      defined, static_cast<std::uint8_t>(program::vector_width(program_.regions[region].lanes)));
  registers_.end();
  defined_[defined] = true;
  nodes_.push_back({region, node});
}

// A step that makes an input of a region, before the first one that needs it.
void SampleSteps::gather(std::uint32_t region, std::uint32_t node) {
  const LimbRegion& of = program_.regions[region];
  const Node& input = of.computation.dag.node(node);
  if (input.op != Op::kInput || defined_[value(region, node)]) return;
  if (kind_of_input(of, input.index) != RegionInput::kGathered) return;
  for (const LimbSource& source : of.inputs[input.index]) read_source(source);
  define(region, node);
}

void SampleSteps::read_source(const LimbSource& source) {
  if (source.kind != LimbSource::Kind::kRegion) return;
  const LimbRegion& other = program_.regions[source.region];
  const Ref result = other.computation.results[source.index];
  const Node& node = other.computation.dag.node(result);
  const std::uint32_t read = value(source.region, result.node());
  if (node.op == Op::kInput && !defined_[read]) {
    read_source(other.inputs[node.index][source.lane]);
  } else if (node.op != Op::kConstant) {
    registers_.read(read);
  }
}

}  // namespace sinew::backend
