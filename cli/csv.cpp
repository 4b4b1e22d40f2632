#include "csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "sinew/base/error.h"

namespace sinew::cli {
namespace {

[[noreturn]] void fail(const std::string& file, std::size_t line, std::string what,
                       std::string remedy) {
  throw Error({{file, line, 0}, "", std::move(what), std::move(remedy), Severity::kError, {}});
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

// The fields of one line. Names and numbers hold no commas, so quotes need no more than trimming.
std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto comma = line.find(',');
    parts.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

double number(std::string_view text, const std::string& file, std::size_t line,
              const std::string& column) {
  double value = 0;
  const char* begin = text.data();
  const char* const end = text.data() + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [next, fault] = std::from_chars(begin, end, value);
  if (fault != std::errc{} || next != end) {
    fail(file, line, fmt::format("'{}' in column {} is not a number", text, column),
         "write a decimal number such as -1.5e-3");
  }
  return value;
}

}  // namespace

Table read_csv(std::string_view text, const std::string& file) {
  Table table;
  std::size_t line_number = 0;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write it
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  while (!text.empty()) {
    ++line_number;
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (trim(line).empty()) continue;
    const auto parts = fields(line);
    if (table.columns.empty()) {
      table.columns.assign(parts.begin(), parts.end());
      std::set<std::string> seen;
      for (const std::string& column : table.columns) {
        if (column.empty()) fail(file, line_number, "a column has no name", "name every column");
        if (!seen.insert(column).second) {
          fail(file, line_number, "column " + column + " is there twice", "leave one of them out");
        }
      }
      continue;
    }
    if (parts.size() != table.columns.size()) {
      fail(file, line_number,
           fmt::format("{} numbers for {} columns", parts.size(), table.columns.size()),
           "write one number for each column of the header");
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      table.values.push_back(number(parts[i], file, line_number, table.columns[i]));
    }
  }
  if (table.columns.empty())
    fail(file, 0, "has no header line", "begin with the names of the columns");
  return table;
}

std::string csv_header(const std::vector<std::string>& columns) {
  return fmt::format("{}\n", fmt::join(columns, ","));
}

std::string csv_rows(std::span<const double> values, std::size_t columns) {
  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  for (; columns > 0 && values.size() >= columns; values = values.subspan(columns)) {
    const auto row = values.first(columns);
    fmt::format_to(out, "{}\n", fmt::join(row.begin(), row.end(), ","));
  }
  return fmt::to_string(text);
}

std::string write_csv(const Table& table) {
  return csv_header(table.columns) + csv_rows(table.values, table.columns.size());
}

}  // namespace sinew::cli
