// From what stands on the command line to a program: load, normalise, synthesise, lower. Every
// stage adds what a user should know to the report; what is at fault is thrown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "request.h"
#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/program/program.h"

namespace sinew::cli {

// Models in the graph.
struct Models {
  graph::Store store;
  graph::Places places;
};

// Reads all files; warnings go to standard error.
std::unique_ptr<Models> load(const ModelOptions& options);

// The algorithm that answers the query, in its own graph of the store; or the one that the files
// hold, when no query is named. Notes go to standard error. Returns the algorithm's node.
// `why` gets a line for each step that the planner chose.
graph::Id algorithm_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                       std::vector<std::string>* why = nullptr);

// That algorithm, lowered; or the program that the only file is, if it ends in .program.json.
// `name` is the program's; empty: the query's.
program::Program program_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                            const std::string& name);

program::Program lowered(const Models& models, graph::Id algorithm, const std::string& name);

// "robots/arm.urdf, solver rnea": for banners and reports.
std::string describe(const ModelOptions& files, const QueryOptions& query);

// Prints problems that are no errors.
void print_notes(const Report& report);

}  // namespace sinew::cli
