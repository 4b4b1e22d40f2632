// What an action needs and what it leads to, as a model: conditions and effects in SPARQL on the
// world's graph and the models that lie beside it in the same store.
//
//   Actions actions;
//   actions.add({.name = "http://x/pick",
//                .parameters = {"http://x/part"},
//                .preconditions = {{"ASK { FILTER NOT EXISTS { x:gripper x:holds ?other } }",
//                                   "the gripper holds something"}},
//                .effect = "DELETE { ?part x:lies-on ?table } INSERT { x:gripper x:holds ?part }"
//                          "WHERE { w:this x:part ?part . ?part x:lies-on ?table }"});
//   actions.perform(world, {"http://x/pick", {{"http://x/part", "http://x/bolt"}}, who, now}, …);
//
// Preconditions: an ASK must be true; a SELECT must find nothing, and each row is a reason, with
// {x} in its message replaced by the value of ?x. The effect is a SPARQL update (w: must be
// declared in each text like every prefix; a text without GRAPH writes the unnamed graph).
//
// Arguments: while an action is judged and performed, `w:this` has a triple for each parameter, and
// `w:this a` the action. They lie in a graph of their own, kArgumentsGraph, which is empty before
// and after.
//
// The structure: each row of `attach` (SELECT ?frame ?parent) is attached, each of `detach`
// detached towards the parent, each of `add` (SELECT ?object ?frame ?model; ?model may be left out)
// becomes an object, each of `remove` (SELECT ?object) is none any more; as the situation before
// the effect has them, first what is removed and detached. What the world's description says
// follows from its structure, so an effect that changes it otherwise is refused.
//
// Performing is all of it, or nothing and an Error that names the action and every precondition
// that fails. Facts, description and structure change at one instant (situation.h). `predict` does
// the same in a clone, and hands it over. Both are audited.
//
// Threads: an action takes turns with edits, writes and clones of the world. Whoever else changes
// the store, as rules do, takes turns with actions (graph::Terms).
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/world/audit.h"
#include "sinew/world/fact_history.h"
#include "sinew/world/rights.h"
#include "sinew/world/world.h"

namespace sinew::world {

inline constexpr std::string_view kArgumentsGraph = "https://w3id.org/sinew/world#arguments";
inline constexpr std::string_view kThisAction = "https://w3id.org/sinew/world#this";
inline constexpr std::size_t kMaximumActions = 4096;
inline constexpr std::size_t kMaximumReasons = 100;  // of one refusal; the rest is counted in it

struct Precondition {
  std::string query;    // ASK or SELECT
  std::string message;  // why not, when it fails
};

struct ActionModel {
  std::string name;                          // IRI
  std::vector<std::string> parameters = {};  // IRIs of properties
  std::vector<Precondition> preconditions = {};
  std::string effect;       // SPARQL update
  std::string attach = {};  // SELECT ?frame ?parent, or nothing
  std::string detach = {};
  std::string add = {};  // SELECT ?object ?frame ?model, or nothing
  std::string remove = {};
};

struct ActionCall {
  std::string action;                            // IRI
  std::map<std::string, std::string> arguments;  // IRI of the parameter: IRI of the value
  std::string who;                               // provenance
  Stamp now = {};
};

// A triple in words, N-Triples terms; `graph` empty for the unnamed one.
struct FactText {
  std::string subject, predicate, object, graph;
  friend auto operator<=>(const FactText&, const FactText&) = default;
};

struct Attached {
  std::string frame, parent;  // IRIs
  friend auto operator<=>(const Attached&, const Attached&) = default;
};

struct ObjectAt {
  std::string object, frame, model;  // IRIs; of what is removed the first alone counts
  friend auto operator<=>(const ObjectAt&, const ObjectAt&) = default;
};

struct ActionOutcome {
  // What holds now and did not, and the other way round; the description of the structure apart.
  std::vector<FactText> begun, ended;
  std::vector<Attached> attached, detached;  // in the order of the rows
  std::vector<ObjectAt> added, removed;
  bool changes_structure() const {
    return !attached.empty() || !detached.empty() || !added.empty() || !removed.empty();
  }
};

struct PredictedAction {
  World world;  // a clone in which it was performed
  ActionOutcome outcome;
};

// Who watches over actions; all may be left out.
struct ActionSupervision {
  // Act::kPerform on the action's IRI, Act::kRelate on each frame that is attached or detached,
  // Act::kModel on each object that is added or removed.
  const Rights* rights = nullptr;
  std::shared_ptr<Audit> audit = nullptr;  // of both
  FactHistory* history = nullptr;          // observes what was performed, before and after
};

class Actions {
 public:
  // Throws Error with the action's name when a text is no ASK or SELECT, or no update, or does not
  // select ?frame and ?parent; when a
  // message names a variable that the SELECT does not have; when the name is taken, or there are
  // kMaximumActions.
  void add(ActionModel model);
  std::size_t size() const { return models_.size(); }

  // Throws Error when there is no such action, an argument is missing or too much, `who` has not
  // the right, a precondition fails, or the effect changes the description. Nothing is changed
  // then.
  ActionOutcome perform(World& world, const ActionCall& call,
                        const ActionSupervision& supervision = {}) const;
  // Whether it could be performed is part of the question: the same Errors. `world` stays as it is.
  // Nobody needs a right to ask.
  PredictedAction predict(const World& world, const ActionCall& call,
                          const ActionSupervision& supervision = {}) const;
  // All reasons against it now, in words; empty: it could be performed.
  std::vector<std::string> reasons_against(World& world, const ActionCall& call) const;

 private:
  const ActionModel& find(const std::string& name) const;
  std::map<std::string, ActionModel> models_;
};

}  // namespace sinew::world
