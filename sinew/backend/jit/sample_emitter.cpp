#include "sinew/backend/jit/sample_emitter.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/constant_results.h"
#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/memory.h"
#include "sinew/backend/jit/result_pairs.h"
#include "sinew/backend/jit/sample_steps.h"
#include "sinew/program/limbs/limb_signs.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Node;
using program::Op;
using program::Ref;

// Steps in which sines and cosines come from the registers that they were computed in: those of
// the first joints, which all else waits for.
constexpr std::size_t kEarlySteps = 40;
// Steps for which what lies in memory is held from one reader to the next.
constexpr std::uint32_t kLongest = 20;

class SampleEmitter {
 public:
  SampleEmitter(const LimbProgram& program, const Place& place, LLVMTypeRef number)
      : program_(program), place_(place), number_(number), angles_(program.regions.size()) {
    for (std::uint32_t region = 0; region < program.regions.size(); ++region) {
      emitters_.emplace_back(program.regions[region].computation, place, type_of(region),
                             [this, region](std::uint32_t node) { return fetched(region, node); });
    }
  }

  void emit(std::uint32_t registers) {
    const std::vector<LLVMValueRef> packs = packs_of_angles();
    const std::vector<ResultPair> pairs = pair_results(program_, statements());
    sort_results(pairs);
    const SampleSteps steps(program_, emitters_, pairs, later_);
    steps_ = &steps;
    plan_ = plan_registers(steps.registers(), registers, kLongest);
    Memory memory(place_, number_, {program_.inputs, plan_.size, written_});
    memory_ = &memory;
    if (!packs.empty()) memory.write_sines(packs);
    // Its loops need registers for addresses, too: the others come afterwards.
    store_constant_results(place_.builder, number_, memory.results(), constants_);
    memory.begin();
    for (step_ = 0; step_ < steps.nodes().size(); ++step_) {
      const auto [region, node] = steps.nodes()[step_];
      compute(region, node);
      for (const std::uint32_t value : plan_.leaving[step_]) {
        const RegionNode left = steps.node_of(value);
        emitters_[left.region].forget(left.node);
      }
    }
    for (const std::uint32_t i : later_) memory.write_result(number(program_.results[i]), i);
    LLVMBuildRetVoid(place_.builder);
    memory.end();
  }

 private:
  LLVMTypeRef type_of(std::uint32_t region) const {
    const unsigned width = program::vector_width(program_.regions[region].lanes);
    return width == 1 ? number_ : LLVMVectorType(number_, width);
  }
  const Node& node_of(std::uint32_t region, std::uint32_t node) const {
    return program_.regions[region].computation.dag.node(node);
  }

  std::vector<std::vector<std::uint32_t>> statements() const {
    std::vector<std::vector<std::uint32_t>> of_regions;
    for (const ComputationEmitter& emitter : emitters_) {
      of_regions.push_back(emitter.order());
      std::erase_if(of_regions.back(),
                    [&](std::uint32_t node) { return !emitter.is_statement(node); });
    }
    return of_regions;
  }

  // Which results are written when, and those that are no operations.
  void sort_results(const std::vector<ResultPair>& pairs) {
    results_of_.resize(program_.regions.size());
    pairs_of_.resize(program_.regions.size());
    constants_.resize(program_.results.size());
    std::vector<bool> is_in_pair(program_.results.size(), false);
    for (const ResultPair& pair : pairs) {
      pairs_of_[pair.region][pair.later].push_back(pair);
      for (const ResultPair::Place& place : pair.places) {
        is_in_pair[place.left] = is_in_pair[place.left + 1] = true;
        written_.push_back(place.left);
      }
    }
    for (std::uint32_t i = 0; i < program_.results.size(); ++i) {
      if (is_in_pair[i]) continue;
      const LimbSource& source = program_.results[i];
      constants_[i] = constant(source);
      if (constants_[i]) continue;
      written_.push_back(i);
      if (source.kind == LimbSource::Kind::kRegion) {
        const Ref result = program_.regions[source.region].computation.results[source.index];
        if (emitters_[source.region].is_statement(result.node())) {
          results_of_[source.region][result.node()].push_back(i);
          continue;
        }
      }
      later_.push_back(i);
    }
  }

  // The value of a source that needs no computation.
  std::optional<double> constant(const LimbSource& source) const {
    if (source.kind == LimbSource::Kind::kConstant) return source.value;
    if (source.kind != LimbSource::Kind::kRegion) return std::nullopt;
    const Computation& of = program_.regions[source.region].computation;
    const Ref result = of.results[source.index].negated_if(source.negative);
    if (!of.dag.is_constant(result)) return std::nullopt;
    return of.dag.constant_value(result);
  }

  // All angles that the caller hands over, of all regions: what a region waits for is then under
  // way before the region in front of it is done. None lies across two vectors.
  std::vector<LLVMValueRef> packs_of_angles() {
    std::vector<RegionNode> nodes;
    for (std::uint32_t at = 0; at < program_.regions.size(); ++at) {
      const LimbRegion& region = program_.regions[at];
      for (const std::uint32_t node : emitters_[at].angles_that_are_inputs()) {
        const auto& sources = region.inputs[region.computation.dag.node(node).index];
        const bool from_caller = std::all_of(
            sources.begin(), sources.end(),
            [](const LimbSource& source) { return source.kind == LimbSource::Kind::kCaller; });
        if (from_caller) nodes.push_back({at, node});
      }
    }
    std::stable_sort(nodes.begin(), nodes.end(), [&](const RegionNode& a, const RegionNode& b) {
      return program::vector_width(program_.regions[a.region].lanes) >
             program::vector_width(program_.regions[b.region].lanes);
    });
    std::vector<LLVMValueRef> numbers;
    for (const RegionNode& angle : nodes) {
      const LimbRegion& region = program_.regions[angle.region];
      const auto& sources = region.inputs[node_of(angle.region, angle.node).index];
      angles_[angle.region][angle.node] = numbers.size();
      emitters_[angle.region].fetch_sine(angle.node);
      for (unsigned lane = 0; lane < program::vector_width(region.lanes); ++lane) {
        numbers.push_back(angle_number(sources[lane < sources.size() ? lane : 0].index));
      }
    }
    return packs_of(numbers);
  }

  LLVMValueRef angle_number(std::uint32_t input) const {
    LLVMValueRef offset = integer(input);
    const LLVMValueRef value =
        LLVMBuildLoad2(place_.builder, number_,
                       LLVMBuildInBoundsGEP2(place_.builder, number_,
                                             LLVMGetParam(place_.function, 0), &offset, 1, ""),
                       "");
    LLVMSetAlignment(value, bytes_of(number_));
    return value;
  }

  // Vectors of doubles, the last one filled with zeros.
  std::vector<LLVMValueRef> packs_of(const std::vector<LLVMValueRef>& angles) const {
    const LLVMContextRef context = LLVMGetTypeContext(number_);
    const Ir plain(place_.builder, number_, place_.fuse);
    const unsigned width = angles.size() > 4 ? kSineLanes : angles.size() > 2 ? 4 : 2;
    std::vector<LLVMValueRef> packs;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (i % width == 0) {
        packs.push_back(LLVMConstNull(LLVMVectorType(LLVMDoubleTypeInContext(context), width)));
      }
      packs.back() = LLVMBuildInsertElement(place_.builder, packs.back(),
                                            plain.to_double(angles[i]), integer(i % width), "");
    }
    return packs;
  }

  void compute(std::uint32_t region, std::uint32_t node) {
    ComputationEmitter& emitter = emitters_[region];
    const Node& of = node_of(region, node);
    const LLVMValueRef value =
        of.op == Op::kInput ? gathered(region, of.index) : emitter.compute(node);
    emitter.hold(node, value);
    const std::uint32_t slot = plan_.slot[steps_->value(region, node)];
    if (slot != kNoSlot) memory_->keep(value, slot);
    const auto results = results_of_[region].find(node);
    if (results != results_of_[region].end()) write_results(value, results->second);
    const auto pairs = pairs_of_[region].find(node);
    if (pairs == pairs_of_[region].end()) return;
    for (const ResultPair& pair : pairs->second) write_pair(pair);
  }

  // Both are there now.
  void write_pair(const ResultPair& pair) {
    ComputationEmitter& emitter = emitters_[pair.region];
    const LLVMValueRef left = emitter.value(pair.left), right = emitter.value(pair.right);
    const unsigned width = program::vector_width(program_.regions[pair.region].lanes);
    for (const ResultPair::Place& place : pair.places) {
      memory_->write_result(width == 1 ? in_vector({left, right})
                                       : shuffled(left, right, {place.lane, width + place.lane}),
                            place.left);
    }
  }

  LLVMValueRef in_vector(const std::vector<LLVMValueRef>& numbers) const {
    LLVMValueRef vector =
        LLVMGetUndef(LLVMVectorType(number_, static_cast<unsigned>(numbers.size())));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      vector = LLVMBuildInsertElement(place_.builder, vector, numbers[i], integer(i), "");
    }
    return vector;
  }

  LLVMValueRef shuffled(LLVMValueRef a, LLVMValueRef b, const std::vector<unsigned>& lanes) const {
    const LLVMTypeRef index = LLVMInt32TypeInContext(LLVMGetTypeContext(number_));
    std::vector<LLVMValueRef> chosen;
    for (const unsigned lane : lanes) chosen.push_back(LLVMConstInt(index, lane, false));
    return LLVMBuildShuffleVector(
        place_.builder, a, b, LLVMConstVector(chosen.data(), static_cast<unsigned>(chosen.size())),
        "");
  }

  // Of a node that has just been computed. A vector of which several lanes are wanted negative is
  // negated once.
  void write_results(LLVMValueRef value, const std::vector<std::uint32_t>& results) {
    const auto is_negative = [&](std::uint32_t i) {
      const LimbSource& source = program_.results[i];
      return source.negative !=
             program_.regions[source.region].computation.results[source.index].negative();
    };
    const bool is_vector = LLVMGetTypeKind(LLVMTypeOf(value)) == LLVMVectorTypeKind;
    const bool turns = is_vector && std::count_if(results.begin(), results.end(), is_negative) > 1;
    const LLVMValueRef turned = turns ? LLVMBuildFNeg(place_.builder, value, "") : nullptr;
    for (const std::uint32_t i : results) {
      const LimbSource& source = program_.results[i];
      memory_->write_result(
          turned != nullptr && is_negative(i)
              ? LLVMBuildExtractElement(place_.builder, turned, integer(source.lane), "")
              : number(source),
          i);
    }
  }

  // What a node of a region is in memory; null: nothing.
  LLVMValueRef fetched(std::uint32_t region, std::uint32_t node) {
    const Node& of = node_of(region, node);
    switch (of.op) {
      case Op::kConstant:
        return memory_->constant(
            std::vector<double>(program::vector_width(program_.regions[region].lanes), of.value));
      case Op::kInput:
        if (const LLVMValueRef value = plain_input(region, of.index)) return value;
        break;
      case Op::kSin:
      case Op::kCos:
        if (const LLVMValueRef value = fetched_sine(region, of)) return value;
        break;
      default:
        break;
    }
    const std::uint32_t slot = plan_.slot[steps_->value(region, node)];
    return slot == kNoSlot ? nullptr : memory_->waiting(slot, type_of(region));
  }

  LLVMValueRef plain_input(std::uint32_t region, std::uint32_t input) {
    const std::vector<LimbSource>& sources = program_.regions[region].inputs[input];
    switch (kind_of_input(program_.regions[region], input)) {
      case RegionInput::kCaller:
        return memory_->input(sources[0].index);
      case RegionInput::kConstant: {
        std::vector<double> lanes;
        for (unsigned lane = 0; lane < program::vector_width(program_.regions[region].lanes);
             ++lane) {
          lanes.push_back(sources[lane < sources.size() ? lane : 0].value);
        }
        return memory_->constant(lanes);
      }
      case RegionInput::kGathered:
        break;
    }
    return nullptr;
  }

  LLVMValueRef fetched_sine(std::uint32_t region, const Node& of) const {
    const auto at = angles_[region].find(of.a.node());
    if (at == angles_[region].end()) return nullptr;
    const LLVMTypeRef type = type_of(region);
    const bool early = step_ < kEarlySteps;
    if (of.op == Op::kCos) {
      return early ? memory_->early_cosine(at->second, type) : memory_->cosine(at->second, type);
    }
    const LLVMValueRef sine =
        early ? memory_->early_sine(at->second, type) : memory_->sine(at->second, type);
    return of.a.negative() ? LLVMBuildFNeg(place_.builder, sine, "") : sine;
  }

  LLVMValueRef integer(std::size_t value) const {
    return LLVMConstInt(LLVMInt64TypeInContext(LLVMGetTypeContext(number_)), value, false);
  }

  // A plain number.
  LLVMValueRef number(const LimbSource& source) {
    if (source.kind == LimbSource::Kind::kConstant) return LLVMConstReal(number_, source.value);
    if (source.kind == LimbSource::Kind::kCaller) return memory_->input(source.index);
    const LimbRegion& region = program_.regions[source.region];
    const Ref result = region.computation.results[source.index];
    const LLVMValueRef value = lane_of(source.region, result.node(), source.lane);
    return source.negative != result.negative() ? LLVMBuildFNeg(place_.builder, value, "") : value;
  }

  LLVMValueRef lane_of(std::uint32_t region, std::uint32_t node, std::uint32_t lane) {
    ComputationEmitter& emitter = emitters_[region];
    if (program_.regions[region].lanes == 1) return emitter.value(node);
    if (emitter.held(node) == nullptr) {
      const std::uint32_t slot = plan_.slot[steps_->value(region, node)];
      if (slot != kNoSlot) return memory_->waiting(slot + lane, number_);
      const Node& of = node_of(region, node);
      if (of.op == Op::kInput) return number(program_.regions[region].inputs[of.index][lane]);
    }
    return LLVMBuildExtractElement(place_.builder, emitter.value(node), integer(lane), "");
  }

  // One number for each lane; those that are left over repeat the first.
  LLVMValueRef gathered(std::uint32_t region, std::uint32_t input) {
    const std::vector<LimbSource>& sources = program_.regions[region].inputs[input];
    const unsigned width = program::vector_width(program_.regions[region].lanes);
    if (width == 1) return number(sources[0]);
    if (program::is_whole_vector(program_, sources)) {
      const Ref result = program_.regions[sources[0].region].computation.results[sources[0].index];
      const LLVMValueRef value = emitters_[sources[0].region].value(result.node());
      return sources[0].negative != result.negative() ? LLVMBuildFNeg(place_.builder, value, "")
                                                      : value;
    }
    LLVMValueRef vector = LLVMGetUndef(type_of(region));
    LLVMValueRef first = nullptr;
    for (unsigned lane = 0; lane < width; ++lane) {
      // A number that all lanes share is loaded once.
      const bool repeats = lane > 0 && (lane >= sources.size() || sources[lane] == sources[0]);
      const LLVMValueRef value = repeats ? first : number(sources[lane]);
      if (lane == 0) first = value;
      vector = LLVMBuildInsertElement(place_.builder, vector, value, integer(lane), "");
    }
    return vector;
  }

  const LimbProgram& program_;
  Place place_;
  LLVMTypeRef number_;
  std::vector<ComputationEmitter> emitters_;                  // of the regions
  std::vector<std::map<std::uint32_t, std::size_t>> angles_;  // [region]: node, its place
  std::vector<std::map<std::uint32_t, std::vector<std::uint32_t>>>
      results_of_;  // [region]: of a node
  std::vector<std::map<std::uint32_t, std::vector<ResultPair>>>
      pairs_of_;                                  // [region]: of the later node
  std::vector<std::uint32_t> written_;            // where a store begins
  std::vector<std::optional<double>> constants_;  // results
  std::vector<std::uint32_t> later_;              // other results, written at the end
  const SampleSteps* steps_ = nullptr;
  RegisterPlan plan_;
  Memory* memory_ = nullptr;
  std::size_t step_ = 0;
};

}  // namespace

LimbProgram as_one_region(const Computation& computation) {
  LimbProgram program;
  program.inputs = computation.inputs;
  LimbRegion& region = program.regions.emplace_back();
  region.computation = computation;
  for (std::uint32_t i = 0; i < computation.inputs; ++i) {
    region.inputs.push_back({{.kind = LimbSource::Kind::kCaller, .index = i}});
  }
  for (std::uint32_t i = 0; i < computation.results.size(); ++i) {
    program.results.push_back({.kind = LimbSource::Kind::kRegion, .index = i});
  }
  return program;
}

void emit_sample(const LimbProgram& program, const Place& place, LLVMTypeRef number,
                 std::uint32_t registers) {
  SampleEmitter(program, place, number).emit(registers);
}

}  // namespace sinew::backend
