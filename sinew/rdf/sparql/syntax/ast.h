// What a text says, before it means anything: the syntax tree of SPARQL 1.1 queries and updates.
//
// Terms are interned already (graph::Id); variables are numbers that index `Names`. A blank node in
// a pattern is a variable that nobody can name; in a template or in data it stays a blank node.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/syntax/operators.h"
#include "sinew/rdf/sparql/syntax/source.h"

namespace sinew::rdf::sparql::syntax {

using Variable = std::uint32_t;

// The variables of one query or update operation.
struct Names {
  std::vector<std::string> texts;  // without '?'
  // Variables made for blank nodes and for the parser's own use; SELECT * leaves them out.
  std::vector<bool> hidden;
};

struct Node {
  enum class Kind : std::uint8_t { kTerm, kVariable, kBlank };
  Kind kind = Kind::kTerm;
  // A graph::Id, a Variable, or the number of a blank node in its template.
  std::uint32_t value = 0;

  static Node term(graph::Id id) { return {Kind::kTerm, id.value}; }
  static Node variable(Variable variable) { return {Kind::kVariable, variable}; }
  static Node blank(std::uint32_t number) { return {Kind::kBlank, number}; }
  bool is_variable() const { return kind == Kind::kVariable; }
  graph::Id id() const { return graph::Id{value}; }
  friend bool operator==(Node, Node) = default;
};

struct Path {
  enum class Kind : std::uint8_t {
    kIri,
    kInverse,
    kSequence,
    kAlternative,
    kZeroOrMore,
    kOneOrMore,
    kZeroOrOne,
    kNegated
  };
  Kind kind = Kind::kIri;
  graph::Id iri = {};
  std::vector<Path> parts;
  // Of kNegated: what no edge may be, forward and backward. An empty list does not restrict, but
  // then that direction is only walked if it is listed at all.
  std::vector<graph::Id> forward, backward;
  bool walks_forward = false, walks_backward = false;
};

struct Triple {
  Node subject;
  Node predicate;                    // when there is no path
  std::shared_ptr<const Path> path;  // anything but an IRI or a variable
  Node object;
  std::size_t offset = 0;
};

struct Group;
struct Select;

struct Expression {
  Operator op = Operator::kConstant;
  graph::Id term = {};    // kConstant; kCall: the function
  Variable variable = 0;  // kVariable, kBound
  std::vector<Expression> arguments;
  std::shared_ptr<const Group> pattern;  // kExists, kNotExists
  bool distinct = false;                 // aggregates, and calls (an error unless an aggregate)
  std::string separator = " ";           // kGroupConcat
  std::size_t offset = 0;
};

struct Values {
  std::vector<Variable> variables;
  std::vector<std::vector<graph::Id>> rows;  // the null Id for UNDEF
};

struct Element {
  enum class Kind : std::uint8_t {
    kTriples,
    kFilter,
    kBind,
    kValues,
    kGroup,
    kUnion,
    kOptional,
    kMinus,
    kGraph,
    kService,
    kSelect
  };
  Kind kind = Kind::kTriples;
  std::size_t offset = 0;
  std::vector<Triple> triples;
  Expression expression;  // kFilter, kBind
  Variable variable = 0;  // kBind
  std::shared_ptr<const Values> values;
  std::vector<std::shared_ptr<const Group>> groups;  // kUnion has two or more, most others one
  Node name;                                         // kGraph, kService
  bool silent = false;                               // kService
  std::shared_ptr<const Select> select;
};

struct Group {
  std::vector<Element> elements;
};

struct Projection {
  Variable variable = 0;
  std::optional<Expression> expression;  // (expression AS ?variable)
  std::size_t offset = 0;
};

struct Order {
  Expression expression;
  bool descending = false;
};

struct GroupKey {
  Expression expression;
  std::optional<Variable> variable;  // (expression AS ?variable), or the variable itself
};

// A SELECT at the top or inside a group, and what the other query forms share with it.
struct Select {
  bool distinct = false, reduced = false;
  bool all = false;  // SELECT *; `projections` lists the visible variables then, too
  std::vector<Projection> projections;
  std::shared_ptr<const Group> where;
  bool grouped = false;  // there is a GROUP BY or an aggregate
  std::vector<GroupKey> group_by;
  std::vector<Expression> having;
  std::vector<Order> order_by;
  std::optional<std::uint64_t> limit;
  std::uint64_t offset = 0;
  std::shared_ptr<const Values> values;  // behind everything else
};

// FROM and FROM NAMED, or USING and USING NAMED. Not given: the dataset that the caller chose.
struct DatasetClause {
  bool given = false;
  std::vector<graph::Id> defaults, named;
};

struct TemplateQuad {
  Node subject, predicate, object;
  Node graph;  // the null term: the unnamed graph, or the one of WITH
};

struct Template {
  std::vector<TemplateQuad> quads;
  std::uint32_t blank_count = 0;
};

enum class QueryForm : std::uint8_t { kSelect, kAsk, kConstruct, kDescribe };

struct Query {
  QueryForm form = QueryForm::kSelect;
  std::shared_ptr<const Source> source;
  Names names;
  DatasetClause dataset;
  Select select;  // of ASK, CONSTRUCT and DESCRIBE: everything but the projection
  Template construct;
  bool describe_all = false;
  std::vector<Node> describe;
  std::string base;  // what IRI() resolves against; may be empty
};

struct Operation {
  enum class Kind : std::uint8_t {
    kInsertData,
    kDeleteData,
    kModify,
    kLoad,
    kClear,
    kDrop,
    kCreate,
    kAdd,
    kMove,
    kCopy
  };
  enum class Target : std::uint8_t { kGraph, kDefault, kNamed, kAll };
  Kind kind = Kind::kInsertData;
  std::size_t offset = 0;
  bool silent = false;
  Names names;
  Template deletes, inserts;  // kInsertData, kDeleteData, kModify
  graph::Id with = {};
  DatasetClause using_clause;
  std::shared_ptr<const Group> where;
  Target target = Target::kGraph;  // kClear, kDrop, and where kAdd, kMove, kCopy, kLoad write
  graph::Id graph = {};            // of `target`
  graph::Id source = {};  // what kAdd, kMove, kCopy read (null: the unnamed graph); of kLoad
  std::string base;
};

struct Update {
  std::shared_ptr<const Source> source;
  std::vector<Operation> operations;
};

}  // namespace sinew::rdf::sparql::syntax
