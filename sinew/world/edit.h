// Several changes of a world's structure as one: readers, and the graph, see all of them from
// `commit` on, or none. One edit at a time; another waits. An edit that is destroyed without commit
// leaves no trace.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "sinew/world/world.h"

namespace sinew::world {

class Edit {
 public:
  Edit(Edit&& other) noexcept = default;
  ~Edit();

  // As the World's functions of the same name.
  FrameId add_frame(std::string_view iri);
  ObjectId add_object(std::string_view iri, FrameId frame, std::string_view model = {});
  RelationId add_relation(const RelationSpec& spec);
  MeasurementId add_measurement(const MeasurementSpec& spec);
  MeasurementId add_static(std::string_view relation_iri, FrameId of, FrameId with_respect_to,
                           const Pose& pose, std::string_view provenance);
  void remove(FrameId frame);
  void remove(RelationId relation);
  void remove(MeasurementId measurement);
  void remove(ObjectId object);
  RelationId attach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance);
  RelationId detach(FrameId frame, FrameId parent, Stamp now, std::string_view provenance);
  // An object moves to another frame, without a change of any pose.
  void set_frame(ObjectId object, FrameId frame);
  // A relation as `attach` makes one, or leaves one behind: for scenes that are read back
  // (scene.h).
  void set_attachment(RelationId relation, bool is_attachment, bool is_suspended);
  // A first value for a measurement that this edit has added; nobody reads it yet.
  void set_value(MeasurementId measurement, Stamp stamp, std::span<const double> values);

  FrameId find_frame(std::string_view iri) const;  // index kNone where there is none
  ObjectId find_object(std::string_view iri) const;
  // The pose as this edit's structure has it.
  PoseAnswer pose(FrameId of, FrameId with_respect_to, Stamp now) const;
  const State& state() const { return next_; }

  void commit();
  // Together with what a transaction on the world's graph has changed: whoever asks for both at
  // once (World::situation), and whoever asks the graph alone, sees all of it or nothing.
  void commit_with(graph::Transaction& facts);

 private:
  friend class World;
  friend struct Merger;
  explicit Edit(std::shared_ptr<WorldImpl> world);
  Name new_name(std::string_view iri);
  Name new_name(std::string_view iri, std::uint32_t asked);  // Names::ask_for
  FrameRecord& to_change(FrameId frame);                     // throws unless it is alive
  // No other edit comes between; the edit's end lets the lock go.
  void commit_keeping_lock(graph::Transaction* facts = nullptr);
  // For the world's graph, which nobody makes while there is an edit.
  void touch(ElementKind kind, Index index) {
    if (described_) touched_.push_back({kind, index});
  }
  void unlink(Index relation, Index frame);
  RelationId attach_with(FrameId frame, FrameId parent, const Pose& pose, Stamp now,
                         std::string_view provenance);

  std::shared_ptr<WorldImpl> world_;
  std::unique_lock<std::mutex> lock_;
  State next_;
  EditToken token_;
  std::size_t old_measurements_;  // those with a higher number are this edit's own
  bool described_;                // there is a graph
  std::vector<Element> touched_;  // some more than once; of none if there is no graph
};

}  // namespace sinew::world
