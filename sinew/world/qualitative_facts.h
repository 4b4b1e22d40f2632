// The qualitative relations that hold, as facts in a graph, so that SPARQL and the rules about a
// situation can ask for them. With `w:` = https://w3id.org/sinew/world#
//
//   x:cup w:on x:table                        each rule's name becomes a property
//   F a w:RelationFact ; w:called "on" ; w:first x:cup ; w:second x:table ; w:third … ;
//     w:because "x:cup on x:table: true, along the axes of …" ;
//     w:derived-from M …                      measurements that the places were read from
//
// Whoever may not read one of these gets neither the fact nor the property (reader.h).
//
// They lie in a graph of their own, kQualitativeGraph, which is made anew each time, as of the
// space's last update.
#pragma once

#include <string_view>

#include "sinew/graph/store.h"
#include "sinew/world/qualitative.h"

namespace sinew::world {

inline constexpr std::string_view kQualitativeGraph =
    "https://w3id.org/sinew/world#qualitative-relations";
// Pairs, and triples, of bodies that are looked at for one rule.
inline constexpr std::size_t kMaximumJudgements = 1'000'000;

struct StatedFacts {
  std::size_t facts = 0;
  std::vector<std::string> left_out;  // rules that need a viewer, where there is none
  std::vector<BodyId> unplaced;       // bodies of which nothing can be said
};

// One transaction. Throws Error where a rule would be judged more often than kMaximumJudgements.
// A rule whose bound is a declared property is judged for the bodies that declare it.
StatedFacts state_facts(const Relations& relations, const Space& space, graph::Store& store,
                        FrameId viewer = {});

}  // namespace sinew::world
