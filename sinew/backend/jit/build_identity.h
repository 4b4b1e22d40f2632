// Which build of this library is running.
#pragma once

#include <string>

namespace sinew::backend {

// The identity that the linker gave to this library (the note NT_GNU_BUILD_ID: a digest of what was
// linked); empty where there is none. Code that another build compiled is told apart by it.
std::string build_identity();

}  // namespace sinew::backend
