// sinew weave ALGO.jsonld UPDATE.rq -o ALGO2.jsonld: an algorithm rewritten by a SPARQL update.
#include "sinew/algorithm/weave.h"

#include <iostream>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "prefixes.h"
#include "robot_tree.h"
#include "sinew/program/facts.h"
#include "write_models.h"

namespace sinew::cli {
namespace {

// An update that changes nothing is no fault, but hardly ever what was meant.
void explain_nothing(const std::string& update, bool without_robot, bool without_facts) {
  std::cerr << "warning: the update finds nothing to change in this algorithm";
  if (without_robot && update.find("https://w3id.org/sinew/normalised") != std::string::npos)
    std::cerr << "; it asks for the robot's tree: add --model ROBOT…";
  if (without_facts && (update.find("sa:reads") != std::string::npos ||
                        update.find("sa:writes") != std::string::npos))
    std::cerr << "; it asks what closures read and write: add --facts";
  std::cerr << "\n";
}

}  // namespace

int run_weave(Arguments arguments) {
  CLI::App app(
      "Rewrite an algorithm by a SPARQL update, which sees the algorithm's triples as its default "
      "graph and, with --model, the robot's normalised tree as the named graph "
      "https://w3id.org/sinew/normalised. Updates that ship are in weaves/. The result is checked "
      "as a whole; one that is at fault is refused and nothing is written.",
      "sinew weave");
  ModelOptions models_options;
  models_options.files.resize(1);
  std::string update, output;
  app.add_option("ALGO", models_options.files.front(), "Algorithm that 'sinew synth' wrote")
      ->required();
  app.add_option("UPDATE", update, "SPARQL update; the project's prefixes need no declaration")
      ->required();
  std::vector<std::string> robot;
  app.add_option("--model", robot, "Models of the robot, for updates that ask for limits");
  app.add_option("-o,--output", output, "File for the new algorithm (default: standard output)");
  bool facts = false, repeat = false;
  app.add_flag("--facts", facts,
               "First write what the operator catalogue knows of each closure: the blocks that it "
               "reads and writes (sa:reads, sa:writes), and its operations (sa:additions, …)");
  app.add_flag("--repeat", repeat, "Apply the update until it changes nothing");
  if (const auto code = parse(app, std::move(arguments))) return *code;

  models_options.files.insert(models_options.files.end(), robot.begin(), robot.end());
  const auto models = load(models_options);
  const graph::Id algorithm = algorithm_of(*models, models_options, {});
  if (!robot.empty()) model::write(robot_tree(*models, {}), models->store);
  if (facts) program::write_facts(models->store, algorithm);
  const std::string text = read_input(update);
  const auto counts = algorithm::weave(
      models->store, algorithm, text, update,
      repeat ? algorithm::Rounds::kUntilSettled : algorithm::Rounds::kOne, &known_prefixes());
  std::cerr << counts.added << " triples added, " << counts.removed << " removed";
  if (repeat) std::cerr << " in " << counts.rounds << " rounds";
  std::cerr << "\n";
  if (counts.added + counts.removed == 0) explain_nothing(text, robot.empty(), !facts);
  write_output(output, algorithm_as_jsonld(models->store.view(), algorithm));
  return kOk;
}

}  // namespace sinew::cli
