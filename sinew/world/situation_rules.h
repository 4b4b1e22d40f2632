// Rules about a situation: what the graph of a world says, with the models that lie beside it in
// the same store, is asked by SPARQL. Two kinds:
//
//   SELECT      finds what must not be, a finding for each row: a part heavier than the arm carries
//   CONSTRUCT   derives facts: what can be grasped here and now
//
// Derived facts lie in a graph of their own, kDerivedGraph, which every `apply` makes anew: what no
// longer follows is gone. Facts may follow from facts, over at most kMaximumRounds rounds; findings
// come last and see them all. Numbers of measurements are not in the graph, so rules are about
// structure, models and facts.
//
// One thread at a time applies rules or changes the store (graph::Terms).
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::world {

inline constexpr std::string_view kDerivedGraph = "https://w3id.org/sinew/world#derived";
inline constexpr int kMaximumRounds = 64;
inline constexpr std::size_t kMaximumSituationRules = 1024;
inline constexpr std::size_t kMaximumFindings = 10'000;  // of one `apply`
inline constexpr std::size_t kMaximumFacts = 1'000'000;  // of one `apply`

struct SituationRule {
  std::string name;          // IRI
  std::string query;         // SELECT or CONSTRUCT
  std::string message = {};  // of a SELECT's findings; {x} becomes the value of ?x
};

struct Finding {
  std::string rule;
  std::string message;
  std::map<std::string, std::string> values;  // by variable, without those that are unbound
};

struct AppliedRules {
  std::vector<Finding> findings;  // by rule, then by row
  std::size_t facts = 0;          // derived, each once
  int rounds = 0;                 // until nothing new followed
};

class SituationRules {
 public:
  // Throws Error with the rule's name when the text is no query, the message names a variable that
  // the query does not have, or there are kMaximumSituationRules.
  void add(SituationRule rule);
  // In one transaction: all facts or, when a limit is reached, an Error and the facts of before.
  AppliedRules apply(graph::Store& store) const;

 private:
  std::vector<SituationRule> derive_, find_;
};

}  // namespace sinew::world
