// The elements of a world by number: typed, so that a frame is not taken for a relation. Numbers
// are the same in a world and its clones and are never used again.
#pragma once

#include <cstdint>

namespace sinew::world {

using Index = std::uint32_t;
inline constexpr Index kNone = UINT32_MAX;

struct FrameId {
  Index index = kNone;
  constexpr explicit operator bool() const { return index != kNone; }
  friend constexpr auto operator<=>(FrameId, FrameId) = default;
};
struct ObjectId {
  Index index = kNone;
  constexpr explicit operator bool() const { return index != kNone; }
  friend constexpr auto operator<=>(ObjectId, ObjectId) = default;
};
struct RelationId {
  Index index = kNone;
  constexpr explicit operator bool() const { return index != kNone; }
  friend constexpr auto operator<=>(RelationId, RelationId) = default;
};
struct MeasurementId {
  Index index = kNone;
  constexpr explicit operator bool() const { return index != kNone; }
  friend constexpr auto operator<=>(MeasurementId, MeasurementId) = default;
};

}  // namespace sinew::world
