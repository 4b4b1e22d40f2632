// The graph into the syntax tree.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sinew/blocks/graph.h"
#include "sinew/blocks/graph_names.h"
#include "sinew/blocks/schema.h"
#include "sinew/graph/standard_iris.h"

namespace sinew::blocks {
namespace {

using graph::Id;

class GraphReader {
 public:
  GraphReader(const graph::View& view, const std::string& name)
      : view_(view), terms_(view.terms()), name_(name) {
    type_ = terms_.find_iri(graph::kRdfType);
    first_ = terms_.find_iri(graph::kRdfFirst);
    rest_ = terms_.find_iri(graph::kRdfRest);
    nil_ = terms_.find_iri(graph::kRdfNil);
  }

  Node run(Id file) {
    if (!file) file = only_file();
    base_ = terms_.text(file);
    collect_names(file, "", 0);
    Node node = make("file");
    known_ = {"entries"};
    read_comments(file, node);
    check_known(file);
    read_children(file, node, "", 0);
    return node;
  }

 private:
  [[noreturn]] void fail(Id about, std::string what, std::string remedy) const {
    throw Error(Problem{{name_, 0, 0},
                        about ? terms_.to_string(about) : "",
                        std::move(what),
                        std::move(remedy),
                        Severity::kError,
                        {}});
  }
  Id term(std::string_view name) const {
    return terms_.find_iri(std::string(kDataNamespace) + std::string(name));
  }
  Id object(Id subject, std::string_view predicate) const {
    const Id id = term(predicate);
    return id ? view_.object(subject, id) : Id{};
  }
  Node make(std::string_view kind) const {
    Node node;
    node.kind = kind;
    node.place = {name_, 0, 0};
    return node;
  }

  Id only_file() const {
    Id found;
    const Id type = term("File");
    if (type && type_) {
      view_.match({}, type_, type, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        if (found) fail(quad.subject, "there is more than one data:File", "say which one is meant");
        found = quad.subject;
        return true;
      });
    }
    if (!found) fail({}, "there is no data:File", "describe one whose data:entries are the items");
    return found;
  }

  std::vector<Id> list(Id head, Id about) const {
    std::vector<Id> items;
    while (head && head != nil_) {
      const Id item = first_ ? view_.object(head, first_) : Id{};
      const Id next = rest_ ? view_.object(head, rest_) : Id{};
      if (!item || !next || items.size() > 1'000'000)
        fail(about, "a list is broken", "write it as @list");
      items.push_back(item);
      head = next;
    }
    return items;
  }

  const KindRow& kind_of(Id id) const {
    const KindRow* found = nullptr;
    if (type_) {
      view_.match(id, type_, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        const std::string_view iri = terms_.text(quad.object);
        if (iri.starts_with(kDataNamespace)) found = find_type(iri.substr(kDataNamespace.size()));
        return found == nullptr;
      });
    }
    if (!found)
      fail(id, "the node has no type that the language knows",
           "give it one, such as Prototype or Alias");
    return *found;
  }

  std::string literal(Id id, Id about) const {
    if (!terms_.is_literal(id))
      fail(about, fmt::format("{} is no text", terms_.to_string(id)), "write a string");
    return std::string(terms_.text(id));
  }

  // ---- names ----

  void collect_names(Id parent, const std::string& scope, std::size_t depth) {
    if (depth > kMaximumNesting) fail(parent, "modules are nested too deep", "");
    for (const Id item : list(object(parent, "entries"), parent)) {
      const KindRow& row = kind_of(item);
      if (row.kind == "module") {
        const Id name = object(item, "name");
        collect_names(item, join_scope(scope, name ? literal(name, item) : ""), depth + 1);
      } else if (row.named) {
        names_.add(std::string(row.kind), std::string(full_name(item)));
      }
    }
  }

  // "module.name" of an item of this file or of the prelude.
  std::string full_name(Id item) const {
    const std::string_view iri = terms_.text(item);
    if (iri.starts_with(base_)) return std::string(iri.substr(base_.size()));
    if (iri.starts_with(kPreludeBase)) return std::string(iri.substr(kPreludeBase.size()));
    fail(item, "the item lies neither in this file nor in the prelude",
         fmt::format("items of this file begin with {}", base_));
  }

  std::string reference(std::string_view kind, Id item, const std::string& scope) const {
    if (!terms_.is_iri(item)) fail(item, "a reference to an item has to be an IRI", "");
    return names_.shorten(std::string(kind), full_name(item), scope);
  }

  // ---- nodes ----

  void read_comments(Id id, Node& node) {
    const auto read = [&](const char* predicate, std::vector<std::string>& lines) {
      for (const Id line : list(object(id, predicate), id)) lines.push_back(literal(line, id));
      known_.insert(predicate);
    };
    read("comment", node.comments);
    read("end-comment", node.end_comments);
    known_.insert("remark");
    if (const Id remark = object(id, "remark")) node.remark = literal(remark, id);
  }

  // Nothing is dropped: every property has to be one that was read.
  void check_known(Id id) const {
    view_.match(id, {}, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      if (quad.predicate == type_) return true;
      const std::string_view iri = terms_.text(quad.predicate);
      if (!iri.starts_with(kDataNamespace)) return true;  // what others say about the node
      if (!known_.count(std::string(iri.substr(kDataNamespace.size())))) {
        fail(id, fmt::format("the property {} does not belong to this kind of node", iri),
             "leave it out");
      }
      return true;
    });
  }

  void read_texts(Id id, const KindRow& row, Node& node, const std::string& scope) {
    for (const TextRow& text : row.texts) {
      known_.insert(std::string(text.predicate));
      const Id value = object(id, text.predicate);
      if (!value) continue;
      if (text.style == TextStyle::kList) {
        for (const Id item : list(value, id))
          node.add(std::string(text.text), literal(item, id), node.place);
      } else if (text.style == TextStyle::kReference) {
        node.add(std::string(text.text), reference(text.refers_to, value, scope), node.place);
      } else {
        node.add(std::string(text.text), literal(value, id), node.place);
      }
    }
  }

  Node read(Id id, const std::string& scope, std::size_t depth) {
    if (depth > kMaximumNesting) fail(id, "the description is nested too deep", "");
    const KindRow& row = kind_of(id);
    Node node = make(row.kind);
    known_.clear();
    read_texts(id, row, node, scope);
    if (row.named && !node.has("name") && terms_.is_iri(id)) {
      // The name may be left to the IRI.
      const std::string full = full_name(id);
      node.texts.insert(node.texts.begin(), {"name", full.substr(full.rfind('.') + 1), node.place});
    }
    if (row.kind == "argument" || row.kind == "member") {
      known_.insert("prototype");
      if (const Id prototype = object(id, "prototype")) {
        node.add(row.kind == "argument" ? "prototype" : "value",
                 reference("dproto", prototype, scope), node.place);
      }
    }
    read_comments(id, node);
    if (row.kind == "dproto") {
      read_fields(id, node, scope, depth);
      return node;
    }
    known_.insert("entries");
    check_known(id);
    read_children(id, node, row.kind == "module" ? join_scope(scope, node.text("name")) : scope,
                  depth);
    return node;
  }

  void read_children(Id id, Node& node, const std::string& scope, std::size_t depth) {
    for (const Id child : list(object(id, "entries"), id))
      node.children.push_back(read(child, scope, depth + 1));
  }

  void read_fields(Id id, Node& node, const std::string& scope, std::size_t depth) {
    known_.insert("notes");
    for (const FieldRow& row : field_rows()) {
      known_.insert(std::string(row.predicate));
      if (!row.form_predicate.empty()) known_.insert(std::string(row.form_predicate));
    }
    check_known(id);
    for (const FieldRow& row : field_rows()) {
      Node field = make(row.kind);
      if (const Id form = row.form_predicate.empty() ? Id{} : object(id, row.form_predicate)) {
        field.add("form", literal(form, id), field.place);
      } else if (const Id value = object(id, row.predicate)) {
        read_field(row, value, field, scope, depth);
      } else {
        continue;
      }
      node.children.push_back(std::move(field));
    }
    for (const Id note : list(object(id, "notes"), id)) {
      const Id at = object(note, "at");
      const std::string kind = at ? literal(at, note) : "";
      const auto field = std::find_if(node.children.begin(), node.children.end(),
                                      [&](const Node& child) { return child.kind == kind; });
      if (field == node.children.end())
        fail(note, fmt::format("a note is at '{}', which is not there", kind), "");
      read_comments(note, *field);
    }
  }

  void read_field(const FieldRow& row, Id value, Node& field, const std::string& scope,
                  std::size_t depth) {
    if (!row.entry_kind.empty()) {
      for (const Id entry : list(value, value))
        field.children.push_back(read(entry, scope, depth + 1));
    } else if (row.style == TextStyle::kLiteral) {
      field.add("value", literal(value, value), field.place);
    } else if (terms_.is_iri(value)) {
      field.add("value", reference(row.refers_to, value, scope), field.place);
    } else {
      known_.clear();
      known_.insert("entries");
      read_texts(value, *find_kind(row.written_out), field, scope);
      check_known(value);
      read_children(value, field, scope, depth);
    }
  }

  const graph::View& view_;
  const graph::Terms& terms_;
  const std::string& name_;
  std::string base_;
  ItemNames names_;
  std::set<std::string> known_;  // predicates that the node at hand may have
  Id type_, first_, rest_, nil_;
};

}  // namespace

Node from_graph(const graph::View& view, graph::Id file, const std::string& name) {
  return GraphReader(view, name).run(file);
}

}  // namespace sinew::blocks
