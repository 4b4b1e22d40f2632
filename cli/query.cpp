// sinew query MODEL… (-e TEXT | -q FILE) and sinew update …: SPARQL on models.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <span>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "prefixes.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/results/table.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/turtle/writer.h"
#include "write_models.h"

namespace sinew::cli {
namespace {

// The SPARQL text of a command: given in place or in a file.
struct SparqlText {
  std::string expression, file;

  void add_options(CLI::App& app) {
    auto* e = app.add_option("-e,--expression", expression,
                             "SPARQL text; the project's prefixes need no declaration");
    app.add_option("-q,--query-file", file, "File with SPARQL text, - for standard input")
        ->excludes(e);
  }
  bool is_given() const { return !expression.empty() || !file.empty(); }
  std::string text() const { return file.empty() ? expression : read_input(file); }
};

int need_text(const CLI::App& app) {
  std::cerr << app.get_name() << ": give the SPARQL text with -e or -q\n";
  return kBadUsage;
}

// The formats of rows (and of yes or no), and those of triples; the first is what is written where
// none is asked for.
constexpr std::array kRowFormats = {"table", "json", "xml", "csv", "tsv"};
constexpr std::array kTripleFormats = {"turtle", "ntriples", "jsonld"};

std::string rows_as(const std::string& format, const rdf::ResultSet& results,
                    const graph::Terms& terms) {
  if (format == "json") return rdf::write_results(results, rdf::ResultFormat::kJson, terms);
  if (format == "xml") return rdf::write_results(results, rdf::ResultFormat::kXml, terms);
  if (format == "csv") return rdf::write_results(results, rdf::ResultFormat::kCsv, terms);
  if (format == "tsv") return rdf::write_results(results, rdf::ResultFormat::kTsv, terms);
  return rdf::write_table(results, terms, known_prefixes());
}

std::string triples_as(const std::string& format, std::span<const graph::Quad> triples,
                       const graph::Terms& terms) {
  if (format == "jsonld") return triples_as_jsonld(triples, terms);
  rdf::WriteOptions options;
  options.prefixes = known_prefixes();
  return rdf::write_rdf(triples,
                        format == "ntriples" ? rdf::Syntax::kNTriples : rdf::Syntax::kTurtle, terms,
                        options);
}

// Throws Error where the answer's kind has no such format.
std::string format_answer(const rdf::sparql::Answer& answer, const graph::Terms& terms,
                          const std::string& format) {
  const bool triples = answer.kind == rdf::sparql::AnswerKind::kTriples;
  const std::span<const char* const> formats =
      triples ? std::span<const char* const>(kTripleFormats) : kRowFormats;
  if (!format.empty() && std::ranges::find(formats, format) == formats.end()) {
    Problem problem;
    problem.what =
        fmt::format("--format {}: the query gives {}", format, triples ? "triples" : "rows");
    problem.remedy = fmt::format("ask for {}", fmt::join(formats, ", "));
    throw Error(std::move(problem));
  }
  return triples ? triples_as(format, answer.triples, terms)
                 : rows_as(format, answer.results, terms);
}

}  // namespace

int run_query(Arguments arguments) {
  CLI::App app(
      "Answer a SPARQL query on the union of all graphs of the models. SELECT and ASK give a "
      "table, CONSTRUCT and DESCRIBE give Turtle, or what --format says.",
      "sinew query");
  ModelOptions models_options;
  SparqlText sparql;
  std::string format, output;
  bool explain = false;
  add_model_options(app, models_options);
  sparql.add_options(app);
  std::vector<std::string> formats(kRowFormats.begin(), kRowFormats.end());
  formats.insert(formats.end(), kTripleFormats.begin(), kTripleFormats.end());
  app.add_option("--format", format,
                 "Of rows: table (default), json, xml, csv, tsv; of triples: turtle (default), "
                 "ntriples, jsonld")
      ->check(CLI::IsMember(formats));
  app.add_flag("--explain", explain, "Print the plan instead of the answer");
  app.add_option("-o,--output", output, "File for the answer (default: standard output)");
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (!sparql.is_given()) return need_text(app);

  const auto models = load(models_options);
  rdf::sparql::QueryOptions options;
  options.name = sparql.file;
  options.prefixes = &known_prefixes();
  const std::string text = sparql.text();
  const graph::View view = models->store.view();
  graph::Terms& terms = models->store.terms();
  write_output(output, explain ? rdf::sparql::explain(view, terms, text, options)
                               : format_answer(rdf::sparql::query(view, terms, text, options),
                                               terms, format));
  return kOk;
}

int run_update(Arguments arguments) {
  CLI::App app(
      "Apply a SPARQL update to the models and write the result as TriG; the model files stay as "
      "they are.",
      "sinew update");
  ModelOptions models_options;
  SparqlText sparql;
  std::string output;
  add_model_options(app, models_options);
  sparql.add_options(app);
  app.add_option("-o,--output", output, "File for the result (default: standard output)");
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (!sparql.is_given()) return need_text(app);

  const auto models = load(models_options);
  rdf::sparql::UpdateOptions options;
  options.name = sparql.file;
  options.prefixes = &known_prefixes();
  graph::Transaction transaction = models->store.begin();
  const auto counts =
      rdf::sparql::update(transaction, models->store.terms(), sparql.text(), options);
  transaction.commit();
  std::cerr << counts.added << " triples added, " << counts.removed << " removed\n";
  rdf::WriteOptions write_options;
  write_options.prefixes = known_prefixes();
  write_output(output, rdf::write_rdf(rdf::quads_of(models->store.view()), rdf::Syntax::kTriG,
                                      models->store.terms(), write_options));
  return kOk;
}

}  // namespace sinew::cli
