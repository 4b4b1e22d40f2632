// Writes an algorithm model into its own named graph, through a transaction of the caller's; or
// only makes the model, for whoever lowers it and asks nothing of the graph.
//
// A data block is known by its slot (what it is for) and the model element that it belongs to; a
// closure by its operator and its arguments. Asking for one that is there gives that one, so what
// two steps need is made once. IRIs are derived from the same facts: the same model and query give
// the same algorithm.
//
// Everything is checked when it is made: a closure with a wrong quantity or frame throws Error,
// naming the frames, the closure, the step and the model element.
#pragma once

#include <initializer_list>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "sinew/algorithm/model.h"
#include "sinew/graph/store.h"

namespace sinew::algorithm {

// What the builder cannot know by itself.
struct BlockSpec {
  std::string_view slot;
  graph::Id represents;
  std::string_view quantity;
  graph::Id of = {}, wrt = {}, reference = {}, seen_by = {};
  Role role = Role::kInternal;
  bool prismatic = false;      // a translational joint's: the quantity's other unit
  std::uint32_t size = 0;      // where the quantity leaves it open
  std::string_view unit = {};  // where the quantity leaves it open
  std::span<const double> value = {};
  // The part of its name after the dot, where it is not the element's; kWholeRobot: no such part.
  std::string_view label = {};
};
inline constexpr std::string_view kWholeRobot = "*";

// Why a closure is made.
struct Cause {
  graph::Id step;   // IRI of the synthesis step
  graph::Id about;  // the model element
};

enum class BuilderWrites : std::uint8_t { kGraph, kNothing };

class Builder {
 public:
  // `algorithm` names the algorithm and its graph, which must be empty.
  Builder(graph::Store& store, graph::Transaction& transaction, graph::Id algorithm,
          BuilderWrites writes = BuilderWrites::kGraph);

  // The block with this slot and element, made if need be.
  std::uint32_t block(const BlockSpec& spec);
  // kNoIndex when there is none.
  std::uint32_t find(std::string_view slot, graph::Id element) const;

  // Appends a closure to the schedule unless it is there.
  void closure(std::string_view operation, std::initializer_list<std::uint32_t> arguments,
               const Cause& cause);
  // The same with a list for the operator's first port.
  void closure_of_many(std::string_view operation, std::span<const std::uint32_t> many,
                       std::initializer_list<std::uint32_t> others, const Cause& cause);

  // The same with so many arguments for each port.
  void closure_with_counts(std::string_view operation, std::vector<std::uint32_t> arguments,
                           std::vector<std::uint32_t> counts, const Cause& cause);

  // Hands a block out, after the outputs so far; under another name than its own, if one is given.
  void output(std::uint32_t block, std::string_view name = {});

  // Says that a block changes at a lower rate than the rest (Block::held). An input, or what a
  // closure computes.
  void hold(std::uint32_t block) { algorithm_.blocks[block].held = true; }

  // Gives a block another name, which nothing else may have. Before finish().
  void rename(std::uint32_t block, std::string name);

  // Writes what is only known at the end (the schedule, the interface) and checks the whole. The
  // builder is not to be used afterwards.
  void finish();

  const Algorithm& algorithm() const { return algorithm_; }
  // Hands it out, after finish().
  Algorithm take() { return std::move(algorithm_); }
  const Block& at(std::uint32_t block) const { return algorithm_.blocks[block]; }
  const Names& names() const { return names_; }
  graph::Terms& terms() { return terms_; }

 private:
  struct Key {
    graph::Id slot, element;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const {
      return (std::uint64_t{key.slot.value} << 32 | key.element.value) * 0x9E3779B97F4A7C15ull >>
             20;
    }
  };

  void add(graph::Id subject, graph::Id predicate, graph::Id object);
  void write(const Block& block, graph::Id slot);
  void write(const Closure& closure);
  void write_end();
  void append(const Operator& op, std::vector<std::uint32_t> arguments,
              std::vector<std::uint32_t> counts, const Cause& cause);
  std::string unique_name(std::string_view slot, std::string_view label);

  graph::Terms& terms_;
  graph::Transaction& transaction_;
  Names names_;
  BuilderWrites writes_;
  Algorithm algorithm_;
  std::pmr::monotonic_buffer_resource memory_;  // of what only grows
  std::pmr::unordered_map<Key, std::uint32_t, KeyHash> by_slot_{&memory_};
  std::pmr::unordered_map<graph::Id, std::uint32_t> closures_{&memory_};
  std::pmr::unordered_map<std::pmr::string, std::uint32_t> name_uses_{&memory_};
  std::unordered_map<std::string_view, std::vector<graph::Id>> port_terms_;  // by operator
  std::unordered_map<const Operator*, graph::Id> operator_terms_;
  std::vector<graph::Id> parts_;  // of the closure that is being made
  std::uint32_t inputs_ = 0, outputs_ = 0;
};

// Writes an RDF list into a graph; returns its head.
graph::Id write_list(graph::Terms& terms, graph::Transaction& transaction, const Names& names,
                     graph::Id graph, std::span<const graph::Id> items);

}  // namespace sinew::algorithm
