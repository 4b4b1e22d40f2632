// The planner and the evaluator against the standard's own definition, on random queries.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/algebra/translate.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/sparql/syntax/parser.h"
#include "sinew/rdf/sparql/test/random_query.h"
#include "sinew/rdf/sparql/test/reference.h"
#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

std::vector<graph::Quad> all_quads(const graph::Store& store) {
  std::vector<graph::Quad> quads;
  const auto keep = [&](const graph::Quad& quad) {
    quads.push_back(quad);
    return true;
  };
  store.view().match({}, {}, {}, graph::Dataset::kDefault, keep);
  store.view().match_named({}, {}, {}, keep);
  return quads;
}

// Empty when both agree. What the reference finds too large is left out.
std::string difference(unsigned seed, bool* compared) {
  RandomQuery random(seed);
  Table table(random.data());
  const std::string text = random.query();
  syntax::Query parsed;
  try {
    parsed = syntax::parse_query(table.store.terms(), text);
  } catch (const Error&) {
    return {};  // a random text may use a variable twice in BIND
  }
  const algebra::Query query = algebra::translate(parsed);
  reference::Reference reference(all_quads(table.store), table.store.terms());
  const auto expected = reference.rows(query);

  QueryOptions options;
  options.dataset = graph::Dataset::kDefault;
  auto got = sparql::query(table.store.view(), table.store.terms(), text, options).results.rows;
  std::sort(got.begin(), got.end());
  *compared = !expected.empty();
  if (got == expected) return {};
  std::string message = "seed " + std::to_string(seed) + "\n" + text + "\n";
  const auto add = [&](const char* title, const std::vector<std::vector<graph::Id>>& rows) {
    message += title;
    for (const auto& row : rows) {
      for (const graph::Id id : row) message += "  " + table.name(id);
      message += "\n";
    }
  };
  add("expected:\n", expected);
  add("got:\n", got);
  return message + explain(table.store.view(), table.store.terms(), text, options);
}

TEST(Equivalence, RandomQueriesMeanWhatTheStandardSays) {
  const char* const from = std::getenv("SINEW_RANDOM_SEED");
  const char* const rounds = std::getenv("SINEW_RANDOM_ROUNDS");
  const unsigned first = from ? static_cast<unsigned>(std::atoi(from)) : 1;
  const unsigned count = rounds ? static_cast<unsigned>(std::atoi(rounds)) : 3000;
  unsigned with_rows = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    bool compared = false;
    const std::string found = difference(seed, &compared);
    with_rows += compared ? 1 : 0;
    ASSERT_EQ(found, "");
  }
  // Most queries must have solutions, or nothing is tested.
  if (!from) {
    EXPECT_GT(with_rows, count / 4);
  }
}

}  // namespace
}  // namespace sinew::rdf::sparql
