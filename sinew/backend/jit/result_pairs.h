// Results that are neighbours in the caller's array, computed one soon after the other: stored
// together, with one instruction for two numbers.
//
// Of limbs side by side a value has one number for each limb, and so has its neighbour; one
// instruction puts the first limb's two numbers side by side, another the second's. That is as many
// instructions, but a processor that computes two stores at a time writes only one a cycle to the
// cache where they go to different lines: HyQ's mass matrix takes 44 ns instead of 51. Of plain
// numbers only those are joined that are wanted in several places: the joining delays the last
// results of a short function.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/limbs/limb_program.h"

namespace sinew::backend {

struct ResultPair {
  std::uint32_t region = 0;
  std::uint32_t left = 0, right = 0;  // nodes
  std::uint32_t later = 0;            // the one of the two that is computed last
  struct Place {
    std::uint32_t lane = 0;
    std::uint32_t left = 0;  // which result; that of the right is the next one
  };
  std::vector<Place> places;

  std::uint32_t earlier() const { return later == left ? right : left; }
};

// No result is in two pairs. `statements`: of each region, the nodes that are computed, in order.
std::vector<ResultPair> pair_results(const program::LimbProgram& program,
                                     const std::vector<std::vector<std::uint32_t>>& statements);

}  // namespace sinew::backend
