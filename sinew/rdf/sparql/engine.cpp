#include "sinew/rdf/sparql/engine.h"

#include <set>

#include "sinew/rdf/sparql/algebra/translate.h"
#include "sinew/rdf/sparql/describe.h"
#include "sinew/rdf/sparql/eval/evaluator.h"
#include "sinew/rdf/sparql/instantiate.h"
#include "sinew/rdf/sparql/plan/planner.h"
#include "sinew/rdf/sparql/syntax/parser.h"

namespace sinew::rdf::sparql {
namespace {

using graph::Id;
using syntax::QueryForm;

syntax::ParseOptions parse_options(const QueryOptions& options) {
  syntax::ParseOptions result;
  result.name = options.name;
  result.base = options.base;
  result.limits = options.limits;
  result.prefixes = options.prefixes;
  return result;
}

struct Compiled {
  algebra::Query query;
  plan::DatasetPlan dataset;
  std::shared_ptr<const plan::Plan> plan;
};

Compiled compile(const graph::View& view, graph::Terms& terms, std::string_view text,
                 const QueryOptions& options) {
  Compiled result;
  result.query = algebra::translate(syntax::parse_query(terms, text, parse_options(options)));
  result.dataset = plan::dataset_of(result.query.dataset, options.dataset);
  result.plan = plan::make_plan(result.query, view, result.dataset);
  return result;
}

// Rows with computed terms moved into the store's dictionary.
std::vector<std::vector<Id>> rows_of(const Compiled& compiled, const graph::View& view,
                                     graph::Terms& terms, const Limits& limits) {
  std::vector<std::vector<Id>> rows;
  eval::Evaluator evaluator(compiled.plan);
  evaluator.select(view, {}, limits, [&](std::span<const Id> row) {
    rows.emplace_back(row.begin(), row.end());
    return true;
  });
  for (auto& row : rows) {
    for (Id& id : row) id = evaluator.space().keep(id, terms);
  }
  return rows;
}

std::vector<graph::Quad> construct(const Compiled& compiled,
                                   const std::vector<std::vector<Id>>& rows, graph::Terms& terms) {
  std::vector<graph::Quad> made;
  Instantiator instantiator(compiled.query.construct, compiled.query.select.columns);
  for (const auto& row : rows) instantiator.fill(row, {}, terms, made);
  std::vector<graph::Quad> result;
  std::set<graph::Quad> seen;
  for (const graph::Quad& quad : made) {
    if (seen.insert(quad).second) result.push_back(quad);
  }
  return result;
}

std::vector<graph::Quad> describe_all(const Compiled& compiled, const graph::View& view,
                                      const std::vector<std::vector<Id>>& rows) {
  std::vector<Id> nodes;
  for (const syntax::Node node : compiled.query.describe) {
    if (!node.is_variable()) nodes.push_back(node.id());
  }
  for (const auto& row : rows) nodes.insert(nodes.end(), row.begin(), row.end());
  return describe(view, compiled.dataset, nodes);
}

}  // namespace

Answer query(const graph::View& view, graph::Terms& terms, std::string_view text,
             const QueryOptions& options) {
  const Compiled compiled = compile(view, terms, text, options);
  Answer answer;
  if (compiled.query.form == QueryForm::kAsk) {
    answer.kind = AnswerKind::kBoolean;
    answer.results.boolean = eval::Evaluator(compiled.plan).ask(view, {}, options.limits);
    return answer;
  }
  auto rows = rows_of(compiled, view, terms, options.limits);
  switch (compiled.query.form) {
    case QueryForm::kConstruct:
      answer.kind = AnswerKind::kTriples;
      answer.triples = construct(compiled, rows, terms);
      break;
    case QueryForm::kDescribe:
      answer.kind = AnswerKind::kTriples;
      answer.triples = describe_all(compiled, view, rows);
      break;
    default:
      answer.results.columns = compiled.plan->columns;
      answer.results.rows = std::move(rows);
      break;
  }
  return answer;
}

void check_query(graph::Terms& terms, std::string_view text, const QueryOptions& options) {
  algebra::translate(syntax::parse_query(terms, text, parse_options(options)));
}

std::string explain(const graph::View& view, graph::Terms& terms, std::string_view text,
                    const QueryOptions& options) {
  return plan::explain(*compile(view, terms, text, options).plan, terms);
}

}  // namespace sinew::rdf::sparql
