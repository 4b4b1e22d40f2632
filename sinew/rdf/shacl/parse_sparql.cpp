// SHACL-SPARQL: constraints that are queries (section 5), and components that a shapes graph
// defines by queries (section 6).
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sinew/rdf/shacl/prebinding.h"
#include "sinew/rdf/shacl/shape_parser.h"
#include "sinew/rdf/shacl/sparql_check.h"
#include "sinew/rdf/sparql/syntax/parser.h"

namespace sinew::rdf::shacl {

struct ShapeParser::CustomComponent {
  struct Parameter {
    Id path;
    std::string name;
    bool optional;
  };
  Id node;
  std::vector<Parameter> parameters;
  Id validator, node_validator, property_validator;  // 0 where there is none
};

namespace {

// The longest NCName at the end of the IRI (section 6.2.1), as far as a SPARQL variable may hold
// it.
std::string_view local_name(std::string_view iri) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c & 0x80) != 0;
  };
  std::size_t start = iri.size();
  for (std::size_t at = iri.size(); at > 0; --at) {
    const char c = iri[at - 1];
    if (is_letter(c)) {
      start = at - 1;
    } else if (!(c >= '0' && c <= '9') && c != '-' && c != '.') {
      break;
    }
  }
  return iri.substr(start);
}

bool is_variable_name(std::string_view name) {
  return !name.empty() && name.find_first_of("-.") == std::string_view::npos;
}

std::optional<std::size_t> column(const sparql::Prepared& query, std::string_view name) {
  const auto& columns = query.columns();
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

}  // namespace

// ---- the text ----

// Everything that sh:prefixes of the node declares, also by owl:imports (section 5.2.1).
std::string ShapeParser::prologue(Id node) {
  std::vector<Id> declaring = in_.objects(node, v_.prefixes);
  for (std::size_t i = 0; i < declaring.size(); ++i) {
    for (const Id imported : in_.objects(declaring[i], v_.owl_imports)) {
      if (std::find(declaring.begin(), declaring.end(), imported) == declaring.end()) {
        declaring.push_back(imported);
      }
    }
  }
  std::map<std::string, std::string> known;
  for (const Id source : declaring) {
    for (const Id declaration : in_.objects(source, v_.declare)) {
      const auto names = in_.objects(declaration, v_.prefix);
      const auto spaces = in_.objects(declaration, v_.name_space);
      if (names.size() != 1 || spaces.size() != 1 || !terms().is_literal(names[0]) ||
          !terms().is_literal(spaces[0])) {
        fault(source, v_.declare, "a prefix declaration is incomplete",
              "give it one sh:prefix (a string) and one sh:namespace (an xsd:anyURI)");
        continue;
      }
      const std::string name(terms().text(names[0])), space(terms().text(spaces[0]));
      const auto [at, is_new] = known.try_emplace(name, space);
      if (!is_new && at->second != space) {
        fault(node, v_.prefixes,
              fmt::format("the prefix {} means both <{}> and <{}>", name, at->second, space),
              "declare it once");
      }
    }
  }
  std::string text;
  for (const auto& [name, space] : known) text += fmt::format("PREFIX {}: <{}> ", name, space);
  return text;
}

// Prepares the query that `holder` has as sh:select or sh:ask for a shape. check.names and
// check.values are those of the pre-bound variables.
bool ShapeParser::prepare(Id holder, Id property, const Shape& shape, SparqlCheck& check) {
  const auto texts = in_.objects(holder, property);
  if (texts.empty()) {
    fault(holder, {}, fmt::format("there is no {}", name(property)), "give it one query");
    return false;
  }
  if (!at_most_one(holder, property, texts) || !is_string(holder, property, texts[0], false)) {
    return false;
  }
  if (!check.is_ask) {
    for (const Id deactivated : in_.objects(holder, v_.deactivated)) {
      if (boolean(holder, v_.deactivated, deactivated).value_or(false)) return false;
    }
  }
  std::vector<std::string_view> prebound(check.names.begin(), check.names.end());
  std::vector<std::string_view> returned;
  for (const std::string_view each : prebound) {
    if (each != "shapesGraph" && each != "currentShape") returned.push_back(each);
  }
  prebound.emplace_back("shapesGraph");
  prebound.emplace_back("currentShape");
  try {
    std::string text = prologue(holder) + std::string(terms().text(texts[0]));
    sparql::syntax::ParseOptions options;
    options.parameters = prebound;
    const auto parsed = sparql::syntax::parse_query(store_.terms(), text, options);
    using Form = sparql::syntax::QueryForm;
    if (parsed.form != (check.is_ask ? Form::kAsk : Form::kSelect)) {
      fault(holder, property, fmt::format("the query of {} is of another form", name(property)),
            check.is_ask ? "write an ASK query" : "write a SELECT query");
      return false;
    }
    if (const auto why = prebinding_fault(parsed, prebound, returned)) {
      fault(holder, property,
            fmt::format("the query of {} cannot be used: {}", name(property), *why),
            "SHACL allows no MINUS, VALUES or SERVICE, no new value for a variable that is bound "
            "before, and only sub-selects that return those variables");
      return false;
    }
    if (shape.path) text = with_path(text, to_sparql(*shape.path, terms()));
    const std::vector<std::string_view> names(check.names.begin(), check.names.end());
    for (const graph::Dataset dataset : {graph::Dataset::kUnion, graph::Dataset::kDefault}) {
      check.queries[static_cast<std::size_t>(dataset)] =
          sparql::prepare(store_, text, names, dataset);
    }
  } catch (const Error& error) {
    fault(holder, property, fmt::format("the query of {}: {}", name(property), error.what()),
          "mend the query");
    return false;
  }
  const sparql::Prepared& query = *check.queries[0];
  if (!check.is_ask && !column(query, "this")) {
    fault(holder, property, "the query does not return $this", "add it to SELECT");
    return false;
  }
  check.value_column = column(query, "value");
  check.path_column = column(query, "path");
  check.message_column = column(query, "message");
  check.failure_column = column(query, "failure");
  check.messages = messages(holder);
  return true;
}

// $this, and for ASK $value, then the shape and the shapes graph.
SparqlCheck ShapeParser::new_check(Id shape, bool is_ask) const {
  SparqlCheck check;
  check.is_ask = is_ask;
  const auto bind = [&](std::string name, Id value) {
    check.names.push_back(std::move(name));
    check.values.push_back(value);
  };
  bind("this", {});
  if (is_ask) bind("value", {});
  bind("currentShape", shape);
  if (out_.graph) bind("shapesGraph", out_.graph);
  return check;
}

// ---- sh:sparql ----

void ShapeParser::sparql_constraint(Id node, Shape& shape, Id constraint) {
  SparqlCheck check = new_check(node, false);
  check.source_constraint = constraint;
  if (!prepare(constraint, v_.select, shape, check)) return;
  Constraint made{.component = Component::kSparql};
  made.component_iri =
      store_.terms().iri(fmt::format("{}{}", kSh, component_name(Component::kSparql)));
  made.sparql = std::make_shared<const SparqlCheck>(std::move(check));
  shape.constraints.push_back(std::move(made));
}

// ---- components that the shapes graph defines ----

void ShapeParser::find_custom_components() {
  std::vector<Id> nodes;
  for (const Id type : sub_classes_of(v_.constraint_component)) {
    for (const Id node : in_.subjects(v_.rdf_type, type)) {
      // The vocabulary of SHACL may be part of the graph; its components are built in.
      const bool built_in = terms().text(node).starts_with(kSh);
      if (!built_in && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) {
        nodes.push_back(node);
      }
    }
  }
  for (const Id node : nodes) {
    auto component = std::make_shared<CustomComponent>();
    component->node = node;
    if (!terms().is_iri(node)) {
      fault(node, {}, "a constraint component without IRI", "give it one");
      continue;
    }
    for (const Id parameter : in_.objects(node, v_.parameter)) {
      const auto paths = in_.objects(parameter, v_.path);
      if (paths.size() != 1 || !terms().is_iri(paths[0])) {
        fault(node, v_.parameter, "a parameter without IRI", "give it one sh:path that is an IRI");
        continue;
      }
      bool optional = false;
      for (const Id flag : in_.objects(parameter, v_.optional)) {
        optional = boolean(parameter, v_.optional, flag).value_or(false);
      }
      const std::string name(local_name(terms().text(paths[0])));
      if (!is_variable_name(name)) {
        fault(node, v_.parameter, fmt::format("the parameter {} gives no variable", name),
              "let its IRI end in a name of letters, digits and _");
        continue;
      }
      component->parameters.push_back({paths[0], name, optional});
    }
    const bool any_required =
        std::any_of(component->parameters.begin(), component->parameters.end(),
                    [](const auto& each) { return !each.optional; });
    if (!any_required) {
      fault(node, v_.parameter, "a constraint component without parameter that is not optional",
            "give it one");
      continue;
    }
    component->validator = in_.object(node, v_.validator);
    component->node_validator = in_.object(node, v_.node_validator);
    component->property_validator = in_.object(node, v_.property_validator);
    custom_.push_back(std::move(component));
  }
}

void ShapeParser::custom_constraints(Id node, Shape& shape) {
  for (const auto& component : custom_) {
    std::vector<std::vector<Id>> values;
    bool complete = true;
    for (const auto& parameter : component->parameters) {
      values.push_back(in_.objects(node, parameter.path));
      complete = complete && (parameter.optional || !values.back().empty());
    }
    if (!complete) continue;
    if (component->parameters.size() == 1) {
      // Each value of a single parameter is a constraint of its own.
      for (const Id value : values[0]) custom_constraint(node, shape, *component, {value});
      continue;
    }
    std::vector<Id> single;
    for (std::size_t i = 0; i < values.size(); ++i) {
      complete = at_most_one(node, component->parameters[i].path, values[i]) && complete;
      single.push_back(values[i].empty() ? Id{} : values[i][0]);
    }
    if (complete) custom_constraint(node, shape, *component, single);
  }
}

void ShapeParser::custom_constraint(Id node, Shape& shape, const CustomComponent& component,
                                    const std::vector<Id>& values) {
  const Id special = shape.path ? component.property_validator : component.node_validator;
  const Id validator = special ? special : component.validator;
  if (!validator) {
    warn(node, {}, fmt::format("{} has no validator for this kind of shape", name(component.node)),
         "it is not checked");
    return;
  }
  const bool is_ask = !special;
  SparqlCheck check = new_check(node, is_ask);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    check.names.push_back(component.parameters[i].name);
    check.values.push_back(values[i]);
  }
  if (!prepare(validator, is_ask ? v_.ask : v_.select, shape, check)) return;
  Constraint made{.component = Component::kCustom};
  made.component_iri = component.node;
  made.sparql = std::make_shared<const SparqlCheck>(std::move(check));
  shape.constraints.push_back(std::move(made));
}

}  // namespace sinew::rdf::shacl
