// What the passes of a step work with: the model, the algorithm so far, and the blackboard on which
// steps leave data blocks for each other.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "sinew/algorithm/builder.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/external_wrenches.h"
#include "sinew/synthesis/motion_drivers.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/relation.h"
#include "sinew/synthesis/robot.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

using BlockIndex = std::uint32_t;
struct Control;  // control.h

// Which data block is in a slot of a model element at this moment of the synthesis. Most slots are
// filled once; accumulations fill theirs again and again.
class Blackboard {
 public:
  void put(std::string_view slot, Id element, BlockIndex block);
  // algorithm::kNoIndex when the slot is empty.
  BlockIndex find(std::string_view slot, Id element) const;

  // Calls visit(element, block) for each element that has one in this slot.
  template <typename Visit>
  void for_each(std::string_view slot, Visit visit) const {
    const auto found = slots_.find(slot);
    if (found == slots_.end()) return;
    for (const auto& [element, block] : found->second) visit(element, block);
  }

  // Several effects that are kept apart, each with the element that it comes from: the forces that
  // reach a body, one for each driver or joint.
  struct Carried {
    Id origin;
    BlockIndex block;
  };
  void carry(std::string_view slot, Id element, const Carried& effect);
  const std::vector<Carried>& carried(std::string_view slot, Id element) const;

 private:
  std::unordered_map<std::string_view, std::unordered_map<Id, BlockIndex>> slots_;
  std::vector<std::unique_ptr<std::string>> names_;
  std::map<std::pair<std::string, Id>, std::vector<Carried>> carried_;
};

// A node that stands for two elements: an entry of a matrix.
Id pair_of(graph::Terms& terms, Id a, Id b);

struct Context {
  graph::Store& store;
  graph::View view;  // of the model, and of the algorithm while it grows
  algorithm::Builder& builder;
  const Robot& robot;
  const Query& query;
  Id reference;  // the body with respect to which absolute motions are: the root, or free fall
  std::array<double, 3> gravity = {};  // [m/s^2], seen from the root; zero when it does not matter
  // The body frames that matter, where only the way to some tips does; empty: all.
  std::unordered_set<Id> scope = {};
  // Of each body: mass, first moment, rotational inertia; as stated, or regrouped (regroup.h).
  std::unordered_map<Id, std::array<double, 10>> inertias = {};
  std::vector<ExternalWrench> wrenches = {};
  std::vector<Relation> relations = {};       // motions that are asked for between any two frames
  const Control* control = nullptr;           // the task's, where there is one
  std::vector<BlockIndex> task_outputs = {};  // flags, events and control signals
  MotionDrivers drivers = {};  // acceleration constraints, external wrenches, groups of drivers
  Blackboard board = {};
  graph::Transaction* transaction = nullptr;                    // the synthesis' own
  std::map<std::pair<std::string, Id>, BlockIndex> shown = {};  // by show_slots
  const Step* step = nullptr;                                   // whose pass is running
  mutable const Step* named_step = nullptr;                     // whose IRI was asked for last
  mutable Id step_term = {};                                    // that IRI

  // The block in a slot; Error naming the step, slot and element when it is empty.
  BlockIndex block(std::string_view slot, Id element) const;
  bool has(std::string_view slot, Id element) const;

  // Writes what is in these slots into a graph of its own, for the queries of steps that are data:
  // ELEMENT slot:NAME BLOCK (step_models.h).
  void show_slots(std::span<const std::string> slots);
  Id slots_graph() const;

  // Makes a block and puts it in its slot.
  BlockIndex make(const algorithm::BlockSpec& spec);
  // Makes a closure for a model element, in the name of the running step.
  void closure(std::string_view operation, std::initializer_list<BlockIndex> arguments, Id about);

  void closure_of_many(std::string_view operation, std::span<const BlockIndex> many,
                       std::initializer_list<BlockIndex> others, Id about);

  void closure_with_counts(std::string_view operation, std::vector<BlockIndex> arguments,
                           std::vector<std::uint32_t> counts, Id about);

  // The part of a joint's data blocks' names after the dot, where it is not the joint's name.
  std::string_view label(Id joint) const;

  algorithm::Cause cause(Id about) const;

  Id pair(Id a, Id b);  // see pair_of

  // The numbers of a coordinate of the normalised tree.
  std::vector<double> numbers(Id coordinate) const;
};

std::vector<double> coordinate_numbers(const graph::View& view, Id coordinate);

}  // namespace sinew::synthesis
