#include "pipeline.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "driver_options.h"
#include "output.h"
#include "sinew/algorithm/read.h"
#include "sinew/model/load.h"
#include "sinew/model/normalise.h"
#include "sinew/program/derivatives.h"
#include "sinew/program/lower.h"
#include "sinew/program/program_json.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/synthesis/combine_queries.h"
#include "sinew/synthesis/query_faults.h"
#include "sinew/synthesis/read_query.h"
#include "sinew/synthesis/synthesise.h"
#include "sinew/synthesis/task_query.h"
#include "sinew/task/read_task.h"

namespace sinew::cli {
namespace {

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error({{}, "", std::move(what), std::move(remedy), Severity::kError, {}});
}

// A program that 'sinew generate --target program' wrote stands for all the earlier stages.
bool is_program(const std::string& file) { return file.ends_with(".program.json"); }

bool names_query(const QueryOptions& query) {
  return !query.query_file.empty() || !query.solver.empty() || !query.ask.empty();
}

void print_note(const std::string& text) { std::cerr << "note: " << text << "\n"; }

// Several questions about one robot have the same to say of it.
void print_note_once(Models& models, const std::string& text) {
  if (models.noted.insert(text).second) print_note(text);
}

// The algorithm that the files hold.
graph::Id only_algorithm(Models& models) {
  const auto found = algorithm::find_algorithms(models.store.view());
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    fail("the models hold no algorithm, and no query is named",
         "add --solver NAME or --query FILE, or give a file that 'sinew synth' wrote");
  }
  std::string names;
  for (const graph::Id id : found) names += " " + std::string(models.store.terms().text(id));
  fail("the models hold more than one algorithm:" + names, "give a file with one of them");
}

catalogue::Catalogue catalogue_of(const ModelOptions& files) {
  catalogue::Catalogue catalogue;
  for (const std::string& folder : files.catalogs) catalogue.add_directory(folder);
  return catalogue;
}

// What the command line says in addition to a query.
void add_options(synthesis::Query& query, const QueryOptions& options) {
  if (!options.base.empty()) {
    query.base = options.base;
    query.base_origin = {};
  }
  if (!options.tips.empty()) {
    query.tips = options.tips;
    query.tips_origin = {};
  }
  if (options.gravity == "input") {
    for (synthesis::Given& given : query.given) given.varies |= given.quantity == "gravity";
  } else if (!options.gravity.empty()) {
    query.gravity = parse_vector3(options.gravity, "--gravity");
  }
  if (options.floating) query.floating = true;
  if (options.forces_apart) query.forces = synthesis::Forces::kApart;
  if (options.stationary_frames) query.frames = synthesis::Frames::kStationary;
  for (const std::string& text : options.hold) query.held.push_back(parse_held(text));
  apply_driver_options(options, query);
}

// The task that the models hold; null where they hold none.
std::shared_ptr<const task::Task> task_of(Models& models) {
  Report report;
  auto task = std::make_shared<task::Task>(task::read_task(models.store, models.places, report));
  report.throw_if_errors();
  return task->empty() ? nullptr : task;
}

// The query that the task's solver stands for.
synthesis::Query query_of_task(Models& models, const QueryOptions& options,
                               std::shared_ptr<const task::Task> task) {
  Report report;
  synthesis::Query query =
      synthesis::query_of_task(models.store.view(), models.places, std::move(task), report);
  report.throw_if_errors();
  add_options(query, options);
  return query;
}

// Of a task without a solver, which only turns numbers into others: an outer loop, a watchdog.
synthesis::Query query_of_signals(const QueryOptions& options,
                                  std::shared_ptr<const task::Task> task) {
  synthesis::Query query;
  query.name = "task";
  for (const char* quantity : {"joint-position", "joint-velocity"})
    query.given.push_back({quantity, std::string(synthesis::kEveryJoint)});
  query.task = std::move(task);
  add_options(query, options);
  return query;
}

}  // namespace

std::vector<synthesis::Query> queries_of(const ModelOptions& files, const QueryOptions& options) {
  std::vector<synthesis::Query> queries;
  if (!options.query_file.empty())
    queries.push_back(synthesis::parse_query(read_input(options.query_file), options.query_file,
                                             catalogue_of(files)));
  std::istringstream names(options.solver);
  for (std::string name; std::getline(names, name, ',');)
    queries.push_back(synthesis::named_query(name));
  if (queries.empty() || !options.ask.empty() || !options.give.empty()) {
    synthesis::Query more;
    more.name = "asked";
    for (const std::string& text : options.ask) more.asked.push_back(parse_asked(text));
    for (const std::string& text : options.give) more.given.push_back(parse_given(text));
    queries.push_back(std::move(more));
  }
  return queries;
}

synthesis::Query query_of(std::vector<synthesis::Query> queries, const QueryOptions& options) {
  synthesis::Query query =
      queries.size() == 1 ? std::move(queries.front()) : synthesis::combined(queries);
  add_options(query, options);
  return query;
}

namespace {

void normalise(Models& models, const synthesis::Query& query, std::optional<double> snap) {
  const bool gravity_varies = std::ranges::any_of(query.given, [](const synthesis::Given& given) {
    return given.quantity == "gravity" && given.varies;
  });
  Models::RobotAsked asked{query.base, query.tips, query.gravity, gravity_varies, snap};
  if (models.normalised && models.normalised->asked == asked &&
      models.normalised->version == models.store.view().stamp())
    return;
  models.normalised.reset();
  model::NormaliseOptions options;
  if (snap) options.snap_tolerance = *snap;
  options.base = query.base;
  options.lenient = models.lenient;
  options.tips = query.tips;
  if (query.gravity)
    options.gravity = model::Vector3{(*query.gravity)[0], (*query.gravity)[1], (*query.gravity)[2]};
  options.gravity_varies = gravity_varies;
  Report report;
  const model::Tree tree = model::normalise(models.store, models.places, options, report);
  print_notes(report);
  // What is wrong with a name of the query's is the query's fault.
  const synthesis::Origin& origin =
      query.tips_origin.place.file.empty() ? query.base_origin : query.tips_origin;
  Report placed;
  for (const Problem& problem : report.problems())
    placed.add(problem.severity == Severity::kError && problem.place.file.empty() &&
                       problem.iri.empty()
                   ? synthesis::fault_in(query, origin, "", problem.what, problem.remedy)
                   : problem);
  placed.throw_if_errors();
  for (const std::string& note : tree.notes) print_note(note);
  model::write(tree, models.store);
  models.normalised = Models::Normalised{std::move(asked), models.store.view().stamp()};
}

}  // namespace

void throw_with_places(const Models& models, const Error& error) {
  Report report;
  for (Problem problem : error.problems()) {
    const graph::Id node =
        problem.place.file.empty() ? models.store.terms().find_iri(problem.iri) : graph::Id{};
    if (node) problem.place = models.places.find(node);
    report.add(std::move(problem));
  }
  report.throw_if_errors();
  throw error;
}

graph::Id algorithm_of(Models& models, const ModelOptions& files, const QueryOptions& options,
                       std::vector<std::string>* why, synthesis::AlgorithmGraph graph) {
  if (!names_query(options)) {
    const auto task = task_of(models);
    const bool has_algorithm = !algorithm::find_algorithms(models.store.view()).empty();
    if (!task || (!task->solver && has_algorithm)) {
      const graph::Id algorithm = only_algorithm(models);
      if (options.snap)
        fail("--snap changes a robot, and the algorithm has been made of one already",
             "give the robot's models and a query");
      return algorithm;
    }
    if (!task->solver)
      return algorithm_of(models, query_of_signals(options, task), why, options.snap, graph);
    return algorithm_of(models, query_of_task(models, options, task), why, options.snap, graph);
  }
  return algorithm_of(models, query_of(queries_of(files, options), options), why, options.snap,
                      graph);
}

graph::Id algorithm_of(Models& models, const synthesis::Query& asked, std::vector<std::string>* why,
                       std::optional<double> snap, synthesis::AlgorithmGraph graph) {
  synthesis::Query query = asked;
  if (!query.task) query.task = task_of(models);
  normalise(models, query, snap);
  synthesis::Synthesis synthesis = with_places(
      models, [&] { return synthesis::synthesise(models.store, query, &models.places, graph); });
  // It has written nothing of which the tree is made.
  models.normalised->version = models.store.view().stamp();
  for (const std::string& note : synthesis.notes) print_note_once(models, note);
  if (why != nullptr) *why = std::move(synthesis.why);
  models.made.reset();
  if (synthesis.model)
    models.made = Models::Made{std::move(*synthesis.model), models.store.view().stamp()};
  return synthesis.algorithm;
}

program::Program program_of(Models& models, const ModelOptions& files, const QueryOptions& options,
                            const std::string& name) {
  return later_program_of(models, files, options, name).take();
}

program::Program LaterProgram::take() && {
  if (model_) program_ = program::lower(std::move(*model_), *terms_, name_);
  model_.reset();
  return std::move(program_);
}

std::size_t LaterProgram::size() const {
  return model_ ? model_->closures.size() : program_.closures.size();
}

LaterProgram later_program_of(Models& models, const ModelOptions& files,
                              const QueryOptions& options, const std::string& name) {
  if (files.files.size() == 1 && is_program(files.files.front())) {
    if (names_query(options)) {
      fail(files.files.front() + " answers one query already", "leave out --solver and --query");
    }
    const std::string& file = files.files.front();
    program::Program program = program::from_json(read_input(file), file);
    if (!name.empty()) program.name = name;
    program::add_derivatives(program, options.derivatives);
    return LaterProgram(std::move(program));
  }
  const graph::Id algorithm =
      algorithm_of(models, files, options, nullptr, synthesis::AlgorithmGraph::kIfNeeded);
  std::string program_name = name;
  if (program_name.empty()) program_name = options.solver.empty() ? "program" : options.solver;
  std::replace(program_name.begin(), program_name.end(), ',', '_');
  // Derivatives can be refused, which belongs to the synthesis' part.
  if (models.made && models.made->model.id == algorithm && options.derivatives.empty()) {
    algorithm::Algorithm model = std::move(models.made->model);
    models.made.reset();
    return {std::move(model), models.store.terms(), program_name};
  }
  program::Program program = lowered(models, algorithm, program_name);
  program::add_derivatives(program, options.derivatives);
  return LaterProgram(std::move(program));
}

std::vector<QueryOptions> each_solver(const QueryOptions& query) {
  std::vector<QueryOptions> questions;
  std::istringstream names(query.solver);
  for (std::string name; std::getline(names, name, ',');) {
    const bool again = std::ranges::any_of(
        questions, [&](const QueryOptions& other) { return other.solver == name; });
    if (again)
      fail("solver '" + name + "' is named twice, and each is to have files of its own",
           "name it once");
    questions.push_back(query);
    questions.back().solver = name;
  }
  if (questions.empty())
    fail("no solver is named that could have files of its own", "add --solver");
  return questions;
}

program::Program lowered(const Models& models, graph::Id algorithm, const std::string& name) {
  const graph::View view = models.store.view();
  if (models.made && models.made->model.id == algorithm && models.made->version == view.stamp())
    return program::lower(models.made->model, view.terms(), name);
  return program::lower(view, algorithm, name, &models.places);
}

void note_held(const program::Program& program) {
  std::string names;
  for (const program::Variable& variable : program.variables)
    if (variable.held && variable.role == program::Role::kInternal)
      names += (names.empty() ? "" : ", ") + variable.name;
  if (!names.empty())
    print_note("the query holds " + names +
               " between updates: here it is computed anew each time; code of 'sinew generate' "
               "has the update");
}

std::unique_ptr<Models> load(const ModelOptions& options) {
  auto models = std::make_unique<Models>();
  models->lenient = options.lenient;
  model::LoadOptions load_options;
  for (const std::string& folder : options.catalogs) load_options.catalogues.emplace_back(folder);
  load_options.lenient = options.lenient;
  std::vector<std::filesystem::path> files;
  for (const std::string& file : options.files) {
    if (!is_program(file)) files.emplace_back(file);
  }
  files.insert(files.end(), options.steps.begin(), options.steps.end());
  Report report;
  model::load_files(files, load_options, models->store, models->places, report);
  print_notes(report);
  report.throw_if_errors();
  return models;
}

void print_notes(const Report& report) {
  for (const Problem& problem : report.problems()) {
    if (problem.severity == Severity::kWarning) std::cerr << to_string(problem) << "\n";
  }
}

std::string describe(const ModelOptions& files, const QueryOptions& query) {
  std::string text;
  for (const std::string& file : files.files) {
    text += (text.empty() ? "" : " ") + std::filesystem::path(file).filename().string();
  }
  if (!query.solver.empty()) text += ", solver " + query.solver;
  if (!query.query_file.empty()) {
    text += ", query " + std::filesystem::path(query.query_file).filename().string();
  }
  for (const std::string& asked : query.ask) text += ", " + asked;
  return text;
}

}  // namespace sinew::cli
