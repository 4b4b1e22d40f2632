// Where things are: shapes of objects, of frames and of named areas, placed in one frame by the
// world's poses, and which of them are within a region.
//
//   Space space(world, cell);                            // everything is placed in `cell`
//   const BodyId part = space.add(object, {{Box{{0.1, 0.1, 0.2}}, {}}});
//   space.add_area("http://cell/storage-magazine", shelf, {{Box{{0.6, 0.4, 0.5}}, {}}});
//   space.update(now);
//   space.within("http://cell/storage-magazine", Match::kInside).bodies
//
// `update` reads the poses of frames of which something was written since (change_board.h), or that
// time itself changes (predictions, expiry), and changes the index where something has left its
// box; queries answer as of the last update. Poses are read one frame after the other, all for the
// same `now`. What has no pose is in no answer and is named in each: `unplaced`.
//
// One Space is used by one thread at a time; the world may be written meanwhile by any other. The
// world stays where it is for as long as the Space lives. Structural edits are followed: objects
// that are removed leave it, and those that are attached elsewhere move, with the next update.
#pragma once

#include <memory>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/world/shape.h"
#include "sinew/world/space_index.h"
#include "sinew/world/world.h"

namespace sinew::world {

class Reader;

struct BodyId {
  Index index = kNone;
  constexpr explicit operator bool() const { return index != kNone; }
  friend constexpr auto operator<=>(BodyId, BodyId) = default;
};

enum class Match : std::uint8_t {
  kTouching,  // a shape of the body and one of the region overlap or touch
  kInside,    // every shape of the body is inside one shape of the region
};

struct RegionAnswer {
  Status status = Status::kNoData;  // of the region's own pose; kOk where there is an answer
  std::vector<BodyId> bodies;       // in the order in which they were added
  std::vector<BodyId> unplaced;     // bodies whose pose is not known
};

// A box in the index is this much larger than the body on every side [m]: what moves by less leaves
// the index as it is.
inline constexpr double kIndexMargin = 0.05;
inline constexpr std::size_t kMaximumBodyShapes = 1000;

class Space {
 public:
  // Where a pose has expired, Policy::kFilter leaves the body unplaced.
  Space(const World& world, FrameId frame, Policy policy = Policy::kInform);
  // On behalf of a component: what it may not read has no place, with Status::kForbidden. Its
  // rights are asked when a frame is first placed, and at the next update after structural edits or
  // a change of the rights.
  Space(const Reader& reader, FrameId frame, Policy policy = Policy::kInform);

  // Shapes are described in the frame of the object, or in the given one. A body has the IRI of its
  // object or frame, which has one body at most. Throws Error for shapes that are none.
  BodyId add(ObjectId object, std::vector<Shape> shapes);
  BodyId add(FrameId frame, std::vector<Shape> shapes);
  // Areas are regions with a name: they are asked for, and are in no answer.
  BodyId add_area(std::string_view iri, FrameId frame, std::vector<Shape> shapes);
  void remove(BodyId body);

  struct Update {
    std::size_t moved = 0;       // bodies whose pose is another one than before
    std::size_t reinserted = 0;  // of these, how many the index had to move
    std::size_t unplaced = 0;
  };
  Update update(Stamp now);

  // Error where something is to be inside an open mesh.
  RegionAnswer within(FrameId frame, const std::vector<Shape>& region, Match match) const;
  RegionAnswer within(BodyId area, Match match) const;
  RegionAnswer within(std::string_view area_iri, Match match) const;  // Error where there is none

  BodyId find(std::string_view iri) const;  // bodies and areas; index kNone where there is none
  std::string name(BodyId body) const;
  std::vector<BodyId> bodies() const;  // without areas
  FrameId frame() const { return frame_; }
  const World& world() const { return *world_; }
  Stamp as_of() const { return as_of_; }
  // Of the last update: the body's frame in frame(), and its shapes seen from there.
  PoseAnswer pose(BodyId body) const;
  const std::vector<Shape>& shapes(BodyId body) const;
  FrameId frame_of(BodyId body) const;
  bool is_placed(BodyId body) const;
  Status status(BodyId body) const;  // kOk when it is placed, or why it is not
  // Another frame of the world in frame(), at the time of the last update.
  PoseAnswer pose_of(FrameId frame) const;
  // What the places of these were read from, constants too: whoever may not read one of them may
  // not learn where they are. Each once.
  std::vector<MeasurementId> read_for(std::span<const BodyId> bodies, FrameId frame = {}) const;

 private:
  struct Place {  // a frame that bodies are attached to
    FrameId frame;
    std::optional<PreparedPose> query;  // none: whoever asks may not
    PoseAnswer answer = {};
    Stamp read_at = {};
    std::vector<Index> bodies = {};
    bool is_stale = true;  // to be read at the next update
    bool moved = false;
  };
  // Cells whose counts lie side by side, and the places that depend on each.
  struct Watched {
    const ChangeCount* count;
    std::uint32_t seen;
    Index place;
  };
  struct Recheck {  // when time changes the answer of a place that nobody writes
    Stamp at;
    Index place;
    Stamp read_at;  // of the reading that said so; another one since: of no meaning
    friend bool operator<(const Recheck& a, const Recheck& b) { return a.at > b.at; }
  };
  struct Body {
    std::string name;
    bool alive = false, area = false;
    ObjectId object = {};  // none: attached to the frame itself
    FrameId frame;
    Index place = kNone;  // of the frame; kNone: not looked up since the frame changed
    bool is_new = true;   // not yet placed, though its place may be known
    std::vector<Shape> described, placed = {};
    bool is_placed = false;
    bool is_indexed = false;
    Bounds3 indexed = {};  // its box in the index
  };
  BodyId insert(Body body);
  const Body& alive(BodyId body) const;
  Index add_place(FrameId frame);
  PreparedPose prepare(const PoseQuery& query) const;
  void follow_structure();
  void follow_rights();
  void plan_anew(Place& place) const;
  void watch_all();
  void mark_changed();
  void read(Index place);
  PoseAnswer aged(const Place& place) const;
  void list_unplaced();
  void place(Body& body, Index index, Update& counts);
  void take_out(Body& body, Index index);
  RegionAnswer search(const std::vector<Shape>& region, Match match, std::string_view iri) const;

  const World* world_;
  FrameId frame_;
  Policy policy_;
  Stamp as_of_;
  std::vector<Body> bodies_;
  std::vector<Bounds3> boxes_;    // of the placed shapes, by body
  std::vector<BodyId> unplaced_;  // bodies, not areas, that have no pose; in their order
  std::unordered_map<std::string, Index> by_name_;
  std::vector<Place> places_;
  std::unordered_map<Index, Index> place_of_;  // by frame
  std::uint64_t structure_ = 0;                // the world's, at the last update
  std::shared_ptr<const Reader> reader_;       // on whose behalf; null: the owner's
  std::uint64_t rights_ = 0;                   // how often they had changed, at the last update
  std::vector<Watched> watched_;               // in the order of their counts in memory
  std::vector<Index> always_;                  // places that are read at each update
  std::priority_queue<Recheck> rechecks_;
  std::vector<Index> stale_;  // places to be read at this update
  std::vector<Index> added_;  // bodies without a place yet
  bool is_watching_ = false;
  bool unplaced_changed_ = true;
  std::size_t unplaced_areas_ = 0;
  SpaceIndex index_;
  mutable std::vector<Index> candidates_;  // of one query; kept for the next
};

}  // namespace sinew::world
