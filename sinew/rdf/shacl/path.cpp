#include "sinew/rdf/shacl/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace sinew::rdf::shacl {
namespace {

// A list of nodes without duplicates; a set beside it once it is no longer short.
class NodeSet {
 public:
  bool insert(Id node) {
    constexpr std::size_t kShort = 16;
    if (nodes_.size() < kShort) {
      if (std::find(nodes_.begin(), nodes_.end(), node) != nodes_.end()) return false;
    } else {
      if (known_.empty()) known_.insert(nodes_.begin(), nodes_.end());
      if (!known_.insert(node).second) return false;
    }
    nodes_.push_back(node);
    return true;
  }
  const std::vector<Id>& nodes() const { return nodes_; }
  std::vector<Id> take() { return std::move(nodes_); }

 private:
  std::vector<Id> nodes_;
  std::unordered_set<Id> known_;
};

// Walks the path, or with `forward` false, the path the other way round.
void walk(const Path& path, Id start, bool forward, const GraphReader& data, NodeSet& into);

void walk_sequence(const Path& path, Id start, bool forward, const GraphReader& data,
                   NodeSet& into) {
  std::vector<Id> here = {start};
  const std::size_t count = path.parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Path& part = path.parts[forward ? i : count - 1 - i];
    NodeSet next;
    for (const Id node : here) walk(part, node, forward, data, next);
    here = next.take();
  }
  for (const Id node : here) into.insert(node);
}

// Breadth first, each node once, so that cycles end.
void walk_closure(const Path& path, Id start, bool forward, const GraphReader& data,
                  NodeSet& into) {
  NodeSet reached;
  if (path.kind == Path::Kind::kZeroOrMore) {
    reached.insert(start);
  } else {
    walk(path.parts[0], start, forward, data, reached);
  }
  for (std::size_t i = 0; i < reached.nodes().size(); ++i) {
    const Id from = reached.nodes()[i];
    walk(path.parts[0], from, forward, data, reached);
  }
  for (const Id node : reached.nodes()) into.insert(node);
}

void walk(const Path& path, Id start, bool forward, const GraphReader& data, NodeSet& into) {
  switch (path.kind) {
    case Path::Kind::kPredicate:
      data.match(forward ? start : Id{}, path.predicate, forward ? Id{} : start,
                 [&](const graph::Quad& quad) {
                   into.insert(forward ? quad.object : quad.subject);
                   return true;
                 });
      break;
    case Path::Kind::kInverse:
      walk(path.parts[0], start, !forward, data, into);
      break;
    case Path::Kind::kSequence:
      walk_sequence(path, start, forward, data, into);
      break;
    case Path::Kind::kAlternative:
      for (const Path& part : path.parts) walk(part, start, forward, data, into);
      break;
    case Path::Kind::kZeroOrMore:
    case Path::Kind::kOneOrMore:
      walk_closure(path, start, forward, data, into);
      break;
    case Path::Kind::kZeroOrOne:
      into.insert(start);
      walk(path.parts[0], start, forward, data, into);
      break;
  }
}

}  // namespace

std::vector<Id> nodes_at(const Path& path, Id start, const GraphReader& data) {
  NodeSet nodes;
  walk(path, start, true, data, nodes);
  return nodes.take();
}

std::string to_sparql(const Path& path, const graph::Terms& terms) {
  const auto part = [&](std::size_t i) { return to_sparql(path.parts[i], terms); };
  switch (path.kind) {
    case Path::Kind::kPredicate:
      return terms.to_string(path.predicate);
    case Path::Kind::kInverse:
      return fmt::format("(^{})", part(0));
    case Path::Kind::kZeroOrMore:
      return fmt::format("({}*)", part(0));
    case Path::Kind::kOneOrMore:
      return fmt::format("({}+)", part(0));
    case Path::Kind::kZeroOrOne:
      return fmt::format("({}?)", part(0));
    case Path::Kind::kSequence:
    case Path::Kind::kAlternative:
      break;
  }
  std::string text = "(";
  for (std::size_t i = 0; i < path.parts.size(); ++i) {
    if (i > 0) text += path.kind == Path::Kind::kSequence ? '/' : '|';
    text += part(i);
  }
  return text + ")";
}

}  // namespace sinew::rdf::shacl
