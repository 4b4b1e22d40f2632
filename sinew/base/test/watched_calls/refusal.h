// What a call throws, as text.
#pragma once

#include <string>

#include "sinew/base/error.h"

namespace sinew {

// All problems, one a line; "none" where it throws nothing.
template <typename Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace sinew
