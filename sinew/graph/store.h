// The quad store: subject, predicate, object, graph. Graph 0 is the unnamed (default) graph.
//
// Reading goes through a View (view.h), which is a version of the store. A view of the present is
// `store.view()`; a `Snapshot` is a view that keeps its version alive: it costs O(1), and goes on
// seeing exactly what was committed when it was taken, whatever is written later and from whichever
// thread.
//
// Writing goes through a Transaction: everything is visible to its own view at once, to others on
// commit, all or nothing; one that is destroyed without commit leaves no trace. One transaction at
// a time; a second one waits, unless the waiting thread has the first one itself: that is an Error,
// for it would wait for ever. `undo_to(mark)` takes back what a transaction did since the mark, for
// search.
//
// Synchronisation: readers of snapshots take no lock and do not wait for the writer, nor it for
// them (records.h says why that is safe); taking and giving back a snapshot and committing take a
// mutex for some ten nanoseconds. A removed triple is unlinked from its lists once no snapshot
// needs it, at a constant cost per removal in the long run. Its memory comes back when a
// transaction begins while more records are dead than alive: the store is then copied without them
// (some 50 ns a triple), and snapshots that are still alive keep the old copy for as long as they
// live.
//
// Limits: 2^31 - 2 triples, and as many times that a triple is in a graph beyond its first; removed
// ones included until the next copy. Error beyond.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "sinew/graph/packed.h"
#include "sinew/graph/terms.h"
#include "sinew/graph/view.h"

namespace sinew::graph {

struct Core;
struct StoreData;

inline constexpr std::uint32_t kMaxQuads = INT32_MAX - 1;
// Fewer dead records than this are never worth a copy.
inline constexpr std::uint32_t kWorthCompacting = 4096;

struct StoreLimits {
  std::uint32_t terms = kMaxTerms;
  std::uint32_t quads = kMaxQuads;
};

// May outlive its store.
class Snapshot : public View {
 public:
  Snapshot(const Snapshot& other);
  Snapshot(Snapshot&& other) noexcept;
  Snapshot& operator=(Snapshot other) noexcept;
  ~Snapshot();

 private:
  friend class Store;
  Snapshot(std::shared_ptr<Core> core, Version version, std::size_t size);

  std::shared_ptr<Core> core_;
  Version version_;
};

class Transaction {
 public:
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  // Takes back everything that was not committed.
  ~Transaction();

  // False when it was there already. Throws Error when the store is full, or when one of the ids is
  // no term of this store; the transaction is then as it was before.
  bool add(const Quad& quad);
  // The same for each, and faster where they are many; returns how many were new. When it throws,
  // those before the culprit have been added.
  std::size_t add(std::span<const Quad> quads);
  bool remove(const Quad& quad);  // false when it was not there
  void clear(Id graph);           // every triple of this graph
  void create_graph(Id graph);    // exists from now on, even while it is empty
  void drop_graph(Id graph);

  View view() const;  // sees this transaction's own changes; valid until the transaction ends
  using Mark = std::size_t;
  Mark mark() const;
  // Takes as long as what is taken back took. Where there was no mark before it, lists that it is
  // in may be walked as well, of at most some hundred triples for each that is taken back.
  void undo_to(Mark mark);
  // After it the transaction is over: no more changes.
  void commit();

 private:
  friend class Store;
  explicit Transaction(StoreData& data);
  StoreData& data() const;

  StoreData* data_;
  Version version_;
  std::uint32_t known_terms_ = 0;  // there were so many terms at least
};

class Store {
 public:
  explicit Store(StoreLimits limits = {});
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  Terms& terms();
  const Terms& terms() const;
  // What is committed, at each call anew. Not to be used while another thread writes: take a
  // snapshot.
  View view() const;
  Snapshot snapshot() const;  // O(1), any thread
  // The committed edges of one predicate, or with 0 of all, packed (packed.h): made when they are
  // first asked for after a commit, the same ones as long as nothing else is committed. For walks
  // over much of a graph. Any thread; takes a lock.
  std::shared_ptr<const Adjacency> edges(Id predicate, Direction direction) const;
  Transaction begin();
  bool add(const Quad& quad);  // a transaction of one
  bool remove(const Quad& quad);
  // What is committed, without history, as a store with its own life; terms keep their ids.
  Store clone() const;

 private:
  explicit Store(std::unique_ptr<StoreData> data);
  std::unique_ptr<StoreData> data_;
};

}  // namespace sinew::graph
