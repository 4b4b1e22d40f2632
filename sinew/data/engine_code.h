// The interpreter's operations. Internal to the module.
#pragma once

#include "sinew/data/engine.h"

namespace sinew::data {

enum class Converter::Code : std::uint8_t {
  kEnd,
  kLoadDouble,   // register c = double at block a, x bytes from its begin
  kLoad,         // the same of any kind of number
  kLoadPath,     // the same behind pointers: path x
  kLoadDoubles,  // from block a the places x to y
  kStoreDoubles,
  kStoreDouble,  // the other way
  kStore,
  kStorePath,
  kAdd,  // c = a + b, and so on
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kSquareRoot,
  kCopy,    // c = a
  kSelect,  // c = a != 0 ? b : x
  kOther,   // c = ScalarOperation(kind) of a and b
  kCall,    // x of the calls
  kGuard,   // x of the guards
};

}  // namespace sinew::data
