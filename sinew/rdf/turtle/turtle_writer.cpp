#include "sinew/rdf/turtle/turtle_writer.h"

#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/turtle/shape.h"
#include "sinew/rdf/turtle/term_text.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

constexpr std::size_t kWidth = 100;  // columns
constexpr std::size_t kIndent = 4;

// Where the last line begins.
std::size_t line_start(const std::string& text) {
  const std::size_t newline = text.rfind('\n');
  return newline == std::string::npos ? 0 : newline + 1;
}

class TurtleWriter {
 public:
  TurtleWriter(std::span<const Quad> quads, const graph::Terms& terms, const Prefixes& prefixes)
      : terms_(terms),
        shape_(quads, terms),
        short_terms_(terms, prefixes),
        type_(terms.find_iri(graph::kRdfType)),
        nil_(terms.find_iri(graph::kRdfNil)) {}

  std::string write(bool graphs) {
    std::string body;
    Id graph;
    for (const Description& description : shape_.descriptions()) {
      if (shape_.is_nested(description.subject)) continue;
      if (description.graph != graph) {
        if (graph) body += "}\n";
        graph = description.graph;
        if (!body.empty()) body += '\n';
        node(body, graph);
        body += " {\n";
      } else if (!body.empty()) {
        body += '\n';
      }
      statement(body, description, graphs && graph ? kIndent : 0);
    }
    if (graph) body += "}\n";

    std::string text;
    const Prefixes used = short_terms_.used();
    for (const Prefix& prefix : used.list()) {
      text += fmt::format("@prefix {}: ", prefix.name);
      append_iri(text, prefix.iri);
      text += " .\n";
    }
    if (!text.empty() && !body.empty()) text += '\n';
    return text + body;
  }

 private:
  // A property list or list is first tried on one line; if that gets wider than the page, it is
  // given up.
  struct TooWide {};

  void statement(std::string& out, const Description& description, std::size_t indent) {
    out.append(indent, ' ');
    if (terms_.is_blank(description.subject) && !shape_.has_label(description.subject)) {
      out += "[]";
    } else {
      node(out, description.subject);
    }
    if (description.quads.size() > 1 || !one_property(out, description.quads)) {
      properties(out, description.quads, indent + kIndent);
    }
    out += " .\n";
  }

  // Behind the subject, if there is room for it; otherwise nothing is written.
  bool one_property(std::string& out, std::span<const Quad> quads) {
    const std::size_t begin = out.size();
    out += ' ';
    if (compact_properties(out, quads, line_start(out) + kWidth)) return true;
    out.resize(begin);
    return false;
  }

  // Every property on lines of its own.
  void properties(std::string& out, std::span<const Quad> quads, std::size_t indent) {
    for (std::size_t i = 0; i < quads.size(); ++i) {
      const bool same = i > 0 && quads[i].predicate == quads[i - 1].predicate;
      if (same) {
        out += ", ";
      } else {
        out += i > 0 ? " ;\n" : "\n";
        out.append(indent, ' ');
        predicate(out, quads[i].predicate);
        out += ' ';
      }
      object(out, quads[i].object, indent);
    }
  }

  void object(std::string& out, Id id, std::size_t indent) {
    if (!is_bracketed(id)) return node(out, id);
    const std::size_t begin = out.size();
    if (compact_object(out, id, line_start(out) + kWidth)) return;
    out.resize(begin);
    if (const auto elements = shape_.list(id)) {
      out += '(';
      for (const Id element : *elements) list_element(out, element, indent + kIndent);
      out += '\n';
      out.append(indent, ' ').append(")");
    } else {
      out += '[';
      properties(out, shape_.properties(id), indent + kIndent);
      out += '\n';
      out.append(indent, ' ').append("]");
    }
  }

  // On the line at hand if there is room, else on the next.
  void list_element(std::string& out, Id id, std::size_t indent) {
    const std::size_t line = line_start(out);
    const bool first = out.back() == '(';
    if (!first && !is_bracketed(id)) {
      const std::size_t begin = out.size();
      out += ' ';
      node(out, id);
      if (out.size() - line <= kWidth) return;
      out.resize(begin);
    }
    out += '\n';
    out.append(indent, ' ');
    object(out, id, indent);
  }

  // The compact forms stay on the line at hand and give up, with false, where it gets longer than
  // `limit`; the caller then cuts what they have written.
  bool compact_properties(std::string& out, std::span<const Quad> quads, std::size_t limit) {
    for (std::size_t i = 0; i < quads.size(); ++i) {
      const bool same = i > 0 && quads[i].predicate == quads[i - 1].predicate;
      if (i > 0) out += same ? ", " : " ; ";
      if (!same) {
        predicate(out, quads[i].predicate);
        out += ' ';
      }
      if (!compact_object(out, quads[i].object, limit)) return false;
    }
    return true;
  }

  bool compact_object(std::string& out, Id id, std::size_t limit) {
    if (!is_bracketed(id)) {
      const std::size_t begin = out.size();
      node(out, id);
      if (out.find('\n', begin) != std::string::npos) return false;
    } else if (id == nil_) {
      out += "()";
    } else if (const auto elements = shape_.list(id)) {
      out += "( ";
      for (const Id element : *elements) {
        if (!compact_object(out, element, limit)) return false;
        out += ' ';
      }
      out += ')';
    } else if (shape_.properties(id).empty()) {
      out += "[]";
    } else {
      out += "[ ";
      if (!compact_properties(out, shape_.properties(id), limit)) return false;
      out += " ]";
    }
    return out.size() <= limit;
  }

  bool is_bracketed(Id id) const { return id == nil_ || shape_.is_nested(id); }

  void predicate(std::string& out, Id id) {
    if (id == type_) {
      out += 'a';
    } else {
      node(out, id);
    }
  }

  void node(std::string& out, Id id) {
    if (terms_.is_blank(id)) {
      labels_.append(out, id);
    } else {
      short_terms_.append(out, id);
    }
  }

  const graph::Terms& terms_;
  Shape shape_;
  ShortTerms short_terms_;
  const Id type_, nil_;
  BlankLabels labels_;
};

}  // namespace

std::string write_turtle(std::span<const Quad> quads, bool graphs, const graph::Terms& terms,
                         const Prefixes& prefixes) {
  return TurtleWriter(quads, terms, prefixes).write(graphs);
}

}  // namespace sinew::rdf
