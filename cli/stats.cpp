// sinew stats ALGO.jsonld: what an algorithm is made of and what it costs. Whatever the graph can
// tell is asked of the graph.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "prefixes.h"
#include "sinew/algorithm/weave.h"
#include "sinew/backend/c_target.h"
#include "sinew/base/error.h"
#include "sinew/program/dead_closures.h"
#include "sinew/program/facts.h"
#include "sinew/program/interface.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/results/table.h"
#include "sinew/rdf/sparql/engine.h"

namespace sinew::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kClosuresByOperator =
    "SELECT ?operator (COUNT(?closure) AS ?number) WHERE { ?algorithm sa:closure ?closure . "
    "?closure a ?operator } GROUP BY ?operator ORDER BY DESC(?number) ?operator";
constexpr const char* kDataByQuantity =
    "SELECT ?quantity (COUNT(?data) AS ?number) (SUM(?size) AS ?numbers) WHERE { "
    "?algorithm sa:data ?data . ?data sa:quantity ?quantity ; sa:size ?size } "
    "GROUP BY ?quantity ORDER BY DESC(?number) ?quantity";

// Rows of (name, number, …) of a query on one algorithm's graph.
Json ask(Models& models, graph::Id algorithm, const std::string& text) {
  graph::Terms& terms = models.store.terms();
  std::string query = text;
  const auto where = query.find("WHERE {");
  query.replace(where, 7, "FROM <" + std::string(terms.text(algorithm)) + "> WHERE {");
  rdf::sparql::QueryOptions options;
  options.prefixes = &known_prefixes();
  const auto answer = rdf::sparql::query(models.store.view(), terms, query, options).results;
  Json rows = Json::object();
  for (const auto& row : answer.rows) {
    const std::string_view iri = terms.text(row[0]);
    const std::string name = known_prefixes().shorten(iri).value_or(std::string(iri));
    Json numbers = Json::array();
    for (std::size_t i = 1; i < row.size(); ++i) {
      numbers.push_back(static_cast<std::int64_t>(terms.number(row[i]).value_or(0)));
    }
    rows[name] = numbers.size() == 1 ? numbers[0] : numbers;
  }
  return rows;
}

backend::GeneratedCode generated(const program::Program& program) {
  backend::COptions options;
  options.name = program.name;
  return backend::generate_c(program, options);
}

Json as_json(const program::OperationCount& operations) {
  return {{"add", operations.add},
          {"multiply", operations.multiply},
          {"divide", operations.divide},
          {"sqrt", operations.sqrt},
          {"sincos", operations.sincos}};
}

// Adds and multiplies that generated C spends on one sine with its cosine
// (templates/c/sincos.c.mustache).
constexpr std::size_t kOperationsOfSincos = 48;

std::size_t adds_and_multiplies(const program::OperationCount& operations) {
  return operations.add + operations.multiply;
}
std::size_t all_operations(const program::OperationCount& operations) {
  return adds_and_multiplies(operations) + operations.divide + operations.sqrt +
         kOperationsOfSincos * operations.sincos;
}

// The costs of several programs, their sum, and what is saved by one that does the same as all.
Json compared(const std::vector<std::pair<std::string, program::OperationCount>>& programs,
              const program::OperationCount& together,
              std::size_t (*cost)(const program::OperationCount&)) {
  Json rows = Json::object();
  std::size_t sum = 0;
  for (const auto& [name, operations] : programs) {
    rows[name] = cost(operations);
    sum += cost(operations);
  }
  rows["sum"] = sum;
  rows["together"] = cost(together);
  const double share = static_cast<double>(cost(together)) / static_cast<double>(sum);
  rows["saved_percent"] = std::round(1000.0 * (1.0 - share)) / 10.0;
  return rows;
}

// What each of several queries costs in a program of its own. Their algorithms join the models'
// graph.
std::vector<std::pair<std::string, program::OperationCount>> apart(Models& models,
                                                                   const ModelOptions& files,
                                                                   const QueryOptions& options) {
  std::vector<std::pair<std::string, program::OperationCount>> programs;
  std::vector<synthesis::Query> queries = queries_of(files, options);
  if (queries.size() < 2) return programs;
  for (synthesis::Query& query : queries) {
    if (query.asked.empty()) continue;  // it only gives more to the others
    const std::string name = query.name;
    const graph::Id algorithm =
        algorithm_of(models, query_of({std::move(query)}, options), nullptr, options.snap);
    programs.emplace_back(name, generated(lowered(models, algorithm, "statistics")).operations);
  }
  return programs;
}

// The answers of statistics that users write (statistics/*.rq), on the algorithm with what its
// operators read, write and cost.
std::string answers_of(Models& models, graph::Id algorithm, const std::vector<std::string>& weaves,
                       const std::vector<std::string>& queries, const std::string& format) {
  program::write_facts(models.store, algorithm);
  for (const std::string& update : weaves)
    algorithm::weave(models.store, algorithm, read_input(update), update,
                     algorithm::Rounds::kUntilSettled, &known_prefixes());
  std::string text;
  for (const std::string& file : queries) {
    rdf::sparql::QueryOptions options;
    options.name = file;
    options.prefixes = &known_prefixes();
    const auto answer =
        rdf::sparql::query(models.store.view(), models.store.terms(), read_input(file), options);
    if (answer.kind == rdf::sparql::AnswerKind::kTriples)
      throw Error(Problem{{file, 1, 0},
                          "",
                          "a statistic is a table",
                          "write a SELECT or an ASK; 'sinew query' takes the others",
                          {},
                          {}});
    if (queries.size() > 1 && format == "text") text += fmt::format("# {}\n", file);
    text += format == "json"
                ? rdf::write_results(answer.results, rdf::ResultFormat::kJson, models.store.terms())
                : rdf::write_table(answer.results, models.store.terms(), known_prefixes());
  }
  return text;
}

}  // namespace

int run_stats(Arguments arguments) {
  CLI::App app(
      "Count an algorithm's data, closures, floating-point operations and memory; of several "
      "queries also what each would cost by itself (adds and multiplies). With -q, answer "
      "statistics "
      "written as SPARQL (those that ship are in statistics/) on the algorithm, in which each "
      "closure "
      "states what it reads (sa:reads), writes (sa:writes) and costs by itself (sa:additions, "
      "sa:multiplications, sa:divisions, sa:square-roots, sa:sines-and-cosines, sa:choices).",
      "sinew stats");
  ModelOptions models_options;
  QueryOptions query;
  std::string format = "text";
  add_model_options(app, models_options);
  add_query_options(app, query);
  app.add_option("--format", format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  std::vector<std::string> queries, weaves;
  app.add_option("-q,--query-file", queries,
                 "Statistic to answer instead: a SPARQL query; may be repeated");
  auto* weave = app.add_option("--weave", weaves,
                               "Update to apply to the algorithm before, until it changes nothing "
                               "(weaves/depths.rq: sa:depth); may be repeated");
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (weave->count() > 0 && queries.empty()) {
    std::cerr << "sinew stats: --weave prepares what -q asks; give -q FILE\n";
    return kBadUsage;
  }

  const auto models = load(models_options);
  const graph::Id algorithm = algorithm_of(*models, models_options, query);
  if (!queries.empty()) {
    write_output("", answers_of(*models, algorithm, weaves, queries, format));
    return kOk;
  }
  const program::Program program = lowered(*models, algorithm, "statistics");
  const program::Program live = program::without_dead_closures(program);
  const backend::GeneratedCode code = generated(program);
  const program::OperationCount& operations = code.operations;
  const bool holds = std::any_of(program.variables.begin(), program.variables.end(),
                                 [](const program::Variable& v) { return v.held; });

  std::size_t memory = 0;
  for (const program::Variable& variable : live.variables) memory += variable.size * sizeof(double);
  const program::Interface interface = program::interface_of(program);
  Json report;
  report["algorithm"] = models->store.terms().text(algorithm);
  report["closures"] = ask(*models, algorithm, kClosuresByOperator);
  report["data"] = ask(*models, algorithm, kDataByQuantity);
  report["scheduled"] = {
      {"closures", live.closures.size()}, {"variables", live.variables.size()},
      {"memory_bytes", memory},           {"longest_chain", program::longest_chain(live)},
      {"inputs", interface.in_size},      {"outputs", interface.out_size},
      {"state", interface.state_size}};
  report["operations"] = as_json(operations);
  if (holds) report["operations of an update"] = as_json(code.update);
  if (const auto programs = apart(*models, models_options, query); programs.size() > 1) {
    report["adds and multiplies of each asked apart"] =
        compared(programs, operations, adds_and_multiplies);
    report["all floating-point operations of each asked apart"] =
        compared(programs, operations, all_operations);
  }
  if (format == "json") {
    write_output("", report.dump(1) + "\n");
    return kOk;
  }
  std::string text = fmt::format("{}\n", report["algorithm"].get<std::string>());
  for (const auto& [section, rows] : report.items()) {
    if (!rows.is_object()) continue;
    text += "\n" + section + "\n";
    for (const auto& [name, value] : rows.items()) {
      const std::string numbers =
          value.is_array() ? fmt::format("{} ({} numbers)", value[0].dump(), value[1].dump())
                           : value.dump();
      text += fmt::format("  {:<55} {}\n", name, numbers);
    }
  }
  write_output("", text);
  return kOk;
}

}  // namespace sinew::cli
