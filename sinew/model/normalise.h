// From a model, as its author wrote it, to the one form that solvers are made from: a tree of
// bodies in SI units, static poses composed, joint frames on their axes, inertias in their body's
// frame. The contract is in docs/architecture.md; the result as numbers in tree.h.
//
// What is at fault in the model goes to the report, with its place; where there is an error, the
// tree is not to be used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/model/rotation.h"
#include "sinew/model/tree.h"

namespace sinew::model {

// Names are IRIs, or the last segment of one.
struct NormaliseOptions {
  // A link, or a frame of one; empty: the model's only root. It may be any: joints between it and
  // the model's root are walked against their direction.
  std::string base;
  // Links, frames or joints; only the bodies on the way to them are kept. Empty: all.
  std::vector<std::string> tips;
  // Seen from the base [m/s^2]; overrides the model's.
  std::optional<Vector3> gravity;
  // Gravity is an input of the program: that none is stated is not worth a note.
  bool gravity_varies = false;
  // Turns and slides joint frames about and along their axes, so that constants become 0 or 1.
  // Frames of the model stay where they are; only frames that nobody named move.
  bool choose_frames = true;
  // Direction cosines within it of 0, 1 or -1 become that; lengths and parts of inertias within
  // kLengthTolerance, if that is less, become 0. A coarser one (1e-4 takes 1.5708 for pi/2; at
  // most kCoarsestSnap) changes results by as much; Tree::notes then say what it has changed.
  double snap_tolerance = kSnapTolerance;
  // Moments of inertia that no real body has are a warning instead of an error; see plausible.h.
  bool lenient = false;
};

Tree normalise(graph::Store& store, const graph::Places& places, const NormaliseOptions& options,
               Report& report);

}  // namespace sinew::model
