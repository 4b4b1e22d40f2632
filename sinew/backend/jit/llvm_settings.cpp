#include "sinew/backend/jit/llvm_settings.h"

#ifdef SINEW_OWN_LLVM
#include <llvm-c/Support.h>
#include <llvm/CodeGen/MachineScheduler.h>
#include <llvm/CodeGen/Passes.h>
#include <llvm/CodeGen/RegAllocRegistry.h>
#include <llvm/CodeGen/ScheduleDAGInstrs.h>
#include <llvm/CodeGen/TargetPassConfig.h>

#include <iterator>

#include "sinew/backend/jit/register_allocator.h"
#endif

namespace sinew::backend {

#ifdef SINEW_OWN_LLVM

namespace {

thread_local CodeOrder::Who who_of_thread = CodeOrder::kByGenerator;

llvm::FunctionPass* register_allocator() {
  switch (who_of_thread) {
    case CodeOrder::kPlanned:
      return create_ordered_allocator();
    case CodeOrder::kAsWritten:
      return llvm::createBasicRegisterAllocator();
    default:
      return llvm::createGreedyRegisterAllocator();
  }
}

// Leaves all where it is.
class NoScheduling : public llvm::ScheduleDAGInstrs {
 public:
  using ScheduleDAGInstrs::ScheduleDAGInstrs;
  void schedule() override {}
};

llvm::ScheduleDAGInstrs* scheduler(llvm::MachineSchedContext* context) {
  if (who_of_thread != CodeOrder::kByGenerator) {
    return new NoScheduling(*context->MF, context->MLI);  // the pass owns it
  }
  llvm::ScheduleDAGInstrs* const own = context->PassConfig->createMachineScheduler(context);
  return own != nullptr ? own : llvm::createGenericSchedLive(context);
}

}  // namespace

void set_up_code_generator() {
  static const bool done = [] {
    // Both look at all pairs of loads and stores of a block, of which ours have a thousand. We join
    // neighbouring stores ourselves (constant_results.h, result_pairs.h); and the scheduler gives
    // up telling loads and stores apart one by one where there are more than a hundred. Loops go
    // round a few times only, and filling up to where they would be aligned takes some seven bytes
    // each.
    static llvm::MachineSchedRegistry registered("sinew", "as the thread wants it", scheduler);
    const char* const options[] = {"sinew",
                                   "-misched=sinew",
                                   "-combiner-store-merging=false",
                                   "-dag-maps-huge-region=100",
                                   "-dag-maps-reduction-size=50",
                                   "-max-bytes-for-alignment=1"};
    LLVMParseCommandLineOptions(static_cast<int>(std::size(options)), options, nullptr);
    llvm::RegisterRegAlloc::setDefault(register_allocator);
    return true;
  }();
  static_cast<void>(done);
}

CodeOrder::CodeOrder(Who who) { who_of_thread = who; }
CodeOrder::~CodeOrder() { who_of_thread = kByGenerator; }

#else

void set_up_code_generator() {}
CodeOrder::CodeOrder(Who) {}
CodeOrder::~CodeOrder() = default;

#endif

}  // namespace sinew::backend
