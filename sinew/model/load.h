// Loads the files of a model into one graph: JSON-LD, Turtle and its relatives, and URDF, by the
// ends of their names. Every node keeps the place where it was written.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::model {

struct LoadOptions {
  // Folders with further contexts, each with a catalog.json; see sinew/rdf/catalogue/catalogue.h.
  std::vector<std::filesystem::path> catalogues;
  // What a context does not define, and what is no element of URDF, is a warning instead of an
  // error.
  bool lenient = false;
  // For URDF; empty: https://w3id.org/sinew/robots/ and the robot's name.
  std::string urdf_base_iri;
};

enum class FileKind { kJsonLd, kTurtle, kUrdf, kUnknown };

// .json .jsonld | .ttl .trig .nt .nq | .urdf .xml
FileKind kind_of_file(std::string_view name);

// A file, or a text that stands for one.
struct Source {
  std::string name;
  std::string text;
};

// Throws Error when the file cannot be read.
Source read_source(const std::filesystem::path& file);

// Adds all sources to the store in one transaction: after an error, nothing was added. Faults go to
// the report, as many as can be found.
void load(std::span<const Source> sources, const LoadOptions& options, graph::Store& store,
          graph::Places& places, Report& report);
void load_files(std::span<const std::filesystem::path> files, const LoadOptions& options,
                graph::Store& store, graph::Places& places, Report& report);

}  // namespace sinew::model
