// Result sets as CSV and as TSV.
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/term_text.h"

namespace sinew::rdf {
namespace {

using graph::Id;

void refuse_boolean(const ResultSet& results, const char* name) {
  if (!results.boolean) return;
  fail_at({}, std::string(name) + " has no form for an answer of yes or no",
          "write the answer as JSON or XML");
}

// RFC 4180, section 2: in quotes where the value holds a quote, a comma or an end of line.
void append_csv(std::string& out, std::string_view text) {
  if (text.find_first_of("\",\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace

std::string write_csv(const ResultSet& results, const graph::Terms& terms) {
  refuse_boolean(results, "CSV");
  BlankLabels labels;
  std::string out;
  for (std::size_t i = 0; i < results.columns.size(); ++i) {
    if (i > 0) out += ',';
    append_csv(out, results.columns[i]);
  }
  out += "\r\n";
  for (const auto& row : results.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out += ',';
      if (!row[i]) continue;
      if (terms.is_blank(row[i])) {
        labels.append(out, row[i]);
      } else {
        append_csv(out, terms.text(row[i]));
      }
    }
    out += "\r\n";
  }
  return out;
}

std::string write_tsv(const ResultSet& results, const graph::Terms& terms) {
  refuse_boolean(results, "TSV");
  BlankLabels labels;
  const Prefixes none;
  ShortTerms short_terms(terms, none, false);
  std::string out;
  for (std::size_t i = 0; i < results.columns.size(); ++i) {
    if (i > 0) out += '\t';
    out.append("?").append(results.columns[i]);
  }
  out += '\n';
  std::string cell;
  for (const auto& row : results.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out += '\t';
      if (!row[i]) continue;
      if (terms.is_blank(row[i])) {
        labels.append(out, row[i]);
        continue;
      }
      cell.clear();
      short_terms.append(cell, row[i]);
      for (const char c : cell) {  // a tab can only be inside a literal
        if (c == '\t') {
          out += "\\t";
        } else {
          out += c;
        }
      }
    }
    out += '\n';
  }
  return out;
}

}  // namespace sinew::rdf
