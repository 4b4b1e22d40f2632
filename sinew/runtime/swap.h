// What a program hands over to the one that takes its place.
//
// In this order, for each state of the new program:
//
// - one that a rule of the caller names is converted as it says, or gets its first value;
// - one whose IRI and prototype are unchanged is carried over;
// - for the others its model declares what happens (sa:at-swap: initialised, or converted by an
//   operator or a factor);
// - where nothing is declared, a state that the old program does not have gets its first value, and
//   one that it has with another prototype refuses the swap.
//
// Set-points with the same IRI and prototype keep their value.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/runtime/clock.h"
#include "sinew/runtime/executable.h"

namespace sinew::runtime {

// Of the new program's block `to`, by IRI or name, from the old one's `from`. The function runs in
// the loop, between two cycles: it must be real-time safe.
struct StateConversion {
  std::string to, from;
  std::function<void(std::span<const double> from, std::span<double> to)> convert;
};

struct SwapRules {
  std::vector<StateConversion> conversions;
  std::vector<std::string> initialise;  // states, by IRI or name
  // Values of set points that the old program does not have, by IRI or name.
  std::vector<std::pair<std::string, std::vector<double>>> set_points;
};

// Names of the blocks of the new program.
struct SwapReport {
  std::vector<std::string> carried, converted, initialised;  // states
  std::vector<std::string> kept, set;                        // set points
};

// How a swap went, told by the loop.
struct SwapRecord {
  std::uint64_t tick = 0;       // the first cycle of the new program
  Nanoseconds requested = 0;    // when `swap` was called
  Nanoseconds running = 0;      // when that cycle began
  Nanoseconds in_loop = 0;      // wall time that the exchange took in the loop
  Nanoseconds in_loop_cpu = 0;  // the part of it that the loop's thread itself computed
};

struct StateCopy {
  std::span<const double> from;
  std::span<double> to;
  std::function<void(std::span<const double> from, std::span<double> to)> convert;  // empty: copy
};

struct StatePlan {
  SwapReport report;
  std::vector<StateCopy> copies;
  std::vector<bool> given;  // by block of the new program: a set point that has a value
};

// Throws Error when a rule names what is not there. `given`: the old program's set points that have
// a value. Writes those of the rules into the new program.
StatePlan plan_states(const Executable& old, const std::vector<bool>& given, Executable& next,
                      const SwapRules& rules);

}  // namespace sinew::runtime
