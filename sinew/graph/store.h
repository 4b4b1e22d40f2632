// The quad store: subject, predicate, object, graph. Graph 0 is the unnamed (default) graph.
//
// Reading goes through a View, which is a version of the store and a choice of dataset. A view of the
// present is `store.view()`; a `Snapshot` is a view that keeps its version alive: it costs O(1), and goes
// on seeing exactly what was committed when it was taken, whatever is written later and from whichever thread.
//
// Writing goes through a Transaction: everything is visible to its own view at once, to others on commit,
// all or nothing; one that is destroyed without commit leaves no trace. One transaction at a time; a
// second one waits. `undo_to(mark)` takes back what a transaction did since the mark, for search.
//
// Limits: 2^32 - 2 quads over the lifetime between compactions; Error beyond.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "sinew/graph/terms.h"

namespace sinew::graph {

struct Quad {
  Id subject, predicate, object;
  Id graph = {};
  friend constexpr auto operator<=>(const Quad&, const Quad&) = default;
};

// Which graphs a pattern is matched against.
enum class Dataset : std::uint8_t {
  kUnion,    // every triple once, whichever graphs hold it (what models are queried with)
  kDefault,  // the unnamed graph alone (SPARQL's default)
};

class Store;
class Snapshot;
class Transaction;

// A version of the store as a pattern matcher. Cheap to copy; valid as long as what it came from.
class View {
 public:
  const Terms& terms() const;

  // Calls visit(const Quad&) for every triple that matches, wildcard where the Id is 0, in the order in
  // which the triples were added; stops when visit returns false. Returns false if it was stopped.
  // Quad::graph is 0 here; each triple comes once. No allocation. `visit` may add to the store: what is
  // added meanwhile may or may not be seen.
  template <typename Visit>
  bool match(Id subject, Id predicate, Id object, Dataset dataset, Visit&& visit) const;
  // The same in one named graph (or, with graph 0, in the unnamed graph); Quad::graph is that graph.
  template <typename Visit>
  bool match_in(Id subject, Id predicate, Id object, Id graph, Visit&& visit) const;
  // The same over all *named* graphs: a triple comes once for every graph that holds it.
  template <typename Visit>
  bool match_named(Id subject, Id predicate, Id object, Visit&& visit) const;

  bool contains(Id subject, Id predicate, Id object, Dataset dataset = Dataset::kUnion) const;
  bool contains_in(const Quad& quad) const;
  // Convenience for functional properties: the first object/subject or 0.
  Id object(Id subject, Id predicate) const;
  Id subject(Id predicate, Id object) const;

  // An upper bound of the number of matches from live counters, in O(1); for planners.
  std::size_t estimate(Id subject, Id predicate, Id object) const;
  std::size_t size() const;  // distinct triples of the union
  // Calls visit(Id) for every named graph that is not empty or was created by create_graph.
  template <typename Visit>
  bool named_graphs(Visit&& visit) const;

 private:
  // (implementation's own)
};

class Snapshot : public View { /* movable, copyable; keeps its version alive */ };

class Transaction {
 public:
  bool add(const Quad& quad);     // false when it was there already
  bool remove(const Quad& quad);  // false when it was not there
  void clear(Id graph);
  void create_graph(Id graph);
  void drop_graph(Id graph);
  View view() const;  // sees this transaction's own changes
  using Mark = std::size_t;
  Mark mark() const;
  void undo_to(Mark mark);
  void commit();
  // The destructor takes back everything that was not committed.
};

class Store {
 public:
  Store();
  Terms& terms();
  const Terms& terms() const;
  View view() const;          // the present; not to be used while another thread writes (take a snapshot)
  Snapshot snapshot() const;  // O(1), any thread
  Transaction begin();
  bool add(const Quad& quad);     // a transaction of one
  bool remove(const Quad& quad);
  Store clone() const;            // a full copy with its own life (terms keep their ids)
};

}  // namespace sinew::graph
