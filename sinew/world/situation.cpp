#include "sinew/world/situation.h"

#include "sinew/world/impl.h"
#include "sinew/world/symbols.h"

namespace sinew::world {

Situation World::situation() {
  graph();  // from now on there is one
  const std::lock_guard instant(impl_->instant);
  return {impl_->symbols->store.snapshot(), impl_->published(),
          impl_->structure.load(std::memory_order_acquire), impl_};
}

PoseAnswer Situation::pose(FrameId of, FrameId with_respect_to, Stamp now) const {
  const auto plan = make_plan(
      structure, world->family->names, [this](std::uint64_t owner) { return world->as_of(owner); },
      {.of = of, .with_respect_to = with_respect_to}, false, structure_version);
  PoseAnswer answer;
  read_latest(*plan, now, Policy::kInform, answer);
  return answer;
}

}  // namespace sinew::world
