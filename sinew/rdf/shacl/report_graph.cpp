#include <fmt/format.h>

#include "sinew/rdf/shacl/report.h"

namespace sinew::rdf::shacl {
namespace {

class GraphWriter {
 public:
  GraphWriter(graph::Store& store, Id graph)
      : terms_(store.terms()), v_(store.terms()), graph_(graph) {}

  std::vector<graph::Quad> write(const ValidationReport& report) {
    const Id node = terms_.fresh_blank();
    add(node, v_.rdf_type, v_.validation_report);
    add(node, v_.conforms, terms_.boolean(report.conforms()));
    for (const Result& result : report.results) add(node, v_.result, write(result));
    return std::move(quads_);
  }

 private:
  Id write(const Result& result) {
    const Id node = terms_.fresh_blank();
    add(node, v_.rdf_type, v_.validation_result);
    add(node, v_.focus_node, result.focus_node);
    if (result.path) add(node, v_.result_path, write(*result.path));
    if (result.value) add(node, v_.value, result.value);
    add(node, v_.result_severity, result.severity);
    add(node, v_.source_constraint_component, result.component_iri);
    add(node, v_.source_shape, result.source_shape);
    if (result.source_constraint) add(node, v_.source_constraint, result.source_constraint);
    for (const Message& message : result.messages) {
      add(node, v_.result_message, terms_.literal(message.text, {}, message.language));
    }
    if (result.messages.empty()) {
      const std::string text = fmt::format("{}; {}", result.what, result.remedy);
      add(node, v_.result_message, terms_.literal(text, {}, "en"));
    }
    for (const Result& detail : result.details) add(node, v_.detail, write(detail));
    return node;
  }

  // The path's own structure, anew: the report does not share blank nodes with the shapes.
  Id write(const Path& path) {
    switch (path.kind) {
      case Path::Kind::kPredicate:
        return path.predicate;
      case Path::Kind::kSequence:
        return list(path.parts);
      case Path::Kind::kAlternative:
        return wrap(v_.alternative_path, list(path.parts));
      case Path::Kind::kInverse:
        return wrap(v_.inverse_path, write(path.parts[0]));
      case Path::Kind::kZeroOrMore:
        return wrap(v_.zero_or_more_path, write(path.parts[0]));
      case Path::Kind::kOneOrMore:
        return wrap(v_.one_or_more_path, write(path.parts[0]));
      case Path::Kind::kZeroOrOne:
        return wrap(v_.zero_or_one_path, write(path.parts[0]));
    }
    return {};
  }
  Id wrap(Id property, Id inner) {
    const Id node = terms_.fresh_blank();
    add(node, property, inner);
    return node;
  }
  Id list(const std::vector<Path>& parts) {
    Id next = v_.rdf_nil;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      const Id cell = terms_.fresh_blank();
      add(cell, v_.rdf_first, write(*part));
      add(cell, v_.rdf_rest, next);
      next = cell;
    }
    return next;
  }
  void add(Id subject, Id predicate, Id object) {
    quads_.push_back({subject, predicate, object, graph_});
  }

  graph::Terms& terms_;
  Vocabulary v_;
  Id graph_;
  std::vector<graph::Quad> quads_;
};

}  // namespace

std::vector<graph::Quad> to_graph(const ValidationReport& report, graph::Store& store, Id graph) {
  return GraphWriter(store, graph).write(report);
}

}  // namespace sinew::rdf::shacl
