// From what stands on the command line to a program: load, normalise, synthesise, lower. Every
// stage adds what a user should know to the report; what is at fault is thrown.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "request.h"
#include "sinew/algorithm/model.h"
#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/program/program.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/synthesise.h"

namespace sinew::cli {

// Models in the graph.
struct Models {
  graph::Store store;
  graph::Places places;
  bool lenient = false;  // ModelOptions::lenient
  // The algorithm that was made last, which need not be read from the graph as long as the graph is
  // what it was then; it may not be there.
  struct Made {
    algorithm::Algorithm model;
    graph::Stamp version;
  };
  std::optional<Made> made;
  // The tree that was normalised last: whoever asks for the same robot finds it there, as long as
  // nothing but algorithms of it have come into the graph.
  struct RobotAsked {
    std::string base;
    std::vector<std::string> tips;
    std::optional<std::array<double, 3>> gravity;
    bool gravity_varies = false;
    std::optional<double> snap;
    bool operator==(const RobotAsked&) const = default;
  };
  struct Normalised {
    RobotAsked asked;
    graph::Stamp version;
  };
  std::optional<Normalised> normalised;
  std::set<std::string> noted;  // notes of the synthesis that have been printed
};

// Reads all files; warnings go to standard error.
std::unique_ptr<Models> load(const ModelOptions& options);

// The algorithm that answers the query, in its own graph of the store; or the one that the files
// hold, when no query is named. Notes go to standard error. Returns the algorithm's node.
// `why` gets a line for each step that the planner chose; `snap` is QueryOptions::snap.
// AlgorithmGraph::kIfNeeded: for whoever only has it lowered.
graph::Id algorithm_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                       std::vector<std::string>* why = nullptr,
                       synthesis::AlgorithmGraph graph = synthesis::AlgorithmGraph::kWritten);
graph::Id algorithm_of(Models& models, const synthesis::Query& query,
                       std::vector<std::string>* why = nullptr,
                       std::optional<double> snap = std::nullopt,
                       synthesis::AlgorithmGraph graph = synthesis::AlgorithmGraph::kWritten);

// Each query that the options name, as it is; and all of them as one, with the options' base, tips,
// gravity and policies.
std::vector<synthesis::Query> queries_of(const ModelOptions& files, const QueryOptions& query);
synthesis::Query query_of(std::vector<synthesis::Query> queries, const QueryOptions& options);

// That algorithm, lowered; or the program that the only file is, if it ends in .program.json.
// `name` is the program's; empty: the query's.
program::Program program_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                            const std::string& name);

// The same in two parts: the synthesis, which adds to the graph, is done, and the lowering is left
// to whoever wants it, on any thread, while the models are there and may be added to.
class LaterProgram {
 public:
  explicit LaterProgram(program::Program program) : program_(std::move(program)) {}
  LaterProgram(algorithm::Algorithm model, const graph::Terms& terms, std::string name)
      : model_(std::move(model)), terms_(&terms), name_(std::move(name)) {}

  program::Program take() &&;
  std::size_t size() const;  // closures

 private:
  program::Program program_;
  std::optional<algorithm::Algorithm> model_;  // of which the program is made
  const graph::Terms* terms_ = nullptr;
  std::string name_;
};
LaterProgram later_program_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                              const std::string& name);

// Each solver that the options name as a question of its own, with all that they say besides.
// Throws Error where they name none, or one twice.
std::vector<QueryOptions> each_solver(const QueryOptions& query);

program::Program lowered(const Models& models, graph::Id algorithm, const std::string& name);

// Tells, on standard error, that what a query holds between updates is computed anew each time
// here.
void note_held(const program::Program& program);

// "robots/arm.urdf, solver rnea": for banners and reports.
std::string describe(const ModelOptions& files, const QueryOptions& query);

// The stages behind the graph know nodes, not files: what `make` throws gets the place where the
// node at fault was written.
[[noreturn]] void throw_with_places(const Models& models, const Error& error);
template <typename Make>
auto with_places(const Models& models, Make&& make) {
  try {
    return make();
  } catch (const Error& error) {
    throw_with_places(models, error);
  }
}

// Prints problems that are no errors.
void print_notes(const Report& report);

}  // namespace sinew::cli
