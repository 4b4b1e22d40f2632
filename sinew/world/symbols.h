// A world's description in a graph, kept in step with its structure. Everything in the world's
// named graph follows from the state; what else the store holds is left alone. Terms, with `w:` =
// https://w3id.org/sinew/world# and `rel:` = the published spatial relations:
//
//   F a geom:Frame
//   O a w:Object ; w:attached-to F ; w:instance-of M
//   R a rel:Pose | w:Joint | w:Property ; rel:of F ; rel:with-respect-to G ; w:suspended true
//   M a w:Measurement ; w:of-relation R ; w:quantity "pose" ; w:life-cycle "static" ;
//     w:provenance P ; w:coord-frame F ; w:used-by U ; w:value D
//   D a w:DataBlock ; w:prototype "ros_pose" ; w:consistency D0 ; w:realtime true ; w:derived true
//   R w:measured-by M
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/world/state.h"

namespace sinew::world {

inline constexpr std::string_view kWorldNamespace = "https://w3id.org/sinew/world#";

// What `keep` wants of the facts, into another store.
void copy_facts(const graph::View& from, graph::Store& to,
                const std::function<bool(const graph::Quad&)>& keep);

struct Symbols {
  // Describes the whole state in a new store. Of what is inherited, everything but the description.
  Symbols(std::string_view world_iri, const Names& names, const State& state,
          const graph::Snapshot* inherited);

  // What was said of these elements goes, what is true of them now comes, when the transaction is
  // committed. An element may be named more than once.
  void update(graph::Transaction& transaction, const State& before, const State& after,
              std::vector<Element> touched);

  graph::Store store;

 private:
  void describe(const State& state, ElementKind kind, Index index, std::vector<graph::Quad>& quads);
  void describe_all(const State& state);
  graph::Id iri(Name name);
  graph::Id world(std::string_view term);

  const Names& names_;
  graph::Id graph_;
  std::vector<graph::Id> terms_;  // by Name::value
};

}  // namespace sinew::world
