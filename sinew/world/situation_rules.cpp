#include "sinew/world/situation_rules.h"

#include <algorithm>
#include <optional>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/message_text.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

using graph::Id;

rdf::sparql::Answer ask(const graph::View& view, graph::Terms& terms, const SituationRule& rule) {
  return rdf::sparql::query(view, terms, rule.query, {.name = rule.name, .base = {}});
}

}  // namespace

void SituationRules::add(SituationRule rule) {
  if (derive_.size() + find_.size() == kMaximumSituationRules) {
    refuse(rule.name, "more than " + std::to_string(kMaximumSituationRules) + " rules", "fewer");
  }
  // An empty store answers at once, and tells which kind of query it is.
  graph::Store empty;
  const auto answer = ask(empty.view(), empty.terms(), rule);
  if (answer.kind == rdf::sparql::AnswerKind::kBoolean) {
    refuse(rule.name, "an ASK tells only that something is so, not what",
           "a SELECT for findings, a CONSTRUCT for facts");
  }
  if (answer.kind == rdf::sparql::AnswerKind::kTriples) {
    if (!rule.message.empty()) {
      refuse(rule.name, "a message for derived facts", "a SELECT, or no message");
    }
    derive_.push_back(std::move(rule));
    return;
  }
  const auto& columns = answer.results.columns;
  const auto known = [&](const std::string& name) -> std::optional<std::string> {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) return std::nullopt;
    return name;
  };
  if (!filled_in(rule.message, known)) {
    refuse(rule.name, "its message names what the query does not select: " + rule.message,
           "{x} for a selected variable ?x");
  }
  find_.push_back(std::move(rule));
}

AppliedRules SituationRules::apply(graph::Store& store) const {
  graph::Terms& terms = store.terms();
  const Id derived = terms.iri(kDerivedGraph);
  graph::Transaction transaction = store.begin();
  transaction.clear(derived);
  AppliedRules situation;
  for (bool more = !derive_.empty(); more; ++situation.rounds) {
    if (situation.rounds == kMaximumRounds) {
      refuse(derive_.front().name,
             "facts go on following from facts after " + std::to_string(kMaximumRounds) + " rounds",
             "rules that make no new terms out of those they made");
    }
    more = false;
    for (const SituationRule& rule : derive_) {
      for (graph::Quad fact : ask(transaction.view(), terms, rule).triples) {
        // What is known is no new fact, wherever it is said.
        if (transaction.view().contains(fact.subject, fact.predicate, fact.object)) continue;
        fact.graph = derived;
        if (!transaction.add(fact)) continue;
        more = true;
        if (++situation.facts > kMaximumFacts) {
          refuse(rule.name, "more than " + std::to_string(kMaximumFacts) + " facts",
                 "a narrower rule");
        }
      }
    }
  }
  for (const SituationRule& rule : find_) {
    const rdf::sparql::Answer answer = ask(transaction.view(), terms, rule);
    for (const auto& row : answer.results.rows) {
      if (situation.findings.size() == kMaximumFindings) {
        refuse(rule.name, "more than " + std::to_string(kMaximumFindings) + " findings",
               "a narrower rule");
      }
      Finding finding{rule.name, {}, {}};
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i]) finding.values[answer.results.columns[i]] = terms.text(row[i]);
      }
      finding.message = *filled_in(rule.message, [&](const std::string& name) {
        const auto found = finding.values.find(name);
        return std::optional(found == finding.values.end() ? "(none)" : found->second);
      });
      situation.findings.push_back(std::move(finding));
    }
  }
  transaction.commit();
  return situation;
}

}  // namespace sinew::world
