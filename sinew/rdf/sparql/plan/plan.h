// What the evaluator runs: a flat list of operators over slots.
//
// A slot is a place for one term. Constants, parameters and variables all have slots, so an operand
// is a slot's number and nothing else; a slot that holds the null Id is unbound. Each operator
// makes its bindings one after another and has the rest of the list run for each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/plan/path.h"
#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::sparql::plan {

using Slot = std::uint32_t;
using Index = std::uint32_t;  // of an operator, an expression, a table, …
inline constexpr std::uint32_t kNone = UINT32_MAX;

enum class OpKind : std::uint8_t {
  kMatch,       // a triple: subject, predicate, object in the graph
  kPath,        // path from subject to object in the graph
  kGraphNames,  // the graph's name, over all named graphs
  kFilter,      // goes on where the expression is true
  kDiffer,  // as kFilter, for ?a != ?b (negated: =), which needs no values unless both are literals
  kExtend,  // slot := expression; goes on without it if that fails
  kOptional,  // body, which ends in kOptionalEnd; goes on without if that was never reached
  kOptionalEnd,
  kUnion,   // all branches
  kExists,  // goes on if the body, which ends in kFound, finds something (or nothing: negated)
  kFound,
  kValues,   // the rows of a constant table
  kTable,    // the rows of a sub-plan, evaluated on its own
  kMinus,    // goes on unless a row of the sub-plan is compatible and shares a variable
  kNothing,  // no solution
  kRefuse,   // an error: SERVICE
  kJump,     // goes on at `next`; only while a plan is made
  kEmit,     // a solution is complete
};

// Where triples are looked for.
enum class GraphKind : std::uint8_t { kDefault, kNamed };

struct Op {
  OpKind kind = OpKind::kEmit;
  GraphKind graph_kind = GraphKind::kDefault;
  bool negated = false;  // kExists, kDiffer
  // kPath: both ends are variables, so that a path of no steps only matches nodes of the graph.
  bool nodes_only = false;
  bool repeats = false;  // kMatch, kPath: a slot stands in two places
  // kMatch: positions (1 subject, 2 predicate, 4 object, 8 graph) that are surely unbound before.
  std::uint8_t free = 0;
  Index next = kNone;
  Slot subject = 0, predicate = 0, object = 0;
  Slot graph = 0;       // kNamed
  Index body = kNone;   // kOptional, kExists: first operator; kUnion: first of `branches`
  Index item = kNone;   // an expression, a path, a table, a flag; kUnion: number of branches
  double estimate = 0;  // rows out for each row in, as the planner saw it
};

struct Expression {
  Operator op = Operator::kConstant;
  Slot slot = 0;            // kConstant, kVariable, kBound
  graph::Id function = {};  // kCall
  Index first = 0;          // arguments: expressions[argument_list[first + i]]
  std::uint32_t count = 0;
  Index body = kNone;           // kExists, kNotExists: first operator
  std::uint32_t cache = kNone;  // REGEX and REPLACE: where the compiled pattern is kept
  std::size_t offset = 0;
};

struct ValuesTable {
  std::vector<Slot> slots;
  std::vector<graph::Id> cells;  // row after row
  std::size_t row_count = 0;
};

struct Aggregate {
  Operator op = Operator::kCount;
  bool distinct = false;
  Index argument = kNone;  // an expression; kNone: COUNT(*)
  Slot result = 0;
  std::string separator;
};

struct Assignment {
  Slot slot = 0;
  Index expression = 0;
};

struct SortKey {
  Index expression = 0;
  bool descending = false;
};

// One SELECT: what its operators' solutions go through.
struct Block {
  Index first = kNone;  // operator
  bool grouped = false;
  std::vector<Assignment> keys;
  std::vector<Aggregate> aggregates;
  Index after_groups = kNone;  // first operator for each group: HAVING, VALUES, select expressions
  std::vector<SortKey> order;
  std::vector<Slot> columns;
  std::vector<Slot> solution;  // all that the pattern binds by name, for COUNT(DISTINCT *)
  bool distinct = false;
  std::optional<std::uint64_t> limit;
  std::uint64_t offset = 0;
};

// A block whose rows are computed once, and joined as a table.
struct SubPlan {
  Index block = 0;
  // Slots that it reads from around, as if they were constants; it is run anew when they change.
  // All other slots are empty while it runs.
  std::vector<Slot> depends;
  std::vector<Index> key;  // columns that are surely bound on both sides: looked up by hash
};

struct DatasetPlan {
  enum class Default : std::uint8_t { kUnion, kUnnamed, kMerge };
  Default kind = Default::kUnion;
  std::vector<graph::Id> merged;  // kMerge: these graphs, each triple once
  bool named_restricted = false;  // only the graphs in `named` are named graphs
  std::vector<graph::Id> named;
};

struct Plan {
  std::vector<graph::Id> initial;  // the value of every slot before anything runs
  std::vector<std::string> slot_names;
  std::uint32_t parameter_count = 0;  // parameters are slots 0, 1, …
  std::vector<Op> ops;
  std::vector<Index> branches;
  std::vector<Expression> expressions;
  std::vector<Index> arguments;
  PathSteps paths;
  std::vector<PathRoots> path_roots;
  std::vector<ValuesTable> values;
  std::vector<SubPlan> tables;
  std::vector<Block> blocks;  // blocks[0] is the query itself
  std::uint32_t flag_count = 0;
  std::uint32_t cache_count = 0;
  DatasetPlan dataset;
  std::vector<std::string> columns;
  std::shared_ptr<const syntax::Source> source;
  std::string base;
  std::size_t planned_for = 0;  // size of the graph when it was planned
};

}  // namespace sinew::rdf::sparql::plan
