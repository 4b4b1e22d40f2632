#include "sinew/backend/jit/emit.h"

#include <cstring>
#include <optional>
#include <vector>

#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/constant_results.h"
#include "sinew/backend/jit/limb_emitter.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Ref;

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
    emit_limbs(*limbs, begin(function(kSingleName)), number);
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
