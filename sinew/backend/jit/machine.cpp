// IR to machine code in this process, with LLVM's ORC, and the cache of compiled objects on disk.
#include <fcntl.h>
#include <llvm-c/Analysis.h>
#include <llvm-c/Core.h>
#include <llvm-c/Error.h>
#include <llvm-c/LLJIT.h>
#include <llvm-c/Object.h>
#include <llvm-c/Orc.h>
#include <llvm-c/Target.h>
#include <llvm-c/TargetMachine.h>
#include <llvm-c/Transforms/PassBuilder.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sinew/backend/jit/build_identity.h"
#include "sinew/backend/jit/content_hash.h"
#include "sinew/backend/jit/emit.h"
#include "sinew/backend/jit/entry.h"
#include "sinew/backend/jit/llvm_settings.h"
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
  bool has_fma = false;
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
  result.has_fma =
      list.find(",+fma,") != std::string::npos || result.triple.rfind("aarch64", 0) == 0;
  return result;
}

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

// The object file of the computation's module.
std::string compile_object(const program::Computation& computation,
                           const program::LimbProgram* limbs, const JitWanted& wanted,
                           const Host& host, JitLevel level) {
  const Machine machine(host, level);
  const LLVMContextRef context = LLVMContextCreate();
  const LLVMModuleRef module = emit_module(context, computation, limbs, wanted, host.has_fma);
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
  const RegisterAllocation registers(level);
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

std::string read_cached(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Keeping a compiled object is a convenience: where the folder cannot be written, the next run
// compiles again.
void write_cached(const std::filesystem::path& path, const std::string& object) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const std::filesystem::path part = path.string() + "." + std::to_string(getpid());
  {
    std::ofstream file(part, std::ios::binary);
    file << object;
    if (!file.flush()) {
      file.close();
      std::filesystem::remove(part, ignored);
      return;
    }
  }
  std::filesystem::rename(part, path, ignored);
  if (ignored) std::filesystem::remove(part, ignored);
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
  explicit LinkedCode(const std::string& object) {
    check(LLVMOrcCreateLLJIT(&jit_, nullptr));
    define_sincos_repair();
    check(LLVMOrcLLJITAddObjectFile(jit_, LLVMOrcLLJITGetMainJITDylib(jit_), buffer_of(object)));
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

  std::string object;
  std::filesystem::path cached;
  bool from_cache = false;
  static const std::string identity = build_identity();
  if (!options.cache_folder.empty() && !identity.empty()) {
    std::string machine = this_host.triple + this_host.cpu + this_host.features + identity;
    machine += wanted.is_float ? " float" : " double";
    if (wanted.block) machine += " block";
    if (wanted.one_by_one) machine += " one by one";
    cached =
        std::filesystem::path(options.cache_folder) /
        (content_hash(computation, limbs, machine + char('0' + static_cast<int>(options.level))) +
         ".o");
    object = read_cached(cached);
    from_cache = function_bytes(object, kSingleName) > 0;
  }
  if (!from_cache) {
    object = compile_object(computation, limbs, wanted, this_host, options.level);
    if (!cached.empty()) write_cached(cached, object);
  }
  const auto code = std::make_shared<LinkedCode>(object);
  result.single = code->find<void*>(kSingleName);
  result.one_by_one = wanted.one_by_one ? code->find<void*>(kOneByOneName) : result.single;
  result.code_bytes = function_bytes(object, kSingleName);
  if (wanted.block) {
    result.block = code->find<void*>(kBlockName);
    result.batch_code_bytes = function_bytes(object, kBlockName);
  }
  result.from_cache = from_cache;
  result.owner = code;
}

}  // namespace sinew::backend
