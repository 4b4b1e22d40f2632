#include "sinew/rdf/jsonld/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "sinew/rdf/isomorphism/refinement.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/compactor.h"
#include "sinew/rdf/jsonld/from_rdf.h"

namespace sinew::jsonld {
namespace {

// The order in which a person writes the entries of a node.
int rank(std::string_view key) {
  if (key == keyword::kId) return 0;
  if (key == keyword::kType) return 1;
  return key == keyword::kGraph ? 3 : 2;
}

// Orders the entries of every node, and gives blank nodes short labels in the order of the
// document.
class Arranger {
 public:
  explicit Arranger(json::Arena& arena) : arena_(arena) {}

  void arrange(json::Value& value) {
    for (json::Value& item : value.items()) arrange(item);
    if (!value.is_object() || is_value_object(value)) return;
    const auto members = value.members();
    const std::vector<json::Member> before(members.begin(), members.end());
    auto next = members.begin();
    for (int wanted = 0; wanted <= 3; ++wanted) {
      next = std::copy_if(before.begin(), before.end(), next, [&](const json::Member& member) {
        return rank(member.name()) == wanted;
      });
    }
    value.members_were_moved();
    for (json::Member& member : value.members()) {
      if (member.name() == keyword::kId) {
        rename(member.value);
      } else if (member.name() == keyword::kType) {
        for (json::Value& type : member.value.items()) rename(type);
      } else {
        arrange(member.value);
      }
    }
  }

 private:
  void rename(json::Value& id) {
    if (!id.text().starts_with("_:")) return;
    const auto [entry, is_new] = labels_.try_emplace(id.text());
    if (is_new) entry->second = arena_.copy(fmt::format("_:b{}", labels_.size() - 1));
    id = json::Value::string(entry->second);
  }

  json::Arena& arena_;
  std::unordered_map<std::string_view, std::string_view> labels_;
};

// The same order for the same graph, whatever the order and the names of blank nodes it came with.
std::vector<graph::Quad> in_sorted_order(std::span<const graph::Quad> quads,
                                         const graph::Terms& terms) {
  std::unordered_map<graph::Id, std::size_t> rank_of_blank;
  for (const graph::Id blank : rdf::ordered_blanks(quads, terms)) {
    rank_of_blank.emplace(blank, rank_of_blank.size());
  }
  const auto key = [&](graph::Id id) {
    const auto blank = rank_of_blank.find(id);
    const bool is_literal = terms.is_literal(id);
    return std::tuple(blank != rank_of_blank.end(),
                      blank == rank_of_blank.end() ? 0 : blank->second,
                      blank == rank_of_blank.end() ? terms.text(id) : std::string_view{},
                      is_literal, is_literal ? terms.text(terms.datatype(id)) : std::string_view{},
                      is_literal ? terms.language(id) : std::string_view{});
  };
  std::vector<graph::Quad> sorted(quads.begin(), quads.end());
  std::sort(sorted.begin(), sorted.end(), [&](const graph::Quad& a, const graph::Quad& b) {
    if (a.graph != b.graph) return key(a.graph) < key(b.graph);
    if (a.subject != b.subject) return key(a.subject) < key(b.subject);
    if (a.predicate != b.predicate) return key(a.predicate) < key(b.predicate);
    return a.object != b.object && key(a.object) < key(b.object);
  });
  return sorted;
}

bool is_prefix_by_itself(std::string_view iri) {
  return !iri.empty() && std::string_view(":/?#[]@").find(iri.back()) != std::string_view::npos;
}

// What the document has under "@context"; null if nothing.
json::Value context_of(const WriteOptions& options, json::Arena& arena) {
  json::Value list = json::Value::array(arena);
  for (const std::string& iri : options.contexts) list.append(arena, json::Value::string(iri));
  if (!options.prefixes.empty()) {
    json::Value prefixes = json::Value::object(arena);
    for (const auto& [name, iri] : options.prefixes) {
      json::Value definition = json::Value::string(iri);
      if (!is_prefix_by_itself(iri)) {
        definition = json::Value::object(arena);
        definition.add(arena, keyword_value(keyword::kId), json::Value::string(iri));
        definition.add(arena, keyword_value(keyword::kPrefix), json::Value::boolean(true));
      }
      prefixes.set(arena, json::Value::string(name), definition);
    }
    list.append(arena, prefixes);
  }
  if (list.items().empty()) return {};
  return list.items().size() == 1 ? list.items()[0] : list;
}

}  // namespace

Writer::Writer(const catalogue::Catalogue& catalogue, WriteOptions options)
    : options_(std::move(options)), contexts_(std::make_unique<RemoteDocuments>(catalogue)) {}

Writer::~Writer() = default;
Writer::Writer(Writer&&) noexcept = default;
Writer& Writer::operator=(Writer&&) noexcept = default;

std::string Writer::write(std::span<const graph::Quad> quads, const graph::Terms& terms) {
  std::vector<graph::Quad> sorted;
  if (options_.sorted) quads = sorted = in_sorted_order(quads, terms);
  json::Arena arena(1 << 16);
  const Options options;
  const FromRdfStyle style{.typed_native_values = true, .embed_blank_nodes = true};
  json::Value expanded = FromRdf(terms, options, arena, style).document(quads);
  Arranger(arena).arrange(expanded);

  ContextProcessor processor(arena, *contexts_, options);
  const json::Value local = context_of(options_, arena);
  const Context* context = processor.initial({});
  if (!local.is_null())
    context = processor.process(context, local, {"the contexts to write with", ""});
  const json::Value compacted =
      Compactor(processor, /*plain_values=*/true).document(context, expanded, false);

  json::Value document = json::Value::object(arena);
  if (!local.is_null()) document.add(arena, keyword_value(keyword::kContext), local);
  for (const json::Member& member : compacted.members()) {
    document.add(arena, member.key, member.value);
  }
  return json::to_pretty_text(document, options_.width);
}

std::string Writer::write_graph(const graph::View& view, graph::Id graph) {
  std::vector<graph::Quad> quads;
  view.match_in({}, {}, {}, graph, [&](const graph::Quad& quad) {
    quads.push_back(quad);
    return true;
  });
  return write(quads, view.terms());
}

std::string Writer::write_all(const graph::View& view) {
  std::vector<graph::Quad> quads;
  const auto add = [&](const graph::Quad& quad) {
    quads.push_back(quad);
    return true;
  };
  view.match_in({}, {}, {}, graph::Id{}, add);
  view.named_graphs([&](graph::Id graph) { return view.match_in({}, {}, {}, graph, add); });
  return write(quads, view.terms());
}

}  // namespace sinew::jsonld
