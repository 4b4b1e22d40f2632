#include "sinew/data/engine_compile.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "sinew/data/engine_code.h"
#include "sinew/data/machine_code.h"

namespace sinew::data {

#if defined(__x86_64__) && defined(__unix__)

namespace {

constexpr std::uint64_t kSignBit = 1ull << 63;
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

}  // namespace

// Numbers are named as the interpreter's registers, each of which is written once. A number is in a
// vector register, in its place among the interpreter's registers (its home), or both; constants
// have a place behind the code. When all vector registers are taken, the number that is wanted
// last goes home (Belady 1966).
class ConverterCompiler {
 public:
  explicit ConverterCompiler(Converter& converter) : converter_(converter) {}

  void run() {
    flatten();
    collect_uses();
    enter();
    for (now_ = 0; now_ < list_.size(); ++now_) translate(list_[now_]);
    leave();
    converter_.code_ = code_.finish();
    if (!converter_.code_) return;
    converter_.compiled_ =
        reinterpret_cast<Converter::Compiled>(const_cast<void*>(converter_.code_.get()));
    converter_.needs_constants_ = calls_;
  }

 private:
  using Code = Converter::Code;
  using Operation = Converter::Operation;
  using I = Instruction;

  struct Item {
    Operation operation;
    std::uint32_t index = 0;  // among the converter's operations
  };

  void flatten() {
    const auto& operations = converter_.operations_;
    for (std::uint32_t i = 0; i < operations.size(); ++i) {
      const Operation& o = operations[i];
      if (o.code == Code::kLoadDoubles || o.code == Code::kStoreDoubles) {
        for (std::uint32_t k = o.x; k < o.y; ++k) {
          const Converter::Place& place = converter_.places_[k];
          const Code one = o.code == Code::kLoadDoubles ? Code::kLoadDouble : Code::kStoreDouble;
          list_.push_back(
              {{one, 0, o.a, 0, static_cast<std::uint16_t>(place.number), place.offset, 0}, i});
        }
      } else if (o.code != Code::kEnd) {
        list_.push_back({o, i});
      }
    }
    for (const Item& item : list_) calls_ |= !is_native(item.operation);
  }

  static bool is_float(const Operation& o) { return ScalarKind(o.kind) == ScalarKind::kFloat32; }
  static bool is_native(const Operation& o) {
    switch (o.code) {
      case Code::kLoadDouble:
      case Code::kStoreDouble:
      case Code::kAdd:
      case Code::kSubtract:
      case Code::kMultiply:
      case Code::kDivide:
      case Code::kNegate:
      case Code::kSquareRoot:
      case Code::kCopy:
      case Code::kSelect:
        return true;
      case Code::kLoad:
      case Code::kStore:
        return is_float(o);
      case Code::kOther:
        return ScalarOperation(o.kind) == ScalarOperation::kLess ||
               ScalarOperation(o.kind) == ScalarOperation::kAbsolute ||
               ScalarOperation(o.kind) == ScalarOperation::kCopySign;
      default:
        return false;
    }
  }

  void collect_uses() {
    uses_.resize(kMaximumRegisters);
    next_.resize(kMaximumRegisters, 0);
    at_home_.resize(kMaximumRegisters, false);
    vector_of_.resize(kMaximumRegisters);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const Operation& o = list_[i].operation;
      const auto use = [&](std::size_t number) {
        if (uses_[number].empty() || uses_[number].back() != i) uses_[number].push_back(i);
      };
      switch (o.code) {
        case Code::kStoreDouble:
        case Code::kStore:
        case Code::kStorePath:
          use(o.c);
          break;
        case Code::kAdd:
        case Code::kSubtract:
        case Code::kMultiply:
        case Code::kDivide:
        case Code::kOther:
          use(o.a);
          use(o.b);
          break;
        case Code::kNegate:
        case Code::kSquareRoot:
        case Code::kCopy:
          use(o.a);
          break;
        case Code::kSelect:
          use(o.a);
          use(o.b);
          use(o.x);
          break;
        default:
          break;
      }
    }
  }

  bool is_constant(std::size_t number) const { return number < converter_.constants_.size(); }
  // The next operation after this one (or from this one on) that reads the number.
  std::size_t next_use(std::size_t number, bool from_now = false) {
    std::size_t& at = next_[number];
    const std::vector<std::size_t>& uses = uses_[number];
    while (at < uses.size() && uses[at] < now_) ++at;
    std::size_t i = at;
    while (!from_now && i < uses.size() && uses[i] <= now_) ++i;
    return i < uses.size() ? uses[i] : kNever;
  }

  static std::int32_t home(std::size_t number) {
    return static_cast<std::int32_t>(number * sizeof(double));
  }
  void send_home(std::size_t number) {
    if (is_constant(number) || at_home_[number]) return;
    code_.instruction(I::kMoveStore, *vector_of_[number], registers_, home(number));
    at_home_[number] = true;
  }
  void forget(Vector vector) {
    if (!holds_[vector]) return;
    vector_of_[*holds_[vector]].reset();
    holds_[vector].reset();
  }

  // A vector register for something new; `keep` are not to be touched.
  Vector fresh(std::initializer_list<Vector> keep) {
    const auto kept = [&](Vector vector) {
      for (const Vector it : keep) {
        if (it == vector) return true;
      }
      return false;
    };
    std::optional<Vector> best;
    std::size_t farthest = 0;
    for (Vector vector = 0; vector < kVectors; ++vector) {
      if (kept(vector)) continue;
      const std::size_t wanted = holds_[vector] ? next_use(*holds_[vector], true) : kNever;
      if (!holds_[vector] || wanted == kNever) {
        forget(vector);
        return vector;
      }
      if (!best || wanted > farthest) {
        best = vector;
        farthest = wanted;
      }
    }
    send_home(*holds_[*best]);
    forget(*best);
    return *best;
  }

  // The vector register that has the number, which is fetched if need be.
  Vector fetch(std::size_t number, std::initializer_list<Vector> keep) {
    if (vector_of_[number]) return *vector_of_[number];
    const Vector vector = fresh(keep);
    if (is_constant(number)) {
      code_.with_constant(I::kMove, vector, converter_.constants_[number]);
    } else {
      code_.instruction(I::kMove, vector, registers_, home(number));
      at_home_[number] = true;
    }
    give(number, vector);
    return vector;
  }
  void give(std::size_t number, Vector vector) {
    forget(vector);
    holds_[vector] = number;
    vector_of_[number] = vector;
  }

  // Begins a result as a copy of the number: in its own register if nobody needs it any more.
  Vector begin_with(std::size_t number, std::initializer_list<Vector> keep) {
    const Vector has = fetch(number, keep);
    const bool wanted_too = std::find(keep.begin(), keep.end(), has) != keep.end();
    if (next_use(number) == kNever && !wanted_too) {
      forget(has);
      return has;
    }
    std::array<Vector, 4> kept = {has, has, has, has};
    std::size_t i = 1;
    for (const Vector it : keep) kept[i++] = it;
    const Vector result = fresh({kept[0], kept[1], kept[2], kept[3]});
    code_.instruction(I::kMoveAll, result, has);
    return result;
  }

  // Result = a OP b, where b may stay in memory.
  void binary(I instruction, std::size_t a, std::size_t b, std::size_t result, bool commutes) {
    if (commutes && vector_of_[b] && next_use(b) == kNever &&
        !(vector_of_[a] && next_use(a) == kNever)) {
      std::swap(a, b);
    }
    if (a == b) {
      const Vector both = begin_with(a, {});
      code_.instruction(instruction, both, both);
      return give(result, both);
    }
    if (vector_of_[b]) {
      const Vector right = *vector_of_[b];
      const Vector left = begin_with(a, {right});
      code_.instruction(instruction, left, right);
      return give(result, left);
    }
    const Vector left = begin_with(a, {});
    if (is_constant(b)) {
      code_.with_constant(instruction, left, converter_.constants_[b]);
    } else {
      code_.instruction(instruction, left, registers_, home(b));
    }
    give(result, left);
  }

  General block(std::size_t index) {
    if (index == 0) return source_;
    if (index == 1) return target_;
    code_.load(General::kAx, blocks_, static_cast<std::int32_t>(index * sizeof(char*)));
    return General::kAx;
  }

  void translate(const Item& item) {
    const Operation& o = item.operation;
    if (!is_native(o)) return interpret(item);
    switch (o.code) {
      case Code::kLoadDouble:
      case Code::kLoad: {
        const Vector vector = fresh({});
        const I load = o.code == Code::kLoad ? I::kFloatToDouble : I::kMove;
        code_.instruction(load, vector, block(o.a), static_cast<std::int32_t>(o.x));
        return give(o.c, vector);
      }
      case Code::kStoreDouble: {
        const Vector vector = fetch(o.c, {});
        return code_.instruction(I::kMoveStore, vector, block(o.a), static_cast<std::int32_t>(o.x));
      }
      case Code::kStore: {
        const Vector vector = fetch(o.c, {}), single = fresh({vector});
        code_.instruction(I::kDoubleToFloat, single, vector);
        return code_.instruction(I::kMoveFloatStore, single, block(o.a),
                                 static_cast<std::int32_t>(o.x));
      }
      case Code::kAdd:
        return binary(I::kAdd, o.a, o.b, o.c, true);
      case Code::kSubtract:
        return binary(I::kSubtract, o.a, o.b, o.c, false);
      case Code::kMultiply:
        return binary(I::kMultiply, o.a, o.b, o.c, true);
      case Code::kDivide:
        return binary(I::kDivide, o.a, o.b, o.c, false);
      case Code::kNegate: {
        const Vector vector = begin_with(o.a, {});
        code_.with_bits(I::kExclusiveOr, vector, kSignBit);
        return give(o.c, vector);
      }
      case Code::kSquareRoot: {
        const Vector has = fetch(o.a, {}), vector = fresh({has});
        code_.instruction(I::kSquareRoot, vector, has);
        return give(o.c, vector);
      }
      case Code::kCopy:
        return give(o.c, begin_with(o.a, {}));
      case Code::kSelect:
        return select(o);
      default:
        return other(o);
    }
  }

  // a != 0 ? b : x, by masks: nothing is jumped over, so the time does not depend on the numbers.
  void select(const Operation& o) {
    const Vector b = fetch(o.b, {});
    const Vector c = fetch(o.x, {b});
    const Vector mask = begin_with(o.a, {b, c});
    const Vector zero = fresh({b, c, mask});
    code_.instruction(I::kExclusiveOr, zero, zero);
    code_.compare(MachineCode::Compare::kNotEqual, mask, zero);
    code_.instruction(I::kMoveAll, zero, mask);
    code_.instruction(I::kAnd, zero, b);
    code_.instruction(I::kAndNot, mask, c);
    code_.instruction(I::kOr, mask, zero);
    give(o.c, mask);
  }

  void other(const Operation& o) {
    switch (ScalarOperation(o.kind)) {
      case ScalarOperation::kAbsolute: {
        const Vector vector = begin_with(o.a, {});
        code_.with_bits(I::kAnd, vector, ~kSignBit);
        return give(o.c, vector);
      }
      case ScalarOperation::kLess: {
        const Vector b = fetch(o.b, {});
        const Vector vector = begin_with(o.a, {b});
        code_.compare(MachineCode::Compare::kLess, vector, b);
        code_.with_constant(I::kAnd, vector, 1.0);
        return give(o.c, vector);
      }
      default: {  // copysign
        const Vector b = fetch(o.b, {});
        const Vector vector = begin_with(o.a, {b});
        const Vector sign = fresh({vector, b});
        code_.instruction(I::kMoveAll, sign, b);
        code_.with_bits(I::kAnd, sign, kSignBit);
        code_.with_bits(I::kAnd, vector, ~kSignBit);
        code_.instruction(I::kOr, vector, sign);
        return give(o.c, vector);
      }
    }
  }

  // One operation by the interpreter, which finds and leaves all numbers at home.
  void interpret(const Item& item) {
    for (Vector vector = 0; vector < kVectors; ++vector) {
      if (!holds_[vector]) continue;
      if (next_use(*holds_[vector], true) != kNever) send_home(*holds_[vector]);
      forget(vector);
    }
    code_.move(General::kDi, self_);
    code_.load_number(General::kSi, item.index);
    code_.move(General::kDx, registers_);
    code_.move(General::kCx, blocks_);
    code_.call(reinterpret_cast<const void*>(&Converter::step_at), General::kAx);
    code_.leave_if_false();
    const Operation& o = item.operation;
    const bool gives = o.code == Code::kLoad || o.code == Code::kLoadPath || o.code == Code::kOther;
    if (gives) at_home_[o.c] = true;
  }

  // The function's arguments are in di (registers), si (blocks), dx (the converter). Where nothing
  // is called they can stay in registers that calls may overwrite.
  void enter() {
    code_.landing();
    if (calls_) {
      for (const General reg : kSaved) code_.push(reg);
      code_.move(General::kBx, General::kDi);
      code_.move(General::k12, General::kSi);
      code_.move(General::k13, General::kDx);
      registers_ = General::kBx;
      blocks_ = General::k12;
      self_ = General::k13;
      source_ = General::k14;
      target_ = General::k15;
    }
    code_.load(source_, blocks_, 0);
    code_.load(target_, blocks_, sizeof(char*));
  }

  void leave() {
    code_.load_number(General::kAx, 1);
    code_.mark_end();
    if (calls_) {
      for (std::size_t i = kSaved.size(); i-- > 0;) code_.pop(kSaved[i]);
    }
    code_.return_();
  }

  // An odd number of them, so that the stack is on a multiple of 16 at calls.
  static constexpr std::array<General, 5> kSaved = {General::kBx, General::k12, General::k13,
                                                    General::k14, General::k15};

  Converter& converter_;
  MachineCode code_;
  std::vector<Item> list_;
  std::size_t now_ = 0;
  bool calls_ = false;
  General registers_ = General::kDi, blocks_ = General::kSi, self_ = General::kDx;
  General source_ = General::k8, target_ = General::k9;
  std::vector<std::vector<std::size_t>> uses_;
  std::vector<std::size_t> next_;
  std::vector<bool> at_home_;
  std::vector<std::optional<Vector>> vector_of_;
  std::array<std::optional<std::size_t>, kVectors> holds_;
};

void compile(Converter& converter) { ConverterCompiler(converter).run(); }

#else

void compile(Converter&) {}

#endif

}  // namespace sinew::data
