// What a world says of itself conforms to its domain, whatever was done to it, and in whatever
// order it was made.
#include "sinew/world/world_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "random_poses.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/edit.h"
#include "sinew/world/fact_history.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

std::vector<std::string> faults(World& world) {
  Report report;
  graph::check(world.graph().view(), world_domain(world.graph().terms()), {}, report);
  std::vector<std::string> found;
  for (const Problem& problem : report.problems()) found.push_back(to_string(problem));
  return found;
}

std::set<std::string> texts(World& world) {
  std::set<std::string> all;
  const graph::Terms& terms = world.graph().terms();
  for (const graph::Quad& fact : facts_of(world.graph().view())) {
    all.insert(terms.to_string(fact.subject) + terms.to_string(fact.predicate) +
               terms.to_string(fact.object));
  }
  return all;
}

// What a world of ten frames in a chain is made of: each step needs those that it names.
struct Step {
  std::string name;
  std::vector<std::string> needs;
  std::function<void(World&)> make;
};

std::vector<Step> steps(const std::vector<Pose>& poses) {
  std::vector<Step> all;
  const auto iri = [](const char* kind, std::size_t i) {
    return "http://x/" + std::string(kind) + std::to_string(i);
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string frame = iri("frame", i), object = iri("object", i);
    all.push_back({frame, {}, [frame](World& world) { world.add_frame(frame); }});
    all.push_back({object, {frame}, [=](World& world) {
                     world.add_object(object, world.find_frame(frame), "http://x/model");
                   }});
    if (i == 0) continue;
    const std::string relation = iri("relation", i), measurement = iri("measurement", i),
                      before = iri("frame", i - 1);
    all.push_back({relation, {frame, before}, [=](World& world) {
                     world.add_relation({.name = relation,
                                         .of = world.find_frame(frame),
                                         .with_respect_to = world.find_frame(before)});
                   }});
    all.push_back({measurement, {relation}, [=](World& world) {
                     world.add_measurement({.name = measurement,
                                            .relation = world.find_relation(relation),
                                            .model = {.provenance = "http://x/camera",
                                                      .used_by = {"http://x/task"}}});
                   }});
    const Pose pose = poses[i];
    all.push_back({iri("value", i), {measurement}, [=](World& world) {
                     world.write(world.find_measurement(measurement), at_s(1), pose,
                                 {"http://x/camera"});
                   }});
  }
  return all;
}

TEST(WorldDomain, TheOrderInWhichAWorldIsMadeMakesNoDifference) {
  std::mt19937_64 random(1);
  std::vector<Pose> poses;
  for (int i = 0; i < 10; ++i) poses.push_back(random_pose(random));
  std::set<std::string> first;
  Pose first_pose;
  for (int run = 0; run < 40; ++run) {
    std::vector<Step> open = steps(poses);
    std::shuffle(open.begin(), open.end(), random);
    World world;
    if (run % 2) world.graph();  // described from the start, or at the end: the same
    std::set<std::string> made;
    while (!open.empty()) {
      const auto next = std::find_if(open.begin(), open.end(), [&](const Step& step) {
        return std::all_of(step.needs.begin(), step.needs.end(),
                           [&](const std::string& name) { return made.contains(name); });
      });
      ASSERT_NE(next, open.end());
      next->make(world);
      made.insert(next->name);
      open.erase(next);
    }
    const PoseAnswer answer = world.pose(world.find_frame("http://x/frame9"),
                                         world.find_frame("http://x/frame0"), at_s(1));
    ASSERT_EQ(answer.status, Status::kOk);
    if (run == 0) first = texts(world), first_pose = answer.pose;
    ASSERT_EQ(texts(world), first) << run;
    ASSERT_EQ(difference(answer.pose, first_pose), 0) << run;
    EXPECT_TRUE(faults(world).empty());
  }
}

// Random edits, removals, attaching and detaching: the description always conforms.
TEST(WorldDomain, ADescriptionConformsWhateverIsDone) {
  std::mt19937_64 random(2);
  World world;
  std::vector<std::string> frames;
  for (int i = 0; i < 300; ++i) {
    const auto frame = [&] {
      return frames.empty() ? FrameId{} : world.find_frame(frames[random() % frames.size()]);
    };
    const std::string number = std::to_string(i);
    try {
      switch (random() % 8) {
        case 0:
        case 1:
          frames.push_back("http://x/f" + number);
          world.add_frame(frames.back());
          break;
        case 2:
          world.add_object("http://x/o" + number, frame());
          break;
        case 3:
        case 4:
          world.add_static("http://x/r" + number, frame(), frame(), random_pose(random), "me");
          break;
        case 5:
          world.attach(frame(), frame(), at_s(i), "http://x/me");
          break;
        case 6:
          world.detach(frame(), frame(), at_s(i), "http://x/me");
          break;
        default:
          world.remove(frame());
          break;
      }
    } catch (const Error&) {
      // Refused, which is an answer too: then it changes nothing.
    }
    const auto found = faults(world);
    ASSERT_TRUE(found.empty()) << i << ": " << found.front();
  }
}

TEST(WorldDomain, WhatLiesBesideItAndDoesNotConformIsFound) {
  World world;
  world.add_frame("http://x/table");
  graph::Transaction transaction = world.graph().begin();
  rdf::sparql::update(transaction, world.graph().terms(),
                      "PREFIX x: <http://x/> PREFIX rel: "
                      "<https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> "
                      "INSERT DATA { x:half a "
                      "rel:Pose ; rel:of x:table . x:odd a rel:Pose ; rel:of x:table ; "
                      "rel:with-respect-to x:sky }");
  transaction.commit();
  const auto found = faults(world);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].find("http://x/half: a https://comp-rob2b.github.io/metamodels/geometry/"
                          "spatial-relations#Pose has 0 of"),
            std::string::npos);
  EXPECT_NE(found[1].find("leads to http://x/sky, which is no"), std::string::npos);
}

}  // namespace
}  // namespace sinew::world
