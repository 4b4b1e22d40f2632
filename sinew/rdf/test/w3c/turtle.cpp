// The suites of Turtle and TriG: what must be accepted, what must be refused, and what it means.
//
// Beyond what the suites ask, every text that is accepted is written again in each syntax and read
// back, and must come out the same.
#include <fmt/format.h>

#include "manifest.h"
#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/turtle/reader.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Quad;
namespace fs = std::filesystem;

std::vector<Quad> read(std::string_view text, Syntax syntax, const std::string& name,
                       const std::string& base, graph::Terms& terms) {
  std::vector<Quad> quads;
  read_rdf(text, syntax, {name, base, {}}, terms,
           [&](const Quad& quad, std::size_t, std::size_t) { quads.push_back(quad); });
  return quads;
}

std::string round_trips(const std::vector<Quad>& quads, bool graphs, graph::Terms& terms) {
  const Prefixes prefixes{{"rdf", "http://www.w3.org/1999/02/22-rdf-syntax-ns#"},
                          {"xsd", "http://www.w3.org/2001/XMLSchema#"},
                          {"", "http://a.example/"}};
  for (const Syntax syntax :
       {graphs ? Syntax::kTriG : Syntax::kTurtle, graphs ? Syntax::kNQuads : Syntax::kNTriples}) {
    const std::string text = write_rdf(quads, syntax, terms, {prefixes, true});
    std::vector<Quad> again;
    try {
      again = read(text, syntax, "what we wrote", "", terms);
    } catch (const Error& error) {
      return std::string("cannot read what was written: ") + error.what() + "\n" + text;
    }
    if (const Comparison same = compare_quads(quads, again, terms); !same) {
      return "changed by writing: " + same.difference + "\n" + text;
    }
    if (text != write_rdf(again, syntax, terms, {prefixes, true})) {
      return "written differently the second time:\n" + text;
    }
  }
  return {};
}

void run_suite(const fs::path& folder, Syntax syntax, Syntax expected_syntax, SuiteReport& report) {
  const Manifest manifest(folder / "manifest.ttl");
  const auto base = manifest.text(manifest.self(), "mf:assumedTestBase");
  for (const ManifestTest& test : manifest.tests()) {
    report.test(test.name, [&]() -> std::string {
      const fs::path file = manifest.file(test.action);
      const std::string text = read_file(file);
      graph::Terms terms;
      std::vector<Quad> quads;
      const bool negative = test.kind.find("Negative") != std::string::npos;
      try {
        quads = read(text, syntax, file.filename().string(),
                     base.value() + file.filename().string(), terms);
      } catch (const Error& error) {
        if (!negative) return error.what();
        const Problem& problem = error.problems().front();
        if (problem.place.line == 0 || problem.place.column == 0 || problem.remedy.empty()) {
          return fmt::format("an error without place or remedy: {}", error.what());
        }
        return {};
      }
      if (negative) return "accepted, but it is wrong";
      if (test.kind.ends_with("Eval")) {
        const fs::path expected = manifest.file(test.result);
        const Comparison same = compare_quads(
            quads, read(read_file(expected), expected_syntax, expected.string(), "", terms), terms);
        if (!same) return same.difference;
      } else if (!test.kind.ends_with("PositiveSyntax")) {
        return "an unknown kind of test: " + test.kind;
      }
      return round_trips(quads, syntax == Syntax::kTriG, terms);
    });
  }
}

}  // namespace
}  // namespace sinew::rdf::w3c

int main(int argc, char** argv) {
  using namespace sinew::rdf;
  return w3c::run(argc, argv,
                  {{"turtle",
                    [](const auto& folder, w3c::SuiteReport& report) {
                      w3c::run_suite(folder, Syntax::kTurtle, Syntax::kNTriples, report);
                    }},
                   {"trig", [](const auto& folder, w3c::SuiteReport& report) {
                      w3c::run_suite(folder, Syntax::kTriG, Syntax::kNQuads, report);
                    }}});
}
