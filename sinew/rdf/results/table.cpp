#include "sinew/rdf/results/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/turtle/term_text.h"

namespace sinew::rdf {
namespace {

// In characters; each is taken to be one column wide.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Control characters would upset the terminal.
std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += c == '\t' ? "\\t" : fmt::format("\\u{:04X}", int{c});
    } else {
      out += c;
    }
  }
  return out;
}

void append_line(std::string& out, const std::vector<std::string>& cells,
                 const std::vector<std::size_t>& widths) {
  const std::size_t begin = out.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += "  ";
    out += cells[i];
    out.append(widths[i] - width(cells[i]), ' ');
  }
  while (out.size() > begin && out.back() == ' ') out.pop_back();
  out += '\n';
}

}  // namespace

std::string write_table(const ResultSet& results, const graph::Terms& terms,
                        const Prefixes& prefixes) {
  if (results.boolean) return *results.boolean ? "yes\n" : "no\n";
  BlankLabels labels;
  ShortTerms short_terms(terms, prefixes, false);
  std::vector<std::vector<std::string>> lines(1);
  for (const std::string& column : results.columns) lines[0].push_back("?" + column);
  for (const auto& row : results.rows) {
    std::vector<std::string>& cells = lines.emplace_back(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!row[i]) continue;
      if (terms.is_blank(row[i])) {
        labels.append(cells[i], row[i]);
      } else if (terms.number(row[i])) {
        cells[i] = terms.text(row[i]);
      } else if (!short_terms.try_append(cells[i], row[i])) {
        cells[i] = terms.to_string(row[i]);
      }
      cells[i] = printable(cells[i]);
    }
  }
  std::vector<std::size_t> widths(results.columns.size(), 0);
  for (const auto& cells : lines) {
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], width(cells[i]));
  }
  std::vector<std::string> rule;
  for (const std::size_t columns : widths) rule.emplace_back(columns, '-');
  lines.insert(lines.begin() + 1, std::move(rule));

  std::string out;
  if (!results.columns.empty()) {
    for (const auto& cells : lines) append_line(out, cells, widths);
  }
  const std::size_t rows = results.rows.size();
  return out + fmt::format("({} {})\n", rows, rows == 1 ? "row" : "rows");
}

}  // namespace sinew::rdf
