#include "sinew/synthesis/context.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sinew/base/error.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/synthesis/step_models.h"

namespace sinew::synthesis {

using algorithm::kNoIndex;

std::string_view to_string(Direction direction) {
  switch (direction) {
    case Direction::kOutward:
      return "outward";
    case Direction::kInward:
      return "inward";
    case Direction::kLocal:
      return "local";
    case Direction::kOnce:
      return "once";
  }
  return "";
}

Id Visit::operator[](std::string_view column) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == column) return row[i];
  throw std::logic_error(
      fmt::format("a visitor asks for ?{}, which its query does not select", column));
}

void Blackboard::put(std::string_view slot, Id element, BlockIndex block) {
  auto found = slots_.find(slot);
  if (found == slots_.end()) {
    names_.push_back(std::make_unique<std::string>(slot));
    found = slots_.emplace(*names_.back(), std::unordered_map<Id, BlockIndex>{}).first;
  }
  found->second[element] = block;
}

BlockIndex Blackboard::find(std::string_view slot, Id element) const {
  const auto found = slots_.find(slot);
  if (found == slots_.end()) return kNoIndex;
  const auto block = found->second.find(element);
  return block == found->second.end() ? kNoIndex : block->second;
}

void Blackboard::carry(std::string_view slot, Id element, const Carried& effect) {
  std::vector<Carried>& list = carried_[{std::string(slot), element}];
  for (Carried& one : list)
    if (one.origin == effect.origin) {
      one = effect;
      return;
    }
  list.push_back(effect);
}

const std::vector<Blackboard::Carried>& Blackboard::carried(std::string_view slot,
                                                            Id element) const {
  static const std::vector<Carried> none;
  const auto found = carried_.find({std::string(slot), element});
  return found == carried_.end() ? none : found->second;
}

bool Context::has(std::string_view slot, Id element) const {
  return board.find(slot, element) != kNoIndex;
}

BlockIndex Context::block(std::string_view slot, Id element) const {
  const BlockIndex found = board.find(slot, element);
  if (found == kNoIndex)
    throw Error(Problem{{},
                        std::string(view.terms().text(element)),
                        fmt::format("step {} needs its {}, which no step before has made",
                                    step ? step->name : "(none)", slot),
                        "put the step that gives it into an earlier sweep, or before this one",
                        {},
                        {}});
  return found;
}

Id Context::slots_graph() const {
  graph::Terms& terms = builder.terms();
  return terms.derived(terms.iri(std::string(kSlotNamespace) + "Blackboard"),
                       {builder.algorithm().id});
}

void Context::show_slots(std::span<const std::string> slots) {
  graph::Terms& terms = builder.terms();
  const Id graph = slots_graph();
  for (const std::string& slot : slots) {
    const Id property = terms.iri(std::string(kSlotNamespace) + slot);
    board.for_each(slot, [&](Id element, BlockIndex block) {
      const auto [found, fresh] = shown.try_emplace({slot, element}, block);
      if (!fresh && found->second == block) return;
      if (!fresh) transaction->remove({element, property, builder.at(found->second).id, graph});
      transaction->add({element, property, builder.at(block).id, graph});
      found->second = block;
    });
  }
}

BlockIndex Context::make(const algorithm::BlockSpec& spec) {
  const BlockIndex made = builder.block(spec);
  board.put(spec.slot, spec.represents, made);
  return made;
}

std::string_view Context::label(Id joint) const {
  for (const RobotJoint& one : robot.joints)
    if (one.joint == joint) return one.label;
  return {};
}

algorithm::Cause Context::cause(Id about) const {
  if (step != named_step) {
    graph::Terms& terms = builder.terms();
    step_term = step ? terms.iri(std::string(algorithm::kStepNamespace) + step->name) : Id{};
    named_step = step;
  }
  return {step_term, about};
}

void Context::closure(std::string_view operation, std::initializer_list<BlockIndex> arguments,
                      Id about) {
  builder.closure(operation, arguments, cause(about));
}

void Context::closure_of_many(std::string_view operation, std::span<const BlockIndex> many,
                              std::initializer_list<BlockIndex> others, Id about) {
  builder.closure_of_many(operation, many, others, cause(about));
}

void Context::closure_with_counts(std::string_view operation, std::vector<BlockIndex> arguments,
                                  std::vector<std::uint32_t> counts, Id about) {
  builder.closure_with_counts(operation, std::move(arguments), std::move(counts), cause(about));
}

Id pair_of(graph::Terms& terms, Id a, Id b) {
  return terms.derived(terms.iri(algorithm::kPair), {a, b});
}

Id Context::pair(Id a, Id b) { return pair_of(builder.terms(), a, b); }

std::vector<double> Context::numbers(Id coordinate) const {
  return coordinate_numbers(view, coordinate);
}

std::vector<double> coordinate_numbers(const graph::View& view, Id coordinate) {
  const graph::Terms& terms = view.terms();
  const Id value = terms.find_iri(std::string(algorithm::kTreeNamespace) + "value");
  const Id first = terms.find_iri(graph::kRdfFirst), rest = terms.find_iri(graph::kRdfRest),
           nil = terms.find_iri(graph::kRdfNil);
  std::vector<double> result;
  for (Id node = view.object(coordinate, value); node && node != nil;
       node = view.object(node, rest))
    result.push_back(terms.number(view.object(node, first)).value());
  return result;
}

}  // namespace sinew::synthesis
