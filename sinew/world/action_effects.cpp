#include "sinew/world/action_effects.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/edit.h"
#include "sinew/world/impl.h"
#include "sinew/world/message_text.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

using graph::Id;
using rdf::sparql::AnswerKind;

rdf::sparql::Answer ask(const graph::View& view, graph::Terms& terms, const std::string& name,
                        const std::string& query) {
  return rdf::sparql::query(view, terms, query, {.name = name, .base = {}});
}

void check_arguments(const ActionModel& model, const ActionCall& call) {
  for (const std::string& parameter : model.parameters) {
    const auto found = call.arguments.find(parameter);
    if (found == call.arguments.end() || found->second.empty()) {
      refuse(model.name, "no value for its parameter " + parameter, "the IRI of one");
    }
  }
  for (const auto& [parameter, value] : call.arguments) {
    if (std::find(model.parameters.begin(), model.parameters.end(), parameter) ==
        model.parameters.end()) {
      refuse(model.name, "a value for " + parameter + ", which is no parameter of it",
             "those that its model has");
    }
  }
}

void put_arguments(graph::Transaction& transaction, graph::Terms& terms, const ActionModel& model,
                   const ActionCall& call) {
  const Id graph = terms.iri(kArgumentsGraph), self = terms.iri(kThisAction);
  transaction.clear(graph);
  transaction.add({self, terms.iri(graph::kRdfType), terms.iri(model.name), graph});
  for (const auto& [parameter, value] : call.arguments) {
    transaction.add({self, terms.iri(parameter), terms.iri(value), graph});
  }
}

std::vector<std::string> failed(const graph::View& view, graph::Terms& terms,
                                const ActionModel& model) {
  std::vector<std::string> reasons;
  std::size_t more = 0;
  const auto add = [&](std::string reason) {
    reasons.size() < kMaximumReasons ? reasons.push_back(std::move(reason)) : void(++more);
  };
  for (const Precondition& precondition : model.preconditions) {
    const rdf::sparql::Answer answer = ask(view, terms, model.name, precondition.query);
    if (answer.kind == AnswerKind::kBoolean) {
      if (!*answer.results.boolean) add(precondition.message);
      continue;
    }
    for (const auto& row : answer.results.rows) {
      add(*filled_in(precondition.message, [&](const std::string& name) {
        const auto& columns = answer.results.columns;
        const auto at = std::find(columns.begin(), columns.end(), name) - columns.begin();
        const Id value = row[static_cast<std::size_t>(at)];
        return std::optional(value ? std::string(terms.text(value)) : "(none)");
      }));
    }
  }
  if (more > 0) reasons.push_back("and " + std::to_string(more) + " more");
  return reasons;
}

FactText text_of(const graph::Terms& terms, const graph::Quad& fact) {
  return {terms.to_string(fact.subject), terms.to_string(fact.predicate),
          terms.to_string(fact.object), fact.graph ? terms.to_string(fact.graph) : ""};
}

// What a query says the structure is to become: a row for each, a text for each of `names`, of
// which the last ones need not be bound.
std::vector<std::vector<std::string>> rows_of(const graph::View& view, graph::Terms& terms,
                                              const ActionModel& model, const std::string& query,
                                              std::initializer_list<const char*> names,
                                              std::size_t needed) {
  std::vector<std::vector<std::string>> found;
  if (query.empty()) return found;
  const rdf::sparql::Answer answer = ask(view, terms, model.name, query);
  const auto& columns = answer.results.columns;
  for (const auto& row : answer.results.rows) {
    std::vector<std::string>& texts = found.emplace_back();
    for (const char* name : names) {
      const auto column = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                                   columns.begin());
      const Id value = column < row.size() ? row[column] : Id{};
      if (!value && texts.size() < needed) {
        refuse(model.name,
               "?" + std::string(name) + " is not bound in a row that changes the structure",
               "a value in each row");
      }
      texts.push_back(value ? std::string(terms.text(value)) : std::string());
    }
  }
  return found;
}

std::vector<Attached> pairs(const graph::View& view, graph::Terms& terms, const ActionModel& model,
                            const std::string& query) {
  std::vector<Attached> found;
  for (auto& row : rows_of(view, terms, model, query, {"frame", "parent"}, 2)) {
    found.push_back({std::move(row[0]), std::move(row[1])});
  }
  return found;
}

std::vector<ObjectAt> objects(const graph::View& view, graph::Terms& terms,
                              const ActionModel& model, const std::string& query) {
  std::vector<ObjectAt> found;
  const std::size_t needed = &query == &model.add ? 2 : 1;
  for (auto& row : rows_of(view, terms, model, query, {"object", "frame", "model"}, needed)) {
    found.push_back({std::move(row[0]), std::move(row[1]), std::move(row[2])});
  }
  return found;
}

FrameId frame_of(const Edit& edit, const ActionModel& model, const std::string& iri) {
  const FrameId frame = edit.find_frame(iri);
  if (!frame)
    refuse(model.name, "it attaches or detaches " + iri + ", which is no frame", "a frame");
  return frame;
}

void ask_to(const Rights* rights, const ActionCall& call, Act act, const std::string& what) {
  if (!rights) return;
  if (const auto reason = rights->reason_against(call.who, act, what)) {
    refuse(what, *reason, "a rule that allows " + call.who + " to " + std::string(to_string(act)));
  }
}

// In one world. `rights`: of who performs it; null: nobody is asked.
ActionOutcome perform_in(World& world, const ActionModel& model, const ActionCall& call,
                         const Rights* rights) {
  graph::Store& store = world.graph();
  graph::Terms& terms = store.terms();
  // First the world's lock, then the store's, as every edit takes them; one that is not committed
  // leaves no trace.
  Edit edit = world.edit();
  const std::vector<graph::Quad> before = facts_of(store.view());
  graph::Transaction transaction = store.begin();
  put_arguments(transaction, terms, model, call);
  const std::vector<std::string> reasons = failed(transaction.view(), terms, model);
  if (!reasons.empty()) {
    std::vector<Problem> problems;
    for (const std::string& reason : reasons) {
      problems.push_back({{},
                          model.name,
                          "it cannot be performed: " + reason,
                          "a situation in which its precondition holds",
                          Severity::kError,
                          {}});
    }
    throw Error(std::move(problems));
  }
  ActionOutcome outcome;
  outcome.attached = pairs(transaction.view(), terms, model, model.attach);
  outcome.detached = pairs(transaction.view(), terms, model, model.detach);
  outcome.added = objects(transaction.view(), terms, model, model.add);
  outcome.removed = objects(transaction.view(), terms, model, model.remove);
  rdf::sparql::UpdateOptions options;
  options.name = model.name;
  rdf::sparql::update(transaction, terms, model.effect, options);
  transaction.clear(terms.iri(kArgumentsGraph));
  const FactChanges changes = changes_between(before, facts_of(transaction.view()));
  const Id description = terms.iri(world.impl().iri);
  for (const auto& [from, to] :
       {std::pair(&changes.begun, &outcome.begun), std::pair(&changes.ended, &outcome.ended)}) {
    for (const graph::Quad& fact : *from) {
      to->push_back(text_of(terms, fact));
      if (fact.graph == description) {
        refuse(model.name,
               "its effect changes what the world's structure says: " + to->back().subject + " " +
                   to->back().predicate + " " + to->back().object,
               "an effect on other facts; attach, detach and edits change the structure");
      }
    }
    std::sort(to->begin(), to->end());
  }
  for (const auto& [object, frame, kind] : outcome.removed) {
    ask_to(rights, call, Act::kModel, object);
    const ObjectId there = edit.find_object(object);
    if (!there) refuse(model.name, "it removes " + object + ", which is no object", "an object");
    edit.remove(there);
  }
  for (const auto& [frame, parent] : outcome.detached) {
    ask_to(rights, call, Act::kRelate, frame);
    edit.detach(frame_of(edit, model, frame), frame_of(edit, model, parent), call.now, call.who);
  }
  for (const auto& [frame, parent] : outcome.attached) {
    ask_to(rights, call, Act::kRelate, frame);
    edit.attach(frame_of(edit, model, frame), frame_of(edit, model, parent), call.now, call.who);
  }
  for (const auto& [object, frame, kind] : outcome.added) {
    ask_to(rights, call, Act::kModel, object);
    edit.add_object(object, frame_of(edit, model, frame), kind);
  }
  if (outcome.changes_structure()) {
    edit.commit_with(transaction);
  } else {
    transaction.commit();
  }
  return outcome;
}

// What `act` throws is recorded as the reason, and thrown on.
template <typename Perform>
auto audited(const ActionSupervision& supervision, Act act, const ActionCall& call,
             Perform&& perform) {
  AuditEntry entry{.act = act, .who = call.who, .what = call.action};
  try {
    auto result = perform();
    entry.accepted = true;
    if (supervision.audit) supervision.audit->record(std::move(entry));
    return result;
  } catch (const Error& error) {
    for (const Problem& problem : error.problems()) {
      entry.reason += (entry.reason.empty() ? "" : "; ") + problem.what;
    }
    if (supervision.audit) supervision.audit->record(std::move(entry));
    throw;
  }
}

}  // namespace

void Actions::add(ActionModel model) {
  if (model.name.empty()) refuse({}, "an action without a name", "its IRI");
  if (models_.contains(model.name)) {
    refuse(model.name, "there is an action of this name", "another IRI");
  }
  if (models_.size() == kMaximumActions) {
    refuse(model.name, "more than " + std::to_string(kMaximumActions) + " actions", "fewer");
  }
  graph::Store empty;  // answers at once, and tells which kind of query it is
  for (const Precondition& precondition : model.preconditions) {
    const auto answer = ask(empty.view(), empty.terms(), model.name, precondition.query);
    if (answer.kind == AnswerKind::kTriples) {
      refuse(model.name, "a precondition that makes triples", "an ASK, or a SELECT for reasons");
    }
    const auto& columns = answer.results.columns;
    const bool is_ask = answer.kind == AnswerKind::kBoolean;
    const auto known = [&](const std::string& name) -> std::optional<std::string> {
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) return std::nullopt;
      return name;
    };
    if (precondition.message.empty() || (!is_ask && !filled_in(precondition.message, known))) {
      refuse(model.name,
             "the message of its precondition is empty, or names what the query does not select: " +
                 precondition.message,
             "{x} for a selected variable ?x");
    }
  }
  const auto check_columns = [&](const std::string& query, const char* what,
                                 std::initializer_list<const char*> needed) {
    if (query.empty()) return;
    const auto columns = ask(empty.view(), empty.terms(), model.name, query).results.columns;
    std::string all;
    for (const char* name : needed) all += " ?" + std::string(name);
    for (const char* name : needed) {
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
        refuse(model.name, std::string(what) + " does not select ?" + name, "SELECT" + all);
      }
    }
  };
  check_columns(model.attach, "what it attaches or detaches", {"frame", "parent"});
  check_columns(model.detach, "what it attaches or detaches", {"frame", "parent"});
  check_columns(model.add, "what it adds", {"object", "frame"});
  check_columns(model.remove, "what it removes", {"object"});
  rdf::sparql::QueryOptions options;
  options.name = model.name;
  rdf::sparql::check_update(empty.terms(), model.effect, options);
  models_.emplace(model.name, std::move(model));
}

const ActionModel& Actions::find(const std::string& name) const {
  const auto found = models_.find(name);
  if (found == models_.end()) refuse(name, "there is no action of this name", "see Actions::add");
  return found->second;
}

ActionOutcome Actions::perform(World& world, const ActionCall& call,
                               const ActionSupervision& supervision) const {
  return audited(supervision, Act::kPerform, call, [&] {
    const ActionModel& model = find(call.action);
    check_arguments(model, call);
    if (supervision.rights) {
      if (const auto reason =
              supervision.rights->reason_against(call.who, Act::kPerform, call.action)) {
        refuse(call.action, *reason, "a rule that allows " + call.who + " to perform-action");
      }
    }
    if (supervision.history) supervision.history->observe(world.graph(), call.now);
    ActionOutcome outcome = perform_in(world, model, call, supervision.rights);
    if (supervision.history) supervision.history->observe(world.graph(), call.now);
    return outcome;
  });
}

PredictedAction Actions::predict(const World& world, const ActionCall& call,
                                 const ActionSupervision& supervision) const {
  return audited(supervision, Act::kPredict, call, [&] {
    const ActionModel& model = find(call.action);
    check_arguments(model, call);
    World clone = world.clone();
    ActionOutcome outcome = perform_in(clone, model, call, nullptr);
    return PredictedAction{std::move(clone), std::move(outcome)};
  });
}

std::vector<std::string> Actions::reasons_against(World& world, const ActionCall& call) const {
  const ActionModel& model = find(call.action);
  check_arguments(model, call);
  graph::Store& store = world.graph();
  graph::Transaction transaction = store.begin();  // taken back at the end
  put_arguments(transaction, store.terms(), model, call);
  return failed(transaction.view(), store.terms(), model);
}

}  // namespace sinew::world
