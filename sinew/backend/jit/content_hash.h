// What a computation is, as a name for its compiled code.
#pragma once

#include <string>
#include <string_view>

#include "sinew/program/dag/dag.h"
#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

// 128 bits in hexadecimal, of everything that the machine code depends on: the graphs, their
// results and order, and `machine` (the target and the compiler). Two hashes of FNV-1a with
// different offsets (Fowler, Noll & Vo); the cache is trusted, so resistance to forgery is not
// asked for.
std::string content_hash(const program::Computation& computation, const program::LimbProgram* limbs,
                         std::string_view machine);

}  // namespace sinew::backend
