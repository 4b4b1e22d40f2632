#include "sinew/rdf/sparql/prepared_insert.h"

#include <algorithm>

#include "sinew/rdf/sparql/algebra/translate.h"
#include "sinew/rdf/sparql/eval/evaluator.h"
#include "sinew/rdf/sparql/instantiate.h"
#include "sinew/rdf/sparql/plan/planner.h"
#include "sinew/rdf/sparql/syntax/parser.h"

namespace sinew::rdf::sparql {

using graph::Id;
using syntax::Operation;

struct PreparedInsert::Data {
  graph::Terms* terms = nullptr;
  syntax::Update parsed;
  std::vector<syntax::Variable> columns;
  std::shared_ptr<const plan::Plan> plan;
  Limits limits;
};

PreparedInsert::PreparedInsert() : data_(std::make_unique<Data>()) {}
PreparedInsert::~PreparedInsert() = default;

std::vector<graph::Quad> PreparedInsert::triples(const graph::View& view,
                                                 std::span<const Id> parameters) const {
  eval::Evaluator evaluator(data_->plan);
  std::vector<Id> rows;
  std::size_t count = 0;
  evaluator.select(view, parameters, data_->limits, [&](std::span<const Id> row) {
    rows.insert(rows.end(), row.begin(), row.end());
    ++count;
    return true;
  });
  for (Id& id : rows) id = evaluator.space().keep(id, *data_->terms);
  const std::size_t width = data_->columns.size();
  Instantiator inserts(data_->parsed.operations.front().inserts, data_->columns);
  std::vector<graph::Quad> result;
  for (std::size_t i = 0; i < count; ++i)
    inserts.fill(std::span<const Id>(rows.data() + i * width, width), {}, *data_->terms, result);
  return result;
}

std::shared_ptr<const PreparedInsert> prepare_insert(graph::Store& store, std::string_view text,
                                                     std::span<const std::string_view> parameters,
                                                     const Limits& limits) {
  syntax::ParseOptions options;
  options.name = "insertion";
  options.limits = limits;
  options.parameters = parameters;
  std::shared_ptr<PreparedInsert> result(new PreparedInsert);
  PreparedInsert::Data& data = *result->data_;
  data.parsed = syntax::parse_update(store.terms(), text, options);
  const std::vector<Operation>& operations = data.parsed.operations;
  if (operations.size() != 1 || operations.front().kind != Operation::Kind::kModify ||
      !operations.front().deletes.quads.empty() || operations.front().inserts.quads.empty())
    data.parsed.source->fail(0, "only one INSERT { ... } WHERE { ... } can be prepared",
                             "write one that deletes nothing");
  data.terms = &store.terms();
  data.limits = limits;
  const Operation& operation = operations.front();
  for (const syntax::TemplateQuad& quad : operation.inserts.quads)
    for (const syntax::Node node : {quad.subject, quad.predicate, quad.object, quad.graph})
      if (node.is_variable()) data.columns.push_back(node.value);
  std::sort(data.columns.begin(), data.columns.end());
  data.columns.erase(std::unique(data.columns.begin(), data.columns.end()), data.columns.end());
  const algebra::Query query =
      algebra::translate_where(operation, data.parsed.source, data.columns, parameters);
  data.plan = plan::make_plan(query, store.view(),
                              plan::dataset_of(operation.using_clause, graph::Dataset::kUnion));
  return result;
}

}  // namespace sinew::rdf::sparql
