// What a query means: the algebra of SPARQL 1.1, section 18.
//
// A variable is a number that means the same wherever it occurs in one query: variables of a
// sub-select that are not projected have got numbers of their own. Parameters keep their number
// everywhere. Each pattern knows which variables it may bind and which it binds in every solution;
// the planner lives on that.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/algebra/variable_set.h"
#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::sparql::algebra {

struct Pattern;
struct Select;

// A term or a variable.
struct Node {
  bool is_variable = false;
  std::uint32_t value = 0;  // a graph::Id or a Variable
  static Node term(graph::Id id) { return {false, id.value}; }
  static Node variable(Variable variable) { return {true, variable}; }
};

struct Triple {
  Node subject, predicate, object;
  std::shared_ptr<const syntax::Path> path;  // then `predicate` has no meaning
};

struct Expression {
  Operator op = Operator::kConstant;
  graph::Id term = {};    // kConstant; kCall: the function
  Variable variable = 0;  // kVariable, kBound
  std::vector<Expression> arguments;
  std::shared_ptr<const Pattern> pattern;  // kExists, kNotExists
  std::size_t offset = 0;                  // in the text, for messages
};

struct Pattern {
  enum class Kind : std::uint8_t {
    kTriples,   // triples
    kJoin,      // parts; none: the one solution that binds nothing
    kLeftJoin,  // parts[0] OPTIONAL parts[1], conditions
    kUnion,     // parts
    kMinus,     // parts[0] MINUS parts[1]
    kFilter,    // parts[0], conditions
    kExtend,    // parts[0], variable := expression
    kGraph,     // GRAPH name parts[0]
    kValues,    // values
    kSelect,    // a sub-select
    kService,   // refused when it is evaluated, unless `silent`
  };
  Kind kind = Kind::kJoin;
  bool silent = false;
  std::size_t offset = 0;
  std::vector<Triple> triples;
  std::vector<Pattern> parts;
  std::vector<Expression> conditions;
  Variable variable = 0;
  Expression expression;
  Node name;
  std::vector<Variable> value_variables;
  std::vector<std::vector<graph::Id>> value_rows;
  std::shared_ptr<const Select> select;

  VariableSet possible;  // bound in some solution, perhaps
  VariableSet certain;   // bound in every solution
};

struct Aggregate {
  Operator op = Operator::kCount;
  Variable result = 0;
  bool distinct = false;
  std::optional<Expression> argument;  // none: COUNT(*)
  std::string separator;
};

struct Assignment {
  Variable variable = 0;
  Expression expression;
};

struct Order {
  Expression expression;
  bool descending = false;
};

// In the order in which it is evaluated: the pattern, groups, HAVING, a last join with values,
// select expressions, ORDER BY, projection, DISTINCT, OFFSET and LIMIT.
struct Select {
  Pattern where;
  bool grouped = false;
  std::vector<Assignment> keys;
  std::vector<Aggregate> aggregates;
  std::vector<Expression> having;
  std::optional<Pattern> values;
  std::vector<Assignment> assignments;
  std::vector<Order> order;
  std::vector<Variable> columns;
  bool distinct = false;
  bool reduced = false;
  std::optional<std::uint64_t> limit;
  std::uint64_t offset = 0;
};

struct Query {
  std::shared_ptr<const syntax::Source> source;
  syntax::QueryForm form = syntax::QueryForm::kSelect;
  Select select;
  std::vector<std::string> names;    // by variable
  std::vector<Variable> parameters;  // in the order in which they were declared
  syntax::DatasetClause dataset;
  // CONSTRUCT, and updates: the nodes of templates that are variables mean columns of `select`.
  syntax::Template construct;
  std::vector<syntax::Node> describe;
  std::string base;
};

// All variables that the expression mentions; those that a pattern of EXISTS may bind, too.
VariableSet variables_of(const Expression& expression);
// All variables that the pattern binds or that its expressions mention. Those of a sub-select that
// it does not project are not seen.
VariableSet mentioned(const Pattern& pattern);

}  // namespace sinew::rdf::sparql::algebra
