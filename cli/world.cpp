// sinew world: a scene from models, and what it answers.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>

#include "output.h"
#include "prefixes.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/rdf/results/table.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/turtle/writer.h"
#include "sinew/world/copy_declarations.h"
#include "sinew/world/qualitative_facts.h"
#include "sinew/world/space.h"
#include "world_scene.h"
#include "world_watch.h"

namespace sinew::cli {
namespace {

using world::FrameId;
using world::Index;
using world::MeasurementId;
using world::RelationId;
using world::Status;

// What the verbs ask besides the scene.
struct Asked {
  std::string of, with_respect_to, in, area, viewer, relation, text, file, output;
  std::vector<std::string> judge;
  bool inside = false, why = false, uncertain = false, with_robot = false;
};

std::string seconds(world::Duration duration) {
  return duration == world::kForever ? "for ever"
                                     : fmt::format("{:g} s", world::seconds_of(duration));
}

bool is_of_robot(const LoadedScene& scene, const world::RelationRecord& relation) {
  const auto knows = [&](Index frame) {
    return scene.robot_frames.contains(scene.world.name(FrameId{frame}));
  };
  return knows(relation.of) && knows(relation.with_respect_to);
}

// ---- show ----

int show(LoadedScene& scene, const Asked&) {
  const world::World& world = scene.world;
  const world::State state = world.state();
  fmt::print("as of {:g} s\n\nobjects\n", world::seconds_of(scene.now.time_since_epoch()));
  for (Index i = 0; i < state.objects.size(); ++i) {
    const auto& object = state.objects[i];
    if (!object.alive) continue;
    fmt::print("  {}  attached to {}\n", world.name(world::ObjectId{i}),
               short_name(world.name(FrameId{object.frame})));
  }
  for (const auto& body : scene.declared.bodies) {
    if (body.kind != world::DeclaredKind::kArea) continue;
    const auto label = scene.declared.labels.find(body.iri);
    fmt::print("  {}  area at {}{}\n", body.iri, short_name(world.name(body.frame)),
               label == scene.declared.labels.end() ? "" : ", \"" + label->second + "\"");
  }
  fmt::print("\nrelations, and who measures them\n");
  for (Index i = 0; i < state.relations.size(); ++i) {
    const auto& relation = state.relations[i];
    if (!relation.alive || relation.with_respect_to == world::kNone) continue;
    // What is fixed within a robot is in the robot's own model.
    if (relation.kind == world::RelationKind::kFree && is_of_robot(scene, relation)) continue;
    fmt::print("  {}  {} with respect to {}{}\n", short_name(world.name(RelationId{i})),
               short_name(world.name(FrameId{relation.of})),
               short_name(world.name(FrameId{relation.with_respect_to})),
               relation.suspended ? ", suspended" : "");
    for (Index m = relation.first_measurement; m != world::kNone; m = state.measurements[m].next) {
      const auto& record = state.measurements[m];
      world::World::Sample sample;
      try {
        sample = scene.asker ? scene.asker->read().latest(MeasurementId{m}, scene.now)
                             : world.latest(MeasurementId{m}, scene.now);
      } catch (const Error&) {
        sample.status = Status::kForbidden;
      }
      std::string status(to_string(sample.status));
      if (sample.status == Status::kOk) {
        const bool is_static = std::holds_alternative<world::Static>(record.model->life_cycle);
        status = is_static ? "known" : sample.freshness.expires < scene.now ? "expired" : "fresh";
        if (!is_static) status += ", " + seconds(scene.now - sample.stamp) + " old";
      }
      fmt::print("    {}  {}, by {}: {}\n", short_name(world.name(MeasurementId{m})),
                 to_string(record.model->life_cycle), short_name(record.model->provenance), status);
    }
  }
  show_triggers(scene);
  return kOk;
}

// ---- pose ----

int pose(LoadedScene& scene, const Asked& asked) {
  const world::PoseQuery query = {.of = scene.frame(asked.of),
                                  .with_respect_to = scene.frame(asked.with_respect_to)};
  world::PreparedPose prepared =
      scene.asker ? scene.asker->read().prepare_pose(query) : scene.world.prepare_pose(query);
  const world::PoseAnswer answer = prepared.latest(scene.now);
  if (!answer) {
    std::string which;
    if (answer.bounds.measurement) which = " (" + scene.world.name(answer.bounds.measurement) + ")";
    std::cerr << scene.world.name(query.of) << ": its pose with respect to "
              << scene.world.name(query.with_respect_to)
              << " is not known: " << to_string(answer.status) << which << "\n";
    return kFault;
  }
  const auto& [q, p] = answer.pose;
  fmt::print("position    {:.9g} {:.9g} {:.9g} m\n", p.x, p.y, p.z);
  fmt::print("quaternion  {:.9g} {:.9g} {:.9g} {:.9g}\n", q.x, q.y, q.z, q.w);
  const world::Freshness& fresh = answer.freshness;
  fmt::print("freshness   currency {}, timeliness {}, {} updates missed, {:.0f} % still hold{}\n",
             seconds(fresh.currency), seconds(fresh.timeliness), fresh.obsolescence,
             100 * fresh.rate, fresh.predicted ? ", predicted" : "");
  if (fresh.expires < scene.now) {
    fmt::print("            expired {} ago\n", seconds(scene.now - fresh.expires));
  } else if (fresh.expires != world::Stamp::max()) {
    fmt::print("            holds for another {}\n", seconds(fresh.expires - scene.now));
  }
  if (asked.uncertain) {
    const auto known = uncertainties_of(scene.world, scene.declared);
    const auto uncertain = scene.asker ? scene.asker->read().uncertain_pose(query, known, scene.now)
                                       : uncertain_pose(scene.world, query, known, scene.now);
    if (!uncertain) {
      std::string names;
      for (const std::string& name : uncertain.undeclared) {
        names += (names.empty() ? "" : ", ") + name;
      }
      std::cerr << scene.world.name(query.of)
                << ": its uncertainty is not known; no covariance is declared of " << names
                << "; declare one, or w:Exact\n";
      return kFault;
    }
    const world::Covariance& S = uncertain.pose.covariance;
    fmt::print("deviation   {:.4g} {:.4g} {:.4g} rad, {:.4g} {:.4g} {:.4g} m, seen by {}\n",
               std::sqrt(S(0, 0)), std::sqrt(S(1, 1)), std::sqrt(S(2, 2)), std::sqrt(S(3, 3)),
               std::sqrt(S(4, 4)), std::sqrt(S(5, 5)), short_name(scene.world.name(query.of)));
  }
  if (asked.why) {
    for (const auto& step : prepared.symbolic()) {
      fmt::print("{:<16}{}  by {}{}\n", step.operation, short_name(step.relation),
                 short_name(step.measurement), step.constant ? ", constant" : "");
    }
  }
  return kOk;
}

// ---- space ----

world::Space space_of(LoadedScene& scene, const Asked& asked) {
  const FrameId root = scene.root(asked.in);
  world::Space space =
      scene.asker ? world::Space(scene.asker->read(), root) : world::Space(scene.world, root);
  add_bodies(space, scene.declared);
  space.update(scene.now);
  return space;
}

void name_unplaced(const world::Space& space, const std::vector<world::BodyId>& bodies) {
  for (const world::BodyId body : bodies) {
    std::cerr << space.name(body) << ": where it is is not known: " << to_string(space.status(body))
              << "\n";
  }
}

int within(LoadedScene& scene, const Asked& asked) {
  const world::Space space = space_of(scene, asked);
  const std::string area = scene.body(asked.area);
  const auto answer =
      space.within(area, asked.inside ? world::Match::kInside : world::Match::kTouching);
  if (answer.status != Status::kOk) {
    std::cerr << area << ": where it is is not known: " << to_string(answer.status) << "\n";
    return kFault;
  }
  for (const world::BodyId body : answer.bodies) std::cout << space.name(body) << "\n";
  name_unplaced(space, answer.unplaced);
  return kOk;
}

world::FrameId viewer_of(const LoadedScene& scene, const Asked& asked) {
  return asked.viewer.empty() ? FrameId{} : scene.frame(asked.viewer);
}

int relations(LoadedScene& scene, const Asked& asked) {
  const world::Space space = space_of(scene, asked);
  const world::Relations relations = relations_of(space, scene.declared);
  if (!asked.judge.empty()) {  // FIRST RELATION SECOND [THIRD]
    const auto body = [&](std::size_t i) {
      return asked.judge.size() > i ? space.find(scene.body(asked.judge[i])) : world::BodyId{};
    };
    const world::Judgement judgement = relations.judge({.relation = asked.judge[1],
                                                        .first = body(0),
                                                        .second = body(2),
                                                        .third = body(3),
                                                        .viewer = viewer_of(scene, asked)});
    std::cout << explain(judgement) << "\n";
    return judgement.status == Status::kOk ? kOk : kFault;
  }
  if (!asked.relation.empty()) relations.rule(asked.relation);  // refuses what is none
  graph::Store facts;
  const auto stated = state_facts(relations, space, facts, viewer_of(scene, asked));
  rdf::sparql::QueryOptions options;
  options.prefixes = &known_prefixes();
  const auto answer = rdf::sparql::query(
      facts.view(), facts.terms(),
      "SELECT ?first ?relation ?second ?third ?because WHERE { ?fact w:called ?relation ; "
      "w:first ?first ; w:second ?second ; w:because ?because "
      "OPTIONAL { ?fact w:third ?third } } ORDER BY ?first ?relation ?second",
      options);
  for (const auto& row : answer.results.rows) {
    const auto text = [&](std::size_t i) { return std::string(facts.terms().text(row[i])); };
    if (!asked.relation.empty() && text(1) != asked.relation) continue;
    if (asked.why) {
      std::cout << text(4) << "\n";
    } else {
      std::cout << short_name(text(0)) << " " << text(1) << " " << short_name(text(2))
                << (row[3] ? " and " + short_name(text(3)) : "") << "\n";
    }
  }
  for (const std::string& rule : stated.left_out) {
    if (!asked.relation.empty() && rule != asked.relation) continue;
    std::cerr << rule << ": left out, as nobody looks; name the frame of whoever does with "
              << "--viewer\n";
  }
  name_unplaced(space, stated.unplaced);
  return kOk;
}

// ---- rights ----

int rights(LoadedScene& scene, const Asked&) {
  Report report;
  check_configuration(scene.world, scene.rights.rights, scene.rights.writers, report);
  check_configuration(scene.world, scene.rights, report);
  for (const auto& writer : scene.rights.writers) {
    fmt::print("{} writes {}\n", short_name(writer.who), short_name(writer.what));
  }
  for (const auto& reader : scene.rights.readers) {
    fmt::print("{} reads {}\n", short_name(reader.who), short_name(reader.what));
  }
  for (const auto& entry : scene.audit->entries()) {
    fmt::print("{} {} {}: {}\n", short_name(entry.who), to_string(entry.act),
               short_name(entry.what), entry.accepted ? "allowed" : entry.reason);
  }
  for (const Problem& problem : report.problems()) std::cerr << to_string(problem) << "\n";
  return report.has_errors() ? kFault : kOk;
}

// ---- graph ----

int query(LoadedScene& scene, const Asked& asked) {
  if (asked.text.empty() == asked.file.empty()) {
    std::cerr << "sinew world query: give the SPARQL text with -e or -q\n";
    return kBadUsage;
  }
  // Models have values too: on behalf of a component, what is said of what it may read.
  std::optional<world::JudgedFacts> judged;
  if (scene.asker) judged = scene.asker->read().facts();
  graph::Store& store = judged ? judged->store : scene.models->store;
  if (judged) {
    for (const std::string& name : judged->left_out) {
      std::cerr << name << ": left out, as it is not for " << scene.asker->who() << "\n";
    }
  }
  if (!scene.declared.bodies.empty()) {
    const world::Space space = space_of(scene, asked);
    state_facts(relations_of(space, scene.declared), space, store, viewer_of(scene, asked));
  }
  rdf::sparql::QueryOptions options;
  options.name = asked.file;
  options.prefixes = &known_prefixes();
  const auto answer =
      rdf::sparql::query(store.view(), store.terms(),
                         asked.file.empty() ? asked.text : read_input(asked.file), options);
  if (answer.kind == rdf::sparql::AnswerKind::kTriples) {
    rdf::WriteOptions write_options;
    write_options.prefixes = known_prefixes();
    write_output(asked.output, rdf::write_rdf(answer.triples, rdf::Syntax::kTurtle, store.terms(),
                                              write_options));
  } else {
    write_output(asked.output, rdf::write_table(answer.results, store.terms(), known_prefixes()));
  }
  return kOk;
}

// A prefix for each namespace that several things of the scene are in: what stands before the '#'
// or
// '/' at its end.
std::vector<std::pair<std::string, std::string>> prefixes_of(const LoadedScene& scene) {
  std::map<std::string, int> count;
  const world::State state = scene.world.state();
  const auto add = [&](const std::string& iri) {
    const std::string space = iri.substr(0, iri.size() - short_name(iri).size());
    if (space.find("://") != std::string::npos) ++count[space];
  };
  for (Index i = 0; i < state.frames.size(); ++i) {
    if (state.frames[i].alive) add(scene.world.name(FrameId{i}));
  }
  for (Index i = 0; i < state.objects.size(); ++i) {
    if (state.objects[i].alive) add(scene.world.name(world::ObjectId{i}));
  }
  std::vector<std::pair<std::string, std::string>> prefixes;
  for (const auto& [space, uses] : count) {
    const std::string name = short_name(space.substr(0, space.size() - 1));
    const bool is_name = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
                         std::all_of(name.begin(), name.end(), [](unsigned char c) {
                           return std::isalnum(c) || c == '_' || c == '-';
                         });
    const bool is_taken = std::any_of(prefixes.begin(), prefixes.end(),
                                      [&](const auto& prefix) { return prefix.first == name; });
    if (uses > 1 && is_name && !is_taken) prefixes.emplace_back(name, space);
  }
  return prefixes;
}

int save(LoadedScene& scene, const Asked& asked) {
  const world::State state = scene.world.state();
  graph::Store out;
  Report report;
  world::SceneWriting writing;
  world::DeclaredScene declared = scene.declared;
  if (!asked.with_robot) {
    writing.leave_out = [&](RelationId id) {
      return is_of_robot(scene, state.relations[id.index]);
    };
    std::erase_if(declared.bodies, [&](const world::DeclaredBody& body) {
      return body.kind == world::DeclaredKind::kFrame && scene.robot_frames.contains(body.iri);
    });
  }
  if (scene.asker) {
    scene.asker->read().write_scene(declared, out, report, writing);
  } else {
    write_scene(scene.world, declared, out, report, writing);
  }
  world::copy_declarations(scene.models->store, out);
  print_notes(report);
  const bool turtle = asked.output.ends_with(".ttl");
  if (turtle || asked.output.ends_with(".trig")) {
    rdf::WriteOptions options;
    options.prefixes = known_prefixes();
    for (const auto& [name, space] : prefixes_of(scene)) options.prefixes.set(name, space);
    write_output(asked.output, rdf::write_rdf(rdf::quads_of(out.view()),
                                              turtle ? rdf::Syntax::kTurtle : rdf::Syntax::kTriG,
                                              out.terms(), options));
  } else {
    const catalogue::Catalogue catalogue;
    jsonld::WriteOptions options;
    options.contexts = world::scene_contexts();
    options.prefixes = prefixes_of(scene);
    write_output(asked.output, jsonld::Writer(catalogue, options).write_all(out.view()));
  }
  return kOk;
}

struct Verb {
  const char* name;
  const char* summary;
  int (*run)(LoadedScene&, const Asked&);
  void (*options)(CLI::App&, Asked&);
};

void add_in(CLI::App& app, Asked& asked) {
  app.add_option("--in", asked.in, "Frame in which is asked (default: the one nothing places)");
  app.add_option("--viewer", asked.viewer,
                 "Frame of who looks, x to the front, for left, right and in front as seen");
}

const Verb kVerbs[] = {
    {"show", "What there is, who measures it, and how fresh it is", show, nullptr},
    {"pose", "The pose of one frame with respect to another, and how fresh it is", pose,
     [](CLI::App& app, Asked& asked) {
       app.add_option("--of", asked.of, "The frame whose pose it is")->required();
       app.add_option("--wrt", asked.with_respect_to, "The frame it is seen from")->required();
       app.add_flag("--uncertainty", asked.uncertain, "Also its deviations, from covariances");
       app.add_flag("--why", asked.why, "Also the relations and measurements it is composed of");
     }},
    {"within", "What touches an area or a body, or is inside it", within,
     [](CLI::App& app, Asked& asked) {
       app.add_option("--area", asked.area, "Name or label of the area, or of a body")->required();
       app.add_flag("--inside", asked.inside, "Only what is inside as a whole");
       add_in(app, asked);
     }},
    {"relations", "Which qualitative relations hold: on, in, near, left-of, …", relations,
     [](CLI::App& app, Asked& asked) {
       app.add_option("--relation", asked.relation, "Only this one");
       app.add_option("--judge", asked.judge,
                      "FIRST RELATION SECOND [THIRD]: whether it holds, and by which numbers")
           ->expected(3, 4)
           ->option_text("TEXT x 3 or 4");
       app.add_flag("--why", asked.why, "With the numbers that make each true");
       add_in(app, asked);
     }},
    {"rights", "Who writes and reads what, and what does not fit together", rights, nullptr},
    {"query", "SPARQL on the scene's models and the relations that hold", query,
     [](CLI::App& app, Asked& asked) {
       app.add_option("-e,--expression", asked.text,
                      "SPARQL text; w: and the other prefixes are known");
       app.add_option("-q,--query-file", asked.file, "File with SPARQL text");
       app.add_option("-o,--output", asked.output, "File for the answer");
       add_in(app, asked);
     }},
    {"save",
     "The scene as a model again, with the last value of every measurement, rights and triggers",
     save,
     [](CLI::App& app, Asked& asked) {
       app.add_flag("--with-robot", asked.with_robot,
                    "Also the robot's frames, joints and shapes, so that the file stands alone");
       app.add_option(
           "-o,--output", asked.output,
           "FILE.jsonld, FILE.trig, or FILE.ttl where nothing is in named graphs (default: "
           "JSON-LD on standard output)");
     }},
};

}  // namespace

int run_world(Arguments arguments) {
  CLI::App app(
      "A scene from models, and what it answers.\n\n"
      "Frames (or what is attached to them), areas and measurements are named by IRI, by label, or "
      "by what follows the "
      "last '#' or '/' of the IRI.",
      "sinew world");
  app.require_subcommand(1);
  SceneOptions options;
  Asked asked;
  for (const Verb& verb : kVerbs) {
    CLI::App* const command = app.add_subcommand(verb.name, verb.summary);
    add_scene_options(*command, options);
    if (verb.options) verb.options(*command, asked);
  }
  WatchOptions watching;
  CLI::App* const watched = app.add_subcommand(
      "watch", "What the scene's triggers would do while --write values come, one after the other");
  add_scene_options(*watched, options);
  watched->add_option("--until", watching.until_s,
                      "Look on until then, in seconds (default: until the last value)");
  watched->add_option("--step", watching.step_s, "Seconds between two looks after it");
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (app.got_subcommand(watched)) {
    const int code = watch(options, watching);
    std::fflush(stdout);
    return code;
  }
  const auto scene = load_world(options);
  for (const Verb& verb : kVerbs) {
    if (!app.got_subcommand(verb.name)) continue;
    const int code = verb.run(*scene, asked);
    std::fflush(stdout);
    return code;
  }
  return kBadUsage;
}

}  // namespace sinew::cli
