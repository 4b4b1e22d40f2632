// One writer and one reader for each format, behind formats.h; and what they share.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "sinew/base/error.h"
#include "sinew/rdf/results/formats.h"

namespace sinew::rdf {

std::string write_xml(const ResultSet& results, const graph::Terms& terms);
std::string write_json(const ResultSet& results, const graph::Terms& terms);
std::string write_csv(const ResultSet& results, const graph::Terms& terms);
std::string write_tsv(const ResultSet& results, const graph::Terms& terms);

ResultSet read_xml(std::string_view text, std::string_view file, graph::Terms& terms);
ResultSet read_json(std::string_view text, std::string_view file, graph::Terms& terms);
ResultSet read_csv(std::string_view text, std::string_view file, graph::Terms& terms);
ResultSet read_tsv(std::string_view text, std::string_view file, graph::Terms& terms);

// Collects columns and rows, and refuses what no result set can be.
class ResultBuilder {
 public:
  // Throws Error when the name comes twice, is no variable's name, or there are too many.
  void add_column(std::string_view name, const Place& place);
  std::size_t column_count() const { return results_.columns.size(); }
  // Throws Error when there is no such column.
  std::size_t column(std::string_view name, const Place& place) const;
  // A row in which nothing is bound yet; throws Error when there are too many cells.
  void add_row(const Place& place);
  // In the last row; throws Error when the cell is bound already.
  void bind(std::size_t column, graph::Id value, const Place& place);
  void set_boolean(bool value, const Place& place);
  // Throws Error when the text gave neither a list of rows, were it empty, nor a boolean.
  ResultSet finish(const Place& place, bool has_results);

 private:
  ResultSet results_;
  std::unordered_map<std::string, std::size_t> columns_;
};

[[noreturn]] void fail_at(const Place& place, std::string what, std::string remedy);

}  // namespace sinew::rdf
