#include "sinew/backend/jit/register_allocator.h"

#ifdef SINEW_OWN_LLVM

#include <llvm/Analysis/AliasAnalysis.h>
#include <llvm/CodeGen/CalcSpillWeights.h>
#include <llvm/CodeGen/LiveIntervals.h>
#include <llvm/CodeGen/LiveRangeEdit.h>
#include <llvm/CodeGen/LiveRegMatrix.h>
#include <llvm/CodeGen/LiveStacks.h>
#include <llvm/CodeGen/MachineBlockFrequencyInfo.h>
#include <llvm/CodeGen/MachineDominators.h>
#include <llvm/CodeGen/MachineFunctionPass.h>
#include <llvm/CodeGen/MachineLoopInfo.h>
#include <llvm/CodeGen/MachineRegisterInfo.h>
#include <llvm/CodeGen/RegisterClassInfo.h>
#include <llvm/CodeGen/SlotIndexes.h>
#include <llvm/CodeGen/Spiller.h>
#include <llvm/CodeGen/TargetRegisterInfo.h>
#include <llvm/CodeGen/VirtRegMap.h>

#include <algorithm>
#include <map>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

#include "sinew/backend/jit/register_tiers.h"

namespace sinew::backend {
namespace {

using llvm::LiveInterval;
using llvm::LiveRegMatrix;
using llvm::MCPhysReg;
using llvm::Register;

struct Waiting {
  llvm::SlotIndex begin;
  unsigned value;  // the number of the register that stands for it
};
bool operator<(const Waiting& a, const Waiting& b) {  // the first comes out of a queue first
  return a.begin != b.begin ? b.begin < a.begin : a.value > b.value;
}

class OrderedAllocator : public llvm::MachineFunctionPass, private llvm::LiveRangeEdit::Delegate {
 public:
  static char ID;
  OrderedAllocator() : MachineFunctionPass(ID) {}

  llvm::StringRef getPassName() const override { return "Registers in the order of values"; }

  void getAnalysisUsage(llvm::AnalysisUsage& usage) const override {
    usage.setPreservesCFG();
    add<llvm::AAResultsWrapperPass>(usage);
    add<llvm::SlotIndexesWrapperPass>(usage);
    add<llvm::LiveIntervalsWrapperPass>(usage);
    add<llvm::LiveStacks>(usage);
    add<llvm::MachineBlockFrequencyInfoWrapperPass>(usage);
    add<llvm::MachineDominatorTreeWrapperPass>(usage);
    add<llvm::MachineLoopInfoWrapperPass>(usage);
    add<llvm::VirtRegMap>(usage);
    add<llvm::LiveRegMatrix>(usage);
    MachineFunctionPass::getAnalysisUsage(usage);
  }
  llvm::MachineFunctionProperties getRequiredProperties() const override {
    return llvm::MachineFunctionProperties().set(llvm::MachineFunctionProperties::Property::NoPHIs);
  }
  llvm::MachineFunctionProperties getClearedProperties() const override {
    return llvm::MachineFunctionProperties().set(llvm::MachineFunctionProperties::Property::IsSSA);
  }

  bool runOnMachineFunction(llvm::MachineFunction& function) override {
    function_ = &function;
    registers_ = &function.getRegInfo();
    target_ = function.getSubtarget().getRegisterInfo();
    map_ = &getAnalysis<llvm::VirtRegMap>();
    intervals_ = &getAnalysis<llvm::LiveIntervalsWrapperPass>().getLIS();
    matrix_ = &getAnalysis<llvm::LiveRegMatrix>();
    registers_->freezeReservedRegs();
    classes_.runOnMachineFunction(function);

    llvm::VirtRegAuxInfo weights(
        function, *intervals_, *map_, getAnalysis<llvm::MachineLoopInfoWrapperPass>().getLI(),
        getAnalysis<llvm::MachineBlockFrequencyInfoWrapperPass>().getMBFI());
    weights.calculateSpillWeightsAndHints();
    spiller_.reset(llvm::createInlineSpiller(*this, function, *map_, weights));

    collect();
    while (!waiting_.empty()) {
      const Register next = Register::index2VirtReg(waiting_.top().value);
      waiting_.pop();
      if (registers_->reg_nodbg_empty(next)) {
        intervals_->removeInterval(next);
      } else {
        place(intervals_->getInterval(next));
      }
    }
    spiller_->postOptimization();
    for (llvm::MachineInstr* const dead : rematerialised_) {
      intervals_->RemoveMachineInstrFromMaps(*dead);
      dead->eraseFromParent();
    }
    rematerialised_.clear();
    spiller_.reset();
    tiers_.clear();
    return true;
  }

 private:
  template <typename Pass>
  static void add(llvm::AnalysisUsage& usage) {
    usage.addRequired<Pass>();
    usage.addPreserved<Pass>();
  }

  llvm::ArrayRef<MCPhysReg> order(const LiveInterval& interval) const {
    return classes_.getOrder(registers_->getRegClass(interval.reg()));
  }
  // Eight registers have names of the same length. One that the caller wants back costs more.
  unsigned tier(MCPhysReg reg) const {
    const bool is_callers = classes_.getLastCalleeSavedAlias(reg).isValid();
    return target_->getEncodingValue(reg) / 8 + (is_callers ? 1 : 0);
  }

  // Registers that a value may get, and the values.
  struct File {
    std::size_t registers = 0;
    std::vector<unsigned> sizes;  // of the tiers
    std::vector<Lifetime> lifetimes;
  };

  // There are classes with a part of a file's registers only.
  void set_sizes(File& file, llvm::ArrayRef<MCPhysReg> order) const {
    if (order.size() <= file.registers) return;
    file.registers = order.size();
    file.sizes.clear();
    for (const MCPhysReg reg : order) {
      if (file.sizes.size() <= tier(reg)) file.sizes.resize(tier(reg) + 1, 0);
      ++file.sizes[tier(reg)];
    }
  }

  // Bytes that a longer name costs: one more in an instruction that overwrites an operand, whose
  // name has a byte more in any case, two in others.
  unsigned weight(Register reg) const {
    unsigned sum = 0;
    for (const llvm::MachineInstr& reader : registers_->reg_nodbg_instructions(reg)) {
      const bool overwrites = reader.getNumDefs() == 1 && reader.getNumOperands() > 1 &&
                              reader.isRegTiedToDefOperand(1);
      sum += overwrites ? 1 : 2;
    }
    return sum;
  }

  void collect() {
    std::map<unsigned, File> files;  // by the first unit
    for (unsigned i = 0; i < registers_->getNumVirtRegs(); ++i) {
      const Register reg = Register::index2VirtReg(i);
      if (map_->hasPhys(reg)) continue;
      if (registers_->reg_nodbg_empty(reg)) {
        if (intervals_->hasInterval(reg)) intervals_->removeInterval(reg);
        continue;
      }
      const LiveInterval& interval = intervals_->getInterval(reg);
      wait(interval);
      if (interval.empty()) continue;  // what nothing has defined may be read
      File& file = files[*target_->regunits(order(interval).front()).begin()];
      set_sizes(file, order(interval));
      file.lifetimes.push_back(
          {i, position(interval.beginIndex()), position(interval.endIndex()), weight(reg)});
    }
    for (const auto& [unit, file] : files) {
      for (const auto& [value, tier] : choose_tiers(file.lifetimes, file.sizes)) {
        tiers_[value] = tier;
      }
    }
  }

  unsigned position(llvm::SlotIndex at) const {
    return static_cast<unsigned>(intervals_->getSlotIndexes()->getZeroIndex().distance(at));
  }

  void wait(const LiveInterval& interval) {
    const llvm::SlotIndex begin =
        interval.empty() ? llvm::SlotIndex(intervals_->getSlotIndexes()->getZeroIndex())
                         : interval.beginIndex();
    waiting_.push({begin, Register::virtReg2Index(interval.reg())});
  }

  bool is_free(const LiveInterval& interval, MCPhysReg reg) const {
    return matrix_->checkInterference(interval, reg) == LiveRegMatrix::IK_Free;
  }

  // In the tier that was chosen, or the nearest one.
  MCPhysReg find(const LiveInterval& interval) const {
    const auto chosen = tiers_.find(Register::virtReg2Index(interval.reg()));
    const unsigned wanted = chosen == tiers_.end() ? 0 : chosen->second;
    const auto distance = [&](MCPhysReg reg) {
      const unsigned is = tier(reg);
      return is > wanted ? 2 * (is - wanted) : 2 * (wanted - is) + 1;
    };
    MCPhysReg best = 0;
    const auto consider = [&](MCPhysReg reg) {
      if (best != 0 && distance(best) <= distance(reg)) return;
      if (is_free(interval, reg)) best = reg;
    };
    // A copy less, if it is of the right tier.
    llvm::SmallVector<MCPhysReg, 4> hints;
    target_->getRegAllocationHints(interval.reg(), order(interval), hints, *function_, map_,
                                   matrix_);
    for (const MCPhysReg reg : hints) {
      if (distance(reg) == 0) consider(reg);
    }
    for (const MCPhysReg reg : order(interval)) consider(reg);
    return best;
  }

  void place(const LiveInterval& interval) {
    if (const MCPhysReg reg = find(interval)) {
      matrix_->assign(interval, reg);
      return;
    }
    make_room(interval);
  }

  // What lives longest of all that could make room goes to the stack.
  void make_room(const LiveInterval& interval) {
    const LiveInterval* last = interval.isSpillable() ? &interval : nullptr;
    for (const MCPhysReg reg : order(interval)) {
      const LiveInterval* const there = only_one_in(interval, reg);
      if (there == nullptr || !there->isSpillable()) continue;
      if (last == nullptr || last->endIndex() < there->endIndex()) last = there;
    }
    if (last == nullptr) llvm::report_fatal_error("ran out of registers");
    if (last != &interval) {
      matrix_->unassign(*last);
      wait(interval);
    }
    spill(*last);
  }

  // The value that alone is in the way of another in this register; null where there are more.
  const LiveInterval* only_one_in(const LiveInterval& interval, MCPhysReg reg) const {
    if (matrix_->checkInterference(interval, reg) != LiveRegMatrix::IK_VirtReg) return nullptr;
    const LiveInterval* found = nullptr;
    for (const llvm::MCRegUnit unit : target_->regunits(reg)) {
      for (const LiveInterval* const there : matrix_->query(interval, unit).interferingVRegs()) {
        if (found != nullptr && found != there) return nullptr;
        found = there;
      }
    }
    return found;
  }

  void spill(const LiveInterval& interval) {
    llvm::SmallVector<Register, 4> pieces;
    llvm::LiveRangeEdit edit(&interval, pieces, *function_, *intervals_, map_, this,
                             &rematerialised_);
    spiller_->spill(edit);
    matrix_->invalidateVirtRegs();
    for (const Register reg : pieces) wait(intervals_->getInterval(reg));
  }

  // What else changes when a value goes to the stack: those are asked again that are in a register,
  // and others while they wait.
  bool LRE_CanEraseVirtReg(Register reg) override {
    LiveInterval& interval = intervals_->getInterval(reg);
    if (map_->hasPhys(reg)) {
      matrix_->unassign(interval);
      return true;
    }
    interval.clear();
    return false;
  }
  void LRE_WillShrinkVirtReg(Register reg) override {
    if (!map_->hasPhys(reg)) return;
    const LiveInterval& interval = intervals_->getInterval(reg);
    matrix_->unassign(interval);
    wait(interval);
  }

  llvm::MachineFunction* function_ = nullptr;
  llvm::MachineRegisterInfo* registers_ = nullptr;
  const llvm::TargetRegisterInfo* target_ = nullptr;
  llvm::VirtRegMap* map_ = nullptr;
  llvm::LiveIntervals* intervals_ = nullptr;
  LiveRegMatrix* matrix_ = nullptr;
  llvm::RegisterClassInfo classes_;
  std::unique_ptr<llvm::Spiller> spiller_;
  llvm::SmallPtrSet<llvm::MachineInstr*, 32> rematerialised_;
  std::priority_queue<Waiting> waiting_;
  std::map<unsigned, unsigned> tiers_;  // of values
};

char OrderedAllocator::ID = 0;

}  // namespace

llvm::FunctionPass* create_ordered_allocator() { return new OrderedAllocator(); }

}  // namespace sinew::backend

#endif
