// What a component gets of a world: everything is judged by the rights that are in force, for
// whoever it is, and recorded. The World itself, with all that asks nobody, is given to nobody but
// its owner.
//
//   Access access(world, rights, audit);                       // the owner's
//   Participant task = access.participant("http://cell/task-controller");
//   task.read().prepare_pose(…)   task.write(seen, …)   task.change().attach(…)
//   access.change(other_rights);  // what was handed out is judged again
//
// A participant must not outlive the world; one that came from `clone` has its world itself.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "sinew/world/action_effects.h"
#include "sinew/world/authority.h"
#include "sinew/world/reader.h"
#include "sinew/world/rights.h"
#include "sinew/world/world.h"

namespace sinew::world {

class Participant {
 public:
  const std::string& who() const { return reader_.who(); }

  const Reader& read() const { return reader_; }
  Actor& change() { return actor_; }  // the structure

  // ---- writing, as itself ----
  Status write(MeasurementId measurement, Stamp stamp, const Pose& pose);
  Status write(MeasurementId measurement, Stamp stamp, std::span<const double> values);
  Status write_together(Stamp stamp, std::span<const World::Value> values);
  Status write_block(MeasurementId measurement, std::size_t block, Stamp stamp, const void* value,
                     std::size_t size);
  Writer claim(MeasurementId measurement);
  BatchWriter claim(std::span<const MeasurementId> measurements);
  // That it needs none of the first `count` entries any more; Error where it is no user.
  void done(MeasurementId measurement, const History& history, std::size_t count);

  // ---- actions ----
  ActionOutcome perform(const Actions& actions, const std::string& action,
                        std::map<std::string, std::string> arguments, Stamp now,
                        FactHistory* history = nullptr);
  struct Prediction;
  // What it would lead to, for the same participant to look at. It needs no right to ask. Why an
  // action is refused is said in its author's words, of whatever its preconditions look at; facts
  // that follow from measurements that it may not read are not there to be looked at.
  Prediction predict(const Actions& actions, const std::string& action,
                     std::map<std::string, std::string> arguments, Stamp now) const;

  // ---- names: symbolic, and nobody's secret ----
  FrameId find_frame(std::string_view iri) const { return world_->find_frame(iri); }
  RelationId find_relation(std::string_view iri) const { return world_->find_relation(iri); }
  MeasurementId find_measurement(std::string_view iri) const {
    return world_->find_measurement(iri);
  }
  ObjectId find_object(std::string_view iri) const { return world_->find_object(iri); }
  FrameId frame_of(ObjectId object) const { return world_->frame_of(object); }
  template <typename Id>
  const std::string& name(Id id) const {
    return world_->name(id);
  }

  // A world of its own from now on, in O(1), in which it may what it may here.
  Participant clone() const;

 private:
  friend class Access;
  Participant(World& world, std::shared_ptr<World> own, std::shared_ptr<Authority> authority,
              std::string who);
  World* world_;
  std::shared_ptr<World> own_;  // of a clone
  std::shared_ptr<Authority> authority_;
  Reader reader_;
  Actor actor_;
};

struct Participant::Prediction {
  Participant participant;  // in the world that the action would lead to
  ActionOutcome outcome;    // without facts of graphs that it may not read
};

// The owner's: makes participants, and changes what they may.
class Access {
 public:
  // The world must outlive it, where it is. Writing is enforced from now on (rights.h).
  Access(World& world, Rights rights, std::shared_ptr<Audit> audit = nullptr);
  Participant participant(std::string who);
  Rights rights() const { return authority_->rights(); }
  // Prepared queries, triggers, and claims of real-time handles are judged again: what may not any
  // more answers Status::kForbidden from then on. Clones that participants have are under the same
  // rights, but for claims in them.
  void change(const Rights& rights);

 private:
  World& world_;
  std::shared_ptr<Authority> authority_;
};

}  // namespace sinew::world
