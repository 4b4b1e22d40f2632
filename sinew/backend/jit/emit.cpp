#include "sinew/backend/jit/emit.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "sinew/backend/jit/constant_results.h"
#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/sincos.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Dag;
using program::Node;
using program::Op;
using program::Ref;

bool is_trigonometric(Op op) { return op == Op::kSin || op == Op::kCos; }

// What every part of a function needs.
struct Place {
  LLVMBuilderRef builder = nullptr;
  LLVMValueRef function = nullptr;
  LLVMValueRef repair = nullptr;
  bool fuse = false;
};

using Load = std::function<LLVMValueRef(std::uint32_t input)>;
// Called with the value of each node in turn.
using Computed = std::function<void(std::uint32_t node, LLVMValueRef value)>;

// Sines and cosines of single numbers, which share vectors of doubles.
class PackedSines {
 public:
  // `angles` are floats or doubles.
  PackedSines(const Place& place, const std::vector<LLVMValueRef>& angles)
      : builder_(place.builder) {
    if (angles.empty()) return;
    context_ = LLVMGetTypeContext(LLVMTypeOf(angles.front()));
    const Ir number(builder_, LLVMTypeOf(angles.front()), place.fuse);
    width_ = angles.size() > 4 ? kSineLanes : angles.size() > 2 ? 4 : 2;
    std::vector<LLVMValueRef> packs;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (i % width_ == 0)
        packs.push_back(LLVMConstNull(LLVMVectorType(LLVMDoubleTypeInContext(context_), width_)));
      packs.back() = LLVMBuildInsertElement(builder_, packs.back(), number.to_double(angles[i]),
                                            integer(i % width_), "");
    }
    values_ = emit_sincos(builder_, place.function, place.repair, packs, place.fuse);
  }

  // Of `width` angles from this one on, a vector where they are several; no pack ends between them.
  LLVMValueRef sine(std::size_t first, unsigned width) const {
    return part(values_.sine, first, width);
  }
  LLVMValueRef cosine(std::size_t first, unsigned width) const {
    return part(values_.cosine, first, width);
  }

 private:
  LLVMValueRef integer(std::size_t value) const {
    return LLVMConstInt(LLVMInt64TypeInContext(context_), value, false);
  }

  LLVMValueRef part(const std::vector<LLVMValueRef>& packs, std::size_t first,
                    unsigned width) const {
    const LLVMValueRef pack = packs[first / width_];
    if (width == 1) return LLVMBuildExtractElement(builder_, pack, integer(first % width_), "");
    const LLVMTypeRef index = LLVMInt32TypeInContext(context_);
    std::vector<LLVMValueRef> lanes;
    for (unsigned lane = 0; lane < width; ++lane)
      lanes.push_back(LLVMConstInt(index, first % width_ + lane, false));
    return LLVMBuildShuffleVector(builder_, pack, LLVMGetUndef(LLVMTypeOf(pack)),
                                  LLVMConstVector(lanes.data(), width), "");
  }

  LLVMBuilderRef builder_ = nullptr;
  LLVMContextRef context_ = nullptr;
  unsigned width_ = kSineLanes;
  SincosValues values_;
};

// Emits what a computation does on numbers of one type: doubles or vectors of them.
class ComputationEmitter {
 public:
  ComputationEmitter(const Computation& computation, const Place& place, LLVMTypeRef type,
                     Load load)
      : computation_(computation),
        dag_(computation.dag),
        builder_(place.builder),
        function_(place.function),
        repair_(place.repair),
        load_(std::move(load)),
        ir_(place.builder, type, place.fuse),
        fuse_(place.fuse),
        live_(program::live_nodes(computation)),
        uses_(dag_.size(), 0),
        values_(dag_.size(), nullptr),
        sine_(dag_.size(), nullptr),
        cosine_(dag_.size(), nullptr),
        fused_(dag_.size(), false) {
    count_uses();
  }

  // Nodes whose sine or cosine is needed and that are inputs.
  std::vector<std::uint32_t> angles_that_are_inputs() const {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (!live_[i] || !is_trigonometric(dag_.node(i).op)) continue;
      const std::uint32_t angle = dag_.node(i).a.node();
      if (dag_.node(angle).op == Op::kInput) nodes.push_back(angle);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  // Those of an angle, in double: they need not be computed here.
  void set_sine(std::uint32_t angle, LLVMValueRef sine, LLVMValueRef cosine) {
    sine_[angle] = ir_.from_double(sine);
    cosine_[angle] = ir_.from_double(cosine);
  }

  // The results. `computed` may write them as soon as they are there, so that they need no register
  // to the end.
  std::vector<LLVMValueRef> emit(const Computed& computed) {
    emit_sines_of_inputs();
    std::vector<std::uint32_t> order = computation_.order;
    if (order.empty()) {
      order.resize(dag_.size());
      std::iota(order.begin(), order.end(), 0u);
    }
    for (const std::uint32_t index : order) {
      if (live_[index] && !is_fused(index)) computed(index, value(index));
    }
    std::vector<LLVMValueRef> results;
    for (const Ref result : computation_.results) results.push_back(signed_value(result));
    return results;
  }

 private:
  void count_uses() {
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      if (!live_[i]) continue;
      const Node& node = dag_.node(i);
      const Ref operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < program::arity(node.op); ++k) ++uses_[operands[k].node()];
    }
    for (const Ref result : computation_.results) ++uses_[result.node()];
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      const Node& node = dag_.node(i);
      if (!live_[i] || node.op != Op::kAdd) continue;
      if (fuses_second(node)) fused_[node.b.node()] = true;
      if (fuses_first(node)) fused_[node.a.node()] = true;
    }
  }

  // All angles that are inputs: one vectorised evaluation at the start. Angles that are computed
  // get theirs where they are needed.
  void emit_sines_of_inputs() {
    std::vector<std::uint32_t> nodes = angles_that_are_inputs();
    std::erase_if(nodes, [this](std::uint32_t node) { return sine_[node] != nullptr; });
    if (nodes.empty()) return;
    if (ir_.lanes() >= kSineLanes) {
      std::vector<LLVMValueRef> angles;
      for (const std::uint32_t node : nodes) angles.push_back(ir_.to_double(value(node)));
      const SincosValues values = emit_sincos(builder_, function_, repair_, angles, fuse_);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        set_sine(nodes[i], values.sine[i], values.cosine[i]);
      }
      return;
    }
    const unsigned lanes = ir_.lanes();
    std::vector<LLVMValueRef> numbers;
    for (const std::uint32_t node : nodes) {
      for (unsigned lane = 0; lane < lanes; ++lane) {
        const LLVMValueRef at = LLVMConstInt(LLVMInt64TypeInContext(ir_.context()), lane, false);
        numbers.push_back(lanes == 1 ? value(node)
                                     : LLVMBuildExtractElement(builder_, value(node), at, ""));
      }
    }
    const PackedSines sines({builder_, function_, repair_, fuse_}, numbers);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      set_sine(nodes[i], sines.sine(i * lanes, lanes), sines.cosine(i * lanes, lanes));
    }
  }

  LLVMValueRef signed_value(Ref ref) {
    const LLVMValueRef magnitude = value(ref.node());
    return ref.negative() ? ir_.negate(magnitude) : magnitude;
  }

  // Operands come first in the order, so this recursion is shallow.
  LLVMValueRef value(std::uint32_t index) {
    LLVMValueRef& kept = values_[index];
    if (kept == nullptr) kept = compute(index);
    return kept;
  }

  // A product that only one sum needs becomes part of that sum's fused multiply-add.
  bool is_product_of_one_use(Ref ref) const {
    return fuse_ && dag_.node(ref).op == Op::kMultiply && uses_[ref.node()] == 1;
  }
  // At most one operand of a sum is fused into it: the second where it can be.
  bool fuses_second(const Node& sum) const { return is_product_of_one_use(sum.b); }
  bool fuses_first(const Node& sum) const {
    return !fuses_second(sum) && is_product_of_one_use(sum.a);
  }
  bool is_fused(std::uint32_t index) const { return fused_[index]; }

  LLVMValueRef compute(std::uint32_t index) {
    const Node& node = dag_.node(index);
    switch (node.op) {
      case Op::kConstant:
        return ir_.number(node.value);
      case Op::kInput:
        return load_(node.index);
      case Op::kAdd:
        return sum(node);
      case Op::kMultiply:
        return with_sign(ir_.multiply(value(node.a.node()), value(node.b.node())),
                         node.a.negative() != node.b.negative());
      case Op::kFma:
        return ir_.multiply_add(signed_value(node.a), signed_value(node.b), signed_value(node.c));
      case Op::kDivide:
        return with_sign(ir_.divide(value(node.a.node()), value(node.b.node())),
                         node.a.negative() != node.b.negative());
      case Op::kSqrt:
        return ir_.square_root(signed_value(node.a));
      case Op::kSin:
        emit_single_sine(node.a.node());
        return with_sign(sine_[node.a.node()], node.a.negative());
      case Op::kCos:
        emit_single_sine(node.a.node());
        return cosine_[node.a.node()];
      case Op::kLess:
        return ir_.less(signed_value(node.a), signed_value(node.b));
      case Op::kSelect:
        return ir_.select(value(node.a.node()), signed_value(node.b), signed_value(node.c));
    }
    return nullptr;
  }

  LLVMValueRef with_sign(LLVMValueRef value, bool negative) {
    return negative ? ir_.negate(value) : value;
  }

  LLVMValueRef sum(const Node& node) {
    const bool fuse_b = fuses_second(node);
    if (fuse_b || fuses_first(node)) {
      const Ref product = fuse_b ? node.b : node.a;
      const Ref other = fuse_b ? node.a : node.b;
      const Node& factors = dag_.node(product);
      const bool negative = product.negative() != (factors.a.negative() != factors.b.negative());
      return ir_.multiply_add(with_sign(value(factors.a.node()), negative), value(factors.b.node()),
                              signed_value(other));
    }
    if (node.a.negative() && !node.b.negative()) {
      return ir_.subtract(value(node.b.node()), value(node.a.node()));
    }
    if (node.b.negative()) return ir_.subtract(signed_value(node.a), value(node.b.node()));
    return ir_.add(value(node.a.node()), value(node.b.node()));
  }

  void emit_single_sine(std::uint32_t angle) {
    if (sine_[angle] != nullptr) return;
    const SincosValues values =
        emit_sincos(builder_, function_, repair_, {ir_.to_double(value(angle))}, fuse_);
    sine_[angle] = ir_.from_double(values.sine[0]);
    cosine_[angle] = ir_.from_double(values.cosine[0]);
  }

  const Computation& computation_;
  const Dag& dag_;
  LLVMBuilderRef builder_;
  LLVMValueRef function_;
  LLVMValueRef repair_;
  Load load_;
  Ir ir_;
  bool fuse_;
  std::vector<bool> live_;
  std::vector<std::uint32_t> uses_;
  std::vector<LLVMValueRef> values_;  // by node
  std::vector<LLVMValueRef> sine_;    // by the angle's node
  std::vector<LLVMValueRef> cosine_;
  std::vector<bool> fused_;  // by node: part of the one sum that needs it
};

// Bytes of a float or a double.
unsigned bytes_of(LLVMTypeRef number) {
  return LLVMGetTypeKind(number) == LLVMFloatTypeKind ? 4 : 8;
}

// One sample; with a stride, as many as the type has lanes.
void emit_samples(const Computation& computation, const Place& place, LLVMTypeRef type,
                  LLVMValueRef stride) {
  const LLVMTypeRef number = stride != nullptr ? LLVMGetElementType(type) : type;
  const LLVMContextRef context = LLVMGetTypeContext(type);
  const auto address = [&](unsigned parameter, std::size_t index) {
    LLVMValueRef offset = LLVMConstInt(LLVMInt64TypeInContext(context), index, false);
    if (stride != nullptr) offset = LLVMBuildMul(place.builder, offset, stride, "");
    return LLVMBuildInBoundsGEP2(place.builder, number, LLVMGetParam(place.function, parameter),
                                 &offset, 1, "");
  };
  const auto load = [&](std::uint32_t input) {
    const LLVMValueRef value = LLVMBuildLoad2(place.builder, type, address(0, input), "");
    LLVMSetAlignment(value, bytes_of(number));
    return value;
  };
  std::vector<std::vector<std::uint32_t>> results_of(computation.dag.size());  // of each node
  std::vector<std::optional<double>> constants(computation.results.size());
  for (std::uint32_t i = 0; i < computation.results.size(); ++i) {
    const Ref result = computation.results[i];
    if (stride == nullptr && computation.dag.is_constant(result)) {
      constants[i] = computation.dag.constant_value(result);
    } else {
      results_of[result.node()].push_back(i);
    }
  }
  store_constant_results(place.builder, number, LLVMGetParam(place.function, 1), constants);
  const auto store = [&](std::uint32_t node, LLVMValueRef value) {
    for (const std::uint32_t i : results_of[node]) {
      const LLVMValueRef result =
          computation.results[i].negative() ? LLVMBuildFNeg(place.builder, value, "") : value;
      LLVMSetAlignment(LLVMBuildStore(place.builder, result, address(1, i)), bytes_of(number));
    }
  };
  ComputationEmitter(computation, place, type, load).emit(store);
  LLVMBuildRetVoid(place.builder);
}

// One sample with its limbs side by side, region after region.
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

LLVMValueRef declare(LLVMModuleRef module, const char* name, std::vector<LLVMTypeRef> parameters) {
  const LLVMContextRef context = LLVMGetModuleContext(module);
  return LLVMAddFunction(module, name,
                         LLVMFunctionType(LLVMVoidTypeInContext(context), parameters.data(),
                                          static_cast<unsigned>(parameters.size()), false));
}

void add_attribute(LLVMValueRef function, unsigned where, const char* name) {
  const LLVMContextRef context = LLVMGetModuleContext(LLVMGetGlobalParent(function));
  const unsigned kind = LLVMGetEnumAttributeKindForName(name, std::strlen(name));
  LLVMAddAttributeAtIndex(function, where, LLVMCreateEnumAttribute(context, kind, 0));
}

}  // namespace

LLVMModuleRef emit_module(LLVMContextRef context, const program::Computation& computation,
                          const program::LimbProgram* limbs, const JitWanted& wanted, bool fuse) {
  const LLVMModuleRef module = LLVMModuleCreateWithNameInContext("sinew", context);
  const LLVMTypeRef number =
      wanted.is_float ? LLVMFloatTypeInContext(context) : LLVMDoubleTypeInContext(context);
  const LLVMTypeRef pointer = LLVMPointerTypeInContext(context, 0);
  const LLVMTypeRef size = LLVMInt64TypeInContext(context);

  const LLVMValueRef repair = declare(module, kSincosRepairName, {pointer, pointer, pointer, size});
  const LLVMBuilderRef builder = LLVMCreateBuilderInContext(context);
  const auto begin = [&](LLVMValueRef function) {
    for (const unsigned parameter : {1u, 2u}) add_attribute(function, parameter, "noalias");
    add_attribute(function, LLVMAttributeFunctionIndex, "nounwind");
    LLVMPositionBuilderAtEnd(builder, LLVMAppendBasicBlockInContext(context, function, "entry"));
    return Place{builder, function, repair, fuse};
  };
  const auto function = [&](const char* name) { return declare(module, name, {pointer, pointer}); };
  if (limbs == nullptr) {
    emit_samples(computation, begin(function(kSingleName)), number, nullptr);
  } else {
    LimbEmitter(*limbs, begin(function(kSingleName)), number).emit();
  }
  if (wanted.one_by_one) {
    emit_samples(computation, begin(function(kOneByOneName)), number, nullptr);
  }
  if (wanted.block) {
    constexpr unsigned kBlockBytes = 64;
    const LLVMValueRef block = declare(module, kBlockName, {pointer, pointer, size});
    emit_samples(computation, begin(block), LLVMVectorType(number, kBlockBytes / bytes_of(number)),
                 LLVMGetParam(block, 2));
  }
  LLVMDisposeBuilder(builder);
  return module;
}

}  // namespace sinew::backend
