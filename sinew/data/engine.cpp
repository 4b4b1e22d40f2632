#include "sinew/data/engine.h"

#include <cmath>
#include <cstring>

#include "sinew/data/engine_code.h"

namespace sinew::data {
namespace {

template <typename Number>
Number read_as(const char* at) {
  Number value;
  std::memcpy(static_cast<void*>(&value), at, sizeof value);
  return value;
}

template <typename Number>
void write_as(char* at, Number value) {
  std::memcpy(at, &value, sizeof value);
}

double load(ScalarKind kind, const char* at) {
  switch (kind) {
    case ScalarKind::kInt8:
      return read_as<std::int8_t>(at);
    case ScalarKind::kInt16:
      return read_as<std::int16_t>(at);
    case ScalarKind::kInt32:
      return read_as<std::int32_t>(at);
    case ScalarKind::kInt64:
      return static_cast<double>(read_as<std::int64_t>(at));
    case ScalarKind::kUint8:
      return read_as<std::uint8_t>(at);
    case ScalarKind::kUint16:
      return read_as<std::uint16_t>(at);
    case ScalarKind::kUint32:
      return read_as<std::uint32_t>(at);
    case ScalarKind::kUint64:
      return static_cast<double>(read_as<std::uint64_t>(at));
    case ScalarKind::kFloat32:
      return read_as<float>(at);
    case ScalarKind::kFloat64:
      return read_as<double>(at);
  }
  return 0;
}

void store(ScalarKind kind, char* at, double value) {
  switch (kind) {
    case ScalarKind::kInt8:
      return write_as(at, static_cast<std::int8_t>(std::llround(value)));
    case ScalarKind::kInt16:
      return write_as(at, static_cast<std::int16_t>(std::llround(value)));
    case ScalarKind::kInt32:
      return write_as(at, static_cast<std::int32_t>(std::llround(value)));
    case ScalarKind::kInt64:
      return write_as(at, static_cast<std::int64_t>(std::llround(value)));
    case ScalarKind::kUint8:
      return write_as(at, static_cast<std::uint8_t>(std::llround(value)));
    case ScalarKind::kUint16:
      return write_as(at, static_cast<std::uint16_t>(std::llround(value)));
    case ScalarKind::kUint32:
      return write_as(at, static_cast<std::uint32_t>(std::llround(value)));
    case ScalarKind::kUint64:
      return write_as(at, static_cast<std::uint64_t>(std::llround(value)));
    case ScalarKind::kFloat32:
      return write_as(at, static_cast<float>(value));
    case ScalarKind::kFloat64:
      return write_as(at, value);
  }
}

char* follow(char* base, const std::vector<std::size_t>& offsets) {
  char* at = base + offsets[0];
  for (std::size_t i = 1; i < offsets.size(); ++i) at = read_as<char*>(at) + offsets[i];
  return at;
}

// The number of elements of a std::vector (begin and end pointers) or of asn1c's list (array,
// count).
std::size_t count_of(const char* container, bool list, std::size_t element_size) {
  if (list) return static_cast<std::size_t>(read_as<int>(container + sizeof(void*)));
  return static_cast<std::size_t>(read_as<char*>(container + sizeof(void*)) -
                                  read_as<char*>(container)) /
         element_size;
}

}  // namespace

void Converter::call(const Call& call, char* const* blocks) const {
  using Form = Call::Form;
  char *input = blocks[call.input], *output = blocks[call.output];
  switch (call.form) {
    case Form::kInOut:
      return reinterpret_cast<void (*)(const void*, void*)>(call.function)(input, output);
    case Form::kOutIn:
      return reinterpret_cast<void (*)(void*, const void*)>(call.function)(output, input);
    case Form::kValueOut:
      return reinterpret_cast<void (*)(double, void*)>(call.function)(read_as<double>(input),
                                                                      output);
    case Form::kOutValue:
      return reinterpret_cast<void (*)(void*, double)>(call.function)(output,
                                                                      read_as<double>(input));
    case Form::kReturnOfIn:
      return write_as(output, reinterpret_cast<double (*)(const void*)>(call.function)(input));
    case Form::kReturnOfValue:
      return write_as(output,
                      reinterpret_cast<double (*)(double)>(call.function)(read_as<double>(input)));
  }
}

// False ends the conversion.
[[gnu::always_inline]] inline bool Converter::step(const Operation& o, double* r,
                                                   char* const* blocks) const {
  switch (o.code) {
    case Code::kEnd:
      return false;
    case Code::kLoadDoubles:
      for (const Place *place = places_.data() + o.x, *end = places_.data() + o.y; place != end;
           ++place) {
        r[place->number] = read_as<double>(blocks[o.a] + place->offset);
      }
      break;
    case Code::kStoreDoubles:
      for (const Place *place = places_.data() + o.x, *end = places_.data() + o.y; place != end;
           ++place) {
        write_as(blocks[o.a] + place->offset, r[place->number]);
      }
      break;
    case Code::kLoadDouble:
      r[o.c] = read_as<double>(blocks[o.a] + o.x);
      break;
    case Code::kLoad:
      r[o.c] = load(ScalarKind(o.kind), blocks[o.a] + o.x);
      break;
    case Code::kLoadPath:
      r[o.c] = load(ScalarKind(o.kind), follow(blocks[o.a], paths_[o.x].offsets));
      break;
    case Code::kStoreDouble:
      write_as(blocks[o.a] + o.x, r[o.c]);
      break;
    case Code::kStore:
      store(ScalarKind(o.kind), blocks[o.a] + o.x, r[o.c]);
      break;
    case Code::kStorePath:
      store(ScalarKind(o.kind), follow(blocks[o.a], paths_[o.x].offsets), r[o.c]);
      break;
    case Code::kAdd:
      r[o.c] = r[o.a] + r[o.b];
      break;
    case Code::kSubtract:
      r[o.c] = r[o.a] - r[o.b];
      break;
    case Code::kMultiply:
      r[o.c] = r[o.a] * r[o.b];
      break;
    case Code::kDivide:
      r[o.c] = r[o.a] / r[o.b];
      break;
    case Code::kNegate:
      r[o.c] = -r[o.a];
      break;
    case Code::kSquareRoot:
      r[o.c] = std::sqrt(r[o.a]);
      break;
    case Code::kCopy:
      r[o.c] = r[o.a];
      break;
    case Code::kSelect:
      r[o.c] = r[o.a] != 0.0 ? r[o.b] : r[o.x];
      break;
    case Code::kOther:
      r[o.c] = evaluate(ScalarOperation(o.kind), r[o.a], r[o.b], 0);
      break;
    case Code::kCall:
      call(calls_[o.x], blocks);
      break;
    case Code::kGuard: {
      const Guard& guard = guards_[o.x];
      if (count_of(follow(blocks[guard.block], guard.offsets), guard.list, guard.element_size) <=
          guard.index) {
        return false;
      }
      break;
    }
  }
  return true;
}

bool Converter::step_at(const Converter* converter, std::uint64_t index, double* registers,
                        char* const* blocks) {
  return converter->step(converter->operations_[index], registers, blocks);
}

bool Converter::run(const void* source, void* target, std::span<const void* const> inputs) const {
  if (inputs.size() != inputs_) return false;
  double r[kMaximumRegisters];
  alignas(64) char scratch[kMaximumScratch];
  char* blocks[kMaximumBlocks];
  // The source and the inputs are only read.
  blocks[0] = const_cast<char*>(static_cast<const char*>(source));
  blocks[1] = static_cast<char*>(target);
  for (std::size_t i = 0; i < inputs_; ++i) {
    blocks[2 + i] = const_cast<char*>(static_cast<const char*>(inputs[i]));
  }
  for (std::size_t i = 0; i < scratch_.size(); ++i) blocks[2 + inputs_ + i] = scratch + scratch_[i];
  if (needs_constants_) {
    for (std::size_t i = 0; i < constants_.size(); ++i) r[i] = constants_[i];
  }
  if (compiled_) return compiled_(r, blocks, this);
  const Operation* at = operations_.data();
  while (step(*at, r, blocks)) ++at;
  return at->code == Code::kEnd;
}

}  // namespace sinew::data
