// Data blocks that many steps make.
#pragma once

#include <string_view>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

// About the origin of `frame` and seen from it: an inertia, a momentum or a wrench of the body
// `of`, or its twist, which is with respect to the body `wrt`.
algorithm::BlockSpec at_frame(std::string_view slot, std::string_view quantity, Id represents,
                              Id of, Id frame, Id wrt = {});

// The block as a constant, all of whose numbers are zero. Precondition: its quantity or its
// specification says how many numbers it has, and they are no more than kMostZeros.
algorithm::BlockSpec zero(algorithm::BlockSpec spec);
inline constexpr std::size_t kMostZeros = 36;

}  // namespace sinew::synthesis
