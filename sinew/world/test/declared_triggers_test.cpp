// Triggers that models declare: what is read, what is refused with its place, who is told and when,
// and that they are saved as they were declared.
#include "sinew/world/declared_triggers.h"

#include <gtest/gtest.h>

#include "sinew/model/load.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/rdf/turtle/writer.h"
#include "sinew/world/copy_declarations.h"
#include "sinew/world/qualitative_facts.h"
#include "sinew/world/scene.h"

namespace sinew::world {
namespace {

const std::string kTask = "http://x/task", kOther = "http://x/other", kCamera = "http://x/camera";

Stamp at_ms(int milliseconds) { return Stamp(std::chrono::milliseconds(milliseconds)); }

const std::string kPrefixes =
    "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
    "@prefix shape: <https://w3id.org/sinew/shape#> .\n"
    "@prefix unit: <http://qudt.org/vocab/unit/> . @prefix qudt: <http://qudt.org/schema/qudt/> .\n"
    "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
    "@prefix rel: <https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> .\n"
    "@prefix c: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .\n";

// A cup that a camera sees, for the task alone, and a table.
const std::string kTable =
    "x:a a geom:Frame . x:b a geom:Frame .\n"
    "x:table a w:Object ; w:attached-to x:a ; w:shaped-as [ a shape:Box ; shape:size (1.0 1.0 0.1) "
    ";"
    " c:as-seen-by x:a ; qudt:unit unit:M ] .\n"
    "x:cup a w:Object ; w:attached-to x:b ; w:shaped-as [ a shape:Box ; shape:size (0.1 0.1 0.1) ;"
    " c:as-seen-by x:b ; qudt:unit unit:M ] .\n"
    "x:pose a rel:Pose ; rel:of x:b ; rel:with-respect-to x:a ; w:measured-by x:seen .\n"
    "x:seen a w:Measurement ; w:life-cycle \"time-dependent\" ; w:provenance x:camera ;"
    " w:used-by x:task .\n";

const std::string kTriggers =
    "x:t-change a w:Trigger ; w:on-change x:seen ; w:action x:look ; w:priority 5 ; w:who x:task "
    ".\n"
    "x:t-edit a w:Trigger ; w:on-structure true ; w:action x:plan .\n"
    "x:t-ask a w:Trigger ; w:on-condition \"PREFIX x: <http://x/> PREFIX w: "
    "<https://w3id.org/sinew/world#> ASK { GRAPH ?g { x:cup w:on x:table } }\" ; w:action x:grasp "
    ".\n"
    "x:t-near a w:Trigger ; w:threshold [ w:measures \"distance\" ; w:maximum 200.0 ;"
    " qudt:unit unit:MilliM ] ; w:first x:cup ; w:second x:table ; w:action x:slow ; w:who x:task "
    ".\n"
    "x:t-clock a w:Trigger ; w:every [ w:number 100.0 ; qudt:unit unit:MilliSEC ] ;"
    " w:action x:report ; w:priority -2 .\n";

struct Loaded {
  explicit Loaded(const std::string& text) {
    const model::Source source{"scene.ttl", kPrefixes + text};
    model::load({&source, 1}, {}, store, places, report);
    load_scene(world, store, places, report);
    if (report.has_errors()) return;
    scene = read_scene(world, store, places, report);
    triggers = read_triggers(world, scene, store, places, report);
  }
  const DeclaredTrigger& named(const std::string& iri) const {
    for (const DeclaredTrigger& each : triggers) {
      if (each.iri == iri) return each;
    }
    throw Error(Problem{{}, iri, "is no trigger", "", Severity::kError, {}});
  }
  graph::Store store;
  graph::Places places;
  Report report;
  World world;
  DeclaredScene scene;
  std::vector<DeclaredTrigger> triggers;
};

TEST(DeclaredTriggers, EveryOccasionIsRead) {
  const Loaded loaded(kTable + kTriggers);
  ASSERT_FALSE(loaded.report.has_errors()) << to_string(loaded.report.problems().front());
  ASSERT_EQ(loaded.triggers.size(), 5u);
  const DeclaredTrigger& change = loaded.named("http://x/t-change");
  EXPECT_EQ(std::get<OnChange>(change.when).measurement,
            loaded.world.find_measurement("http://x/seen"));
  EXPECT_EQ(change.action, "http://x/look");
  EXPECT_EQ(change.priority, 5);
  EXPECT_EQ(change.who, kTask);
  EXPECT_TRUE(std::holds_alternative<OnStructure>(loaded.named("http://x/t-edit").when));
  EXPECT_NE(std::get<AskedCondition>(loaded.named("http://x/t-ask").when).query.find("ASK"),
            std::string::npos);
  const auto& near = std::get<Threshold>(loaded.named("http://x/t-near").when);
  EXPECT_EQ(near.first, "http://x/cup");
  EXPECT_EQ(near.second, "http://x/table");
  EXPECT_DOUBLE_EQ(near.conditions.at(0).maximum, 0.2);
  const DeclaredTrigger& clock = loaded.named("http://x/t-clock");
  EXPECT_EQ(std::get<Cyclic>(clock.when).period, std::chrono::milliseconds(100));
  EXPECT_EQ(clock.priority, -2);
  EXPECT_EQ(to_string(clock, loaded.world), "every 0.1 s");
}

// What is called in what order, as the scene goes on.
TEST(DeclaredTriggers, AreToldToTheFunctionsThatAreBoundToTheirActions) {
  Loaded loaded(kTable + kTriggers);
  Access access(loaded.world, {});
  Triggers triggers(loaded.world);
  const auto queue = std::make_shared<EventQueue>();
  std::vector<std::string> called;
  TriggerActions actions;
  for (const char* action : {"look", "plan", "grasp", "slow", "nobody-asks"}) {
    actions["http://x/" + std::string(action)] = [&](const DeclaredTrigger& which, const Event&) {
      called.push_back(which.iri.substr(9));
    };
  }
  const BoundTriggers bound =
      bind_triggers(triggers, loaded.world, access, loaded.scene, loaded.triggers, actions, queue);
  EXPECT_EQ(bound.bound.size(), 4u);
  ASSERT_EQ(bound.open.size(), 1u) << "the clock's action has no function: it is listed";
  EXPECT_EQ(bound.open[0].iri, "http://x/t-clock");
  EXPECT_EQ(bound.unused, std::vector<std::string>{"http://x/nobody-asks"});

  Space space(loaded.world, loaded.world.find_frame("http://x/a"));
  add_bodies(space, loaded.scene);
  const Relations relations = relations_of(space, loaded.scene);
  const MeasurementId seen = loaded.world.find_measurement("http://x/seen");
  const auto go = [&](int milliseconds, const Vector3& position) {
    loaded.world.write(seen, at_ms(milliseconds), Pose{{}, position}, {kCamera});
    space.update(at_ms(milliseconds));
    state_facts(relations, space, loaded.world.graph());
    called.clear();
    triggers.look(at_ms(milliseconds));
    queue->run();
    return called;
  };
  using Called = std::vector<std::string>;
  EXPECT_EQ(go(10, {0, 0, 2}), Called{"t-change"});
  EXPECT_EQ(go(20, {0, 0, 0.2}), (Called{"t-change", "t-near"}));   // 0.1 m above it
  EXPECT_EQ(go(30, {0, 0, 0.105}), (Called{"t-change", "t-ask"}));  // on it; it was near already
  EXPECT_EQ(go(40, {0, 0, 2}), Called{"t-change"});
  loaded.world.add_frame("http://x/new");
  EXPECT_EQ(go(50, {0, 0, 0.2}), (Called{"t-change", "t-edit", "t-near"}));
}

TEST(DeclaredTriggers, OfWhoMayNotReadAreRefusedOrNeverTrue) {
  const auto of = [](std::string text, const std::string& who) {
    for (std::size_t at; (at = text.find("w:who x:task")) != std::string::npos;) {
      text.replace(at, 12, "w:who x:" + who);
    }
    return text;
  };
  const auto audit = std::make_shared<Audit>();
  const TriggerActions none;
  int called = 0;
  TriggerActions actions;
  actions["http://x/look"] =
      actions["http://x/slow"] = [&](const DeclaredTrigger&, const Event&) { ++called; };
  Loaded loaded(kTable + of(kTriggers, "other"));
  Access access(loaded.world, {}, audit);
  Triggers triggers(loaded.world);
  const auto queue = std::make_shared<EventQueue>();
  // A change: refused when it is bound, with the measurement.
  EXPECT_THROW(bind_triggers(triggers, loaded.world, access, loaded.scene,
                             {loaded.named("http://x/t-change")}, actions, queue),
               Error);
  EXPECT_EQ(audit->entries().back().what, "http://x/seen");
  EXPECT_EQ(audit->entries().back().who, kOther);
  // A threshold: nothing within it is ever seen.
  bind_triggers(triggers, loaded.world, access, loaded.scene, {loaded.named("http://x/t-near")},
                actions, queue);
  loaded.world.write(loaded.world.find_measurement("http://x/seen"), at_ms(10), Pose{}, {kCamera});
  triggers.look(at_ms(10));
  queue->run();
  EXPECT_EQ(called, 0);
  EXPECT_FALSE(audit->entries().back().accepted);
}

struct Fault {
  const char *name, *text, *says;
};
class TriggerFault : public testing::TestWithParam<Fault> {};

TEST_P(TriggerFault, HasAPlaceAndARemedy) {
  const Loaded loaded(kTable + GetParam().text);
  ASSERT_TRUE(loaded.report.has_errors());
  const std::string said = to_string(loaded.report.problems().front());
  EXPECT_TRUE(said.starts_with("scene.ttl:12")) << said;
  EXPECT_NE(said.find(GetParam().says), std::string::npos) << said;
  EXPECT_TRUE(loaded.triggers.empty());
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, TriggerFault,
    testing::Values(
        Fault{"NoAction", "x:t a w:Trigger ; w:on-structure true .", "what is to be done"},
        Fault{"NoOccasion", "x:t a w:Trigger ; w:action x:f .", "on 0 occasions"},
        Fault{"TwoOccasions",
              "x:t a w:Trigger ; w:action x:f ; w:on-structure true ; w:on-change x:seen .",
              "on 2 occasions"},
        Fault{"NoMeasurement", "x:t a w:Trigger ; w:action x:f ; w:on-change x:cup .",
              "is no measurement"},
        Fault{"NoAsk", "x:t a w:Trigger ; w:action x:f ; w:on-condition \"SELECT * {}\" .",
              "not true or false"},
        Fault{"NoQuery", "x:t a w:Trigger ; w:action x:f ; w:on-condition \"ASK {\" .",
              "of the text"},
        Fault{"NoUnit", "x:t a w:Trigger ; w:action x:f ; w:every [ w:number 1.0 ] .", "unit"},
        Fault{"NoTime",
              "x:t a w:Trigger ; w:action x:f ; w:every [ w:number 0.0 ; qudt:unit unit:SEC ] .",
              "0 ns"},
        Fault{"NoQuantity",
              "x:t a w:Trigger ; w:action x:f ; w:first x:cup ; w:second x:table ; w:threshold [ "
              "w:measures \"love\" ; qudt:unit unit:M ] .",
              "there is no quantity 'love'"},
        Fault{"NoBody",
              "x:t a w:Trigger ; w:action x:f ; w:first x:seen ; w:second x:table ; w:threshold [ "
              "w:measures \"distance\" ; qudt:unit unit:M ] .",
              "is no body"},
        Fault{"NoPriority",
              "x:t a w:Trigger ; w:action x:f ; w:on-structure true ; w:priority \"high\" .",
              "a priority of high"},
        Fault{"NoName", "[] a w:Trigger ; w:action x:f ; w:on-structure true .", "without a name"}),
    [](const auto& info) { return info.param.name; });

TEST(DeclaredTriggers, HaveAsManyBoundsAsTheLimit) {
  std::string bounds;
  for (std::size_t i = 0; i <= kMaximumThresholds; ++i) {
    bounds += (i ? ", " : "") + std::string("[ w:measures \"distance\" ; w:maximum ") +
              std::to_string(i + 1) + ".0 ; qudt:unit unit:M ]";
  }
  const std::string text =
      "x:t a w:Trigger ; w:action x:f ; w:first x:cup ; w:second x:table ; w:threshold " + bounds;
  EXPECT_TRUE(Loaded(kTable + text + " .").report.has_errors());
  const std::string fewer = text.substr(0, text.rfind(", ["));
  EXPECT_FALSE(Loaded(kTable + fewer + " .").report.has_errors());
}

// Saved beside the scene, in the words of the context, and read back: the same models.
TEST(DeclaredTriggers, AreSavedAsTheyWereDeclared) {
  const std::string components =
      "x:task a w:Component ; w:reads x:seen . x:camera a w:Component ; w:writes x:seen .\n";
  const Loaded loaded(kTable + kTriggers + components);
  graph::Store saved;
  Report report;
  write_scene(loaded.world, loaded.scene, saved, report);
  copy_declarations(loaded.store, saved);
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = scene_contexts();
  options.prefixes = {{"x", "http://x/"}};
  const std::string text = jsonld::Writer(catalogue, options).write_all(saved.view());
  EXPECT_NE(text.find("\"on-change\": \"x:seen\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"every\": {"), std::string::npos) << text;

  const model::Source source{"saved.jsonld", text};
  graph::Store again;
  graph::Places places;
  Report fresh;
  model::load({&source, 1}, {}, again, places, fresh);
  graph::Store terms;
  std::vector<graph::Quad> sides[2];
  for (int i = 0; i < 2; ++i) {
    const graph::Store& side = i == 0 ? saved : again;
    rdf::read_rdf(
        rdf::write_rdf(rdf::quads_of(side.view()), rdf::Syntax::kNTriples, side.terms()),
        rdf::Syntax::kNTriples, {"side.nt", "", {}}, terms.terms(),
        [&, i](const graph::Quad& quad, std::size_t, std::size_t) { sides[i].push_back(quad); });
  }
  const rdf::Comparison comparison = rdf::compare_quads(sides[0], sides[1], terms.terms());
  EXPECT_TRUE(comparison) << comparison.difference;
  World world;
  load_scene(world, again, places, fresh);
  const DeclaredScene scene = read_scene(world, again, places, fresh);
  const auto triggers = read_triggers(world, scene, again, places, fresh);
  ASSERT_FALSE(fresh.has_errors()) << to_string(fresh.problems().front());
  ASSERT_EQ(triggers.size(), loaded.triggers.size());
  for (const DeclaredTrigger& trigger : triggers) {
    EXPECT_EQ(to_string(trigger, world), to_string(loaded.named(trigger.iri), loaded.world));
    EXPECT_EQ(trigger.priority, loaded.named(trigger.iri).priority);
    EXPECT_EQ(trigger.who, loaded.named(trigger.iri).who);
    EXPECT_EQ(trigger.action, loaded.named(trigger.iri).action);
  }
}

}  // namespace
}  // namespace sinew::world
