// Rows of numbers with named columns, as `sinew run` reads and writes them: a header line of names,
// then one line of numbers for each evaluation. Numbers are written so that they read back exactly.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::cli {

struct Table {
  std::vector<std::string> columns;
  std::vector<double> values;  // row after row
  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

// Throws Error with file and line: no header, a column named twice or not at all, a line with too
// few or too many numbers, something that is not a number.
Table read_csv(std::string_view text, const std::string& file);

std::string write_csv(const Table& table);
// Its two parts, for tables that are written while they grow.
std::string csv_header(const std::vector<std::string>& columns);
std::string csv_rows(std::span<const double> values, std::size_t columns);

}  // namespace sinew::cli
