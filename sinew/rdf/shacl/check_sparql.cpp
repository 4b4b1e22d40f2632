// Running the queries of SHACL-SPARQL and reading their results (SHACL, sections 5.3 and 6.3).
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/rdf/shacl/sparql_check.h"
#include "sinew/rdf/shacl/validator.h"

namespace sinew::rdf::shacl {
namespace {

[[noreturn]] void fail(const Check& check, std::string what, std::string remedy) {
  Problem problem;
  problem.iri = check.validator.name(check.focus_node);
  problem.what = std::move(what);
  problem.remedy = std::move(remedy);
  throw Error(std::move(problem));
}

const sparql::Prepared& query_for(const Check& check) {
  const GraphReader& data = check.validator.data();
  if (data.graph()) {
    fail(check, "constraints in SPARQL cannot be checked on one named graph",
         "validate the union of all graphs, or the unnamed graph");
  }
  return *check.constraint.sparql->queries[static_cast<std::size_t>(data.dataset())];
}

// A value as a message shows it.
std::string shown(const graph::Terms& terms, Id id) {
  return terms.is_blank(id) ? terms.to_string(id) : std::string(terms.text(id));
}

// Replaces {?name} and {$name} by values; those without a value stay (section 5.3.2).
template <typename ValueOf>
std::string filled(const std::string& text, const graph::Terms& terms, ValueOf&& value_of) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins =
        text[at] == '{' && at + 1 < text.size() && (text[at + 1] == '?' || text[at + 1] == '$');
    const std::size_t end = begins ? text.find('}', at) : std::string::npos;
    if (end != std::string::npos) {
      const Id value = value_of(std::string_view(text).substr(at + 2, end - at - 2));
      if (value) {
        out += shown(terms, value);
        at = end + 1;
        continue;
      }
    }
    out += text[at++];
  }
  return out;
}

template <typename ValueOf>
void set_messages(Result& result, const Check& check, ValueOf&& value_of) {
  const SparqlCheck& sparql = *check.constraint.sparql;
  const auto& templates = sparql.messages.empty() ? check.shape.messages : sparql.messages;
  result.messages.clear();
  for (const Message& message : templates) {
    result.messages.push_back(
        {filled(message.text, check.validator.terms(), value_of), message.language});
  }
}

Id parameter(const SparqlCheck& sparql, std::span<const Id> values, std::string_view name) {
  const auto found = std::find(sparql.names.begin(), sparql.names.end(), name);
  return found == sparql.names.end()
             ? Id{}
             : values[static_cast<std::size_t>(found - sparql.names.begin())];
}

constexpr std::string_view kMend = "mend the data, or the query of the constraint";

void ask(Check& check, const sparql::Prepared& query) {
  const SparqlCheck& sparql = *check.constraint.sparql;
  std::vector<Id> values = sparql.values;
  values[0] = check.focus_node;
  for (const Id value : check.values) {
    values[1] = value;
    if (query.ask(check.validator.data().view(), values)) continue;
    Result* result =
        check.violation(value,
                        fmt::format("{} does not pass {}", check.validator.name(value),
                                    check.validator.name(check.constraint.component_iri)),
                        std::string(kMend));
    if (!result) return;
    set_messages(*result, check,
                 [&](std::string_view name) { return parameter(sparql, values, name); });
  }
}

// A solution is a violation; its columns say more.
void read_row(Check& check, const sparql::Prepared& query, std::span<const Id> parameters,
              std::span<const Id> row) {
  const SparqlCheck& sparql = *check.constraint.sparql;
  const graph::Terms& terms = check.validator.terms();
  const auto at = [&](std::optional<std::size_t> column) { return column ? row[*column] : Id{}; };
  const Id failure = at(sparql.failure_column);
  if (failure && terms.text(failure) == "true") {
    fail(check,
         fmt::format("the query of {} reports a failure",
                     check.validator.name(check.constraint.component_iri)),
         std::string(kMend));
  }
  Id value = at(sparql.value_column);
  if (!value && !check.shape.path) value = check.focus_node;
  Result* result = check.violation(
      value, value ? fmt::format("the value is {}", check.validator.name(value)) : "it is refused",
      std::string(kMend));
  if (!result) return;
  result->source_constraint = sparql.source_constraint;
  if (const Id path = at(sparql.path_column); path && terms.is_iri(path)) {
    result->path = std::make_shared<Path>(Path::of(path));
  }
  if (const Id message = at(sparql.message_column); message && terms.is_literal(message)) {
    result->messages = {{std::string(terms.text(message)), std::string(terms.language(message))}};
    return;
  }
  set_messages(*result, check, [&](std::string_view name) {
    const auto& columns = query.columns();
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) return parameter(sparql, parameters, name);
    return row[static_cast<std::size_t>(found - columns.begin())];
  });
}

void select(Check& check, const sparql::Prepared& query) {
  std::vector<Id> parameters = check.constraint.sparql->values;
  parameters[0] = check.focus_node;
  query.select(check.validator.data().view(), parameters, [&](std::span<const Id> row) {
    read_row(check, query, parameters, row);
    return !check.done();
  });
}

}  // namespace

void check_sparql(Check& check) {
  const sparql::Prepared& query = query_for(check);
  if (check.constraint.sparql->is_ask) {
    ask(check, query);
  } else {
    select(check, query);
  }
}

}  // namespace sinew::rdf::shacl
