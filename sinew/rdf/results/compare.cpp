#include "sinew/rdf/results/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

using Rows = std::vector<std::vector<Id>>;

constexpr std::size_t kRowsToShow = 5;

Comparison different(std::string why) { return {Likeness::kDifferent, std::move(why)}; }

std::string row_text(const std::vector<std::string>& columns, const std::vector<Id>& row,
                     const graph::Terms& terms) {
  std::string text;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i]) text += fmt::format(" ?{}={}", columns[i], terms.to_string(row[i]));
  }
  return text.empty() ? " (nothing bound)" : text;
}

// Some of the rows of `rows` that are not in `others`; both sorted.
std::string missing(const char* heading, const std::vector<std::string>& columns, const Rows& rows,
                    const Rows& others, const graph::Terms& terms) {
  Rows only;
  std::ranges::set_difference(rows, others, std::back_inserter(only));
  std::string text;
  for (std::size_t i = 0; i < std::min(only.size(), kRowsToShow); ++i) {
    text += fmt::format("\n{}{}", heading, row_text(columns, only[i], terms));
  }
  if (only.size() > kRowsToShow) text += fmt::format("\n  and {} more", only.size() - kRowsToShow);
  return text;
}

// The right side's rows with their columns in the left side's order.
Rows rearranged(const ResultSet& right, const std::vector<std::string>& columns) {
  std::vector<std::size_t> from;
  for (const std::string& column : columns) {
    from.push_back(
        static_cast<std::size_t>(std::ranges::find(right.columns, column) - right.columns.begin()));
  }
  Rows rows;
  for (const auto& row : right.rows) {
    std::vector<Id>& moved = rows.emplace_back();
    for (const std::size_t column : from) moved.push_back(row[column]);
  }
  return rows;
}

// A node for each different row, with its cells, and how often it comes or where. The same helper
// terms serve both sides.
std::vector<Quad> as_quads(const Rows& rows, bool ordered, graph::Terms& terms) {
  std::map<std::vector<Id>, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < rows.size(); ++i) places[rows[i]].push_back(i);
  const Id number = terms.iri("urn:sinew:row-number"), count = terms.iri("urn:sinew:row-count");
  std::vector<Quad> quads;
  for (const auto& [row, at] : places) {
    const Id node = terms.fresh_blank();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i]) quads.push_back({node, terms.iri(fmt::format("urn:sinew:column-{}", i)), row[i]});
    }
    if (ordered) {
      for (const std::size_t place : at) {
        quads.push_back({node, number, terms.integer(static_cast<std::int64_t>(place))});
      }
    } else {
      quads.push_back({node, count, terms.integer(static_cast<std::int64_t>(at.size()))});
    }
  }
  return quads;
}

}  // namespace

Comparison compare_results(const ResultSet& left, const ResultSet& right, bool ordered,
                           graph::Terms& terms) {
  if (left.boolean != right.boolean) {
    const auto say = [](const ResultSet& side) {
      return !side.boolean ? "rows" : *side.boolean ? "yes" : "no";
    };
    return different(fmt::format("{} on the left, {} on the right", say(left), say(right)));
  }
  std::vector<std::string> left_columns = left.columns, right_columns = right.columns;
  std::ranges::sort(left_columns);
  std::ranges::sort(right_columns);
  if (left_columns != right_columns) {
    return different(fmt::format("variables ({}) on the left, ({}) on the right",
                                 fmt::join(left.columns, " "), fmt::join(right.columns, " ")));
  }
  Rows left_rows = left.rows, right_rows = rearranged(right, left.columns);
  const auto count =
      fmt::format("{} rows on the left, {} on the right", left_rows.size(), right_rows.size());
  if (!ordered) {
    std::ranges::sort(left_rows);
    std::ranges::sort(right_rows);
  }
  if (left_rows == right_rows) return {Likeness::kIsomorphic, {}};
  Comparison result = different({});
  if (left_rows.size() == right_rows.size()) {
    const std::vector<Quad> left_quads = as_quads(left_rows, ordered, terms);
    result = compare_quads(left_quads, as_quads(right_rows, ordered, terms), terms);
  }
  if (result) return result;
  std::ranges::sort(left_rows);
  std::ranges::sort(right_rows);
  result.difference = count;
  result.difference += missing("  only on the left:", left.columns, left_rows, right_rows, terms);
  result.difference += missing("  only on the right:", left.columns, right_rows, left_rows, terms);
  if (ordered && left_rows == right_rows) result.difference += " in another order";
  return result;
}

}  // namespace sinew::rdf
