// Triggers from models in a graph, with `w:` = https://w3id.org/sinew/world#
//
//   T a w:Trigger ; w:action N ; w:priority 5 ; w:who C ;  and one occasion:
//     w:on-change M                 an entry of the measurement is written or corrected
//     w:on-structure true           frames, relations, objects or measurements come, go or move
//     w:on-condition "ASK …"        it becomes true on the world's graph (situation.h)
//     w:threshold [ w:measures "distance" ; w:maximum 0.3 ; qudt:unit U ]… ; w:first A ; w:second B
//                                   all bounds come to hold between two bodies of the scene
//     w:every [ w:number 0.1 ; qudt:unit unit:SEC ]
//
// The quantities of a threshold are those of rules (qualitative.h), along the axes of the second
// body's frame. C is the component on whose behalf is looked: what it may not read makes no
// condition true, and a change that it may not read is refused. A trigger without w:who is its
// owner's.
//
// N names what is to be done. A model cannot say it: whoever runs the scene binds functions to
// names (`bind_triggers`). A scene may be run by several processes, each with functions of its
// own, so a name that nobody bound here is no error; it is listed as open.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/world/declared_scene.h"
#include "sinew/world/participant.h"
#include "sinew/world/triggers.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumThresholds = 64;  // bounds of one trigger

struct AskedCondition {
  std::string query;  // ASK
};
struct Threshold {
  std::string first, second;  // IRIs of bodies
  std::vector<Condition> conditions;
};
struct DeclaredTrigger {
  std::string iri;
  std::variant<OnChange, OnStructure, AskedCondition, Threshold, Cyclic> when;
  std::string action;  // IRI
  int priority = 0;
  std::string who = {};  // IRI; empty: the owner
};
// In a line: "on change of x:seen", "every 0.1 s", …
std::string to_string(const DeclaredTrigger& trigger, const World& world);

// For a world that load_scene has filled, and what read_scene found in the same models. What is
// wrong is in the report, with its place, and left out.
std::vector<DeclaredTrigger> read_triggers(const World& world, const DeclaredScene& scene,
                                           graph::Store& store, const graph::Places& places,
                                           Report& report);

// ---- from what is declared to what is called ----

using TriggerAction = std::function<void(const DeclaredTrigger&, const Event&)>;
using TriggerActions = std::map<std::string, TriggerAction>;  // by the action's IRI

struct BoundTriggers {
  std::vector<std::pair<TriggerId, DeclaredTrigger>> bound;
  std::vector<DeclaredTrigger> open;  // whose action has no function here
  std::vector<std::string> unused;    // actions that no trigger names
};
// Adds each to `triggers`, which is of the same world; their callbacks run as the queue's do. Who a
// trigger is for reads by `access`. Throws Error where that component may not read what it waits
// for, or a body has no shape. World, scene and access must outlive the triggers; nothing else may
// write the world's graph while they look (situation_rules.h).
BoundTriggers bind_triggers(Triggers& triggers, World& world, Access& access,
                            const DeclaredScene& scene,
                            const std::vector<DeclaredTrigger>& declared,
                            const TriggerActions& actions,
                            const std::shared_ptr<EventQueue>& queue);

}  // namespace sinew::world
