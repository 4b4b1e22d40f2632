// Between spaces that differ in their conventions alone: which changes, with which relations.
// Internal to the module.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/data/plan.h"

namespace sinew::data {

// The relations that lead from one frame to another, the fewest there are, then the first by name.
// None where the frames are one; nothing where no chain leads there.
std::optional<std::vector<RelationLink>> relation_chain(const Library& library,
                                                        const std::string& domain,
                                                        const std::string& of,
                                                        const std::string& in);

// The changes, one for each convention that differs, in order of their names. Where there are none,
// `why` says what is missing and `remedy` what would be right.
struct MissingChange {
  std::string why, remedy;
};
std::optional<std::vector<ConventionStep>> convention_steps(
    const Library& library, const std::string& domain, const std::string& semantic,
    const std::string& coordinates, const std::string& from, const std::string& to,
    MissingChange* missing = nullptr);

// What the steps cost, in additions, without fetching the relations.
int cost_of(const Library& library, Index space, const std::vector<ConventionStep>& steps);

// What is missing for a value of this meaning to change its convention, in any coordinates.
MissingChange missing_change(const Library& library, const std::string& domain,
                             const std::string& semantic, const std::string& from,
                             const std::string& to);

}  // namespace sinew::data
