// IR to machine code in this process, with LLVM's ORC.
#include <llvm-c/Analysis.h>
#include <llvm-c/Core.h>
#include <llvm-c/Error.h>
#include <llvm-c/LLJIT.h>
#include <llvm-c/Object.h>
#include <llvm-c/Orc.h>
#include <llvm-c/Target.h>
#include <llvm-c/TargetMachine.h>
#include <llvm-c/Transforms/PassBuilder.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/backend/jit/build_identity.h"
#include "sinew/backend/jit/content_hash.h"
#include "sinew/backend/jit/emit.h"
#include "sinew/backend/jit/entry.h"
#include "sinew/backend/jit/llvm_settings.h"
#include "sinew/backend/jit/object_cache.h"
#include "sinew/backend/jit/sincos.h"
#include "sinew/base/error.h"

namespace sinew::backend {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error({{}, "", "LLVM refuses the program: " + what, "", Severity::kError, {}});
}

void check(LLVMErrorRef error) {
  if (error == nullptr) return;
  char* const message = LLVMGetErrorMessage(error);
  const std::string text = message;
  LLVMDisposeErrorMessage(message);
  fail(text);
}

// What this machine is, in LLVM's words.
struct Host {
  std::string triple, cpu, features;
  EmitOptions emit;
};

Host host() {
  Host result;
  const auto take = [](char* text) {
    std::string copy = text;
    LLVMDisposeMessage(text);
    return copy;
  };
  result.triple = take(LLVMGetDefaultTargetTriple());
  result.cpu = take(LLVMGetHostCPUName());
  result.features = take(LLVMGetHostCPUFeatures());
  const std::string list = "," + result.features + ",";
  const auto has = [&](const char* feature) { return list.find(feature) != std::string::npos; };
  const bool is_arm = result.triple.rfind("aarch64", 0) == 0;
  result.emit.fuse = is_arm || has(",+fma,");
  result.emit.broadcasts = has(",+avx512vl,");
  result.emit.indexes = result.triple.rfind("x86_64", 0) == 0;
  result.emit.registers = is_arm || has(",+avx512vl,") ? kRegistersOf32 : kRegistersOf16;
  return result;
}

// Code for one sample, or for a block of them.
enum class CodePart { kSamples, kBlock };

class Machine {
 public:
  Machine(const Host& host, JitLevel level) {
    LLVMTargetRef target = nullptr;
    char* message = nullptr;
    if (LLVMGetTargetFromTriple(host.triple.c_str(), &target, &message)) {
      const std::string text = message;
      LLVMDisposeMessage(message);
      fail(text);
    }
    const LLVMCodeGenOptLevel effort =
        level == JitLevel::kFast ? LLVMCodeGenLevelLess : LLVMCodeGenLevelAggressive;
    machine_ =
        LLVMCreateTargetMachine(target, host.triple.c_str(), host.cpu.c_str(),
                                host.features.c_str(), effort, LLVMRelocPIC, LLVMCodeModelDefault);
  }
  ~Machine() { LLVMDisposeTargetMachine(machine_); }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  LLVMTargetMachineRef get() const { return machine_; }

 private:
  LLVMTargetMachineRef machine_ = nullptr;
};

struct WrittenPart {
  LLVMModuleRef module = nullptr;
  CodeOrder::Who who = CodeOrder::kPlanned;
};

// Where registers are few, the plan of a sample's function does not fit as it is, for a step needs
// more than what it reads and computes: there the greedy allocator makes calls up to 9 % shorter.
WrittenPart write_part(LLVMContextRef context, CodePart part, const CodeSource& source,
                       const EmitOptions& options, JitLevel level) {
  const bool is_fast = level == JitLevel::kFast;
  if (part == CodePart::kSamples) {
    return {emit_samples(context, source, options), options.registers <= kRegistersOf16 && !is_fast
                                                        ? CodeOrder::kRegistersByGenerator
                                                        : CodeOrder::kPlanned};
  }
  const BlockModule block = emit_block(context, source, options, is_fast);
  if (block.is_planned) return {block.module, CodeOrder::kPlanned};
  return {block.module, is_fast ? CodeOrder::kAsWritten : CodeOrder::kByGenerator};
}

// The object file of a module.
std::string compile_object(CodePart part, const CodeSource& source, const Host& host,
                           JitLevel level) {
  const Machine machine(host, level);
  const LLVMContextRef context = LLVMContextCreate();
  const auto [module, who] = write_part(context, part, source, host.emit, level);
  LLVMSetTarget(module, host.triple.c_str());
  const LLVMTargetDataRef layout = LLVMCreateTargetDataLayout(machine.get());
  LLVMSetModuleDataLayout(module, layout);
  LLVMDisposeTargetData(layout);

  std::string fault;
  std::string object;
  char* message = nullptr;
#ifndef NDEBUG
  if (LLVMVerifyModule(module, LLVMReturnStatusAction, &message)) fault = message;
  LLVMDisposeMessage(message);
  message = nullptr;
#endif
  LLVMMemoryBufferRef buffer = nullptr;
  const CodeOrder order(who);
  if (fault.empty() && LLVMTargetMachineEmitToMemoryBuffer(machine.get(), module, LLVMObjectFile,
                                                           &message, &buffer)) {
    fault = message;
    LLVMDisposeMessage(message);
  }
  if (buffer != nullptr) {
    object.assign(LLVMGetBufferStart(buffer), LLVMGetBufferSize(buffer));
    LLVMDisposeMemoryBuffer(buffer);
  }
  LLVMDisposeModule(module);
  LLVMContextDispose(context);
  if (!fault.empty()) fail(fault);
  return object;
}

// Empty where nothing is kept.
std::filesystem::path cached_path(CodePart part, const CodeSource& source, const Host& host,
                                  const JitOptions& options) {
  static const std::string identity = build_identity();
  if (options.cache_folder.empty() || identity.empty()) return {};
  std::string machine = host.triple + host.cpu + host.features + identity;
  machine += source.wanted.is_float ? " float" : " double";
  machine += part == CodePart::kBlock ? " block" : " planned";
  if (part == CodePart::kSamples && source.wanted.one_by_one) machine += " one by one";
  machine += static_cast<char>('0' + static_cast<int>(options.level));
  const program::LimbProgram* const limbs = part == CodePart::kBlock ? nullptr : source.limbs;
  return std::filesystem::path(options.cache_folder) /
         (content_hash(source.computation, limbs, machine) + ".o");
}

LLVMMemoryBufferRef buffer_of(const std::string& object) {
  return LLVMCreateMemoryBufferWithMemoryRangeCopy(object.data(), object.size(), "sinew");
}

// Bytes of a function in an object file.
std::size_t function_bytes(const std::string& object, std::string_view name) {
  const LLVMMemoryBufferRef buffer = buffer_of(object);
  char* message = nullptr;
  const LLVMBinaryRef binary = LLVMCreateBinary(buffer, nullptr, &message);
  std::size_t bytes = 0;
  if (binary != nullptr) {
    const LLVMSymbolIteratorRef symbol = LLVMObjectFileCopySymbolIterator(binary);
    for (; !LLVMObjectFileIsSymbolIteratorAtEnd(binary, symbol); LLVMMoveToNextSymbol(symbol)) {
      if (name == LLVMGetSymbolName(symbol)) bytes = LLVMGetSymbolSize(symbol);
    }
    LLVMDisposeSymbolIterator(symbol);
    LLVMDisposeBinary(binary);
  } else {
    LLVMDisposeMessage(message);
  }
  LLVMDisposeMemoryBuffer(buffer);
  return bytes;
}

// Owns code that ORC has linked into this process.
class LinkedCode {
 public:
  explicit LinkedCode(const std::vector<std::string>& objects) {
    check(LLVMOrcCreateLLJIT(&jit_, nullptr));
    define_sincos_repair();
    for (const std::string& object : objects) {
      check(LLVMOrcLLJITAddObjectFile(jit_, LLVMOrcLLJITGetMainJITDylib(jit_), buffer_of(object)));
    }
  }
  ~LinkedCode() {
    if (jit_ != nullptr) LLVMConsumeError(LLVMOrcDisposeLLJIT(jit_));
  }
  LinkedCode(const LinkedCode&) = delete;
  LinkedCode& operator=(const LinkedCode&) = delete;

  template <typename Function>
  Function find(const char* name) const {
    LLVMOrcExecutorAddress address = 0;
    check(LLVMOrcLLJITLookup(jit_, &address, name));
    // NOLINTNEXTLINE(performance-no-int-to-ptr): LLVM gives the address as a number.
    return reinterpret_cast<Function>(address);
  }

 private:
  void define_sincos_repair() {
    LLVMOrcCSymbolMapPair symbol;
    symbol.Name = LLVMOrcLLJITMangleAndIntern(jit_, kSincosRepairName);
    symbol.Sym.Address = reinterpret_cast<LLVMOrcExecutorAddress>(&sinew_sincos_repair);
    symbol.Sym.Flags = {LLVMJITSymbolGenericFlagsExported | LLVMJITSymbolGenericFlagsCallable, 0};
    check(LLVMOrcJITDylibDefine(LLVMOrcLLJITGetMainJITDylib(jit_),
                                LLVMOrcAbsoluteSymbols(&symbol, 1)));
  }

  LLVMOrcLLJITRef jit_ = nullptr;
};

}  // namespace

extern "C" void SINEW_JIT_COMPILE(const program::Computation& computation,
                                  const program::LimbProgram* limbs, const JitOptions& options,
                                  const JitWanted& wanted, JitCode& result) {
  static const bool ready =
      LLVMInitializeNativeTarget() == 0 && LLVMInitializeNativeAsmPrinter() == 0;
  if (!ready) fail("it was built without this machine's target");
  set_up_code_generator();
  static const Host this_host = host();

  const CodeSource source{computation, limbs, wanted};
  std::vector<std::string> objects;
  result.from_cache = true;
  for (const CodePart part : {CodePart::kSamples, CodePart::kBlock}) {
    if (part == CodePart::kBlock && !wanted.block) continue;
    const std::filesystem::path cached = cached_path(part, source, this_host, options);
    std::string object;
    if (!cached.empty()) object = read_cached(cached);
    const char* const name = part == CodePart::kSamples ? kSingleName : kBlockName;
    if (function_bytes(object, name) == 0) {
      object = compile_object(part, source, this_host, options.level);
      if (!cached.empty()) write_cached(cached, object);
      result.from_cache = false;
    }
    (part == CodePart::kSamples ? result.code_bytes : result.batch_code_bytes) =
        function_bytes(object, name);
    objects.push_back(std::move(object));
  }
  const auto code = std::make_shared<LinkedCode>(objects);
  result.single = code->find<void*>(kSingleName);
  result.one_by_one = wanted.one_by_one ? code->find<void*>(kOneByOneName) : result.single;
  if (wanted.block) result.block = code->find<void*>(kBlockName);
  result.owner = code;
}

}  // namespace sinew::backend
