// An algorithm as a cyclic host runs it: pure programs, and around them the external closures
// (read, write, log, check, probe) that speak to the world.
//
// Every data block is written once in a cycle, so an external closure need not run where it stands:
// `read` runs before the pure closures that follow it, the others after those that precede them,
// checks before writes. What is pure thus stays one program, optimised as a whole. Only
// `probe-time` stays in its place, because when it runs is what it measures; it cuts the program in
// two.
//
// The programs here keep no state: a state block is an input, and what closures write to it an
// output, so that the host holds all states and can carry them over to another program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/algorithm/model.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/program/program.h"

namespace sinew::program {

struct External {
  std::string operation;  // "read", "write", "log", ...
  std::string iri;        // of the closure
  std::vector<algorithm::Property> properties;
  std::vector<std::uint32_t> blocks;  // indices into HostPlan::blocks

  // Its property of that name, or nullptr.
  const std::string* property(std::string_view name) const;
};

// A pure program without states, and the blocks of its inputs and outputs (in the order of its
// interface).
struct Segment {
  Program program;
  std::vector<std::uint32_t> inputs, outputs;
};

struct HostStep {
  bool external = false;
  std::uint32_t index = 0;  // into externals or segments
};

// What a state's model declares for a swap (algorithm/model.h).
struct SwapRule {
  std::uint32_t block = 0;  // index into HostPlan::blocks
  algorithm::AtSwap::Kind kind = algorithm::AtSwap::Kind::kInitialise;
  std::string from;                         // kOperator, kScale: IRI of the old program's block
  const algorithm::Operator* op = nullptr;  // kOperator
  double factor = 1;                        // kScale
  std::string factor_unit;
};

struct HostPlan {
  std::string name;
  std::string iri;                 // of the algorithm
  std::optional<double> period_s;  // how often it must run, where it integrates over time
  std::vector<Variable> blocks;    // what the host holds: inputs, states, outputs
  std::vector<Segment> segments;
  std::vector<External> externals;
  std::vector<HostStep> steps;  // in the order in which they run
  std::vector<SwapRule> swap_rules;
};

// Reads and checks the algorithm; throws Error.
HostPlan plan_for_host(const graph::View& view, graph::Id algorithm, std::string_view name,
                       const graph::Places* places = nullptr);

// Of a program that comes from elsewhere: no externals, its inputs are the caller's.
HostPlan plan_for_host(const Program& program);

}  // namespace sinew::program
