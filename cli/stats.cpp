// sinew stats ALGO.jsonld: what an algorithm is made of and what it costs. Whatever the graph can
// tell is asked of the graph.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "prefixes.h"
#include "sinew/backend/c_target.h"
#include "sinew/program/dead_closures.h"
#include "sinew/program/interface.h"
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
  const auto answer =
      rdf::sparql::query(models.store.view(), terms, with_known_prefixes(query), {}).results;
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

// Closures on the longest way from an input to an output, each waiting for the one before.
std::size_t longest_chain(const program::Program& program) {
  std::vector<std::size_t> depth(program.variables.size(), 0);
  std::size_t longest = 0;
  for (const std::uint32_t index : program.schedule) {
    std::size_t deepest = 0;
    for (const std::uint32_t variable : program.closures[index].arguments) {
      deepest = std::max(deepest, depth[variable]);
    }
    for (const std::uint32_t variable : program.closures[index].arguments) {
      if (program.variables[variable].role == program::Role::kInternal) {
        depth[variable] = std::max(depth[variable], deepest + 1);
      }
    }
    longest = std::max(longest, deepest + 1);
  }
  return longest;
}

}  // namespace

int run_stats(Arguments arguments) {
  CLI::App app("Count an algorithm's data, closures, floating-point operations and memory.",
               "sinew stats");
  ModelOptions models_options;
  QueryOptions query;
  std::string format = "text";
  add_model_options(app, models_options);
  add_query_options(app, query);
  app.add_option("--format", format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const auto models = load(models_options);
  const graph::Id algorithm = algorithm_of(*models, models_options, query);
  const program::Program program = lowered(*models, algorithm, "statistics");
  const program::Program live = program::without_dead_closures(program);
  backend::COptions options;
  options.name = program.name;
  const program::OperationCount operations = backend::generate_c(program, options).operations;

  std::size_t memory = 0;
  for (const program::Variable& variable : live.variables) memory += variable.size * sizeof(double);
  const program::Interface interface = program::interface_of(program);
  Json report;
  report["algorithm"] = models->store.terms().text(algorithm);
  report["closures"] = ask(*models, algorithm, kClosuresByOperator);
  report["data"] = ask(*models, algorithm, kDataByQuantity);
  report["scheduled"] = {{"closures", live.closures.size()}, {"variables", live.variables.size()},
                         {"memory_bytes", memory},           {"longest_chain", longest_chain(live)},
                         {"inputs", interface.in_size},      {"outputs", interface.out_size},
                         {"state", interface.state_size}};
  report["operations"] = {{"add", operations.add},
                          {"multiply", operations.multiply},
                          {"divide", operations.divide},
                          {"sqrt", operations.sqrt},
                          {"sincos", operations.sincos}};
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
