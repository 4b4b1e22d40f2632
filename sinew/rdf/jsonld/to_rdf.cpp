#include "sinew/rdf/jsonld/to_rdf.h"

#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/jsonld/expanded.h"
#include "sinew/rdf/jsonld/iri_expansion.h"
#include "sinew/rdf/jsonld/rdf_names.h"

namespace sinew::jsonld {

using graph::Id;

namespace {

constexpr std::string_view kPropertyRole = "property";

std::optional<std::string> fault(std::string_view text) {
  const std::size_t fragment = text.find('#');
  if (fragment != std::string_view::npos &&
      text.find('#', fragment + 1) != std::string_view::npos) {
    return "it has two '#'";
  }
  return rdf::fault_of_iri(text);
}

}  // namespace

ToRdf::ToRdf(const ToRdfContext& context, const QuadSink& sink)
    : context_(context),
      sink_(sink),
      terms_(context.terms),
      rdf_type_(terms_.iri(graph::kRdfType)),
      rdf_first_(terms_.iri(graph::kRdfFirst)),
      rdf_rest_(terms_.iri(graph::kRdfRest)),
      rdf_nil_(terms_.iri(graph::kRdfNil)) {}

void ToRdf::document(const json::Value& expanded) {
  for (const json::Value& item : expanded.items()) node(item, {});
}

void ToRdf::emit(Id subject, Id predicate, Id object, Id graph, json::Position position) {
  if (!subject || !predicate || !object) return;
  sink_({subject, predicate, object, graph});
  if (context_.places != nullptr && position.line != 0) {
    context_.places->note(subject, predicate, context_.file, position.line, position.column);
  }
}

Id ToRdf::blank(std::string_view label) {
  const auto [entry, is_new] = blanks_.try_emplace(label);
  if (is_new) entry->second = terms_.fresh_blank();
  return entry->second;
}

Id ToRdf::iri(std::string_view text, json::Position position, std::string_view role, Id subject) {
  const std::optional<std::string> wrong = fault(text);
  if (!wrong) return terms_.iri(text);
  // Expansion has reported identifiers and types that are relative.
  const bool known = !rdf::is_absolute_iri(text) && role != kPropertyRole;
  if (context_.check != nullptr && !known) {
    context_.check->dropped_quad(
        place_in(context_.source, position),
        subject ? std::string(terms_.text(subject)) : std::string(text),
        fmt::format("the {} <{}> is no well-formed IRI: {}", role, text, *wrong),
        "an absolute IRI, or a term or prefix that a context defines");
  }
  return {};
}

Id ToRdf::predicate(std::string_view text, json::Position position, Id subject) {
  if (!is_blank_node(text)) return iri(text, position, kPropertyRole, subject);
  if (context_.options.produce_generalized_rdf) return blank(text);
  if (context_.check != nullptr) {
    context_.check->dropped_quad(
        place_in(context_.source, position), std::string(terms_.text(subject)),
        fmt::format("the property {} is a blank node", text), "a property with an IRI");
  }
  return {};
}

Id ToRdf::node_id(const json::Value& node) {
  const json::Value* id = node.find(keyword::kId);
  if (id == nullptr) return terms_.fresh_blank();
  if (!id->is_string()) return {};
  if (is_blank_node(id->text())) return blank(id->text());
  return iri(id->text(), id->position(), "identifier", {});
}

void ToRdf::check_index(const json::Value& node, Id subject) {
  const json::Value* index = node.find(keyword::kIndex);
  if (index == nullptr || !subject) return;
  const auto [known, is_new] = indexes_.try_emplace(subject.value, *index);
  if (is_new || json::equal(known->second, *index)) return;
  fail(code::kConflictingIndexes, place_in(context_.source, index->position()),
       std::string(terms_.text(subject)),
       fmt::format("the node has the \"@index\" {} and {}", describe(known->second),
                   describe(*index)),
       "one \"@index\" for one node");
}

Id ToRdf::node(const json::Value& node, Id graph) {
  const Id subject = node_id(node);
  if (context_.places != nullptr && subject && node.members().size() > 1) {
    context_.places->note(subject, {}, context_.file, node.position().line, node.position().column);
  }
  check_index(node, subject);
  node_entries(node, subject, graph);
  return subject;
}

void ToRdf::node_entries(const json::Value& node, Id subject, Id graph) {
  for (const json::Member& member : node.members()) {
    const std::string_view name = member.name();
    if (name == keyword::kId || name == keyword::kIndex) continue;
    if (name == keyword::kType) {
      types(member.value, subject, graph);
    } else if (name == keyword::kGraph) {
      // A graph whose name is no IRI is left out, with what it holds.
      if (!subject) continue;
      for (const json::Value& item : member.value.items()) this->node(item, subject);
    } else if (name == keyword::kIncluded) {
      for (const json::Value& item : member.value.items()) this->node(item, graph);
    } else if (name == keyword::kReverse) {
      reverse(member.value, subject, graph);
    } else {
      property(name, member.key.position(), member.value, subject, graph);
    }
  }
}

void ToRdf::types(const json::Value& types, Id subject, Id graph) {
  for (const json::Value& type : types.items()) {
    const Id object = is_blank_node(type.text())
                          ? blank(type.text())
                          : iri(type.text(), type.position(), "type", subject);
    emit(subject, rdf_type_, object, graph, type.position());
  }
}

void ToRdf::property(std::string_view name, json::Position position, const json::Value& values,
                     Id subject, Id graph) {
  const Id property = predicate(name, position, subject);
  for (const json::Value& value : values.items()) {
    emit(subject, property, object(value, graph), graph, position);
  }
}

void ToRdf::reverse(const json::Value& map, Id subject, Id graph) {
  for (const json::Member& member : map.members()) {
    const Id property = predicate(member.name(), member.key.position(), subject);
    for (const json::Value& value : member.value.items()) {
      emit(node(value, graph), property, subject, graph, member.key.position());
    }
  }
}

Id ToRdf::object(const json::Value& value, Id graph) {
  if (const json::Value* items = value.find(keyword::kList)) return list(*items, graph);
  if (is_value_object(value)) {
    current_graph_ = graph;
    return literal(value);
  }
  return node(value, graph);
}

Id ToRdf::list(const json::Value& items, Id graph) {
  Id first, last;
  for (const json::Value& item : items.items()) {
    const Id cell = terms_.fresh_blank();
    if (last) {
      emit(last, rdf_rest_, cell, graph, {});
    } else {
      first = cell;
    }
    emit(cell, rdf_first_, object(item, graph), graph, item.position());
    last = cell;
  }
  if (!last) return rdf_nil_;
  emit(last, rdf_rest_, rdf_nil_, graph, {});
  return first;
}

}  // namespace sinew::jsonld
