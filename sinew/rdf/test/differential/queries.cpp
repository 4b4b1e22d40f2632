#include <fmt/format.h>

#include <algorithm>

#include "cases.h"

namespace sinew::rdf::differential {
namespace {

constexpr const char* kPrologue =
    "PREFIX ex: <http://example.org/> PREFIX xsd: <http://www.w3.org/2001/XMLSchema#>\n";
constexpr const char* kLinks[] = {"ex:p", "ex:q", "ex:r"};
constexpr const char* kLiterals[] = {"1",       "2",          "-1",      "0.5",   "1.5", "true",
                                     "\"arm\"", "\"arm\"@en", "\"leg\"", "\"1\"", "\"\""};
constexpr const char* kComparisons[] = {"=", "!=", "<", ">", "<=", ">="};
constexpr int kMaxDepth = 2;  // of groups within groups

// Makes one query, with a function for each part of the grammar. `scope` is the list of variables
// that the group at hand may have bound so far; patterns are tied to them, so that results stay
// small.
class QueryMaker {
 public:
  QueryMaker(std::uint64_t seed, int graph) : random_(seed), graph_(graph) {}

  Case make() {
    Case made{Form::kSelect, graph_, random_.chance(70), false, kPrologue};
    const int kind = random_.below(100);
    sets_ = kind < 20 || random_.chance(40);
    any_path_ = sets_ || random_.chance(3);
    if (kind < 10) {
      made.form = Form::kAsk;
      made.query += "ASK " + where();
    } else if (kind < 20) {
      made.form = Form::kConstruct;
      made.query += construct();
    } else if (!sets_ && random_.chance(30)) {
      made.query += aggregate(where_scope());
    } else {
      made.query += select();
      if (random_.chance(10)) {
        made.count_only = true;
        made.query += fmt::format(" LIMIT {}", random_.below(6));
        if (random_.chance(50)) made.query += fmt::format(" OFFSET {}", random_.below(4));
      }
    }
    return made;
  }

 private:
  using Scope = std::vector<std::string>;

  // ---- query forms ----

  std::string where() {
    Scope scope;
    return group(scope, 0);
  }

  struct Where {
    std::string text;
    Scope scope;
  };
  Where where_scope() {
    Where where;
    where.text = group(where.scope, 0);
    return where;
  }

  std::string select() {
    const Where where = where_scope();
    std::string text = sets_ ? "SELECT DISTINCT" : "SELECT";
    if (random_.chance(40)) {
      text += " *";
    } else {
      Scope chosen = some(where.scope);
      if (random_.chance(10)) chosen.emplace_back("?unused");
      for (const std::string& variable : chosen) text += " " + variable;
      if (random_.chance(25)) text += fmt::format(" ({} AS ?computed)", expression(where.scope, 2));
    }
    text += " WHERE " + where.text;
    if (random_.chance(20)) text += " ORDER BY " + random_.pick(where.scope);
    return text;
  }

  std::string aggregate(const Where& where) {
    const Scope keys = random_.chance(75) ? some(where.scope) : Scope{};
    std::string text = "SELECT";
    for (const std::string& key : keys) text += " " + key;
    const std::string value = aggregate_of(where.scope);
    text += fmt::format(" ({} AS ?total)", value);
    if (random_.chance(30)) text += fmt::format(" ({} AS ?other)", aggregate_of(where.scope));
    text += " WHERE " + where.text;
    for (std::size_t i = 0; i < keys.size(); ++i) text += (i == 0 ? " GROUP BY " : " ") + keys[i];
    if (random_.chance(30)) text += fmt::format(" HAVING (COUNT(*) > {})", random_.below(3));
    return text;
  }

  std::string construct() {
    const Where where = where_scope();
    std::string text = "CONSTRUCT {";
    for (int i = 0; i <= random_.below(2); ++i) {
      const std::string subject = random_.chance(15) ? "ex:new" : random_.pick(where.scope);
      const std::string object = random_.pick(where.scope);
      text += fmt::format(" {} {} {} .", subject, random_.pick(kLinks), object);
    }
    return text + " } WHERE " + where.text;
  }

  std::string aggregate_of(const Scope& scope) {
    const std::string variable = random_.pick(scope);
    const std::string distinct = random_.chance(30) ? "DISTINCT " : "";
    switch (random_.below(5)) {
      case 0:
        return fmt::format("COUNT({}*)", distinct);
      case 1:
        return fmt::format("SUM({}{})", distinct, variable);
      case 2:
        return fmt::format("AVG({}{})", distinct, variable);
      default:
        return fmt::format("COUNT({}{})", distinct, variable);
    }
  }

  // ---- groups ----

  std::string group(Scope& scope, int depth) {
    std::string text = "{ ";
    const int patterns = 1 + (random_.chance(55) ? 1 : 0) + (random_.chance(15) ? 1 : 0);
    for (int i = 0; i < patterns; ++i) text += pattern(scope) + " . ";
    for (int i = random_.below(depth == 0 ? 4 : 2); i > 0; --i) text += element(scope, depth) + " ";
    return text + "}";
  }

  std::string element(Scope& scope, int depth) {
    const int kind = depth < kMaxDepth ? random_.below(12) : random_.below(4);
    switch (kind) {
      case 0:
      case 1:
        return fmt::format("FILTER ({})", condition(scope));
      case 2:
        return bind(scope);
      case 3:
        return values(scope);
      case 4:
      case 5:
        return "OPTIONAL " + group(scope, depth + 1);
      case 6:
        return alternatives(scope, depth);
      case 7:
        return "MINUS " + separate_group(scope, depth);
      case 8: {
        const std::string inner = separate_group(scope, depth);
        return fmt::format("FILTER {}EXISTS {}", random_.chance(50) ? "NOT " : "", inner);
      }
      case 9:
        return graph_ % 4 == 0 ? bind(scope) : in_graph(scope, depth);  // see make_graph
      case 10:
        return "OPTIONAL " + group(scope, depth + 1);
      default:
        return subselect(scope, depth);
    }
  }

  // A group whose variables are not seen outside.
  std::string separate_group(const Scope& scope, int depth) {
    Scope inner = scope;
    return group(inner, depth + 1);
  }

  std::string alternatives(Scope& scope, int depth) {
    Scope left = scope, right = scope;
    const std::string second = group(right, depth + 1);
    const std::string text = group(left, depth + 1) + " UNION " + second;
    merge(scope, left);
    merge(scope, right);
    return text;
  }

  std::string in_graph(Scope& scope, int depth) {
    std::string name = fmt::format("ex:g{}", 1 + random_.below(graph_));
    if (random_.chance(50)) {
      name = "?g";
      merge(scope, {name});
    }
    return fmt::format("GRAPH {} {}", name, group(scope, depth + 1));
  }

  std::string subselect(Scope& scope, int depth) {
    Scope inner;
    // Tied to the outer group by a variable that it surely selects.
    const std::string tie = random_.pick(scope);
    inner.push_back(tie);
    const std::string text = group(inner, depth + 1);
    Scope chosen = some(inner);
    merge(chosen, {tie});
    std::string select = random_.chance(50) ? "{ SELECT DISTINCT" : "{ SELECT";
    for (const std::string& variable : chosen) select += " " + variable;
    merge(scope, chosen);
    return select + " " + text + " }";
  }

  std::string bind(Scope& scope) {
    const std::string variable = fmt::format("?x{}", ++fresh_);
    const std::string text = fmt::format("BIND ({} AS {})", expression(scope, 2), variable);
    scope.push_back(variable);
    return text;
  }

  std::string values(Scope& scope) {
    const std::string variable = random_.pick(scope);
    std::string text = "VALUES " + variable + " {";
    const int count = 2 + random_.below(6 * (graph_ + 1));
    for (int i = 0; i < count; ++i) {
      const int kind = random_.below(100);
      text += " " + (kind < 65 ? node() : kind < 80 ? "UNDEF" : random_.pick(kLiterals));
    }
    return text + " }";
  }

  // ---- triple patterns and paths ----

  // Most patterns lead from node to node; some lead to a literal or a class, a few to anything.
  std::string pattern(Scope& scope) {
    std::string subject = node_variable(scope), predicate, object;
    const int kind = random_.below(100);
    if (kind < 25) {
      predicate = random_.chance(50) ? "ex:name" : "ex:value";
      object = random_.chance(93) ? random_.pick(kLiteralVariables) : random_.pick(kLiterals);
    } else if (kind < 35) {
      predicate = "a";
      object = random_.chance(50) ? "ex:C" : "?class";
    } else {
      predicate = kind < 60 ? random_.pick(kLinks) : kind < 92 ? path(2) : "?y";
      object = random_.chance(88) ? random_.pick(kNodeVariables) : node();
      if (kind < 92 && random_.chance(25)) std::swap(subject, object);
    }
    for (const std::string& part : {subject, predicate, object}) {
      if (part.starts_with('?')) merge(scope, {part});
    }
    return fmt::format("{} {} {}", subject, predicate, object);
  }

  // Mostly one that is bound, so that patterns hang together.
  std::string node_variable(const Scope& scope) {
    Scope known;
    for (const char* variable : kNodeVariables) {
      if (std::ranges::find(scope, variable) != scope.end()) known.emplace_back(variable);
    }
    if (known.empty()) return random_.pick(kNodeVariables);
    return random_.chance(5) ? node() : random_.pick(known);
  }

  // SPARQL counts a solution of an alternative once for each way (section 18.4: alt is a union);
  // oxigraph counts it once. So alternatives are left to queries whose answers are sets, to places
  // within
  // (...)* and (...)+, where they do not matter, and to a few queries that show the difference.
  std::string path(int depth, bool counted = true) {
    std::string link = random_.pick(kLinks);
    if (depth == 0) return link;
    const bool alternatives = any_path_ || !counted;
    switch (random_.below(9)) {
      case 0:
        return "^" + link;
      case 1:
        return pair("({}/{})", [&] { return path(depth - 1, counted); });
      case 2:
        if (!alternatives) return link;
        return pair("({}|{})", [&] { return path(depth - 1, counted); });
      case 3:
        return fmt::format("({})*", path(depth - 1, false));
      case 4:
        return fmt::format("({})+", path(depth - 1, false));
      case 5:
        return fmt::format("({})?", path(depth - 1, false));
      case 6:
        return fmt::format("!{}", link);
      case 7:
        if (!alternatives) return link;
        return fmt::format("!({}|^{})", link, random_.pick(kLinks));
      default:
        return link;
    }
  }

  // Some of these are in no graph.
  std::string node() { return fmt::format("ex:n{}", random_.below(7 + 7 * graph_)); }

  // ---- expressions ----

  // A condition that is true for some solutions, more often than not.
  std::string condition(const Scope& scope) {
    switch (random_.below(6)) {
      case 0:
        return expression(scope, 3);
      case 1: {
        const std::string other = operand(scope, 0);
        return fmt::format("{} != {}", random_.pick(scope), other);
      }
      case 2:
        return pair("!bound({}) || isIRI({})", [&] { return random_.pick(scope); });
      case 3:
        return pair("({}) || ({})", [&] { return expression(scope, 2); });
      case 4:
        return ordering();
      default:
        return fmt::format("!(COALESCE({}, false))", expression(scope, 2));
    }
  }

  std::string expression(const Scope& scope, int depth) {
    const std::string x = operand(scope, depth), y = operand(scope, depth);
    switch (random_.below(24)) {
      case 0:
      case 1:
        return fmt::format("{} {} {}", x, random_.chance(50) ? "=" : "!=", y);
      case 2:
        return ordering();
      case 3:
        return fmt::format("bound({})", random_.pick(scope));
      case 4:
        return pair("({}) && ({})", [&] { return nested(scope, depth); });
      case 5:
        return pair("({}) || ({})", [&] { return nested(scope, depth); });
      case 6:
        return fmt::format("!({})", nested(scope, depth));
      case 7: {
        const char* literal = random_.pick(kLiterals);
        return fmt::format("{} {}IN ({}, {})", x, random_.chance(50) ? "NOT " : "", y, literal);
      }
      case 8:
        return fmt::format("{} {} {}", x, random_.chance(50) ? "+" : "-", y);
      case 9:
        return fmt::format("{} * {}", x, y);
      case 10:
        return fmt::format("isIRI({}) || isBlank({})", x, x);
      case 11:
        return fmt::format("isLiteral({}) && !isNumeric({})", x, y);
      case 12:
        return fmt::format("COALESCE({}, {}, \"none\")", x, y);
      case 13:
        return fmt::format("IF({}, {}, {})", nested(scope, depth), x, y);
      case 14:
        return fmt::format("STRLEN(STR({}))", x);
      case 15:
        return fmt::format("CONCAT(STR({}), \"-\", STR({}))", x, y);
      case 16:
        return fmt::format("CONTAINS(STR({}), \"{}\")", x, random_.below(3));
      case 17:
        return fmt::format("UCASE(SUBSTR(STR({}), {}))", x, 1 + random_.below(4));
      case 18:
        return fmt::format("LANG({}) = \"en\"", x);
      case 19:
        return fmt::format("DATATYPE({})", x);
      case 20:
        return fmt::format("{}({})", random_.pick(kRounding), x);
      case 21:
        return fmt::format("REGEX(STR({}), \"^[a-m]\", \"i\")", x);
      case 22:
        return fmt::format("sameTerm({}, {})", x, y);
      default:
        return fmt::format("REPLACE(STR({}), \"[aeiou]\", \"*\")", x);
    }
  }

  // Of values alone: SPARQL leaves the order of IRIs and of texts in a language to the engine.
  std::string ordering() {
    constexpr const char* kValues[] = {"1", "2", "-1", "0.5", "1.5", "true", "\"arm\"", "\"1\""};
    const char* value = random_.pick(kValues);
    return fmt::format("?v {} {}", random_.pick(kComparisons), value);
  }

  std::string nested(const Scope& scope, int depth) {
    return depth > 1 ? expression(scope, depth - 1)
                     : pair("{} = {}", [&] { return operand(scope, 0); });
  }

  std::string operand(const Scope& scope, int depth) {
    if (depth > 1 && random_.chance(15)) return "(" + expression(scope, depth - 1) + ")";
    if (random_.chance(5)) return "?unbound";
    return random_.chance(65) ? random_.pick(scope) : random_.pick(kLiterals);
  }

  // A function's arguments are computed in an order that is the compiler's choice, and draws are
  // not: nothing here draws twice in one call. The second of a pair is drawn first.
  template <typename Draw>
  static std::string pair(const char* format, Draw draw) {
    const std::string second = draw();
    const std::string first = draw();
    return fmt::format(fmt::runtime(format), first, second);
  }

  // ---- scopes ----

  static void merge(Scope& scope, const Scope& others) {
    for (const std::string& variable : others) {
      if (std::ranges::find(scope, variable) == scope.end()) scope.push_back(variable);
    }
  }
  // At least one of them.
  Scope some(const Scope& scope) {
    Scope chosen;
    for (const std::string& variable : scope) {
      if (random_.chance(50)) chosen.push_back(variable);
    }
    if (chosen.empty()) chosen.push_back(random_.pick(scope));
    return chosen;
  }

  static constexpr const char* kNodeVariables[] = {"?a", "?b", "?c", "?d"};
  static constexpr const char* kLiteralVariables[] = {"?v", "?v", "?w"};
  static constexpr const char* kRounding[] = {"ABS", "CEIL", "FLOOR", "ROUND"};
  Random random_;
  int graph_;
  int fresh_ = 0;
  bool sets_ = false;      // each solution comes once
  bool any_path_ = false;  // see path()
};

}  // namespace

Case make_case(int number) {
  return QueryMaker(static_cast<std::uint64_t>(number), number % kGraphs).make();
}

}  // namespace sinew::rdf::differential
