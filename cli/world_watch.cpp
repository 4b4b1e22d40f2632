#include "world_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "sinew/world/qualitative_facts.h"
#include "sinew/world/space.h"

namespace sinew::cli {
namespace {

std::string in_words(const world::DeclaredTrigger& trigger, const world::World& world) {
  std::string text = to_string(trigger, world);
  if (const auto* change = std::get_if<world::OnChange>(&trigger.when)) {
    text = "on change of " + short_name(world.name(change->measurement));
  }
  return text;
}

// What stands behind the '@' of a value; what is no number there is refused when it is written.
double time_of(const std::string& write, const SceneOptions& options) {
  const std::size_t at = write.rfind('@');
  return at == std::string::npos ? options.now_s.value_or(0) : std::atof(write.c_str() + at + 1);
}

// What is looked at, from the first value on.
struct Looking {
  LoadedScene& scene;
  world::Triggers triggers{scene.world};
  std::shared_ptr<world::EventQueue> queue = std::make_shared<world::EventQueue>();
  std::optional<world::Space> space;
  std::optional<world::Relations> relations;

  Looking(LoadedScene& of, const std::string& as) : scene(of) {
    if (!scene.declared.bodies.empty()) {
      space.emplace(scene.world, scene.root({}));
      add_bodies(*space, scene.declared);
      relations.emplace(relations_of(*space, scene.declared));
    }
    world::TriggerActions actions;
    std::vector<world::DeclaredTrigger> watched;
    for (const world::DeclaredTrigger& trigger : scene.triggers) {
      if (!as.empty() && trigger.who != scene.asker->who()) continue;
      watched.push_back(trigger);
      actions.try_emplace(trigger.action,
                          [this](const auto& which, const auto& event) { print(which, event); });
    }
    bind_triggers(triggers, scene.world, *scene.access, scene.declared, watched, actions, queue);
  }
  Looking(const Looking&) = delete;

  void print(const world::DeclaredTrigger& trigger, const world::Event& event) const {
    fmt::print("{:g} s  {}  {}{}: {}{}\n", world::seconds_of(event.now.time_since_epoch()),
               short_name(trigger.iri), in_words(trigger, scene.world),
               event.count > 1 ? fmt::format(", {} times", event.count) : "",
               short_name(trigger.action),
               trigger.who.empty() ? "" : " for " + short_name(trigger.who));
  }
  void look(world::Stamp now) {
    if (space) {
      space->update(now);
      state_facts(*relations, *space, scene.world.graph());
    }
    triggers.look(now);
    queue->run();
  }
};

}  // namespace

void show_triggers(const LoadedScene& scene) {
  if (scene.triggers.empty()) return;
  fmt::print("\ntriggers\n");
  for (const world::DeclaredTrigger& trigger : scene.triggers) {
    fmt::print("  {}  {}: {}, priority {}{}\n", short_name(trigger.iri),
               in_words(trigger, scene.world), short_name(trigger.action), trigger.priority,
               trigger.who.empty() ? "" : ", for " + short_name(trigger.who));
  }
}

int watch(const SceneOptions& options, const WatchOptions& watch) {
  SceneOptions in_order = options;
  std::stable_sort(in_order.writes.begin(), in_order.writes.end(),
                   [&](const std::string& a, const std::string& b) {
                     return time_of(a, options) < time_of(b, options);
                   });
  std::unique_ptr<Looking> looking;
  const auto begin = [&](LoadedScene& scene, world::Stamp now) {
    if (looking) return;
    looking = std::make_unique<Looking>(scene, options.as);
    looking->look(now);
  };
  // Values of the same time are one look.
  std::size_t written = 0;
  const auto is_last_of_its_time = [&] {
    const std::size_t at = written++;
    return at + 1 == in_order.writes.size() ||
           time_of(in_order.writes[at], options) != time_of(in_order.writes[at + 1], options);
  };
  const auto scene = load_world(in_order, begin, [&](LoadedScene&, world::Stamp now) {
    if (is_last_of_its_time()) looking->look(now);
  });
  begin(*scene, scene->now);
  if (watch.until_s) {
    const double from = world::seconds_of(scene->now.time_since_epoch());
    const double looks = std::floor((*watch.until_s - from) / watch.step_s + 1e-9);
    if (!(watch.step_s > 0) || !(looks <= static_cast<double>(kMaximumLooks))) {
      throw Error(Problem{{},
                          "--step",
                          fmt::format("{:g} s until {:g} s", watch.step_s, *watch.until_s),
                          fmt::format("a positive step, at most {} of them", kMaximumLooks),
                          Severity::kError,
                          {}});
    }
    for (double i = 1; i <= looks; ++i) {
      looking->look(world::Stamp(world::duration_of_seconds(from + i * watch.step_s)));
    }
  }
  looking.reset();  // before the scene that it looks at
  return kOk;
}

}  // namespace sinew::cli
