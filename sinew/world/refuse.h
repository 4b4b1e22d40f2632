// How the module's errors are made.
#pragma once

#include <string>
#include <string_view>

#include "sinew/base/error.h"

namespace sinew::world {

[[noreturn]] inline void refuse(std::string_view iri, std::string what, std::string remedy) {
  throw Error(
      Problem{{}, std::string(iri), std::move(what), std::move(remedy), Severity::kError, {}});
}

}  // namespace sinew::world
