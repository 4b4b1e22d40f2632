// The syntax tree into the graph.
#include <fmt/format.h>

#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/graph.h"
#include "sinew/blocks/graph_names.h"
#include "sinew/blocks/schema.h"
#include "sinew/graph/standard_iris.h"

namespace sinew::blocks {
namespace {

using graph::Id;

class GraphWriter {
 public:
  GraphWriter(const std::string& base, graph::Store& store)
      : base_(base), store_(store), terms_(store.terms()) {
    type_ = terms_.iri(graph::kRdfType);
    first_ = terms_.iri(graph::kRdfFirst);
    rest_ = terms_.iri(graph::kRdfRest);
    nil_ = terms_.iri(graph::kRdfNil);
    prelude_names_.collect(prelude(), "");
  }

  Id run(const Node& file) {
    names_.collect(file, "");
    const Id id = terms_.iri(base_);
    add(id, type_, term("File"));
    write_comments(file, id);
    write_children(file, id, "");
    return id;
  }

 private:
  Id term(std::string_view name) {
    return terms_.iri(std::string(kDataNamespace) + std::string(name));
  }
  void add(Id subject, Id predicate, Id object) { store_.add({subject, predicate, object, {}}); }

  // ---- texts and references ----

  Id reference(std::string_view kind_view, const std::string& name, const std::string& scope) {
    const std::string kind(kind_view);
    const std::string full = names_.resolve(kind, name, scope);
    if (!full.empty()) return terms_.iri(base_ + full);
    std::string plain = name;
    if (plain.starts_with("prelude.")) plain = plain.substr(8);
    if (prelude_names_.has(kind, plain)) return terms_.iri(std::string(kPreludeBase) + plain);
    return terms_.iri(base_ + name);  // of an imported file, or a name that is not there
  }

  void write_texts(const Node& node, const KindRow& row, Id id, const std::string& scope) {
    for (const TextRow& text : row.texts) {
      const auto values = node.all(text.text);
      if (values.empty()) continue;
      if (text.style == TextStyle::kList) {
        std::vector<Id> items;
        for (const std::string& value : values) items.push_back(terms_.literal(value));
        add(id, term(text.predicate), list(items));
      } else if (text.style == TextStyle::kReference) {
        add(id, term(text.predicate), reference(text.refers_to, values.front(), scope));
      } else {
        add(id, term(text.predicate), terms_.literal(values.front()));
      }
    }
  }

  Id list(const std::vector<Id>& items) {
    Id rest = nil_;
    for (auto item = items.rbegin(); item != items.rend(); ++item) {
      const Id cell = terms_.fresh_blank();
      add(cell, first_, *item);
      add(cell, rest_, rest);
      rest = cell;
    }
    return rest;
  }

  void write_comments(const Node& node, Id id) {
    const auto write = [&](const char* predicate, const std::vector<std::string>& lines) {
      std::vector<Id> items;
      for (const std::string& line : lines) items.push_back(terms_.literal(line));
      if (!items.empty()) add(id, term(predicate), list(items));
    };
    write("comment", node.comments);
    if (!node.remark.empty()) add(id, term("remark"), terms_.literal(node.remark));
    write("end-comment", node.end_comments);
  }

  // ---- nodes ----

  Id write(const Node& node, const std::string& scope) {
    const KindRow& row = *find_kind(node.kind);
    Id id;
    if (row.named && node.has("name")) {
      const std::string full = join_scope(scope, node.text("name"));
      if (!written_.insert(full).second) {
        throw Error(Problem{node.place,
                            full,
                            "two items of the file have this name",
                            "rename one: in the graph a name is one node",
                            Severity::kError,
                            {}});
      }
      id = terms_.iri(base_ + full);
    } else {
      id = terms_.fresh_blank();
    }
    add(id, type_, term(row.type));
    write_texts(node, row, id, scope);
    if (node.kind == "argument") write_argument(node, id, scope);
    write_comments(node, id);
    if (node.kind == "dproto") {
      write_fields(node, id, scope);
    } else {
      const bool coordinates = function_of_coordinates_;
      if (node.kind == "fproto") function_of_coordinates_ = node.text("context") == "coordinates";
      write_children(node, id,
                     node.kind == "module" ? join_scope(scope, node.text("name")) : scope);
      function_of_coordinates_ = coordinates;
    }
    return id;
  }

  // An argument is a prototype, or of a function of coordinates their name, which is no item.
  void write_argument(const Node& node, Id id, const std::string& scope) {
    if (function_of_coordinates_) return;
    add(id, term("prototype"), reference("dproto", node.text("prototype"), scope));
    store_.remove({id, term("takes"), terms_.literal(node.text("prototype")), {}});
  }

  void write_children(const Node& node, Id id, const std::string& scope) {
    std::vector<Id> items;
    for (const Node& child : node.children) items.push_back(write(child, scope));
    if (!items.empty()) add(id, term("entries"), list(items));
  }

  void write_fields(const Node& node, Id id, const std::string& scope) {
    std::vector<Id> notes;
    for (const FieldRow& row : field_rows()) {
      const Node* field = node.child(row.kind);
      if (!field) continue;
      write_field(row, *field, id, scope);
      if (field->comments.empty() && field->remark.empty() && field->end_comments.empty()) continue;
      const Id note = terms_.fresh_blank();
      add(note, type_, term("Note"));
      add(note, term("at"), terms_.literal(row.kind));
      write_comments(*field, note);
      notes.push_back(note);
    }
    if (!notes.empty()) add(id, term("notes"), list(notes));
  }

  void write_field(const FieldRow& row, const Node& field, Id id, const std::string& scope) {
    if (field.has("value")) {
      add(id, term(row.predicate),
          row.style == TextStyle::kReference ? reference(row.refers_to, field.text("value"), scope)
                                             : terms_.literal(field.text("value")));
    } else if (field.has("form")) {
      add(id, term(row.form_predicate), terms_.literal(field.text("form")));
    } else if (!row.entry_kind.empty()) {
      std::vector<Id> items;
      for (const Node& entry : field.children) {
        const Id item = write(entry, scope);
        // What a composite composes are prototypes; what it says of conventions are words.
        if (row.kind == "composes") {
          add(item, term("prototype"), reference("dproto", entry.text("value"), scope));
          store_.remove({item, term("value"), terms_.literal(entry.text("value")), {}});
        }
        items.push_back(item);
      }
      add(id, term(row.predicate), list(items));
    } else {
      // A representation or units written out.
      const KindRow& kind = *find_kind(row.written_out);
      const Id inner = terms_.fresh_blank();
      add(id, term(row.predicate), inner);
      add(inner, type_, term(kind.type));
      write_texts(field, kind, inner, scope);
      write_children(field, inner, scope);
    }
  }

  const std::string& base_;
  graph::Store& store_;
  graph::Terms& terms_;
  ItemNames names_, prelude_names_;
  std::set<std::string> written_;
  bool function_of_coordinates_ = false;
  Id type_, first_, rest_, nil_;
};

}  // namespace

graph::Id to_graph(const Node& file, const std::string& base, graph::Store& store) {
  return GraphWriter(base, store).run(file);
}

}  // namespace sinew::blocks
