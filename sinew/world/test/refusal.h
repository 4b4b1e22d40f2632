// What a call throws, as text.
#pragma once

#include <string>

#include "sinew/base/error.h"

namespace sinew::world {

// "none" where it throws nothing.
template <typename Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return to_string(error.problems().front());
  }
  return "none";
}

}  // namespace sinew::world
