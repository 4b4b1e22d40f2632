#include "world_scene.h"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <set>

#include "robot_tree.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/model/normalise.h"
#include "sinew/world/robot.h"
#include "sinew/world/robot_shapes.h"

namespace sinew::cli {
namespace {

using world::Index;

[[noreturn]] void refuse(const std::string& name, std::string what, std::string remedy) {
  throw Error(Problem{{}, name, std::move(what), std::move(remedy), Severity::kError, {}});
}

// One of `iris`, by the names that people use.
std::string find(const std::string& name, const std::vector<std::string>& iris,
                 const std::map<std::string, std::string>& labels, const char* kind) {
  if (std::find(iris.begin(), iris.end(), name) != iris.end()) return name;
  std::set<std::string> found;
  for (const std::string& iri : iris) {
    const auto label = labels.find(iri);
    if (short_name(iri) == name || (label != labels.end() && label->second == name)) {
      found.insert(iri);
    }
  }
  if (found.size() == 1) return *found.begin();
  std::string list;
  for (const std::string& iri :
       found.empty() ? std::set<std::string>(iris.begin(), iris.end()) : found) {
    if (list.size() > 400) {
      list += ", …";
      break;
    }
    list += (list.empty() ? "" : ", ") + (found.empty() ? short_name(iri) : iri);
  }
  refuse(name,
         found.empty() ? std::string("is no ") + kind + " of this scene"
                       : std::string("is the name of several: ") + kind,
         list.empty() ? "the scene has none" : "one of " + list);
}

std::vector<double> numbers(const std::string& text, const std::string& option) {
  std::vector<double> result;
  const char *at = text.data(), *const end = at + text.size();
  while (true) {
    double value = 0;
    const auto [rest, fault] = std::from_chars(at, end, value);
    if (fault != std::errc() || (rest != end && *rest != ',')) {
      refuse(option, "'" + text + "' is no list of numbers", "numbers with commas between them");
    }
    result.push_back(value);
    if (rest == end) return result;
    at = rest + 1;
  }
}

world::MeshFiles meshes_of(const SceneOptions& options) {
  world::MeshFiles meshes{.packages = {}, .directory = options.mesh_directory};
  for (const std::string& package : options.packages) {
    const std::size_t equals = package.find('=');
    if (equals == 0 || equals == std::string::npos) {
      refuse("--package", "'" + package + "' names no directory", "NAME=DIRECTORY");
    }
    meshes.packages[package.substr(0, equals)] = package.substr(equals + 1);
  }
  return meshes;
}

// Data blocks of scenes are in the block language.
std::shared_ptr<const data::Library> read_library(const std::string& text) {
  return std::make_shared<const data::Library>(blocks::load_library(text, "data blocks"));
}

void add_the_robot(const SceneOptions& options, LoadedScene& scene) {
  if (options.robots.empty()) return;
  if (options.robot_provenance.empty()) {
    refuse("--robot", "it is not said who measures the robot's joints",
           "--robot-provenance, with the IRI of whoever provides the joint positions");
  }
  ModelOptions files = options.models;
  files.files = options.robots;
  const auto models = load(files);
  const model::Tree tree = robot_tree(*models, {});
  world::add_robot(scene.world, tree, models->store.terms(),
                   {.provenance = options.robot_provenance});
  Report report;
  scene.robot_bodies = world::read_robot_shapes(scene.world, models->store, models->places, report,
                                                meshes_of(options));
  print_notes(report);
  for (const auto& body : tree.bodies) {
    scene.robot_frames.emplace(models->store.terms().text(body.frame));
  }
  for (const auto& frame : tree.frames) {
    scene.robot_frames.emplace(models->store.terms().text(frame.iri));
  }
}

// "MEASUREMENT=x,y,z,qx,qy,qz,qw@12.5"
void write(const std::string& text, const SceneOptions& options, LoadedScene& scene,
           const AtWrite& before, const AtWrite& after) {
  const std::size_t equals = text.rfind('=');
  const std::size_t at = text.find('@', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos) {
    refuse("--write", "'" + text + "' writes nothing", "MEASUREMENT=numbers[@seconds]");
  }
  const world::MeasurementId measurement = scene.measurement(text.substr(0, equals));
  std::vector<double> values =
      numbers(text.substr(equals + 1, at == std::string::npos ? at : at - equals - 1), "--write");
  const world::State state = scene.world.state();
  if (state.measurements[measurement.index].quantity == world::Quantity::kPose) {
    if (values.size() != 7) {
      refuse(scene.world.name(measurement),
             "is a pose, and " + std::to_string(values.size()) + " numbers are written",
             "seven: x,y,z in metres, then the quaternion qx,qy,qz,qw");
    }
    std::rotate(values.begin(), values.begin() + 3, values.end());  // the world's own order
  }
  double seconds = options.now_s.value_or(0);
  if (at != std::string::npos) seconds = numbers(text.substr(at + 1), "--write").front();
  const world::Stamp stamp(world::duration_of_seconds(seconds));
  if (before) before(scene, stamp);
  const std::string who =
      options.as.empty() ? scene.world.model(measurement)->provenance : options.as;
  const world::Status status = scene.world.write(measurement, stamp, values, {who});
  if (status != world::Status::kOk) {
    refuse(scene.world.name(measurement), "is not written: " + std::string(to_string(status)),
           "finite numbers, a quaternion of unit length, and a measurement that is not static");
  }
  if (after) after(scene, stamp);
}

// The time of the last entry of all that changes.
world::Stamp last_stamp(const world::World& world) {
  world::Stamp last = {};
  const world::State state = world.state();
  for (Index i = 0; i < state.measurements.size(); ++i) {
    const auto& record = state.measurements[i];
    if (!record.alive || std::holds_alternative<world::Static>(record.model->life_cycle)) continue;
    const auto sample = world.latest(world::MeasurementId{i}, {});
    if (sample.status != world::Status::kNoData) last = std::max(last, sample.bounds.newest);
  }
  return last;
}

// A frame to which the scene gives shapes of its own has those.
void add_robot_bodies(LoadedScene& scene) {
  for (world::DeclaredBody& body : scene.robot_bodies) {
    const auto& all = scene.declared.bodies;
    const bool is_there =
        std::any_of(all.begin(), all.end(), [&](const auto& each) { return each.iri == body.iri; });
    if (!is_there) scene.declared.bodies.push_back(body);
  }
}

}  // namespace

std::string short_name(const std::string& iri) {
  const std::size_t cut = iri.find_last_of("#/");
  return cut == std::string::npos ? iri : iri.substr(cut + 1);
}

void add_scene_options(CLI::App& app, SceneOptions& options) {
  add_model_options(app, options.models);
  app.add_option(
         "--robot", options.robots,
         "Model file of the scene's robot (may be repeated); its joints are then relations, "
         "measured by JOINT/position")
      ->allow_extra_args(false);
  app.add_option("--robot-provenance", options.robot_provenance,
                 "IRI of who provides the joint positions");
  app.add_option("--write", options.writes,
                 "MEASUREMENT=numbers[@seconds]: written before anything is asked; a pose is "
                 "x,y,z,qx,qy,qz,qw. May be repeated")
      ->allow_extra_args(false);
  app.add_option(
      "--as", options.as,
      "IRI or name of the component that writes and asks: what it may not read it is not "
      "told (default: each measurement's declared provenance writes, and the owner asks)");
  app.add_option("--package", options.packages,
                 "NAME=DIRECTORY: the root of package://NAME/ in the files of meshes. May be "
                 "repeated")
      ->allow_extra_args(false);
  app.add_option("--mesh-directory", options.mesh_directory,
                 "Directory of meshes whose path is relative");
  app.add_option("--now", options.now_s,
                 "The time for which is asked, in seconds (default: that of the last entry)");
}

world::FrameId LoadedScene::frame(const std::string& name) const {
  const world::State state = world.state();
  std::vector<std::string> iris;
  for (Index i = 0; i < state.frames.size(); ++i) {
    if (state.frames[i].alive) iris.push_back(world.name(world::FrameId{i}));
  }
  // An object stands for the frame that it is attached to.
  std::map<std::string, world::FrameId> of_object;
  for (Index i = 0; i < state.objects.size(); ++i) {
    if (!state.objects[i].alive) continue;
    iris.push_back(world.name(world::ObjectId{i}));
    of_object[iris.back()] = {state.objects[i].frame};
  }
  const std::string found = find(name, iris, declared.labels, "frame or object");
  const auto object = of_object.find(found);
  return object == of_object.end() ? world.find_frame(found) : object->second;
}

world::MeasurementId LoadedScene::measurement(const std::string& name) const {
  const world::State state = world.state();
  std::vector<std::string> iris;
  for (Index i = 0; i < state.measurements.size(); ++i) {
    const auto& record = state.measurements[i];
    if (!record.alive) continue;
    const std::string& iri = world.name(world::MeasurementId{i});
    // A robot's joint positions are named by the joint: joint1/position.
    if (iri.ends_with("/" + name) || iri.ends_with("#" + name)) {
      return world::MeasurementId{i};
    }
    iris.push_back(iri);
  }
  return world.find_measurement(find(name, iris, declared.labels, "measurement"));
}

std::string LoadedScene::body(const std::string& name) const {
  std::vector<std::string> iris;
  for (const auto& body : declared.bodies) iris.push_back(body.iri);
  return find(name, iris, declared.labels, "object, frame or area with a shape");
}

world::FrameId LoadedScene::root(const std::string& name) const {
  if (!name.empty()) return frame(name);
  const world::State state = world.state();
  std::vector<bool> is_placed(state.frames.size());
  for (Index i = 0; i < state.relations.size(); ++i) {
    const auto& relation = state.relations[i];
    if (relation.alive && relation.kind != world::RelationKind::kProperty) {
      is_placed[relation.of] = true;
    }
  }
  std::vector<std::string> roots;
  for (Index i = 0; i < state.frames.size(); ++i) {
    if (state.frames[i].alive && !is_placed[i]) roots.push_back(world.name(world::FrameId{i}));
  }
  if (roots.size() == 1) return world.find_frame(roots.front());
  std::string list;
  for (const std::string& iri : roots) list += (list.empty() ? "" : ", ") + iri;
  refuse("--in",
         std::to_string(roots.size()) + " frames are placed by nothing" +
             (list.empty() ? "" : ": " + list),
         "say in which frame is asked");
}

std::unique_ptr<LoadedScene> load_world(const SceneOptions& options, const AtWrite& before,
                                        const AtWrite& after) {
  auto scene = std::make_unique<LoadedScene>();
  scene->models = load(options.models);
  add_the_robot(options, *scene);
  Report report;
  graph::Store& store = scene->models->store;
  load_scene(scene->world, store, scene->models->places, report, {.read_library = read_library});
  if (!report.has_errors()) {
    scene->declared =
        read_scene(scene->world, store, scene->models->places, report, meshes_of(options));
    add_robot_bodies(*scene);
    scene->rights = world::read_rights(store, scene->models->places, report);
    scene->triggers =
        world::read_triggers(scene->world, scene->declared, store, scene->models->places, report);
  }
  report.throw_if_errors();
  print_notes(report);
  scene->audit = std::make_shared<world::Audit>();
  scene->access = std::make_unique<world::Access>(scene->world, scene->rights.rights, scene->audit);
  SceneOptions resolved = options;
  if (!options.as.empty()) {
    const auto& known = scene->rights.components;
    resolved.as = find(options.as, {known.begin(), known.end()}, {}, "component");
    scene->asker = std::make_unique<world::Participant>(scene->access->participant(resolved.as));
  }
  for (const std::string& text : options.writes) write(text, resolved, *scene, before, after);
  scene->now = options.now_s ? world::Stamp(world::duration_of_seconds(*options.now_s))
                             : last_stamp(scene->world);
  return scene;
}

}  // namespace sinew::cli
