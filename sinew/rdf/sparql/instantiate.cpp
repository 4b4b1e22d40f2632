#include "sinew/rdf/sparql/instantiate.h"

#include <algorithm>

namespace sinew::rdf::sparql {

using graph::Id;
using syntax::Node;

Instantiator::Instantiator(const syntax::Template& source, std::span<const std::uint32_t> columns)
    : template_(source), blanks_(source.blank_count) {
  for (syntax::TemplateQuad& quad : template_.quads) {
    for (Node* node : {&quad.subject, &quad.predicate, &quad.object, &quad.graph}) {
      if (!node->is_variable()) continue;
      const auto at = std::find(columns.begin(), columns.end(), node->value);
      node->value = static_cast<std::uint32_t>(at - columns.begin());
    }
  }
}

Id Instantiator::resolve(Node node, std::span<const Id> row, graph::Terms& terms) {
  switch (node.kind) {
    case Node::Kind::kTerm:
      return node.id();
    case Node::Kind::kVariable:
      return row[node.value];
    case Node::Kind::kBlank: {
      Id& blank = blanks_[node.value];
      if (!blank) blank = terms.fresh_blank();
      return blank;
    }
  }
  return {};
}

void Instantiator::fill(std::span<const Id> row, Id default_graph, graph::Terms& terms,
                        std::vector<graph::Quad>& out) {
  std::fill(blanks_.begin(), blanks_.end(), Id{});
  for (const syntax::TemplateQuad& pattern : template_.quads) {
    // Variables first: a quad that is left out must not use up a blank node.
    graph::Quad quad;
    quad.subject = resolve(pattern.subject, row, terms);
    quad.predicate = resolve(pattern.predicate, row, terms);
    quad.object = resolve(pattern.object, row, terms);
    if (!quad.subject || !quad.predicate || !quad.object) continue;
    if (terms.is_literal(quad.subject) || !terms.is_iri(quad.predicate)) continue;
    quad.graph = default_graph;
    if (pattern.graph != Node{}) {
      quad.graph = resolve(pattern.graph, row, terms);
      if (!quad.graph || !terms.is_iri(quad.graph)) continue;
    }
    out.push_back(quad);
  }
}

}  // namespace sinew::rdf::sparql
