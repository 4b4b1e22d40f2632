// What an evaluator keeps for each SELECT and each table of its plan. Private to this folder.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "sinew/rdf/sparql/eval/evaluator.h"
#include "sinew/rdf/sparql/eval/row_set.h"

namespace sinew::rdf::sparql::eval {

// One aggregate of one group.
struct Accumulator {
  std::size_t count = 0;
  bool failed = false;
  Id best = {};      // MIN, MAX, SAMPLE
  Value sum;         // SUM, AVG: a number
  std::string text;  // GROUP_CONCAT
};

struct Evaluator::BlockState {
  const RowVisitor* visit = nullptr;
  std::vector<Id> row;  // the projected columns, then the sort keys
  RowSet distinct;
  std::uint64_t skipped = 0, delivered = 0;
  bool after_groups = false;

  std::vector<Id> rows;  // to be sorted: columns and sort keys
  std::vector<std::size_t> order;

  RowSet groups;                          // keys
  std::vector<Accumulator> accumulators;  // group by group
  std::vector<RowSet> distinct_values;    // for each aggregate: group number and value
  std::vector<Id> key;
};

struct Evaluator::TableState {
  bool is_made = false;
  std::vector<Id> depended;  // on these terms of SubPlan::depends
  std::vector<Id> rows;
  std::size_t width = 0, count = 0;
  // Rows by key: the first row of each, and for each row the next with the same key.
  RowSet keys;
  std::vector<std::size_t> first, last, next;
};

}  // namespace sinew::rdf::sparql::eval
