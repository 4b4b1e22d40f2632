// A property path, ready to be walked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::sparql::plan {

inline constexpr std::uint32_t kNoChain = UINT32_MAX;
inline constexpr std::uint32_t kMaxChain = 8;

// One node of a path; the parts of a node lie behind it, in PathSteps::parts.
struct PathStep {
  using Kind = syntax::Path::Kind;
  Kind kind = Kind::kIri;     // never kInverse: inversion is pushed to the leaves
  bool inverse = false;       // kIri: walked from object to subject
  bool matches_zero = false;  // reaches the node where it begins, whatever the graph holds
  // kZeroOrMore, kOneOrMore, kZeroOrOne: which set of visited nodes. kSequence below one of these:
  // the set for the nodes behind its first part, followed by those for the next ones.
  std::uint32_t visited = 0;
  // kSequence: below * + or ?, where only which nodes are reached counts, not how often. A middle
  // node that was reached before leads nowhere new.
  bool each_middle_once = false;
  graph::Id iri = {};
  std::uint32_t first_part = 0, part_count = 0;
  // kZeroOrMore, kOneOrMore, kZeroOrOne: the sets of the sequences below it, up to the next such
  // step; they are emptied with its own.
  std::uint32_t first_middle = 0, middle_count = 0;
  // kZeroOrMore, kOneOrMore over nothing but IRIs in sequence, at most kMaxChain of them: its
  // number among such steps.
  std::uint32_t chain = kNoChain;
  // kNegated: what no edge may be, by direction.
  bool walks_forward = false, walks_backward = false;
  std::vector<graph::Id> forward, backward;
};

// All paths of one plan.
struct PathSteps {
  std::vector<PathStep> steps;
  std::vector<std::uint32_t> parts;  // indices into `steps`
  std::uint32_t visited_count = 0;
  std::uint32_t chain_count = 0;
};

// The steps, all kIri, of a closure over a chain. Precondition: it is one.
std::span<const std::uint32_t> chain_of(const PathStep& closure, const PathSteps& in);

// Appends the path, and the same path walked backward; returns the two roots.
struct PathRoots {
  std::uint32_t forward = 0, backward = 0;
  std::uint32_t starts = 0;  // the set of visited nodes for when neither end is known
};
PathRoots compile_path(const syntax::Path& path, PathSteps& into);

}  // namespace sinew::rdf::sparql::plan
