// A scene from the command line: models in a world, with the robots that belong to it, values that
// are written before anything is asked, and the names by which things are asked for.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "options.h"
#include "pipeline.h"
#include "sinew/world/audit.h"
#include "sinew/world/declared_rights.h"
#include "sinew/world/declared_triggers.h"
#include "sinew/world/participant.h"
#include "sinew/world/scene.h"

namespace sinew::cli {

struct SceneOptions {
  ModelOptions models;
  std::vector<std::string> robots;  // model files of one robot
  std::string robot_provenance;
  std::vector<std::string> writes;  // "MEASUREMENT=numbers[@seconds]"
  std::string as;  // who writes and asks; empty: each measurement's own provenance, and the owner
  std::vector<std::string> packages;  // "NAME=DIRECTORY", of meshes
  std::string mesh_directory;
  std::optional<double> now_s;
};
void add_scene_options(CLI::App& app, SceneOptions& options);

struct LoadedScene {
  std::unique_ptr<Models> models;
  world::World world;
  world::DeclaredScene declared;
  world::DeclaredRights rights;
  std::shared_ptr<world::Audit> audit;
  world::Stamp now;
  std::set<std::string> robot_frames;             // IRIs
  std::vector<world::DeclaredBody> robot_bodies;  // of its collision geometry
  std::vector<world::DeclaredTrigger> triggers;
  std::unique_ptr<world::Access> access;
  std::unique_ptr<world::Participant> asker;  // on whose behalf is asked; null: the owner's

  // By IRI, by label, or by what follows the last '#' or '/' of the IRI. Throws Error where there
  // is none, or several.
  world::FrameId frame(const std::string& name) const;
  world::MeasurementId measurement(const std::string& name) const;
  std::string body(const std::string& name) const;  // an object, a frame with a shape, or an area
  // The frame that is given, or the only one that nothing places.
  world::FrameId root(const std::string& name) const;
};

// Throws Error with everything that is wrong; notes go to standard error. Values are written in the
// order in which they are given; `before` and `after` each (none: nothing) with the time of it.
using AtWrite = std::function<void(LoadedScene& scene, world::Stamp stamp)>;
std::unique_ptr<LoadedScene> load_world(const SceneOptions& options, const AtWrite& before = {},
                                        const AtWrite& after = {});

// What follows the last '#' or '/'.
std::string short_name(const std::string& iri);

}  // namespace sinew::cli
