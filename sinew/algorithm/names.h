// The terms that algorithm models are written with, interned once for a store.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "sinew/algorithm/quantities.h"
#include "sinew/graph/terms.h"

namespace sinew::algorithm {

inline constexpr std::string_view kAlgorithmNamespace = "https://w3id.org/sinew/algorithm#";
// Role of a node that stands for two: a frame seen from another, a driver of an element.
inline constexpr std::string_view kPair = "https://w3id.org/sinew/algorithm#Pair";
inline constexpr std::string_view kTreeNamespace = "https://w3id.org/sinew/kinematic-tree#";
inline constexpr std::string_view kStepNamespace = "https://w3id.org/sinew/steps#";
inline constexpr std::string_view kUnitNamespace = "http://qudt.org/vocab/unit/";

// Who writes a data block.
enum class Role : std::uint8_t {
  kInput,     // the caller, before each evaluation
  kConstant,  // known now
  kInternal,  // one closure
  kState,     // one closure, at the end of an evaluation; read by the next one
};
inline constexpr std::size_t kRoles = 4;
std::string_view to_string(Role role);  // "input", ...

struct Names {
  explicit Names(graph::Terms& terms);

  graph::Id type, first, rest, nil;
  graph::Id algorithm, data, closure, schedule;       // sa:
  graph::Id data_block, quantity, slot, name, index;  // sa:
  graph::Id represents, role, output, held, size;     // sa:
  graph::Id step, about;                              // sa:
  std::array<graph::Id, kRoles> roles;                // sa:input ...
  std::array<graph::Id, kAttributes> symbols;         // sa:of ...
  graph::Id schedule_type, trigger_chain;             // algo:
  graph::Id value;                                    // tree:
  graph::Id unit;                                     // qudt:
  graph::Id true_literal;
};

// The last segment of an IRI (after the last '#', '/' or ':'), which names it to people.
std::string_view short_name(std::string_view iri);
// Whether people call it that: by its short name, or by what that stands for ("base link" for
// "base%20link").
bool is_called(std::string_view iri, std::string_view name);

}  // namespace sinew::algorithm
