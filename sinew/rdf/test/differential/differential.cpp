// Asks our engine and oxigraph (npm) the same random queries and compares the solutions, as
// multisets and up to blank nodes. Differences that are not explained in known_differences.tsv are
// failures, and so are explanations of differences that are no longer there.
//
//   differential FOLDER        everything that is made goes into FOLDER
//   differential FOLDER NUMBER prints one case and both answers
//
// Where there is no node or npm, or oxigraph cannot be installed, the test is skipped and says so.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "cases.h"
#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/results/compare.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/results/table.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/turtle/reader.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf::differential {
namespace {

namespace fs = std::filesystem;
using graph::Id;
using graph::Quad;

// The version whose faults known_differences.tsv lists.
constexpr const char* kOxigraph = "oxigraph@0.5.11";

void write_file(const fs::path& path, std::string_view text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

bool run(const std::string& command) { return std::system(command.c_str()) == 0; }

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

// Why the test must be skipped; empty when oxigraph is there.
std::string install(const fs::path& folder) {
  if (fs::exists(folder / "node_modules" / "oxigraph")) return {};
  if (!run("command -v node >/dev/null && command -v npm >/dev/null")) {
    return "node and npm are not installed";
  }
  write_file(folder / "package.json", "{ \"private\": true }\n");
  const bool installed = run(fmt::format(
      "cd {} && npm install --no-audit --no-fund {} >npm.log 2>&1", quoted(folder), kOxigraph));
  return installed ? "" : fmt::format("npm cannot install {}", kOxigraph);
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out + "\"";
}

void write_cases(const fs::path& folder) {
  for (int i = 0; i < kGraphs; ++i) {
    write_file(folder / fmt::format("graph{}.nq", i), make_graph(i));
  }
  std::string lines;
  for (int i = 0; i < kQueries; ++i) {
    const Case made = make_case(i);
    lines +=
        fmt::format("{{\"graph\":{},\"union\":{},\"construct\":{},\"query\":{}}}\n", made.graph,
                    made.union_default, made.form == Form::kConstruct, json_string(made.query));
  }
  write_file(folder / "cases.jsonl", lines);
}

// One form for each number: engines differ in how they write sums, and in the last digits of
// quotients.
Id plain(Id id, graph::Terms& terms) {
  const auto number = id ? terms.number(id) : std::nullopt;
  return number ? terms.literal(fmt::format("{:.12g}", *number), terms.datatype(id)) : id;
}

struct Solutions {
  ResultSet results;
  std::vector<Quad> triples;
  std::string error;
};

Solutions ask_ours(const Case& made, graph::Store& store) {
  Solutions solutions;
  try {
    sparql::QueryOptions options;
    options.dataset = made.union_default ? graph::Dataset::kUnion : graph::Dataset::kDefault;
    sparql::Answer answer = sparql::query(store.view(), store.terms(), made.query, options);
    solutions.results = std::move(answer.results);
    solutions.triples = std::move(answer.triples);
  } catch (const Error& error) {
    solutions.error = error.what();
  }
  return solutions;
}

Solutions read_theirs(const fs::path& folder, int number, const Case& made, graph::Terms& terms) {
  const auto file = [&](const char* end) {
    return folder / "answers" / fmt::format("{}.{}", number, end);
  };
  Solutions solutions;
  if (fs::exists(file("error"))) {
    solutions.error = w3c::read_file(file("error"));
  } else if (made.form == Form::kConstruct) {
    read_rdf(
        w3c::read_file(file("nt")), Syntax::kNTriples, {}, terms,
        [&](const Quad& quad, std::size_t, std::size_t) { solutions.triples.push_back(quad); });
  } else {
    const std::string name = file("srj").string();
    solutions.results = read_results(w3c::read_file(name), ResultFormat::kJson, name, terms);
  }
  return solutions;
}

std::string compare(const Case& made, Solutions& ours, Solutions& theirs, graph::Terms& terms) {
  if (!ours.error.empty() || !theirs.error.empty()) {
    return fmt::format("ours: {}; theirs: {}", ours.error, theirs.error);
  }
  if (made.count_only) {
    if (ours.results.rows.size() == theirs.results.rows.size()) return {};
    return fmt::format("{} rows on the left, {} on the right", ours.results.rows.size(),
                       theirs.results.rows.size());
  }
  for (Solutions* side : {&ours, &theirs}) {
    for (auto& row : side->results.rows) {
      for (Id& id : row) id = plain(id, terms);
    }
    for (Quad& quad : side->triples) quad.object = plain(quad.object, terms);
  }
  if (made.form == Form::kConstruct) {
    return compare_quads(ours.triples, theirs.triples, terms).difference;
  }
  return compare_results(ours.results, theirs.results, false, terms).difference;
}

void show(const Case& made, const Solutions& ours, const Solutions& theirs,
          const graph::Terms& terms) {
  const Prefixes prefixes{{"ex", "http://example.org/"},
                          {"xsd", "http://www.w3.org/2001/XMLSchema#"}};
  std::cout << made.query << "\n(graph " << made.graph << (made.union_default ? ", union" : "")
            << ")\n";
  for (const Solutions* side : {&ours, &theirs}) {
    std::cout << (side == &ours ? "---- ours\n" : "---- theirs\n") << side->error << "\n";
    std::cout << (made.form == Form::kConstruct
                      ? write_rdf(side->triples, Syntax::kTurtle, terms, {prefixes, true})
                      : write_table(side->results, terms, prefixes));
  }
}

// Number of the query, and why the answers differ.
std::map<int, std::string> known_differences() {
  std::map<int, std::string> known;
  std::istringstream lines(w3c::read_file(SINEW_KNOWN_DIFFERENCES));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) throw std::runtime_error("no reason: " + line);
    known[std::stoi(line.substr(0, tab))] = line.substr(tab + 1);
  }
  return known;
}

std::vector<graph::Store> read_graphs() {
  std::vector<graph::Store> stores(kGraphs);
  for (int i = 0; i < kGraphs; ++i) {
    graph::Store& store = stores[static_cast<std::size_t>(i)];
    read_rdf(make_graph(i), Syntax::kNQuads, {}, store.terms(),
             [&](const Quad& quad, std::size_t, std::size_t) { store.add(quad); });
  }
  return stores;
}

// A crash, be it for want of stack, must name its query. Only functions that a signal handler may
// call.
volatile std::sig_atomic_t query_at_hand = -1;

void name_the_query(int) {
  char text[] = "FAILED: crash at query     \n";
  int number = query_at_hand;
  for (char* digit = text + sizeof text - 3; number > 0; number /= 10) {
    *digit-- = static_cast<char>('0' + number % 10);
  }
  [[maybe_unused]] const auto written = write(STDOUT_FILENO, text, sizeof text - 1);
  _exit(1);
}

void watch_for_crashes() {
  static char stack[64 * 1024];
  stack_t alternate{};
  alternate.ss_sp = stack;
  alternate.ss_size = sizeof stack;
  sigaltstack(&alternate, nullptr);
  struct sigaction action {};
  action.sa_handler = name_the_query;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) sigaction(signal, &action, nullptr);
}

int run_all(const fs::path& folder, int only) {
  fs::create_directories(folder);
  if (const std::string reason = install(folder); !reason.empty()) {
    std::cout << "skipped: " << reason << "; the comparison with oxigraph was not made\n";
    return w3c::kSkipped;
  }
  if (only < 0) {
    write_cases(folder);
    fs::remove_all(folder / "answers");
    fs::create_directories(folder / "answers");
    if (!run(fmt::format("node {} {}", quoted(SINEW_OXIGRAPH_SCRIPT), quoted(folder)))) {
      std::cout << "FAILED: oxigraph.mjs did not end well\n";
      return 1;
    }
  }
  watch_for_crashes();
  std::vector<graph::Store> stores = read_graphs();
  const std::map<int, std::string> known = known_differences();
  std::map<std::string, int> explained;
  int same = 0, unexplained = 0, empty = 0;
  std::size_t rows = 0;
  for (int i = 0; i < kQueries; ++i) {
    if (only >= 0 && i != only) continue;
    query_at_hand = i;
    const Case made = make_case(i);
    graph::Store& store = stores[static_cast<std::size_t>(made.graph)];
    Solutions ours = ask_ours(made, store);
    Solutions theirs = read_theirs(folder, i, made, store.terms());
    rows += ours.results.rows.size() + ours.triples.size();
    empty += ours.results.rows.empty() && ours.triples.empty() && !ours.results.boolean;
    if (only >= 0) show(made, ours, theirs, store.terms());
    const std::string difference = compare(made, ours, theirs, store.terms());
    const auto reason = known.find(i);
    if (difference.empty() && reason == known.end()) {
      ++same;
    } else if (!difference.empty() && reason != known.end()) {
      ++explained[reason->second];
    } else {
      ++unexplained;
      std::cout << "FAILED query " << i << ": "
                << (difference.empty() ? "the answers no longer differ; take it off the list"
                                       : difference)
                << "\n"
                << made.query << '\n'
                << std::flush;
    }
  }
  std::cout << fmt::format("{} queries, {} of them without solutions, {} solutions: {} agree\n",
                           kQueries, empty, rows, same);
  for (const auto& [reason, count] : explained)
    std::cout << fmt::format("{:>5} {}\n", count, reason);
  std::cout << fmt::format("{:>5} not explained\n", unexplained);
  return unexplained == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sinew::rdf::differential

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: " << argv[0] << " FOLDER [NUMBER]\n";
    return 2;
  }
  try {
    return sinew::rdf::differential::run_all(argv[1], argc > 2 ? std::atoi(argv[2]) : -1);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
