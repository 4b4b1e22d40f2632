// A floating base is one more joint: between the world, which becomes the root, and the tree's
// root.
#pragma once

#include <vector>

#include "sinew/graph/store.h"

namespace sinew::synthesis {

// Adds that joint to the normalised tree while it exists, so that every query sees it; takes it out
// again when it is destroyed. All within the caller's transaction: nobody else ever sees it.
class FloatingBase {
 public:
  FloatingBase(graph::Store& store, graph::Transaction& transaction, graph::Id root_body,
               graph::Id root_frame);
  ~FloatingBase();
  FloatingBase(const FloatingBase&) = delete;
  FloatingBase& operator=(const FloatingBase&) = delete;

 private:
  void add(graph::Id subject, graph::Id predicate, graph::Id object);

  graph::Transaction& transaction_;
  graph::Id graph_;
  std::vector<graph::Quad> added_;
  graph::Quad root_;  // what the tree's own root was called by
};

}  // namespace sinew::synthesis
