// SPARQL 1.1 Update (section 3): each operation evaluates its WHERE fully, then deletes, then
// inserts.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/algebra/translate.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/sparql/eval/evaluator.h"
#include "sinew/rdf/sparql/instantiate.h"
#include "sinew/rdf/sparql/plan/planner.h"
#include "sinew/rdf/sparql/syntax/parser.h"

namespace sinew::rdf::sparql {
namespace {

using graph::Id;
using graph::Quad;
using syntax::Operation;

class Updater {
 public:
  Updater(graph::Transaction& transaction, graph::Terms& terms, const UpdateOptions& options,
          std::shared_ptr<const syntax::Source> source)
      : transaction_(transaction), terms_(terms), options_(options), source_(std::move(source)) {}

  void run(const Operation& operation) {
    using Kind = Operation::Kind;
    switch (operation.kind) {
      case Kind::kInsertData:
      case Kind::kDeleteData:
        change_data(operation);
        break;
      case Kind::kModify:
        modify(operation);
        break;
      case Kind::kLoad:
        load(operation);
        break;
      case Kind::kCreate:
        create(operation);
        break;
      case Kind::kClear:
      case Kind::kDrop:
        clear_or_drop(operation);
        break;
      case Kind::kAdd:
      case Kind::kMove:
      case Kind::kCopy:
        transfer(operation);
        break;
    }
  }

  UpdateCounts counts;

 private:
  void add(const Quad& quad) { counts.added += transaction_.add(quad) ? 1 : 0; }
  void remove(const Quad& quad) { counts.removed += transaction_.remove(quad) ? 1 : 0; }

  std::vector<Quad> quads_in(Id graph) const {
    std::vector<Quad> quads;
    transaction_.view().match_in({}, {}, {}, graph, [&](const Quad& quad) {
      quads.push_back(quad);
      return true;
    });
    return quads;
  }
  void clear(Id graph) {
    for (const Quad& quad : quads_in(graph)) remove(quad);
  }
  bool exists(Id graph) const { return !graph || transaction_.view().has_graph(graph); }
  std::string name(Id graph) const { return graph ? terms_.to_string(graph) : "DEFAULT"; }

  // False where the operation is SILENT and so does nothing.
  bool require(const Operation& operation, Id graph) const {
    if (exists(graph)) return true;
    if (operation.silent) return false;
    source_->fail(operation.offset, fmt::format("there is no graph {}", name(graph)),
                  "create it first, or write SILENT");
  }

  void change_data(const Operation& operation) {
    const bool inserts = operation.kind == Operation::Kind::kInsertData;
    std::vector<Quad> quads;
    Instantiator(inserts ? operation.inserts : operation.deletes, {}).fill({}, {}, terms_, quads);
    for (const Quad& quad : quads) inserts ? add(quad) : remove(quad);
  }

  plan::DatasetPlan dataset_of(const Operation& operation) const {
    plan::DatasetPlan dataset = plan::dataset_of(operation.using_clause, options_.dataset);
    if (operation.with && !operation.using_clause.given) {
      dataset.kind = plan::DatasetPlan::Default::kMerge;
      dataset.merged = {operation.with};
    }
    return dataset;
  }

  void modify(const Operation& operation) {
    std::vector<syntax::Variable> columns;
    for (const syntax::Template* pattern : {&operation.deletes, &operation.inserts}) {
      for (const syntax::TemplateQuad& quad : pattern->quads) {
        for (const syntax::Node node : {quad.subject, quad.predicate, quad.object, quad.graph}) {
          if (node.is_variable()) columns.push_back(node.value);
        }
      }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const graph::View view = transaction_.view();
    const algebra::Query query = algebra::translate_where(operation, source_, columns);
    eval::Evaluator evaluator(plan::make_plan(query, view, dataset_of(operation)));
    std::vector<Id> rows;
    std::size_t count = 0;
    evaluator.select(view, {}, options_.limits, [&](std::span<const Id> row) {
      rows.insert(rows.end(), row.begin(), row.end());
      ++count;
      return true;
    });
    for (Id& id : rows) id = evaluator.space().keep(id, terms_);

    // All deletions are found before the first triple changes, and so are all insertions.
    Instantiator deletes(operation.deletes, columns);
    Instantiator inserts(operation.inserts, columns);
    std::vector<Quad> to_remove, to_add;
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const Id> row(rows.data() + i * columns.size(), columns.size());
      deletes.fill(row, operation.with, terms_, to_remove);
      inserts.fill(row, operation.with, terms_, to_add);
    }
    for (const Quad& quad : to_remove) remove(quad);
    for (const Quad& quad : to_add) add(quad);
  }

  void load(const Operation& operation) {
    std::vector<Quad> quads;
    try {
      if (!options_.load) {
        source_->fail(operation.offset, "LOAD stands here, and nothing is fetched",
                      "give a loader that maps IRIs to documents, or read the file beforehand");
      }
      options_.load(terms_.text(operation.source), [&](const Quad& quad) {
        quads.push_back({quad.subject, quad.predicate, quad.object, operation.graph});
      });
    } catch (const Error&) {
      if (operation.silent) return;
      throw;
    }
    for (const Quad& quad : quads) add(quad);
  }

  void create(const Operation& operation) {
    if (exists(operation.graph)) {
      if (operation.silent) return;
      source_->fail(operation.offset,
                    fmt::format("the graph {} exists already", name(operation.graph)),
                    "write CREATE SILENT, or CLEAR to empty it");
    }
    transaction_.create_graph(operation.graph);
  }

  void clear_or_drop(const Operation& operation) {
    using Target = Operation::Target;
    std::vector<Id> graphs;
    if (operation.target == Target::kGraph) {
      if (!require(operation, operation.graph)) return;
      graphs.push_back(operation.graph);
    } else {
      if (operation.target != Target::kDefault) {
        transaction_.view().named_graphs([&](Id graph) {
          graphs.push_back(graph);
          return true;
        });
      }
      if (operation.target != Target::kNamed) graphs.push_back({});
    }
    for (const Id graph : graphs) {
      clear(graph);
      if (operation.kind == Operation::Kind::kDrop && graph) transaction_.drop_graph(graph);
    }
  }

  void transfer(const Operation& operation) {
    const Id from = operation.source;
    const Id to = operation.graph;
    if (!require(operation, from) || from == to) return;
    const std::vector<Quad> quads = quads_in(from);
    if (operation.kind != Operation::Kind::kAdd) clear(to);
    if (to && !exists(to)) transaction_.create_graph(to);
    for (const Quad& quad : quads) add({quad.subject, quad.predicate, quad.object, to});
    if (operation.kind != Operation::Kind::kMove) return;
    clear(from);
    if (from) transaction_.drop_graph(from);
  }

  graph::Transaction& transaction_;
  graph::Terms& terms_;
  const UpdateOptions& options_;
  std::shared_ptr<const syntax::Source> source_;
};

syntax::Update parse(graph::Terms& terms, std::string_view text, const QueryOptions& options) {
  syntax::ParseOptions parse_options;
  parse_options.name = options.name.empty() ? "update" : options.name;
  parse_options.base = options.base;
  parse_options.limits = options.limits;
  parse_options.prefixes = options.prefixes;
  return syntax::parse_update(terms, text, parse_options);
}

}  // namespace

UpdateCounts update(graph::Transaction& transaction, graph::Terms& terms, std::string_view text,
                    const UpdateOptions& options) {
  const syntax::Update parsed = parse(terms, text, options);
  const graph::Transaction::Mark mark = transaction.mark();
  Updater updater(transaction, terms, options, parsed.source);
  try {
    for (const Operation& operation : parsed.operations) updater.run(operation);
  } catch (...) {
    transaction.undo_to(mark);
    throw;
  }
  return updater.counts;
}

void check_update(graph::Terms& terms, std::string_view text, const QueryOptions& options) {
  parse(terms, text, options);
}

}  // namespace sinew::rdf::sparql
