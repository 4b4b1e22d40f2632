// What holds at one instant: the facts of a world's graph and its structure, which edits and
// actions change together. Whoever asks first the one and then the other may come between two
// changes; a situation holds both.
//
//   const Situation situation = world.situation();
//   if (situation.facts.contains(gripper, holds, bolt)) situation.pose(bolt_frame, gripper_frame,
//   now)
//
// Taking one costs O(1), and it stays as it is. The numbers of measurements are those of when it is
// asked; of an attachment they never change.
#pragma once

#include "sinew/graph/store.h"
#include "sinew/world/world.h"

namespace sinew::world {

struct Situation {
  graph::Snapshot facts;
  State structure;
  std::uint64_t structure_version = 0;
  std::shared_ptr<const WorldImpl> world;

  // As this structure has it.
  PoseAnswer pose(FrameId of, FrameId with_respect_to, Stamp now) const;
};

}  // namespace sinew::world
