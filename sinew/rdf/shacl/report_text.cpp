#include <fmt/format.h>

#include "sinew/rdf/shacl/report.h"

namespace sinew::rdf::shacl {
namespace {

std::string short_name(const graph::Terms& terms, Id id) {
  return terms.is_iri(id) ? std::string(terms.text(id)) : terms.to_string(id);
}

Problem to_problem(const Result& result, const graph::Terms& terms, const graph::Places* places) {
  Problem problem;
  const bool single = result.path && result.path->kind == Path::Kind::kPredicate;
  if (places)
    problem.place = places->find(result.focus_node, single ? result.path->predicate : Id{});
  problem.iri = short_name(terms, result.focus_node);
  const std::string where = single        ? short_name(terms, result.path->predicate) + ": "
                            : result.path ? to_sparql(*result.path, terms) + ": "
                                          : std::string();
  if (result.messages.empty()) {
    problem.what = where + result.what;
    problem.remedy = result.remedy;
  } else {
    // The shape's own words, as the first part of a sentence.
    std::string_view message = result.messages[0].text;
    if (message.ends_with('.')) message.remove_suffix(1);
    problem.what = where + std::string(message);
    // That the value is the node itself says nothing new.
    if (result.value != result.focus_node || result.path) {
      problem.remedy =
          result.remedy.empty() ? result.what : fmt::format("{}: {}", result.what, result.remedy);
    }
  }
  const std::string_view severity = terms.text(result.severity);
  const bool mild =
      severity == fmt::format("{}Warning", kSh) || severity == fmt::format("{}Info", kSh);
  problem.severity = mild ? Severity::kWarning : Severity::kError;
  problem.code = terms.text(result.component_iri);
  return problem;
}

void append(std::string& text, const std::vector<Result>& results, const graph::Terms& terms,
            const graph::Places* places, std::size_t indent) {
  for (const Result& result : results) {
    text.append(indent, ' ');
    text += fmt::format("{} (shape {})\n", to_string(to_problem(result, terms, places)),
                        short_name(terms, result.source_shape));
    append(text, result.details, terms, places, indent + 2);
  }
}

}  // namespace

std::vector<Problem> to_problems(const ValidationReport& report, const graph::Terms& terms,
                                 const graph::Places* places) {
  std::vector<Problem> problems;
  for (const Result& result : report.results) problems.push_back(to_problem(result, terms, places));
  return problems;
}

std::string to_text(const ValidationReport& report, const graph::Terms& terms,
                    const graph::Places* places) {
  if (report.conforms()) return "conforms\n";
  std::string text;
  append(text, report.results, terms, places, 0);
  return text;
}

}  // namespace sinew::rdf::shacl
