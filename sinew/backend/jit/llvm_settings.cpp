#include "sinew/backend/jit/llvm_settings.h"

#ifdef SINEW_OWN_LLVM
#include <llvm-c/Support.h>
#include <llvm/CodeGen/Passes.h>
#include <llvm/CodeGen/RegAllocRegistry.h>

#include <iterator>
#endif

namespace sinew::backend {

#ifdef SINEW_OWN_LLVM

namespace {

thread_local JitLevel level_of_thread = JitLevel::kFull;

llvm::FunctionPass* register_allocator() {
  return level_of_thread == JitLevel::kFast ? llvm::createBasicRegisterAllocator()
                                            : llvm::createGreedyRegisterAllocator();
}

}  // namespace

void set_up_code_generator() {
  static const bool done = [] {
    // Both look at all pairs of loads and stores of a block, of which ours have a thousand. We join
    // neighbouring stores ourselves (constant_results.h); and the scheduler gives up telling loads
    // and stores apart one by one where there are more than a hundred.
    const char* const options[] = {"sinew", "-combiner-store-merging=false",
                                   "-dag-maps-huge-region=100", "-dag-maps-reduction-size=50"};
    LLVMParseCommandLineOptions(static_cast<int>(std::size(options)), options, nullptr);
    llvm::RegisterRegAlloc::setDefault(register_allocator);
    return true;
  }();
  static_cast<void>(done);
}

RegisterAllocation::RegisterAllocation(JitLevel level) { level_of_thread = level; }
RegisterAllocation::~RegisterAllocation() { level_of_thread = JitLevel::kFull; }

#else

void set_up_code_generator() {}
RegisterAllocation::RegisterAllocation(JitLevel) {}
RegisterAllocation::~RegisterAllocation() {}

#endif

}  // namespace sinew::backend
