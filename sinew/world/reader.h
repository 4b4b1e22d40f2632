// Reading on behalf of a component: whoever is no user of a measurement does not get it, nor an
// answer that is made from it, by whatever way he asks.
//
//   Reader task(world, rights, "http://cell/task-controller", audit);
//   PreparedPose grasp = task.prepare_pose({.of = part, .with_respect_to = tool});
//   … grasp.latest_realtime(now) …
//
// What is judged, and when:
//
//   queries, spaces    by all measurements that the plan may use, constants among them, when it is
//                      prepared and when the structure gives it a new plan; never while it answers.
//                      When the rights change (participant.h), what was prepared is judged again,
//                      and answers Status::kForbidden from then on where it may not.
//   single values      each time
//   triggers           when they are added, and when the rights change
//   graphs, scenes     when they are taken; what he may not read is left out, and named
//
// Facts that say where things are (`on`, `near`: qualitative_facts.h) are read by whoever may read
// every measurement that they come from. What rules derived (situation_rules.h) may come from such
// facts: where one of them is left out, the graph of derived facts is left out as a whole, and he
// may apply the rules to his copy.
//
// What is refused is an Error with the measurement's IRI, who asked, and who would get it. Names,
// frames, relations and what measures them by whom are symbolic: they are read by everybody, but
// for measurements that one may not read. The owner of the World itself asks nobody.
//
// A reader must not outlive the world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/world/authority.h"
#include "sinew/world/query_program.h"
#include "sinew/world/scene.h"
#include "sinew/world/triggers.h"
#include "sinew/world/uncertain_path.h"
#include "sinew/world/world.h"

namespace sinew::world {

class FactHistory;

// The name of the unnamed graph in rights.
inline constexpr std::string_view kUnnamedGraph = "https://w3id.org/sinew/world#UnnamedGraph";

// Facts with a life of their own: what is asked, or changed, in the store is nobody else's.
struct JudgedFacts {
  graph::Store store;
  // IRIs of measurements and graphs that are left out, sorted.
  std::vector<std::string> left_out;
};

// A trigger's condition on behalf of a reader. What it may not read makes it false.
struct JudgedCondition {
  std::function<bool(const class Reader& reader, Stamp now)> holds;
};
struct JudgedTrigger {
  std::variant<OnChange, OnStructure, JudgedCondition, Cyclic> when;
  int priority = 0;
  std::function<void(const Event&)> callback = {};
};

class Reader {
 public:
  // By rights of its own, or by those that are in force.
  Reader(const World& world, Rights rights, std::string who,
         std::shared_ptr<Audit> audit = nullptr);
  Reader(const World& world, std::shared_ptr<Authority> authority, std::string who);
  const std::string& who() const { return who_; }

  // ---- queries ----
  PreparedPose prepare_pose(const PoseQuery& query) const;
  PreparedMotion prepare_motion(const PoseQuery& query) const;
  PoseAnswer pose(FrameId of, FrameId with_respect_to, Stamp now) const;
  DistributedPose pose_distribution(const PoseQuery& query, const Uncertainties& known, Stamp now,
                                    const CombineOptions& options = {}) const;
  DistributedPose pose_distribution_at(const PoseQuery& query, const Uncertainties& known,
                                       Stamp time, const CombineOptions& options = {}) const;
  UncertainPose uncertain_pose(const PoseQuery& query, const Uncertainties& known, Stamp now,
                               Order order = Order::kFourth) const;
  PoseProgram pose_program(const PoseQuery& query, graph::Store& store,
                           std::string_view name) const;

  // ---- single measurements ----
  World::Sample latest(MeasurementId measurement, Stamp now) const;
  World::Sample at(MeasurementId measurement, Stamp time) const;
  History history(MeasurementId measurement) const;
  Status read_blocks(MeasurementId measurement, std::span<const World::BlockBuffer> buffers,
                     Stamp* stamp = nullptr) const;
  Status read_blocks_at(MeasurementId measurement, Stamp time,
                        std::span<const World::BlockBuffer> buffers) const;
  // The model itself, to predict with: as good as reading.
  std::shared_ptr<const MeasurementModel> model(MeasurementId measurement) const;

  // ---- triggers ----
  // Of `triggers` on the same world. OnChange is judged as reading is.
  TriggerId listen(Triggers& triggers, JudgedTrigger trigger,
                   std::shared_ptr<EventQueue> listener) const;

  // ---- the graph ----
  // For SPARQL, traversal and property graphs: a copy of the world's graph as it is now, without
  // graphs that he may not read and without what is said of, or follows from, measurements that he
  // may not read.
  JudgedFacts facts() const;
  // The same of the past.
  JudgedFacts facts_at(const FactHistory& history, Stamp time) const;

  // ---- scenes ----
  // As write_scene, without the values of measurements that he may not read: each is a warning.
  void write_scene(const DeclaredScene& scene, graph::Store& store, Report& report,
                   SceneWriting options = {}) const;

 private:
  friend class Space;
  friend class Participant;
  WantedReading wanted(MeasurementId measurement) const;
  void ask(MeasurementId measurement) const;
  UncertaintyGuard uncertainty_guard() const;
  bool may_read(MeasurementId measurement) const;
  struct Hidden;
  Hidden hidden(const graph::View& facts) const;
  JudgedFacts judged(const graph::View& facts) const;
  void hide_what_follows(graph::Store& store) const;

  const World* world_;
  std::string who_;
  std::shared_ptr<Authority> authority_;
  std::shared_ptr<const PlanGuard> guard_;
};

}  // namespace sinew::world
