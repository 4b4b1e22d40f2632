#include "sinew/rdf/sparql/test/random_query.h"

#include <utility>

namespace sinew::rdf::sparql {

std::string RandomQuery::object() {
  if (chance(65)) return variable();
  return chance(60) ? node() : std::to_string(below(3));
}

std::string RandomQuery::data() {
  std::string text = "@prefix : <http://e/> .\n";
  const auto triples = [&](unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      const std::string to = chance(70) ? node() : std::to_string(below(3));
      text += node() + " " + predicate() + " " + to + " .\n";
    }
  };
  triples(2 + below(8));
  text += ":g {\n";
  triples(1 + below(5));
  text += "}\n:h {\n";
  triples(1 + below(4));
  return text + "}\n";
}

std::string RandomQuery::path(unsigned depth) {
  if (depth == 0 || chance(30)) return predicate();
  switch (below(8)) {
    case 0:
      return "^" + predicate();
    case 1:
      // Not of parts that may match no step, unless at the top: the standard is not clear about
      // what they match inside of other paths.
      if (depth < 2) return "(" + predicate() + "/^" + predicate() + ")";
      return path(depth - 1) + "/" + path(depth - 1);
    case 2:
      return "(" + path(depth - 1) + "|" + path(depth - 1) + ")";
    case 3:
      return "(" + path(depth - 1) + ")*";
    case 4:
      return "(" + path(depth - 1) + ")+";
    case 5:
      return "(" + path(depth - 1) + ")?";
    case 6:
      return "!(" + predicate() + "|^" + predicate() + ")";
    default:
      return "!" + predicate();
  }
}

std::string RandomQuery::verb() {
  if (chance(60)) return predicate();
  return chance(30) ? variable() : path(2);
}

std::string RandomQuery::expression(unsigned depth) {
  if (depth == 0 || chance(25)) {
    switch (below(5)) {
      case 0:
        return std::to_string(below(3));
      case 1:
        return node();
      default:
        return variable();
    }
  }
  const auto inner = [&] { return expression(depth - 1); };
  switch (below(9)) {
    case 0:
      return "BOUND(" + variable() + ")";
    case 1:
      return "(" + inner() + " = " + inner() + ")";
    case 2:
      return "(" + inner() + " != " + inner() + ")";
    case 3:
      return "(" + inner() + " < " + inner() + ")";
    case 4:
      return "(" + inner() + " && " + inner() + ")";
    case 5:
      return "(" + inner() + " || " + inner() + ")";
    case 6:
      return "(! " + inner() + ")";
    case 7:
      return "COALESCE(" + inner() + ", " + inner() + ")";
    default: {
      if (chance(40)) return "(" + inner() + " + " + inner() + ")";
      const bool around = std::exchange(in_exists_, true);
      const std::string pattern = group(depth - 1);
      in_exists_ = around;
      return std::string(chance(50) ? "" : "NOT ") + "EXISTS " + pattern;
    }
  }
}

std::string RandomQuery::values() {
  const std::string first = variable();
  std::string second = variable();
  while (second == first) second = variable();
  std::string text = "VALUES (" + first + " " + second + ") {";
  for (unsigned i = 0; i < 1 + below(3); ++i) {
    const auto cell = [&] {
      return chance(25) ? std::string("UNDEF") : chance(70) ? node() : std::to_string(below(3));
    };
    text += " (" + cell() + " " + cell() + ")";
  }
  return text + " }";
}

std::string RandomQuery::sub_select(unsigned depth) {
  const std::string first = variable();
  const std::string where = " WHERE " + group(depth);
  switch (below(4)) {
    case 0:
      return "{ SELECT DISTINCT " + first + where + " }";
    case 1:
      return "{ SELECT " + first + " " + variable() + where + " }";
    case 2:
      return "{ SELECT " + first + " (COUNT(*) AS " + fresh_variable() + ")" + where +
             " GROUP BY " + first + " }";
    default:
      return "{ SELECT (COUNT(DISTINCT " + first + ") AS " + fresh_variable() + ")" + where + " }";
  }
}

std::string RandomQuery::element(unsigned depth) {
  if (depth == 0) return triple();
  switch (below(in_exists_ ? 9 : 12)) {
    case 0:
      return "OPTIONAL " + group(depth - 1);
    case 1:
      return group(depth - 1) + " UNION " + group(depth - 1);
    case 2:
      return "FILTER(" + expression(chance(30) ? 3 : 2) + ")";
    case 3:
      return "BIND(" + expression(1) + " AS " + fresh_variable() + ")";
    case 4:
      return values();
    case 5:
      return group(depth - 1);
    case 6:
      return "GRAPH " +
             (chance(50)   ? variable()
              : chance(50) ? ":g"
                           : ":h") +
             " " + group(depth - 1);
    case 7:
      return "OPTIONAL " + group(depth - 1);
    case 8:
      return triple();
    case 9:
    case 10:
      return "MINUS " + group(depth - 1);
    default:
      return sub_select(depth - 1);
  }
}

std::string RandomQuery::group(unsigned depth) {
  std::string text = "{ ";
  if (chance(80)) text += triple() + " ";
  const unsigned count = below(4);
  for (unsigned i = 0; i < count; ++i) text += element(depth) + " ";
  return text + "}";
}

std::string RandomQuery::query() {
  names_ = 0;
  return "PREFIX : <http://e/> SELECT * WHERE " + group(3);
}

}  // namespace sinew::rdf::sparql
