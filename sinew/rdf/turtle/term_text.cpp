#include "sinew/rdf/turtle/term_text.h"

#include <fmt/format.h>

#include "sinew/base/error.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/turtle/byte_class.h"

namespace sinew::rdf {
namespace {

using graph::Id;

constexpr ByteClass kNeedsEscape =
    bytes_where([](unsigned char c) { return c == '"' || c == '\\' || c == '\n' || c == '\r'; });

std::size_t skip_digits(std::string_view text, std::size_t i) {
  while (i < text.size() && text[i] >= '0' && text[i] <= '9') ++i;
  return i;
}

// As """...""", with ends of lines as they are.
void append_long_quoted(std::string& out, std::string_view value) {
  out += "\"\"\"";
  for (std::size_t i = 0; i < value.size(); ++i) {
    const char c = value[i];
    // A quote is escaped where it could be taken for a part of the end.
    const bool risky = c == '"' && (i + 1 == value.size() || value[i + 1] == '"');
    if (c == '\\' || risky) out += '\\';
    if (c == '\r') {
      out += "\\r";
    } else {
      out += c;
    }
  }
  out += "\"\"\"";
}

}  // namespace

void append_iri(std::string& out, std::string_view iri) {
  if (const auto fault = fault_of_iri(iri)) {
    Problem problem;
    problem.iri = iri;
    problem.what = *fault + " and cannot be written";
    problem.remedy = "percent-encode such characters, and resolve relative IRIs first";
    throw Error(std::move(problem));
  }
  out.append("<").append(iri).append(">");
}

void append_quoted(std::string& out, std::string_view value) {
  out += '"';
  std::size_t begin = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!in(kNeedsEscape, value[i])) continue;
    out.append(value.substr(begin, i - begin));
    begin = i + 1;
    out += '\\';
    out += value[i] == '\n' ? 'n' : value[i] == '\r' ? 'r' : value[i];
  }
  out.append(value.substr(begin));
  out += '"';
}

void append_term(std::string& out, Id id, const graph::Terms& terms) {
  if (!terms.is_literal(id)) return append_iri(out, terms.text(id));
  append_quoted(out, terms.text(id));
  if (const std::string_view language = terms.language(id); !language.empty()) {
    out.append("@").append(language);
  } else if (const std::string_view type = terms.text(terms.datatype(id));
             type != graph::kXsdString) {
    out += "^^";
    append_iri(out, type);
  }
}

void BlankLabels::append(std::string& out, Id node) {
  const std::size_t number = numbers_.try_emplace(node, numbers_.size()).first->second;
  out += fmt::format("_:b{}", number);
}

bool is_bare_literal(std::string_view text, std::string_view datatype) {
  if (!datatype.starts_with(graph::kXsd)) return false;
  datatype.remove_prefix(graph::kXsd.size());
  if (datatype == "boolean") return text == "true" || text == "false";
  if (datatype != "integer" && datatype != "decimal" && datatype != "double") return false;
  const std::size_t start = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  std::size_t i = skip_digits(text, start);
  std::size_t digits = i - start;
  if (datatype == "integer") return digits > 0 && i == text.size();
  const bool has_point = i < text.size() && text[i] == '.';
  if (has_point) {
    const std::size_t fraction = skip_digits(text, i + 1);
    digits += fraction - i - 1;
    // A decimal must not end with its point, which would end the statement.
    if (datatype == "decimal" && fraction == i + 1) return false;
    i = fraction;
  }
  if (datatype == "decimal") return has_point && i == text.size();
  if (digits == 0 || i == text.size() || (text[i] != 'e' && text[i] != 'E')) return false;
  ++i;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
  return i < text.size() && skip_digits(text, i) == text.size();
}

void ShortTerms::append(std::string& out, Id id) {
  if (terms_.is_literal(id)) return append_literal(out, id);
  append_iri(out, id);
}

bool ShortTerms::try_append(std::string& out, Id id) {
  const std::size_t begin = out.size();
  try {
    append(out, id);
    return true;
  } catch (const Error&) {
    out.resize(begin);
    return false;
  }
}

void ShortTerms::append_iri(std::string& out, Id id) {
  const auto name = prefixes_.shorten(terms_.text(id));
  if (!name) return rdf::append_iri(out, terms_.text(id));
  const std::string_view prefix = std::string_view(*name).substr(0, name->find(':'));
  if (!used_.find(prefix)) used_.set(prefix, *prefixes_.find(prefix));
  out += *name;
}

void ShortTerms::append_literal(std::string& out, Id id) {
  const std::string_view text = terms_.text(id);
  const Id datatype = terms_.datatype(id);
  const std::string_view type = terms_.text(datatype);
  if (is_bare_literal(text, type)) {
    out += text;
    return;
  }
  if (several_lines_ && text.find('\n') != std::string_view::npos) {
    append_long_quoted(out, text);
  } else {
    append_quoted(out, text);
  }
  if (const std::string_view language = terms_.language(id); !language.empty()) {
    out.append("@").append(language);
  } else if (type != graph::kXsdString) {
    out += "^^";
    append_iri(out, datatype);
  }
}

Prefixes ShortTerms::used() const {
  Prefixes used;
  for (const Prefix& prefix : prefixes_.list()) {
    if (used_.find(prefix.name)) used.set(prefix.name, prefix.iri);
  }
  return used;
}

}  // namespace sinew::rdf
