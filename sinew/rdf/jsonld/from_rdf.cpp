#include "sinew/rdf/jsonld/from_rdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_set>
#include <utility>

#include "sinew/graph/standard_iris.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/jsonld/errors.h"
#include "sinew/rdf/jsonld/rdf_names.h"

namespace sinew::jsonld {

using graph::Id;

namespace {

// Nothing that comes later, recursive or not, has to expect more.
void check_depth(const json::Value& document) {
  std::vector<std::pair<json::Value, std::size_t>> open = {{document, 0}};
  while (!open.empty()) {
    const auto [value, depth] = open.back();
    open.pop_back();
    if (depth > json::kMaxDepth) {
      fail(code::kLoadingDocumentFailed, {}, "",
           fmt::format("lists are nested more than {} deep", json::kMaxDepth),
           "a graph with flatter lists");
    }
    for (const json::Value& item : value.items()) {
      if (item.is_array() || item.is_object()) open.emplace_back(item, depth + 1);
    }
    for (const json::Member& member : value.members()) {
      if (member.value.is_array() || member.value.is_object()) {
        open.emplace_back(member.value, depth + 1);
      }
    }
  }
}

}  // namespace

FromRdf::FromRdf(const graph::Terms& terms, const Options& options, json::Arena& arena,
                 FromRdfStyle style)
    : terms_(terms),
      options_(options),
      arena_(arena),
      style_(style),
      rdf_type_(terms.find_iri(graph::kRdfType)),
      rdf_rest_(terms.find_iri(graph::kRdfRest)),
      rdf_nil_(terms.find_iri(graph::kRdfNil)),
      rdf_direction_(terms.find_iri(rdf_name::kDirection)) {}

json::Value FromRdf::document(std::span<const graph::Quad> quads) {
  graph({});
  for (const graph::Quad& quad : quads) add(quad);
  for (Graph& graph : graphs_) {
    make_compound_literals(graph);
    make_lists(graph);
    if (style_.embed_blank_nodes) embed(graph);
  }
  json::Value result = document_of_graphs();
  check_depth(result);
  return result;
}

FromRdf::Graph& FromRdf::graph(Id name) {
  const auto [entry, is_new] = graph_index_.try_emplace(name, graphs_.size());
  if (is_new) {
    graphs_.emplace_back().name = name;
    if (name) node(graphs_.front(), name);
  }
  return graphs_[entry->second];
}

json::Value FromRdf::node(Graph& graph, Id id) {
  const auto [entry, is_new] = graph.nodes.try_emplace(id);
  if (is_new) {
    graph.order.push_back(id);
    entry->second = json::Value::object(arena_);
    entry->second.add(arena_, keyword_value(keyword::kId), identifier(id));
  }
  return entry->second;
}

void FromRdf::add(const graph::Quad& quad) {
  Graph& in = graph(quad.graph);
  json::Value subject = node(in, quad.subject);
  const bool is_node = !terms_.is_literal(quad.object);
  if (quad.predicate == rdf_direction_ &&
      options_.rdf_direction == RdfDirection::kCompoundLiteral) {
    in.compound_literals.push_back(quad.subject);
  }
  if (is_node && quad.predicate == rdf_type_ && !options_.use_rdf_type) {
    add_value(subject, keyword_value(keyword::kType), identifier(quad.object), arena_);
    // A type is written by its label, so the node cannot lose it.
    if (terms_.is_blank(quad.object)) usages_.insert_or_assign(quad.object, OnlyUsage());
    return;
  }
  const json::Value value = object(quad.object);
  add_value(subject, identifier(quad.predicate), value, arena_);
  const Usage usage{quad.graph, quad.subject, quad.predicate, value};
  if (quad.object == rdf_nil_) {
    in.ends.push_back(usage);
  } else if (terms_.is_blank(quad.object)) {
    const auto [entry, is_first] = usages_.try_emplace(quad.object, usage);
    if (!is_first) entry->second.reset();
  }
}

bool FromRdf::is_list_cell(const json::Value& node) const {
  const json::Value* first = node.find(graph::kRdfFirst);
  const json::Value* rest = node.find(graph::kRdfRest);
  if (first == nullptr || rest == nullptr) return false;
  if (first->items().size() != 1 || rest->items().size() != 1) return false;
  std::size_t expected = 3;  // with @id
  if (const json::Value* type = node.find(keyword::kType)) {
    if (type->items().size() != 1 || !type->items()[0].is_string(rdf_name::kList)) return false;
    ++expected;
  }
  return node.members().size() == expected;
}

// A usage in another graph does not count: what is moved there would change its graph. What names a
// graph keeps its label.
const FromRdf::Usage* FromRdf::only_usage(const Graph& graph, Id node) const {
  if (graph_index_.contains(node)) return nullptr;
  const auto found = usages_.find(node);
  if (found == usages_.end() || !found->second || found->second->graph != graph.name)
    return nullptr;
  return &*found->second;
}

Id FromRdf::home(Graph& graph, Id cell) {
  Id result = cell;
  for (auto next = graph.holder.find(result); next != graph.holder.end();
       next = graph.holder.find(result)) {
    result = next->second;
  }
  // Later look-ups take the short way.
  for (auto next = graph.holder.find(cell); next != graph.holder.end();
       next = graph.holder.find(cell)) {
    cell = std::exchange(next->second, result);
  }
  return result;
}

// From the end of each list back to its head. A list that contains itself stays as it is.
void FromRdf::make_lists(Graph& graph) {
  for (const Usage& end : graph.ends) {
    Usage usage = end;
    std::vector<json::Value> items;
    std::vector<Id> cells;
    while (usage.property == rdf_rest_ && terms_.is_blank(usage.subject)) {
      const Usage* only = only_usage(graph, usage.subject);
      const auto cell = graph.nodes.find(usage.subject);
      if (only == nullptr || cell == graph.nodes.end() || !is_list_cell(cell->second)) break;
      items.push_back(cell->second.find(graph::kRdfFirst)->items()[0]);
      cells.push_back(usage.subject);
      usage = *only;
    }
    const Id holder = home(graph, usage.subject);
    if (std::find(cells.begin(), cells.end(), holder) != cells.end()) continue;
    json::Value list = json::Value::array(arena_);
    std::for_each(items.rbegin(), items.rend(),
                  [&](const json::Value& item) { list.append(arena_, item); });
    usage.value.erase(keyword::kId);
    usage.value.add(arena_, keyword_value(keyword::kList), list);
    for (const Id cell : cells) {
      graph.nodes.erase(cell);
      graph.holder.emplace(cell, usage.subject);
    }
  }
}

// A node's members become those of the only reference to it.
void FromRdf::embed_into(Graph& graph, Id id, const Usage& usage) {
  json::Value reference = usage.value;
  reference.erase(keyword::kId);
  const auto node = graph.nodes.find(id);
  for (const json::Member& member : node->second.members()) {
    if (member.name() != keyword::kId) reference.add(arena_, member.key, member.value);
  }
  graph.nodes.erase(node);
}

// From the nodes that stand on their own inwards. Nodes that are only reached from each other have
// one of them that stands on its own all the same.
void FromRdf::embed(Graph& graph) {
  std::unordered_map<Id, std::vector<Id>> inner;
  std::vector<Id> roots, circles;
  for (const Id id : graph.order) {
    if (!graph.nodes.contains(id)) continue;
    const Usage* only = terms_.is_blank(id) ? only_usage(graph, id) : nullptr;
    if (only == nullptr) {
      roots.push_back(id);
    } else {
      inner[home(graph, only->subject)].push_back(id);
      circles.push_back(id);
    }
  }
  std::unordered_set<Id> seen;
  std::vector<std::pair<Id, std::size_t>> open;
  const auto visit_from = [&](Id root) {
    if (!seen.insert(root).second) return;
    open.emplace_back(root, 0);
    while (!open.empty()) {
      const auto [outer, depth] = open.back();
      open.pop_back();
      for (const Id id : inner[outer]) {
        if (!seen.insert(id).second) continue;
        const bool too_deep = depth + 1 > kMaxEmbedding;
        if (!too_deep) embed_into(graph, id, *only_usage(graph, id));
        open.emplace_back(id, too_deep ? 0 : depth + 1);
      }
    }
  };
  for (const Id id : roots) visit_from(id);
  for (const Id id : circles) visit_from(id);
}

json::Value FromRdf::nodes_of(const Graph& graph) {
  std::vector<Id> order;
  std::copy_if(graph.order.begin(), graph.order.end(), std::back_inserter(order),
               [&](Id id) { return graph.nodes.contains(id); });
  if (options_.ordered) {
    std::sort(order.begin(), order.end(), [&](Id a, Id b) {
      return graph.nodes.at(a).find(keyword::kId)->text() <
             graph.nodes.at(b).find(keyword::kId)->text();
    });
  }
  json::Value result = json::Value::array(arena_);
  for (const Id id : order) {
    const json::Value& node = graph.nodes.at(id);
    if (node.members().size() > 1) result.append(arena_, node);
  }
  return result;
}

json::Value FromRdf::document_of_graphs() {
  Graph& unnamed = graphs_.front();
  for (const Graph& graph : graphs_) {
    if (!graph.name) continue;
    // The name of a graph may have been taken for a cell of a list.
    json::Value name = node(unnamed, graph.name);
    name.add(arena_, keyword_value(keyword::kGraph), nodes_of(graph));
  }
  return nodes_of(unnamed);
}

}  // namespace sinew::jsonld
