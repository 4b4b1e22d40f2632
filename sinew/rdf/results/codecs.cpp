#include "sinew/rdf/results/codecs.h"

#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"

namespace sinew::rdf {
namespace {

// VARNAME of SPARQL 1.1, section 19.8, without its exclusion of '-' and with any first digit.
bool is_variable_name(std::string_view name) {
  if (name.empty()) return false;
  for (std::size_t i = 0; i < name.size();) {
    const Decoded next = decode_utf8(name, i);
    if (!is_name_character(next.character) || next.character == '-') return false;
    i += next.length;
  }
  return true;
}

}  // namespace

void fail_at(const Place& place, std::string what, std::string remedy) {
  throw Error(Problem{place, "", std::move(what), std::move(remedy), Severity::kError, {}});
}

void ResultBuilder::add_column(std::string_view name, const Place& place) {
  if (!is_variable_name(name)) {
    fail_at(place, fmt::format("\"{}\" is not the name of a variable", name),
            "use letters, digits and _");
  }
  if (results_.columns.size() >= kMaxResultColumns) {
    fail_at(place, fmt::format("there are more than {} variables", kMaxResultColumns),
            "ask for fewer variables");
  }
  if (!columns_.emplace(name, results_.columns.size()).second) {
    fail_at(place, fmt::format("the variable \"{}\" is listed twice", name), "list it once");
  }
  results_.columns.emplace_back(name);
}

std::size_t ResultBuilder::column(std::string_view name, const Place& place) const {
  const auto found = columns_.find(std::string(name));
  if (found == columns_.end()) {
    fail_at(place, fmt::format("the variable \"{}\" is bound but not listed in the head", name),
            "list every variable in the head");
  }
  return found->second;
}

void ResultBuilder::add_row(const Place& place) {
  const std::size_t width = results_.columns.size() + 1;
  if ((results_.rows.size() + 1) * width > kMaxResultCells) {
    fail_at(place, fmt::format("there are more than {} values", kMaxResultCells),
            "ask for fewer rows with LIMIT");
  }
  results_.rows.emplace_back(results_.columns.size());
}

void ResultBuilder::bind(std::size_t column, graph::Id value, const Place& place) {
  graph::Id& cell = results_.rows.back()[column];
  if (cell) {
    fail_at(place, fmt::format("the variable \"{}\" is bound twice", results_.columns[column]),
            "bind each variable once a row");
  }
  cell = value;
}

void ResultBuilder::set_boolean(bool value, const Place& place) {
  if (results_.boolean || !results_.rows.empty() || !results_.columns.empty()) {
    fail_at(place, "there is a boolean besides other results", "give one result");
  }
  results_.boolean = value;
}

ResultSet ResultBuilder::finish(const Place& place, bool has_results) {
  if (!has_results && !results_.boolean) {
    fail_at(place, "there are no results", "give a list of rows, even an empty one, or a boolean");
  }
  return std::move(results_);
}

}  // namespace sinew::rdf
