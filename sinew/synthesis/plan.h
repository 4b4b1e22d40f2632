// The planner: from what is asked and what is given to steps and sweeps.
//
// It goes back from each asked slot to a step that gives it, and on to what that step needs, until
// everything is given. A step that several things need is taken once. Then it sorts the steps into
// as few sweeps as their directions allow.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/sweep.h"

namespace sinew::synthesis {

struct Plan {
  std::vector<Sweep> sweeps;
  std::vector<std::string> why;  // a line for each step: what asked for it
};

// A slot that is asked for, and the words in which the user asked, with their place.
struct Wish {
  std::string slot;
  std::string asked;
  Origin origin = {};
};

// Errors, for each wish that cannot be met, name what is missing and how to give it.
Plan make_plan(std::span<const Step> steps, std::span<const Wish> wishes,
               std::span<const std::string> given, Report& report);

// Checks a hand-written configuration: every step is known, and finds what it needs in a sweep or
// step before it.
void check_sweeps(std::span<const Sweep> sweeps, std::span<const std::string> given,
                  std::string_view configuration, Report& report);

}  // namespace sinew::synthesis
