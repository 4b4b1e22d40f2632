#include "sinew/backend/jit/limb_emitter.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/constant_results.h"
#include "sinew/backend/jit/packed_sines.h"

namespace sinew::backend {
namespace {

using program::Ref;

// Region after region.
class LimbEmitter {
 public:
  LimbEmitter(const program::LimbProgram& program, const Place& place, LLVMTypeRef number)
      : program_(program), place_(place), number_(number) {}

  void emit() {
    // Results by the region and the node that they come from; the others are no operations.
    std::vector<std::vector<std::vector<std::uint32_t>>> results_of;
    for (const program::LimbRegion& region : program_.regions) {
      results_of.emplace_back(region.computation.dag.size());
    }
    std::vector<std::uint32_t> others;
    std::vector<std::optional<double>> constants(program_.results.size());
    for (std::uint32_t i = 0; i < program_.results.size(); ++i) {
      const program::LimbSource& source = program_.results[i];
      constants[i] = constant(source);
      if (constants[i]) continue;
      if (source.kind == program::LimbSource::Kind::kRegion) {
        const program::Computation& of = program_.regions[source.region].computation;
        results_of[source.region][of.results[source.index].node()].push_back(i);
      } else {
        others.push_back(i);
      }
    }
    store_constant_results(place_.builder, number_, LLVMGetParam(place_.function, 1), constants);

    std::vector<ComputationEmitter> emitters;
    for (const program::LimbRegion& region : program_.regions) {
      const unsigned width = width_of(region);
      const LLVMTypeRef type = width == 1 ? number_ : LLVMVectorType(number_, width);
      emitters.emplace_back(region.computation, place_, type,
                            [this, &region, type, width](std::uint32_t input) {
                              return gathered(region.inputs[input], type, width);
                            });
    }
    emit_sines_of_inputs(emitters);
    for (const program::LimbRegion& region : program_.regions) {
      const std::size_t at = results_.size();
      const auto computed = [&](std::uint32_t node, LLVMValueRef value) {
        for (const std::uint32_t i : results_of[at][node]) {
          const program::LimbSource& source = program_.results[i];
          const bool negative =
              source.negative != region.computation.results[source.index].negative();
          store(i, lane_of(value, region.lanes, source.lane), negative);
        }
      };
      results_.push_back(emitters[at].emit(computed));
    }
    for (const std::uint32_t i : others) store(i, number(program_.results[i]), false);
    LLVMBuildRetVoid(place_.builder);
  }

 private:
  LLVMValueRef integer(std::size_t value) const {
    return LLVMConstInt(LLVMInt64TypeInContext(LLVMGetTypeContext(number_)), value, false);
  }
  LLVMValueRef address(unsigned parameter, std::size_t index) const {
    LLVMValueRef offset = integer(index);
    return LLVMBuildInBoundsGEP2(place_.builder, number_, LLVMGetParam(place_.function, parameter),
                                 &offset, 1, "");
  }

  void store(std::uint32_t result, LLVMValueRef value, bool negative) const {
    if (negative) value = LLVMBuildFNeg(place_.builder, value, "");
    LLVMSetAlignment(LLVMBuildStore(place_.builder, value, address(1, result)), bytes_of(number_));
  }

  LLVMValueRef lane_of(LLVMValueRef value, std::uint32_t lanes, std::uint32_t lane) const {
    if (lanes == 1) return value;
    return LLVMBuildExtractElement(place_.builder, value, integer(lane), "");
  }

  static unsigned width_of(const program::LimbRegion& region) {
    unsigned width = 1;
    while (width < region.lanes) width *= 2;
    return width;
  }

  // The value of a source that needs no computation.
  std::optional<double> constant(const program::LimbSource& source) const {
    if (source.kind == program::LimbSource::Kind::kConstant) return source.value;
    if (source.kind != program::LimbSource::Kind::kRegion) return std::nullopt;
    const program::Computation& of = program_.regions[source.region].computation;
    const Ref result = of.results[source.index].negated_if(source.negative);
    if (!of.dag.is_constant(result)) return std::nullopt;
    return of.dag.constant_value(result);
  }

  // Sines and cosines of all angles that the caller hands over, of all regions at once: what a
  // region waits for is then under way before the region in front of it is done.
  void emit_sines_of_inputs(std::vector<ComputationEmitter>& emitters) const {
    struct Angle {
      std::size_t region;
      std::uint32_t node;
    };
    std::vector<Angle> angles;
    for (std::size_t at = 0; at < emitters.size(); ++at) {
      const program::LimbRegion& region = program_.regions[at];
      for (const std::uint32_t node : emitters[at].angles_that_are_inputs()) {
        const auto& sources = region.inputs[region.computation.dag.node(node).index];
        const bool from_caller =
            std::all_of(sources.begin(), sources.end(), [](const program::LimbSource& source) {
              return source.kind == program::LimbSource::Kind::kCaller;
            });
        if (from_caller) angles.push_back({at, node});
      }
    }
    // Vectors first, so that none lies across two packs.
    std::stable_sort(angles.begin(), angles.end(), [&](const Angle& a, const Angle& b) {
      return width_of(program_.regions[a.region]) > width_of(program_.regions[b.region]);
    });
    std::vector<LLVMValueRef> numbers;
    for (const Angle& angle : angles) {
      const program::LimbRegion& region = program_.regions[angle.region];
      const auto& sources = region.inputs[region.computation.dag.node(angle.node).index];
      for (unsigned lane = 0; lane < width_of(region); ++lane)
        numbers.push_back(number(sources[lane < sources.size() ? lane : 0]));
    }
    const PackedSines sines(place_, numbers);
    std::size_t at = 0;
    for (const Angle& angle : angles) {
      const unsigned width = width_of(program_.regions[angle.region]);
      emitters[angle.region].set_sine(angle.node, sines.sine(at, width), sines.cosine(at, width));
      at += width;
    }
  }

  LLVMValueRef number(const program::LimbSource& source) const {
    switch (source.kind) {
      case program::LimbSource::Kind::kConstant:
        return LLVMConstReal(number_, source.value);
      case program::LimbSource::Kind::kCaller: {
        const LLVMValueRef value =
            LLVMBuildLoad2(place_.builder, number_, address(0, source.index), "");
        LLVMSetAlignment(value, bytes_of(number_));
        return value;
      }
      default:
        break;
    }
    const LLVMValueRef value = lane_of(results_[source.region][source.index],
                                       program_.regions[source.region].lanes, source.lane);
    return source.negative ? LLVMBuildFNeg(place_.builder, value, "") : value;
  }

  // One number for each lane; those that are left over repeat the first.
  LLVMValueRef gathered(const std::vector<program::LimbSource>& sources, LLVMTypeRef type,
                        unsigned width) const {
    if (width == 1) return number(sources[0]);
    if (is_whole_vector(sources)) {
      const LLVMValueRef value = results_[sources[0].region][sources[0].index];
      return sources[0].negative ? LLVMBuildFNeg(place_.builder, value, "") : value;
    }
    LLVMValueRef vector = LLVMGetUndef(type);
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

  // Whether these are the lanes of one result, in their order.
  bool is_whole_vector(const std::vector<program::LimbSource>& sources) const {
    const program::LimbSource& first = sources[0];
    if (first.kind != program::LimbSource::Kind::kRegion) return false;
    if (program_.regions[first.region].lanes != sources.size()) return false;
    for (std::uint32_t lane = 0; lane < sources.size(); ++lane) {
      program::LimbSource expected = first;
      expected.lane = lane;
      if (!(sources[lane] == expected)) return false;
    }
    return true;
  }

  const program::LimbProgram& program_;
  Place place_;
  LLVMTypeRef number_;
  std::vector<std::vector<LLVMValueRef>> results_;  // [region][result]
};

}  // namespace

void emit_limbs(const program::LimbProgram& program, const Place& place, LLVMTypeRef number) {
  LimbEmitter(program, place, number).emit();
}

}  // namespace sinew::backend
