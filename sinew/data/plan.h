// How to get from one data prototype to another: the cheapest chain of direct conversions, found by
// Dijkstra's algorithm over prototypes and spaces. Costs are counted in additions. Among equally
// cheap chains the shorter wins, then the one whose stops come first by name: the result never
// depends on the order of the file.
//
// What a declared function can do is preferred to the domain's formula between the same two spaces.
// Steps that lose something are only taken where that is allowed; steps for which there is no way
// back are marked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sinew/data/library.h"

namespace sinew::data {

struct PlanOptions {
  bool allow_lossy = false;
};

struct Plan;

// A relation that a change of conventions computes with: links from one frame to the other, the
// first of which begins at `of`. None: the frame itself.
struct RelationLink {
  Index relation = 0;
  bool inverse = false;
};
struct ConventionStep {
  std::string convention, from, to;
  std::vector<std::vector<RelationLink>> inputs;  // by input of the change
};

// One edge of the chain. `from` and `to` count prototypes or spaces, as the kind says.
struct PlanStep {
  enum class Kind : std::uint8_t {
    kRead,      // prototype to space, by a binding
    kWrite,     // space to prototype, by a binding
    kFormula,   // space to space
    kMembers,   // composed space to composed space, member by member
    kFunction,  // prototype to prototype
    kApart,     // prototype to composed space, a plan for each part
    kTogether,  // composed space to prototype, likewise
    kChange,    // space to space, of other conventions
  };
  Kind kind;
  Index from = 0, to = 0;
  Index which = 0;  // the binding, the formula edge, the function edge
  int cost = 0;
  std::string loses;
  std::vector<Plan>
      members;  // of kMembers, kApart and kTogether: a chain for each member, perhaps empty
  std::vector<ConventionStep> changes;
};

struct Plan {
  Index source = 0, target = 0;  // prototypes; of a member's plan spaces
  std::vector<PlanStep> steps;
  int cost = 0;
  // The relations that are needed, in order, and how each gets from its prototype to the space in
  // which it is used.
  std::vector<Index> relations;
  std::vector<Plan> relation_plans;
};

// The relations whose values have to be given when the conversion runs, in the order in which it
// takes them.
std::vector<Index> inputs_of(const Library& library, const Plan& plan);

// The conversion types of the source's Table I.
enum class ConversionType : std::uint8_t {
  kPlain = 1,
  kAlias = 2,
  kFunction = 3,
  kComposite = 4,
  kIndirect = 5,
  kIndirectComposite = 6,
};
std::string_view name_of(ConversionType type);

// One direct conversion of a chain, from one stop to the next.
struct Segment {
  std::string from,
      to;  // names of prototypes; keys of spaces where the chain stays between formulas
  ConversionType type = ConversionType::kPlain;
  std::string how;  // the function's or formula's name, the aliased forms
  int cost = 0;
  bool one_way = false;
  bool cost_known = true;
  std::vector<std::string> losses;
  std::vector<std::pair<std::string, std::vector<Segment>>> members;  // of composites
};
std::vector<Segment> segments_of(const Library& library, const Plan& plan);
// The type of the whole; its distance is the number of segments.
ConversionType type_of(const std::vector<Segment>& segments);

// The cheapest plan. Throws Error, naming both and the reason, where there is none.
Plan find_plan(const Library& library, Index source, Index target, const PlanOptions& options = {});
// By name; a part is named "pose.Position". Throws Error for unknown names, with suggestions.
Plan find_plan(const Library& library, const std::string& source, const std::string& target,
               const PlanOptions& options = {});

// For a person: what the conversion is, each step, its type, what it costs and loses.
std::string explain(const Library& library, const Plan& plan);

}  // namespace sinew::data
