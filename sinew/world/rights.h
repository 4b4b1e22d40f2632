// Who may write which measurement, relation or model, and who may read: access rights by provenance
// and by declared users.
//
//   Rights rights;
//   rights.allow("http://cell/planner", Act::kRelate, "http://cell/part");
//   auto audit = std::make_shared<Audit>();
//   enforce(world, rights, audit);
//   world.write(seen, stamp, X, {.provenance = "http://cell/robot"});  // Error: names both
//
// Without a rule, a measurement is written by whoever is declared as its provenance and by nobody
// else, and nobody changes relations or models. A rule that forbids is stronger than one that
// allows, and both are stronger than the declared provenance.
//
// A measurement that names its users (MeasurementModel::used_by) is read by them, by whoever is its
// provenance, and by nobody else; one that names none by everybody. Rules are stronger here as
// well. Whoever has the World itself asks nobody: it is its owner's, and components get a Reader
// (reader.h) or a Participant (participant.h).
//
// `enforce` puts itself where the world asks before each write (World::set_write_guard). Structure
// is changed through an Actor, which asks first; World::edit is for the process that owns the
// world. A clone keeps the rights and the audit of its original until it is given others.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/world/audit.h"
#include "sinew/world/world.h"

namespace sinew::world {

inline constexpr std::string_view kAnything = "https://w3id.org/sinew/world#Anything";
inline constexpr std::size_t kMaximumRules = 1u << 16;

class Rights {
 public:
  // `what` is the IRI of a measurement; of a relation or a frame that is attached; of an object; or
  // kAnything. Throws Error when there are kMaximumRules, or a name is empty.
  void allow(std::string_view who, Act act, std::string_view what);
  void forbid(std::string_view who, Act act, std::string_view what);

  // Why not, with the names of both; nothing where it is allowed. `provenance` is that of a
  // measurement, empty for anything else.
  std::optional<std::string> reason_against(std::string_view who, Act act, std::string_view what,
                                            std::string_view provenance = {}) const;
  // The same of reading; `users` and `provenance` are the measurement's.
  std::optional<std::string> reason_against_reading(std::string_view who, std::string_view what,
                                                    std::span<const std::string> users,
                                                    std::string_view provenance) const;
  // Of a graph of the world's store (reader.h): everybody reads it, unless a rule forbids it, or
  // rules name who may.
  std::optional<std::string> reason_against_graph(std::string_view who,
                                                  std::string_view graph) const;
  std::size_t size() const { return rules_.size(); }

  // Of the measurement, or of kAnything: two that declare to write it are an error, not a warning
  // (check_configuration).
  void require_single_writer(std::string_view what);
  bool single_writer(std::string_view what) const;

 private:
  using Key = std::tuple<std::string, Act, std::string>;  // who, act, what
  void set(std::string_view who, Act act, std::string_view what, bool allowed);
  std::optional<bool> rule(std::string_view who, Act act, std::string_view what) const;
  std::map<Key, bool> rules_;
  std::set<std::string, std::less<>> single_writers_;
};

class Authority;

// From now on every write and claim is judged by a copy of these rights, and recorded if there is
// an audit. Claims that there are already are judged again: a handle that may not any more writes
// no more (Status::kForbidden).
void enforce(World& world, const Rights& rights, std::shared_ptr<Audit> audit = nullptr);

// Changes of the structure on behalf of a component. Each throws Error, with the element and the
// component, where the rights do not allow it; nothing is changed then.
class Actor {
 public:
  Actor(World& world, Rights rights, std::string who, std::shared_ptr<Audit> audit = nullptr);
  Actor(World& world, std::shared_ptr<Authority> authority, std::string who);

  RelationId add_relation(const RelationSpec& spec);
  void remove(RelationId relation);
  // The right to change the relations of `frame`.
  RelationId attach(FrameId frame, FrameId parent, Stamp now);
  RelationId detach(FrameId frame, FrameId parent, Stamp now);
  ObjectId add_object(std::string_view iri, FrameId frame, std::string_view model = {});
  void remove(ObjectId object);

 private:
  void ask(Act act, std::string_view what);
  World* world_;
  std::shared_ptr<Authority> authority_;
  std::string who_;
};

// ---- before anything runs ----

// A component says that it will write a measurement.
struct DeclaredWriter {
  std::string who, what;  // IRIs
  Place place = {};       // where it says so
};

// Finds what cannot work together, and reports each with its place:
//   error    a static measurement with a declared writer; a writer without the right; a writer of
//            what is no measurement of this world; several writers where one is required
//   warning  a measurement that changes and that nobody declares to write; several writers of one
void check_configuration(const World& world, const Rights& rights,
                         std::span<const DeclaredWriter> writers, Report& report);

}  // namespace sinew::world
