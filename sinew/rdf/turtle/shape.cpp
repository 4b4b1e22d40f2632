#include "sinew/rdf/turtle/shape.h"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/isomorphism/refinement.h"
#include "sinew/rdf/turtle/writer.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using graph::Quad;

// Position of every term in the order of the text to be: IRIs, blank nodes, literals.
std::unordered_map<Id, std::uint32_t> ranks(std::span<const Quad> quads,
                                            const graph::Terms& terms) {
  std::unordered_map<Id, std::uint32_t> rank;
  std::vector<Id> ids;
  for (const Quad& quad : quads) {
    for (const Id id : {quad.subject, quad.predicate, quad.object, quad.graph}) {
      if (id && !terms.is_blank(id) && rank.try_emplace(id, 0).second) ids.push_back(id);
    }
  }
  const auto text_key = [&](Id id) {
    const bool literal = terms.is_literal(id);
    return std::tuple(terms.text(id), literal ? terms.text(terms.datatype(id)) : "",
                      literal ? terms.language(id) : "");
  };
  const auto literals = std::ranges::partition(ids, [&](Id id) { return terms.is_iri(id); });
  const auto literal_count = static_cast<std::size_t>(literals.size());
  std::sort(ids.begin(), literals.begin(),
            [&](Id a, Id b) { return terms.text(a) < terms.text(b); });
  std::ranges::sort(literals, {}, text_key);
  std::uint32_t next = 1;  // 0 is the unnamed graph
  const auto number = [&](std::span<const Id> some) {
    for (const Id id : some) rank[id] = next++;
  };
  const std::span<const Id> all(ids);
  number(all.first(ids.size() - literal_count));
  number(ordered_blanks(quads, terms));
  number(all.last(literal_count));
  rank[{}] = 0;
  return rank;
}

}  // namespace

Shape::Shape(std::span<const Quad> quads, const graph::Terms& terms) {
  const auto rdf = [&](const char* name) {
    return terms.find_iri(std::string(graph::kRdf) + name);
  };
  type_ = rdf("type");
  first_ = rdf("first");
  rest_ = rdf("rest");
  nil_ = rdf("nil");
  sort_quads(quads, terms);
  describe();
  find_uses(terms);
  limit_nesting();
}

void Shape::sort_quads(std::span<const Quad> quads, const graph::Terms& terms) {
  const auto rank = ranks(quads, terms);
  struct Keyed {
    std::array<std::uint32_t, 4> key;
    Quad quad;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(quads.size());
  for (const Quad& quad : quads) {
    const std::uint32_t predicate = quad.predicate == type_ ? 0 : rank.at(quad.predicate);
    keyed.push_back(
        {{rank.at(quad.graph), rank.at(quad.subject), predicate, rank.at(quad.object)}, quad});
  }
  std::ranges::sort(keyed, {}, &Keyed::key);
  quads_.reserve(keyed.size());
  for (const Keyed& entry : keyed) {
    if (quads_.empty() || quads_.back() != entry.quad) quads_.push_back(entry.quad);
  }
}

void Shape::describe() {
  for (std::size_t begin = 0; begin < quads_.size();) {
    const Quad& head = quads_[begin];
    std::size_t end = begin;
    while (end < quads_.size() && quads_[end].subject == head.subject &&
           quads_[end].graph == head.graph) {
      ++end;
    }
    descriptions_.push_back(
        {head.subject, head.graph, std::span<const Quad>(quads_).subspan(begin, end - begin)});
    begin = end;
  }
}

void Shape::find_uses(const graph::Terms& terms) {
  for (std::uint32_t i = 0; i < descriptions_.size(); ++i) {
    if (!terms.is_blank(descriptions_[i].subject)) continue;
    std::uint32_t& own = uses_[descriptions_[i].subject].description;
    own = own == kNone ? i : kSeveral;
  }
  for (const Quad& quad : quads_) {
    if (terms.is_blank(quad.predicate)) uses_[quad.predicate].needs_label = true;
    if (quad.graph && terms.is_blank(quad.graph)) uses_[quad.graph].needs_label = true;
    if (terms.is_blank(quad.object)) {
      Use& use = uses_[quad.object];
      ++use.references;
      use.graph = quad.graph;
    }
  }
}

bool Shape::is_nested(Id node) const {
  const auto found = uses_.find(node);
  if (found == uses_.end()) return false;
  const Use& use = found->second;
  if (use.needs_label || use.references != 1 || use.description == kSeveral) return false;
  return use.description == kNone || descriptions_[use.description].graph == use.graph;
}

bool Shape::has_label(Id node) const {
  const auto found = uses_.find(node);
  if (found == uses_.end() || is_nested(node)) return false;
  const Use& use = found->second;
  return use.needs_label || use.references > 0 || use.description == kSeveral;
}

std::span<const Quad> Shape::properties(Id node) const {
  const Use& use = uses_.at(node);
  if (use.description == kNone) return {};
  return descriptions_[use.description].quads;
}

// A chain of nested cells cannot come back to itself: its head is used once, from outside.
std::optional<std::vector<Id>> Shape::list(Id head) const {
  std::vector<Id> cells, elements;
  for (Id cell = head; cell != nil_;) {
    const bool may_be_cell = first_ && rest_ && is_nested(cell) && !uses_.at(cell).no_list;
    const auto quads = may_be_cell ? properties(cell) : std::span<const Quad>{};
    // The properties are sorted, and rdf:first comes before rdf:rest.
    if (quads.size() != 2 || quads[0].predicate != first_ || quads[1].predicate != rest_) {
      for (const Id walked : cells) uses_.at(walked).no_list = true;
      return std::nullopt;
    }
    cells.push_back(cell);
    elements.push_back(quads[0].object);
    cell = quads[1].object;
  }
  return elements;
}

void Shape::limit_nesting() {
  std::vector<bool> visited(descriptions_.size(), false);
  // The nodes that are given a label on the way begin descriptions of their own, hence the loop.
  bool again = true;
  while (again) {
    again = false;
    for (std::uint32_t i = 0; i < descriptions_.size(); ++i) {
      if (visited[i] || is_nested(descriptions_[i].subject)) continue;
      visit(i, 0, visited);
      again = true;
    }
  }
  // What is left refers to itself in cycles; a label on one node opens each.
  for (std::uint32_t i = 0; i < descriptions_.size(); ++i) {
    if (visited[i]) continue;
    if (is_nested(descriptions_[i].subject)) uses_[descriptions_[i].subject].needs_label = true;
    visit(i, 0, visited);
  }
}

void Shape::visit(std::uint32_t description, std::size_t depth, std::vector<bool>& visited) {
  visited[description] = true;
  const auto enter = [&](Id node) {
    if (!is_nested(node)) return;
    Use& use = uses_.at(node);
    if (use.description == kNone || visited[use.description]) return;
    if (depth + 1 > kMaxWrittenNesting) {
      use.needs_label = true;
    } else {
      visit(use.description, depth + 1, visited);
    }
  };
  for (const Quad& quad : descriptions_[description].quads) {
    const auto elements = list(quad.object);
    if (!elements || quad.object == nil_) {
      enter(quad.object);
      continue;
    }
    if (depth + 1 > kMaxWrittenNesting) {
      uses_.at(quad.object).needs_label = true;
      continue;
    }
    for (Id cell = quad.object; cell != nil_; cell = properties(cell)[1].object) {
      visited[uses_.at(cell).description] = true;
    }
    ++depth;
    for (const Id element : *elements) enter(element);
    --depth;
  }
}

}  // namespace sinew::rdf
