#include "sinew/backend/jit/emit.h"

#include <cstring>
#include <utility>
#include <vector>

#include "sinew/backend/jit/block_emitter.h"
#include "sinew/backend/jit/computation_emitter.h"
#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/sample_emitter.h"
#include "sinew/backend/jit/sincos.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Ref;

// As many samples as the type has lanes.
void write_block(const Computation& computation, const Place& place, LLVMTypeRef type) {
  const LLVMTypeRef number = LLVMGetElementType(type);
  const LLVMContextRef context = LLVMGetTypeContext(type);
  const auto address = [&](unsigned parameter, std::size_t index) {
    LLVMValueRef offset = LLVMConstInt(LLVMInt64TypeInContext(context), index, false);
    offset = LLVMBuildMul(place.builder, offset, LLVMGetParam(place.function, 2), "");
    return LLVMBuildInBoundsGEP2(place.builder, number, LLVMGetParam(place.function, parameter),
                                 &offset, 1, "");
  };
  const auto load = [&](std::uint32_t node) -> LLVMValueRef {
    if (computation.dag.node(node).op != program::Op::kInput) return nullptr;
    const LLVMValueRef value =
        LLVMBuildLoad2(place.builder, type, address(0, computation.dag.node(node).index), "");
    LLVMSetAlignment(value, bytes_of(number));
    return value;
  };
  ComputationEmitter emitter(computation, place, type, load);

  // All angles that are inputs: one evaluation at the start. Angles that are computed get theirs
  // where they are needed.
  const Ir ir(place.builder, type, place.fuse);
  const std::vector<std::uint32_t> nodes = emitter.angles_that_are_inputs();
  std::vector<LLVMValueRef> angles;
  for (const std::uint32_t node : nodes) angles.push_back(ir.to_double(emitter.value(node)));
  const SincosValues values =
      emit_sincos(place.builder, place.function, place.repair, angles, place.fuse);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    emitter.set_sine(nodes[i], values.sine[i], values.cosine[i]);
  }

  // Results are written as soon as they are there, so that they need no register to the end.
  std::vector<std::vector<std::uint32_t>> results_of(computation.dag.size());  // of each node
  for (std::uint32_t i = 0; i < computation.results.size(); ++i) {
    results_of[computation.results[i].node()].push_back(i);
  }
  const auto write = [&](std::uint32_t node) {
    for (const std::uint32_t i : results_of[node]) {
      const LLVMValueRef result = emitter.signed_value(computation.results[i]);
      LLVMSetAlignment(LLVMBuildStore(place.builder, result, address(1, i)), bytes_of(number));
    }
    results_of[node].clear();
  };
  for (const std::uint32_t node : emitter.order()) {
    if (!emitter.is_statement(node)) continue;
    emitter.value(node);
    write(node);
  }
  for (const Ref result : computation.results) write(result.node());
  LLVMBuildRetVoid(place.builder);
}

LLVMValueRef declare(LLVMModuleRef module, const char* name, LLVMTypeRef result,
                     std::vector<LLVMTypeRef> parameters) {
  return LLVMAddFunction(
      module, name,
      LLVMFunctionType(result, parameters.data(), static_cast<unsigned>(parameters.size()), false));
}

LLVMValueRef declare_repair(LLVMModuleRef module) {
  const LLVMContextRef context = LLVMGetModuleContext(module);
  const LLVMTypeRef pointer = LLVMPointerTypeInContext(context, 0);
  LLVMTypeRef both[] = {pointer, pointer};
  return declare(module, kSincosRepairName, LLVMStructTypeInContext(context, both, 2, false),
                 {pointer, pointer, pointer, LLVMInt64TypeInContext(context)});
}

void add_attribute(LLVMValueRef function, unsigned where, const char* name) {
  const LLVMContextRef context = LLVMGetModuleContext(LLVMGetGlobalParent(function));
  const unsigned kind = LLVMGetEnumAttributeKindForName(name, std::strlen(name));
  LLVMAddAttributeAtIndex(function, where, LLVMCreateEnumAttribute(context, kind, 0));
}

// A module that is being written.
class Module {
 public:
  Module(LLVMContextRef context, const CodeSource& source, const EmitOptions& options)
      : options_(options),
        module_(LLVMModuleCreateWithNameInContext("sinew", context)),
        builder_(LLVMCreateBuilderInContext(context)),
        number_(source.wanted.is_float ? LLVMFloatTypeInContext(context)
                                       : LLVMDoubleTypeInContext(context)),
        pointer_(LLVMPointerTypeInContext(context, 0)),
        size_(LLVMInt64TypeInContext(context)),
        repair_(declare_repair(module_)) {}
  ~Module() { LLVMDisposeBuilder(builder_); }
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  LLVMTypeRef number() const { return number_; }
  LLVMModuleRef module() const { return module_; }
  Place sample_function(const char* name) const { return begin(name, {pointer_, pointer_}); }
  Place block_function(const char* name) const { return begin(name, {pointer_, pointer_, size_}); }

 private:
  Place begin(const char* name, std::vector<LLVMTypeRef> parameters) const {
    const LLVMValueRef function = declare(
        module_, name, LLVMVoidTypeInContext(LLVMGetModuleContext(module_)), std::move(parameters));
    for (const unsigned parameter : {1u, 2u}) add_attribute(function, parameter, "noalias");
    add_attribute(function, LLVMAttributeFunctionIndex, "nounwind");
    LLVMPositionBuilderAtEnd(
        builder_, LLVMAppendBasicBlockInContext(LLVMGetModuleContext(module_), function, "entry"));
    return {builder_, function, repair_, options_.fuse, options_.broadcasts, options_.indexes};
  }

  EmitOptions options_;
  LLVMModuleRef module_;
  LLVMBuilderRef builder_;
  LLVMTypeRef number_, pointer_, size_;
  LLVMValueRef repair_;
};

}  // namespace

LLVMModuleRef emit_samples(LLVMContextRef context, const CodeSource& source,
                           const EmitOptions& options) {
  const Module module(context, source, options);
  const auto emit = [&](const char* name, const program::LimbProgram& program) {
    emit_sample(program, module.sample_function(name), module.number(), options.registers);
  };
  if (source.limbs != nullptr) emit(kSingleName, *source.limbs);
  if (source.limbs == nullptr || source.wanted.one_by_one) {
    emit(source.limbs == nullptr ? kSingleName : kOneByOneName, as_one_region(source.computation));
  }
  return module.module();
}

BlockModule emit_block(LLVMContextRef context, const CodeSource& source, const EmitOptions& options,
                       bool always) {
  constexpr unsigned kBlockBytes = 64;
  const Module module(context, source, options);
  const Place place = module.block_function(kBlockName);
  const LLVMTypeRef type = LLVMVectorType(module.number(), kBlockBytes / bytes_of(module.number()));
  if (options.broadcasts) {
    PlannedBlock block(source.computation, place, type, options.registers);
    if (always || !block.is_short()) {
      block.emit();
      return {module.module(), true};
    }
  }
  write_block(source.computation, place, type);
  return {module.module(), false};
}

}  // namespace sinew::backend
