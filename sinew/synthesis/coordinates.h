// A robot's coordinates: the numbers by which a user moves it. Most are the positions of the tree's
// joints themselves. A joint of several degrees of freedom has one data block for all its numbers,
// and joints that follow others have none. Steps know the tree's joints only: inputs are handed out
// to these before the first sweep (here), and results gathered from them after the last
// (results.h).
#pragma once

#include <string_view>
#include <vector>

#include "sinew/synthesis/context.h"

namespace sinew::synthesis {

struct Coordinate {
  Id joint;                        // of the model
  int compound = -1;               // index into Robot::compounds
  std::vector<std::size_t> parts;  // joints of the tree that follow none, in the order of numbers
};

// In the order of the joints: base to tip, depth first.
std::vector<Coordinate> coordinates(const Robot& robot);

// Joints of the model that follow others and so have no numbers of their own, in their order.
std::vector<Id> followers_of_the_model(const Robot& robot);

// Whether `name` is the node's IRI or the last segment of it.
bool is_named(const graph::View& view, Id node, std::string_view name);

// By IRI or its last segment; Error that lists what there is, or says which joint it follows.
Coordinate find_coordinate(const graph::View& view, const Robot& robot, std::string_view name);

// The inputs for "position", "velocity", "acceleration" or "force" of every coordinate, and that
// slot of every joint of the tree.
void make_coordinate_inputs(Context& context, std::string_view slot);

// That slot of every joint of the tree from the numbers of all coordinates, one after the other.
void take_all(Context& context, std::string_view slot, BlockIndex numbers);

// The same of what belongs to one effect (effects.h), for joints that follow none. `what` is the
// quantity: "acceleration".
void take_all_of(Context& context, std::string_view slot, std::string_view what, BlockIndex numbers,
                 Id effect, std::string_view label);

}  // namespace sinew::synthesis
