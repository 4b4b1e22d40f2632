#include "sinew/backend/jit/sincos.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "sinew/backend/jit/ir_in_step.h"
#include "sinew/backend/jit/sine_constants.h"

namespace sinew::backend {
namespace {

// Vectors of angles from which on a loop computes their sines.
constexpr std::size_t kFewestForLoop = 3;

constexpr double kTwoOverPi = 6.36619772367581382433e-01;
// Adding and taking away 1.5 * 2^52 rounds to an integer and leaves it in the low bits.
constexpr double kRounder = 6755399441055744.0;
// pi/2 in parts: the first two have 33 bits, so their products with quotients below 2^20 are exact.
constexpr double kHalfPi1 = 1.57079632673412561417e+00;
constexpr double kHalfPi2 = 6.07710050630396597660e-11;
constexpr double kHalfPi3 = 2.02226624879595063154e-21;

// sin(r) = r + r^3 (s[0] + s[1] r^2 + ...), cos(r) = 1 - r^2/2 + r^4 (c[0] + c[1] r^2 + ...)
constexpr double kSine[] = {-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                            -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                            -2.50507602534068634195e-08, 1.58969099521155010221e-10};
constexpr double kCosine[] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                              2.48015872894767294178e-05, -2.75573143513906633035e-07,
                              2.08757232129817482790e-09, -1.13596475577881948265e-11};

template <typename Arithmetic, typename Value>
Value horner(const Arithmetic& ir, const Value& z, const double (&coefficients)[6]) {
  Value sum = ir.number(coefficients[5]);
  for (int i = 4; i >= 0; --i) sum = ir.multiply_add(sum, z, ir.number(coefficients[i]));
  return sum;
}

// cos = 1 - z/2 + z^2 c(z)
template <typename Arithmetic, typename Value>
Value cosine_of(const Arithmetic& ir, const Value& z, const Value& polynomial) {
  const Value one = ir.number(1.0);
  if (ir.fuses()) {
    return ir.multiply_add(z, ir.multiply_add(z, polynomial, ir.number(-0.5)), one);
  }
  // 1 - z/2 is rounded once, and its error put back.
  const Value half = ir.multiply(z, ir.number(0.5));
  const Value near = ir.subtract(one, half);
  const Value error = ir.subtract(ir.subtract(one, near), half);
  return ir.add(near, ir.add(error, ir.multiply(ir.multiply(z, z), polynomial)));
}

template <typename Value>
struct Pair {
  Value sine, cosine;
};

// Within 0.9 units in the last place; 0.95 where the machine cannot fuse.
template <typename Arithmetic, typename Value>
Pair<Value> fast_pair(const Arithmetic& ir, const Value& x) {
  const Value shifted = ir.multiply_add(x, ir.number(kTwoOverPi), ir.number(kRounder));
  const Value quotient = ir.subtract(shifted, ir.number(kRounder));
  const Value bits = ir.to_integer_bits(shifted);

  // r + tail = x - quotient * pi/2; the first two products are exact, and so is what they leave,
  // but for r, whose rounding goes into the tail.
  const Value back = ir.negate(quotient);
  const Value r1 = ir.multiply_add(back, ir.number(kHalfPi1), x);
  const Value r = ir.multiply_add(back, ir.number(kHalfPi2), r1);
  const Value lost = ir.multiply_add(back, ir.number(kHalfPi2), ir.subtract(r1, r));
  const Value tail = ir.multiply_add(back, ir.number(kHalfPi3), lost);

  const Value square = ir.multiply(r, r);
  // (r + tail)^2, but for the square of the tail
  const Value z = ir.multiply_add(r, r, ir.multiply(ir.add(r, r), tail));
  const Value sine =
      ir.add(r, ir.multiply_add(ir.multiply(square, r), horner(ir, square, kSine), tail));
  const Value cosine = cosine_of(ir, z, horner(ir, square, kCosine));

  // Quadrant q: (sin, cos) = (s, c), (c, -s), (-s, -c), (-c, s).
  const Value odd = ir.bit_is_set(bits, 0);
  const Value second = ir.shift_left(bits, 62);  // of the low bits is now the sign
  const Value of_next = ir.add_integer(second, std::uint64_t{1} << 62);
  return {ir.flip_sign(ir.select(odd, cosine, sine), second),
          ir.flip_sign(ir.select(odd, sine, cosine), of_next)};
}

}  // namespace

SincosPair fast_sincos(const Ir& ir, LLVMValueRef angle) {
  const Pair<LLVMValueRef> pair = fast_pair(ir, angle);
  return {pair.sine, pair.cosine};
}

SincosValues fast_sincos_in_step(const Ir& ir, const std::vector<LLVMValueRef>& angles) {
  const Pair<IrInStep::Values> pairs = fast_pair(IrInStep(ir, angles.size()), angles);
  return {pairs.sine, pairs.cosine};
}

namespace {

// Those of all angles; a bit that says whether the method covers all of them.
LLVMValueRef fast_sincos(const Ir& ir, LLVMBuilderRef builder,
                         const std::vector<LLVMValueRef>& angles, SincosValues& values) {
  LLVMValueRef covered = nullptr;
  for (const LLVMValueRef x : angles) {
    const SincosPair pair = fast_sincos(ir, x);
    values.sine.push_back(pair.sine);
    values.cosine.push_back(pair.cosine);
    const LLVMValueRef in_range = ir.magnitude_at_most(x, kLargestAngle);
    covered = covered == nullptr ? in_range : LLVMBuildAnd(builder, covered, in_range, "");
  }
  return ir.all(covered);
}

// Where the repair is made, and where the code goes on.
class Repair {
 public:
  Repair(LLVMBuilderRef builder, LLVMValueRef function, LLVMValueRef covered)
      : builder_(builder), fast_(LLVMGetInsertBlock(builder)) {
    const LLVMContextRef context = LLVMGetTypeContext(LLVMTypeOf(covered));
    slow_ = LLVMAppendBasicBlockInContext(context, function, "repair");
    next_ = LLVMAppendBasicBlockInContext(context, function, "reduced");
    LLVMBuildCondBr(builder, covered, next_, slow_);
    LLVMPositionBuilderAtEnd(builder, slow_);
  }
  // `values`: see sinew_sincos_repair. Returns the pointers that were handed over.
  LLVMValueRef call(LLVMValueRef repair, LLVMValueRef first, LLVMValueRef second,
                    LLVMValueRef values, std::size_t n) const {
    const LLVMContextRef context = LLVMGetTypeContext(LLVMTypeOf(values));
    LLVMValueRef arguments[] = {first, second, values,
                                LLVMConstInt(LLVMInt64TypeInContext(context), n, false)};
    return LLVMBuildCall2(builder_, LLVMGlobalGetValueType(repair), repair, arguments, 4, "");
  }
  void end() const {
    LLVMBuildBr(builder_, next_);
    LLVMPositionBuilderAtEnd(builder_, next_);
  }
  // After the end: the value, or what the repair has made of it.
  void merge(LLVMValueRef& value, LLVMValueRef repaired) const {
    if (value == nullptr) return;
    const LLVMValueRef phi = LLVMBuildPhi(builder_, LLVMTypeOf(value), "");
    LLVMValueRef incoming[] = {value, repaired};
    LLVMBasicBlockRef blocks[] = {fast_, slow_};
    LLVMAddIncoming(phi, incoming, blocks, 2);
    value = phi;
  }
  void merge(SincosValues& values, const SincosValues& repaired) const {
    for (std::size_t i = 0; i < values.sine.size(); ++i) merge(values.sine[i], repaired.sine[i]);
    for (std::size_t i = 0; i < values.sine.size(); ++i) {
      merge(values.cosine[i], repaired.cosine[i]);
    }
  }

 private:
  LLVMBuilderRef builder_;
  LLVMBasicBlockRef fast_, slow_ = nullptr, next_ = nullptr;
};

// Sines, cosines and angles as the repair wants them, one behind the other in one array.
void store_values(const Ir& ir, const SincosValues& values, LLVMValueRef array) {
  const std::size_t n = values.sine.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (values.sine[i] == nullptr) continue;
    ir.store_element(values.sine[i], array, i);
    ir.store_element(values.cosine[i], array, n + i);
  }
}
void store_angles(const Ir& ir, const std::vector<LLVMValueRef>& angles, LLVMValueRef array) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    ir.store_element(angles[i], array, 2 * angles.size() + i);
  }
}
// Those that are there in `values`, once more.
SincosValues load_values(const Ir& ir, LLVMValueRef array, const SincosValues& values) {
  SincosValues loaded = values;
  const std::size_t n = values.sine.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (values.sine[i] == nullptr) continue;
    loaded.sine[i] = ir.load_element(array, i);
    loaded.cosine[i] = ir.load_element(array, n + i);
  }
  return loaded;
}

LLVMValueRef fast_sincos_from_table(const Place& place, const std::vector<LLVMValueRef>& angles,
                                    SincosValues& values) {
  SineConstants table(place);
  const Ir ir(place.builder, LLVMTypeOf(angles.front()), place.fuse,
              [&](std::uint64_t bits, LLVMTypeRef type) { return table.load(bits, type); });
  const LLVMValueRef covered = fast_sincos(ir, place.builder, angles, values);
  table.end();
  return covered;
}

// Of the sum of the squares: far is what the method may not cover, and some of what it does.
LLVMValueRef all_are_near(const Ir& ir, const std::vector<LLVMValueRef>& angles) {
  LLVMValueRef sum = ir.multiply(angles.front(), angles.front());
  for (std::size_t i = 1; i < angles.size(); ++i) {
    sum = ir.multiply_add(angles[i], angles[i], sum);
  }
  return ir.magnitude_at_most(sum, kLargestAngle * kLargestAngle);
}

// The last on its own, for what waits for it; the others, whose angles are in the array, by a loop.
void fast_sincos_in_loop(const Place& place, LLVMValueRef last, std::size_t n, LLVMValueRef array,
                         SincosValues& values) {
  const LLVMTypeRef type = LLVMTypeOf(last);
  const LLVMContextRef context = LLVMGetTypeContext(type);
  const LLVMTypeRef integer = LLVMInt64TypeInContext(context);
  SineConstants table(place);
  const Ir ir(place.builder, type, place.fuse,
              [&](std::uint64_t bits, LLVMTypeRef lane) { return table.load(bits, lane); });
  values.sine.resize(n, nullptr);
  values.cosine.resize(n, nullptr);
  const SincosPair pair = fast_sincos(ir, last);
  values.sine.back() = pair.sine;
  values.cosine.back() = pair.cosine;
  store_values(ir, values, array);

  const LLVMBasicBlockRef before = LLVMGetInsertBlock(place.builder);
  const LLVMBasicBlockRef loop = LLVMAppendBasicBlockInContext(context, place.function, "sines");
  const LLVMBasicBlockRef after = LLVMAppendBasicBlockInContext(context, place.function, "");
  LLVMBuildBr(place.builder, loop);
  LLVMPositionBuilderAtEnd(place.builder, loop);
  const LLVMValueRef at = LLVMBuildPhi(place.builder, integer, "");
  const auto element = [&](std::size_t from) {
    LLVMValueRef index = LLVMBuildAdd(place.builder, at, LLVMConstInt(integer, from, false), "");
    return LLVMBuildInBoundsGEP2(place.builder, type, array, &index, 1, "");
  };
  const SincosPair next = fast_sincos(ir, LLVMBuildLoad2(place.builder, type, element(2 * n), ""));
  LLVMBuildStore(place.builder, next.sine, element(0));
  LLVMBuildStore(place.builder, next.cosine, element(n));
  LLVMValueRef begin = LLVMConstInt(integer, 0, false);
  LLVMValueRef following = LLVMBuildAdd(place.builder, at, LLVMConstInt(integer, 1, false), "");
  LLVMBasicBlockRef from_before = before, from_loop = loop;
  LLVMAddIncoming(at, &begin, &from_before, 1);
  LLVMAddIncoming(at, &following, &from_loop, 1);
  LLVMBuildCondBr(
      place.builder,
      LLVMBuildICmp(place.builder, LLVMIntNE, following, LLVMConstInt(integer, n - 1, false), ""),
      loop, after);
  LLVMPositionBuilderAtEnd(place.builder, after);
  table.end();
}

}  // namespace

SincosValues emit_sincos(LLVMBuilderRef builder, LLVMValueRef function, LLVMValueRef repair,
                         const std::vector<LLVMValueRef>& angles, bool fuse) {
  SincosValues values;
  if (angles.empty()) return values;
  const Ir ir(builder, LLVMTypeOf(angles.front()), fuse);
  const Repair slow(builder, function, fast_sincos(ir, builder, angles, values));

  // The repair works in memory; the array is made in the entry block so that it is made once.
  const std::size_t n = angles.size();
  const LLVMValueRef array = ir.entry_array(function, 3 * n);
  store_values(ir, values, array);
  store_angles(ir, angles, array);
  const LLVMValueRef none = LLVMConstNull(LLVMTypeOf(array));
  slow.call(repair, none, none, array, n * ir.lanes());
  const SincosValues repaired = load_values(ir, array, values);
  slow.end();
  slow.merge(values, repaired);
  return values;
}

SincosValues emit_sincos_to(const Place& place, const std::vector<LLVMValueRef>& angles,
                            LLVMValueRef array, LLVMValueRef& first, LLVMValueRef& second) {
  SincosValues values;
  const Ir ir(place.builder, LLVMTypeOf(angles.front()), place.fuse);
  const std::size_t n = angles.size();
  const bool loops = place.broadcasts && n >= kFewestForLoop;
  LLVMValueRef covered = nullptr;
  if (loops) {
    store_angles(ir, angles, array);
    covered = ir.all(all_are_near(ir, angles));
    fast_sincos_in_loop(place, angles.back(), n, array, values);
  } else {
    covered = place.broadcasts ? fast_sincos_from_table(place, angles, values)
                               : fast_sincos(ir, place.builder, angles, values);
    store_values(ir, values, array);
  }
  const Repair slow(place.builder, place.function, covered);
  if (!loops) store_angles(ir, angles, array);
  const LLVMValueRef both = slow.call(place.repair, first, second, array, n * ir.lanes());
  const LLVMValueRef again[] = {LLVMBuildExtractValue(place.builder, both, 0, ""),
                                LLVMBuildExtractValue(place.builder, both, 1, "")};
  const SincosValues repaired = load_values(ir, array, values);
  slow.end();
  slow.merge(first, again[0]);
  slow.merge(second, again[1]);
  slow.merge(values, repaired);
  return values;
}

extern "C" SincosPointers sinew_sincos_repair(const void* first, void* second, double* values,
                                              std::size_t n) {
  double* const sine = values;
  double* const cosine = values + n;
  const double* const x = values + 2 * n;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::fabs(x[i]) <= kLargestAngle) continue;
    sine[i] = std::sin(x[i]);
    cosine[i] = std::cos(x[i]);
  }
  return {first, second};
}

}  // namespace sinew::backend
