#include "sinew/backend/jit/block_sines.h"

#include <algorithm>
#include <utility>

#include "sinew/backend/jit/ir.h"
#include "sinew/backend/jit/sine_constants.h"

namespace sinew::backend {
namespace {

// Angles whose sines and cosines are held in registers.
constexpr std::size_t kMostInRegisters = 8;
// Angles at a time: more need more registers than there are beside those that are held.
constexpr std::size_t kInStep = 3;
constexpr std::size_t kInStepOfFloats = 2;  // each in two vectors of doubles

// Rows that lie one behind the other.
struct Run {
  std::uint32_t first, count;
};

std::vector<Run> runs_of(const std::vector<std::uint32_t>& rows) {
  std::vector<Run> runs;
  for (const std::uint32_t row : rows) {
    if (runs.empty() || row != runs.back().first + runs.back().count) runs.push_back({row, 0});
    ++runs.back().count;
  }
  return runs;
}

class BlockSines {
 public:
  BlockSines(const Place& place, LLVMTypeRef type, const std::vector<std::uint32_t>& rows,
             LLVMValueRef array, BlockParameters& parameters)
      : place_(place),
        builder_(place.builder),
        context_(LLVMGetTypeContext(type)),
        type_(type),
        doubles_(LLVMVectorType(LLVMDoubleTypeInContext(context_), LLVMGetVectorSize(type))),
        rows_(rows),
        array_(array),
        parameters_(parameters) {}

  SincosValues emit() {
    const LLVMValueRef sum = sines_are_in_registers(rows_) ? in_registers() : in_memory();
    const Ir ir(builder_, doubles_, place_.fuse);
    // All angles are near if their magnitudes have a sum that is small, and not if one is no
    // number.
    const LLVMValueRef near =
        LLVMBuildFCmp(builder_, LLVMRealOLE, sum, ir.number(kLargestAngle), "");
    const LLVMBasicBlockRef fast = LLVMGetInsertBlock(builder_);
    const LLVMBasicBlockRef slow = append("repair"), next = append("reduced");
    LLVMBuildCondBr(builder_, ir.all(near), next, slow);
    LLVMPositionBuilderAtEnd(builder_, slow);
    const BlockParameters again = repair();
    const SincosValues repaired = held_.sine.empty() ? SincosValues{} : load_held();
    const LLVMBasicBlockRef slow_end = LLVMGetInsertBlock(builder_);
    LLVMBuildBr(builder_, next);
    LLVMPositionBuilderAtEnd(builder_, next);
    const auto merge = [&](LLVMValueRef& value, LLVMValueRef other) {
      const LLVMValueRef phi = LLVMBuildPhi(builder_, LLVMTypeOf(value), "");
      LLVMValueRef incoming[] = {value, other};
      LLVMBasicBlockRef blocks[] = {fast, slow_end};
      LLVMAddIncoming(phi, incoming, blocks, 2);
      value = phi;
    };
    merge(parameters_.in, again.in);
    merge(parameters_.out, again.out);
    merge(parameters_.row_bytes, again.row_bytes);
    for (std::size_t k = 0; k < held_.sine.size(); ++k) {
      merge(held_.sine[k], repaired.sine[k]);
      merge(held_.cosine[k], repaired.cosine[k]);
    }
    return held_;
  }

 private:
  LLVMBasicBlockRef append(const char* name) const {
    return LLVMAppendBasicBlockInContext(context_, place_.function, name);
  }
  LLVMTypeRef integer_type() const { return LLVMInt64TypeInContext(context_); }
  LLVMTypeRef byte() const { return LLVMInt8TypeInContext(context_); }
  LLVMValueRef integer(std::size_t value) const {
    return LLVMConstInt(integer_type(), value, false);
  }
  LLVMValueRef add(LLVMTypeRef type, LLVMValueRef pointer, LLVMValueRef count) const {
    return LLVMBuildGEP2(builder_, type, pointer, &count, 1, "");
  }
  LLVMValueRef element(LLVMTypeRef type, LLVMValueRef array, std::size_t index) const {
    return add(type, array, integer(index));
  }
  LLVMValueRef row(std::uint32_t index) const {
    return add(byte(), parameters_.in,
               LLVMBuildMul(builder_, parameters_.row_bytes, integer(index), ""));
  }
  LLVMValueRef load_angles(LLVMValueRef from) const {
    const LLVMValueRef x = LLVMBuildLoad2(builder_, type_, from, "");
    LLVMSetAlignment(x, bytes_of(LLVMGetElementType(type_)));
    return Ir(builder_, type_, place_.fuse).to_double(x);
  }
  LLVMValueRef numbers(LLVMValueRef doubles) const {
    return Ir(builder_, type_, place_.fuse).from_double(doubles);
  }

  // Both return the sum of the magnitudes of all angles.
  LLVMValueRef in_registers() {
    SineConstants table(place_);
    const Ir ir = arithmetic(table);
    LLVMValueRef sum = LLVMConstNull(doubles_);
    const std::size_t in_step = type_ == doubles_ ? kInStep : kInStepOfFloats;
    const std::size_t groups = (rows_.size() + in_step - 1) / in_step;
    for (std::size_t group = 0, k = 0; group < groups; ++group) {
      std::vector<LLVMValueRef> angles;
      for (const std::size_t end = rows_.size() * (group + 1) / groups; k < end; ++k) {
        angles.push_back(load_angles(row(rows_[k])));
        sum = ir.add(ir.magnitude(angles.back()), sum);
      }
      const SincosValues values = fast_sincos_in_step(ir, angles);
      for (const LLVMValueRef value : values.sine) held_.sine.push_back(numbers(value));
      for (const LLVMValueRef value : values.cosine) held_.cosine.push_back(numbers(value));
    }
    table.end();
    return sum;
  }

  LLVMValueRef in_memory() {
    SineConstants table(place_);
    const Ir ir = arithmetic(table);
    LLVMValueRef sum = LLVMConstNull(doubles_);
    std::size_t at = 0;
    for (const Run& run : runs_of(rows_)) {
      sum = loop(run, type_, element(type_, array_, at), sum,
                 [&](LLVMValueRef from, LLVMValueRef to, LLVMValueRef sum_before) {
                   const LLVMValueRef x = load_angles(from);
                   const SincosPair pair = fast_sincos(ir, x);
                   LLVMBuildStore(builder_, numbers(pair.sine), to);
                   LLVMBuildStore(builder_, numbers(pair.cosine), element(type_, to, rows_.size()));
                   return ir.add(ir.magnitude(x), sum_before);
                 });
      at += run.count;
    }
    table.end();
    return sum;
  }

  Ir arithmetic(SineConstants& table) const {
    return {builder_, doubles_, place_.fuse,
            [&table](std::uint64_t bits, LLVMTypeRef type) { return table.load(bits, type); }};
  }

  // `body` writes what is done for each row of a run: it gets the row, an element of an array of
  // `type`, which begins at `into`, and a value, and returns the value for the next row.
  template <typename Body>
  LLVMValueRef loop(const Run& run, LLVMTypeRef type, LLVMValueRef into, LLVMValueRef value,
                    Body&& body) const {
    const LLVMValueRef first = row(run.first);
    const LLVMValueRef end = hidden(builder_, element(type, into, run.count));
    const LLVMBasicBlockRef before = LLVMGetInsertBlock(builder_);
    const LLVMBasicBlockRef inside = append("angles"), after = append("angles_done");
    LLVMBuildBr(builder_, inside);
    LLVMPositionBuilderAtEnd(builder_, inside);
    const auto phi = [&](LLVMValueRef start) {
      const LLVMValueRef made = LLVMBuildPhi(builder_, LLVMTypeOf(start), "");
      LLVMBasicBlockRef block = before;
      LLVMAddIncoming(made, &start, &block, 1);
      return made;
    };
    const LLVMValueRef from = phi(first), to = phi(into), carried = phi(value);
    const LLVMValueRef result = body(from, to, carried);
    const LLVMValueRef next_from = add(byte(), from, parameters_.row_bytes);
    const LLVMValueRef next_to = element(type, to, 1);
    LLVMBasicBlockRef block = inside;
    for (auto [made, next] : {std::pair{from, next_from}, {to, next_to}, {carried, result}}) {
      LLVMAddIncoming(made, &next, &block, 1);
    }
    LLVMBuildCondBr(builder_, LLVMBuildICmp(builder_, LLVMIntNE, next_to, end, ""), inside, after);
    LLVMPositionBuilderAtEnd(builder_, after);
    return result;
  }

  // In an array of doubles, from which all come back: a float that is not repaired is what it was.
  BlockParameters repair() const {
    const std::size_t n = rows_.size();
    const Ir doubles(builder_, doubles_, false), floats(builder_, type_, false);
    const LLVMValueRef work = doubles.entry_array(place_.function, 3 * n);
    LLVMSetAlignment(work, 64);
    for (std::size_t k = 0; k < held_.sine.size(); ++k) {
      LLVMBuildStore(builder_, held_.sine[k], element(type_, array_, k));
      LLVMBuildStore(builder_, held_.cosine[k], element(type_, array_, n + k));
    }
    copy(array_, type_, work, doubles_,
         [&](LLVMValueRef value) { return floats.to_double(value); });
    std::size_t at = 2 * n;
    for (const Run& run : runs_of(rows_)) {
      loop(run, doubles_, element(doubles_, work, at), integer(0),
           [&](LLVMValueRef from, LLVMValueRef to, LLVMValueRef nothing) {
             LLVMBuildStore(builder_, load_angles(from), to);
             return nothing;
           });
      at += run.count;
    }
    const LLVMValueRef bytes = Ir(builder_, integer_type(), false).entry_array(place_.function, 1);
    LLVMBuildStore(builder_, parameters_.row_bytes, bytes);
    LLVMValueRef arguments[] = {parameters_.in, parameters_.out, work,
                                integer(n * LLVMGetVectorSize(type_))};
    const LLVMValueRef both = LLVMBuildCall2(builder_, LLVMGlobalGetValueType(place_.repair),
                                             place_.repair, arguments, 4, "");
    copy(work, doubles_, array_, type_,
         [&](LLVMValueRef value) { return floats.from_double(value); });
    return {LLVMBuildExtractValue(builder_, both, 0, ""),
            LLVMBuildExtractValue(builder_, both, 1, ""),
            LLVMBuildLoad2(builder_, integer_type(), bytes, "")};
  }

  // All sines and cosines, from one array to another.
  template <typename Convert>
  void copy(LLVMValueRef from, LLVMTypeRef from_type, LLVMValueRef to, LLVMTypeRef to_type,
            Convert&& convert) const {
    const LLVMBasicBlockRef before = LLVMGetInsertBlock(builder_);
    const LLVMBasicBlockRef inside = append("copy"), after = append("copied");
    LLVMBuildBr(builder_, inside);
    LLVMPositionBuilderAtEnd(builder_, inside);
    const LLVMValueRef index = LLVMBuildPhi(builder_, integer_type(), "");
    const LLVMValueRef value = LLVMBuildLoad2(builder_, from_type, add(from_type, from, index), "");
    LLVMBuildStore(builder_, convert(value), add(to_type, to, index));
    const LLVMValueRef next = LLVMBuildAdd(builder_, index, integer(1), "");
    LLVMValueRef incoming[] = {integer(0), next};
    LLVMBasicBlockRef blocks[] = {before, inside};
    LLVMAddIncoming(index, incoming, blocks, 2);
    const LLVMValueRef all = integer(2 * rows_.size());
    LLVMBuildCondBr(builder_, LLVMBuildICmp(builder_, LLVMIntNE, next, all, ""), inside, after);
    LLVMPositionBuilderAtEnd(builder_, after);
  }

  SincosValues load_held() const {
    SincosValues values;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      values.sine.push_back(LLVMBuildLoad2(builder_, type_, element(type_, array_, k), ""));
      values.cosine.push_back(
          LLVMBuildLoad2(builder_, type_, element(type_, array_, rows_.size() + k), ""));
    }
    return values;
  }

  const Place& place_;
  LLVMBuilderRef builder_;
  LLVMContextRef context_;
  LLVMTypeRef type_, doubles_;
  const std::vector<std::uint32_t>& rows_;
  LLVMValueRef array_;
  BlockParameters& parameters_;
  SincosValues held_;
};

}  // namespace

bool sines_are_in_registers(const std::vector<std::uint32_t>& rows) {
  return rows.size() <= kMostInRegisters;
}

SincosValues emit_block_sines(const Place& place, LLVMTypeRef type,
                              const std::vector<std::uint32_t>& rows, LLVMValueRef array,
                              BlockParameters& parameters) {
  return BlockSines(place, type, rows, array, parameters).emit();
}

}  // namespace sinew::backend
