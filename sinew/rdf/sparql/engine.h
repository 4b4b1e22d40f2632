// SPARQL 1.1 Query and Update, all of it, on a view or a transaction of the graph.
//
//   const Answer answer =
//       query(store.view(), store.terms(), "SELECT ?s WHERE { ?s a <http://e/Joint> }");
//   for (const auto& row : answer.results.rows) ...
//
// For queries that run often or with parameters see `prepared.h`. Terms that a query computes and
// returns are added to `terms`; as always only one thread at a time may do that.
//
// Every fault is an Error with line, column and remedy: of the text, of a limit that is reached, of
// SERVICE and LOAD (nothing is ever fetched).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/results/result_set.h"
#include "sinew/rdf/sparql/prepared.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql {

struct QueryOptions {
  std::string name;  // of the text, for messages: a file name, or empty
  std::string base;  // IRI that relative IRIs in the text resolve against; empty: they are errors
  // What a pattern outside GRAPH is matched against, unless the text has FROM or USING.
  graph::Dataset dataset = graph::Dataset::kUnion;
  Limits limits = {};
  const Prefixes* prefixes = nullptr;  // that the text may use without declaring them
};

enum class AnswerKind { kTable, kBoolean, kTriples };

struct Answer {
  AnswerKind kind = AnswerKind::kTable;
  ResultSet results;  // SELECT: columns and rows in order; ASK: boolean
  std::vector<graph::Quad>
      triples;  // CONSTRUCT, DESCRIBE: each once, in the order in which they were made
};

// DESCRIBE gives every triple whose subject is the node, and those of blank nodes that it leads to.
Answer query(const graph::View& view, graph::Terms& terms, std::string_view text,
             const QueryOptions& options = {});

// Gives the triples of the document with this IRI to `add` (their graph is ignored), or throws
// Error.
using Loader =
    std::function<void(std::string_view iri, const std::function<void(const graph::Quad&)>& add)>;

struct UpdateOptions : QueryOptions {
  Loader load;  // for LOAD; without one, LOAD is an error
};

struct UpdateCounts {
  std::size_t added = 0, removed = 0;  // triples of a graph, of all operations together
};

// Runs all operations in their order. All or nothing: when one fails, the transaction is taken back
// to where it was, and the Error goes on. Does not commit.
UpdateCounts update(graph::Transaction& transaction, graph::Terms& terms, std::string_view text,
                    const UpdateOptions& options = {});

// Throws Error if the text is not a query, or not an update, that could be run.
void check_query(graph::Terms& terms, std::string_view text, const QueryOptions& options = {});
void check_update(graph::Terms& terms, std::string_view text, const QueryOptions& options = {});

// The operators that would run, in their order, with the rows that the planner expects.
std::string explain(const graph::View& view, graph::Terms& terms, std::string_view text,
                    const QueryOptions& options = {});

// Prepared queries by their text, so that the same text is parsed and planned once. Belongs to
// whoever uses the store, and must not outlive it. Safe to use from several threads.
class QueryCache {
 public:
  explicit QueryCache(graph::Store& store);
  ~QueryCache();
  std::shared_ptr<const Prepared> prepare(std::string_view text,
                                          std::span<const std::string_view> parameters = {},
                                          graph::Dataset dataset = graph::Dataset::kUnion);
  std::shared_ptr<const Prepared> prepare(std::string_view text,
                                          std::initializer_list<std::string_view> parameters,
                                          graph::Dataset dataset = graph::Dataset::kUnion) {
    return prepare(text, std::span(parameters.begin(), parameters.size()), dataset);
  }
  std::size_t size() const;
  // Beyond this many the cache is emptied; queries in use live on.
  static constexpr std::size_t kMostQueries = 1000;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace sinew::rdf::sparql
