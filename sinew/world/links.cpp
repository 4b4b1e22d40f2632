#include "sinew/world/links.h"

namespace sinew::world {

// A counting sort by frame, which keeps the order of the relations.
Links::Links(const State& state) {
  const std::size_t frames = state.frames.size(), relations = state.relations.size();
  struct Ends {
    Index relation, of, with_respect_to;
  };
  std::vector<Ends> pairs;
  pairs.reserve(relations);
  ends_.assign(frames + 1, 0);
  for (std::size_t i = 0; i < relations; ++i) {
    const RelationRecord& relation = state.relations[i];
    if (!relation.alive || relation.kind == RelationKind::kProperty) continue;
    pairs.push_back({static_cast<Index>(i), relation.of, relation.with_respect_to});
    ++ends_[relation.of + 1];
    ++ends_[relation.with_respect_to + 1];
  }
  for (std::size_t frame = 0; frame < frames; ++frame) ends_[frame + 1] += ends_[frame];
  items_.resize(2 * pairs.size());
  std::vector<Index> next(ends_.begin(), ends_.end() - 1);
  for (const Ends& ends : pairs) {
    items_[next[ends.of]++] = {ends.relation, ends.with_respect_to};
    items_[next[ends.with_respect_to]++] = {ends.relation, ends.of};
  }
}

}  // namespace sinew::world
