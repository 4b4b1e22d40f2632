// Result sets as XML and as JSON.
#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/term_text.h"

namespace sinew::rdf {
namespace {

using graph::Id;

std::string blank_label(BlankLabels& labels, Id id) {
  std::string label;
  labels.append(label, id);
  return label.substr(2);  // without "_:"
}

// The datatype to be written: none for plain strings and for texts in a language.
std::string_view explicit_datatype(Id literal, const graph::Terms& terms) {
  if (!terms.language(literal).empty()) return {};
  const std::string_view datatype = terms.text(terms.datatype(literal));
  return datatype == graph::kXsdString ? std::string_view{} : datatype;
}

void append_xml(std::string& out, std::string_view text) {
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\r':  // a bare one would be read as an end of line
        out += "&#xD;";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') {
          fail_at({}, fmt::format("XML cannot hold the character 0x{:02X} of \"{}\"", int{c}, text),
                  "write the results as JSON");
        }
        out += c;
    }
  }
}

void append_xml_term(std::string& out, Id id, BlankLabels& labels, const graph::Terms& terms) {
  if (terms.is_blank(id)) {
    out += fmt::format("<bnode>{}</bnode>", blank_label(labels, id));
  } else if (!terms.is_literal(id)) {
    out += "<uri>";
    append_xml(out, terms.text(id));
    out += "</uri>";
  } else {
    out += "<literal";
    if (const auto language = terms.language(id); !language.empty()) {
      out += fmt::format(" xml:lang=\"{}\"", language);
    } else if (const auto datatype = explicit_datatype(id, terms); !datatype.empty()) {
      out += " datatype=\"";
      append_xml(out, datatype);
      out += '"';
    }
    out += '>';
    append_xml(out, terms.text(id));
    out += "</literal>";
  }
}

void append_json(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", int{c});
    } else {
      out += c;
    }
  }
  out += '"';
}

void append_json_term(std::string& out, Id id, BlankLabels& labels, const graph::Terms& terms) {
  if (terms.is_blank(id)) {
    out += fmt::format(R"({{ "type": "bnode", "value": "{}" }})", blank_label(labels, id));
    return;
  }
  out +=
      terms.is_literal(id) ? R"({ "type": "literal", "value": )" : R"({ "type": "uri", "value": )";
  append_json(out, terms.text(id));
  if (terms.is_literal(id)) {
    if (const auto language = terms.language(id); !language.empty()) {
      out += fmt::format(R"(, "xml:lang": "{}")", language);
    } else if (const auto datatype = explicit_datatype(id, terms); !datatype.empty()) {
      out += R"(, "datatype": )";
      append_json(out, datatype);
    }
  }
  out += " }";
}

}  // namespace

std::string write_xml(const ResultSet& results, const graph::Terms& terms) {
  BlankLabels labels;
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<sparql xmlns=\"http://www.w3.org/2005/sparql-results#\">\n"
      "  <head>\n";
  for (const std::string& column : results.columns) {
    out += fmt::format("    <variable name=\"{}\"/>\n", column);
  }
  out += "  </head>\n";
  if (results.boolean) {
    out += fmt::format("  <boolean>{}</boolean>\n", *results.boolean);
  } else {
    out += "  <results>\n";
    for (const auto& row : results.rows) {
      out += "    <result>\n";
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (!row[i]) continue;
        out += fmt::format("      <binding name=\"{}\">", results.columns[i]);
        append_xml_term(out, row[i], labels, terms);
        out += "</binding>\n";
      }
      out += "    </result>\n";
    }
    out += "  </results>\n";
  }
  return out + "</sparql>\n";
}

std::string write_json(const ResultSet& results, const graph::Terms& terms) {
  BlankLabels labels;
  if (results.boolean) {
    return fmt::format("{{\n  \"head\": {{}},\n  \"boolean\": {}\n}}\n", *results.boolean);
  }
  std::string out = "{\n  \"head\": { \"vars\": [";
  for (std::size_t i = 0; i < results.columns.size(); ++i) {
    out += i > 0 ? ", " : " ";
    append_json(out, results.columns[i]);
  }
  out += " ] },\n  \"results\": { \"bindings\": [";
  for (std::size_t r = 0; r < results.rows.size(); ++r) {
    out += r > 0 ? ",\n    {" : "\n    {";
    bool first = true;
    for (std::size_t i = 0; i < results.columns.size(); ++i) {
      if (!results.rows[r][i]) continue;
      out += first ? "\n      " : ",\n      ";
      first = false;
      append_json(out, results.columns[i]);
      out += ": ";
      append_json_term(out, results.rows[r][i], labels, terms);
    }
    out += first ? "}" : "\n    }";
  }
  return out + "\n  ] }\n}\n";
}

}  // namespace sinew::rdf
