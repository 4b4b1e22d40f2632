// sinew synth MODEL… --solver NAME -o ALGO.jsonld: the algorithm model.
#include <iostream>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "sinew/algorithm/attach.h"
#include "sinew/robot/names.h"
#include "write_models.h"

namespace sinew::cli {

int run_synth(Arguments arguments) {
  CLI::App app(
      "Synthesise the algorithm that answers a query: data, closures and schedule, each linked to "
      "the "
      "model element and the step that it comes from. Where the models hold a task, its "
      "controllers "
      "work with the solver; without --solver and --query, its own solver is asked.",
      "sinew synth");
  ModelOptions models_options;
  QueryOptions query;
  std::string output;
  bool explain = false;
  algorithm::RobotAttachment robot;
  add_model_options(app, models_options);
  add_query_options(app, query);
  app.add_flag("--why", explain, "Say on standard error why each step is there");
  app.add_option("--robot", robot.interface,
                 "Read the joints from, and write their forces to, this robot interface: print, "
                 "mujoco, udp or an IRI");
  app.add_option("--safe", robot.safe,
                 "With --robot: what is commanded on a fault, for all joints or VALUE,VALUE,…")
      ->delimiter(',');
  app.add_option("-o,--output", output, "File for the algorithm (default: standard output)");
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const auto models = load(models_options);
  std::vector<std::string> why;
  const graph::Id algorithm = algorithm_of(*models, models_options, query, &why);
  if (explain) {
    for (const std::string& line : why) std::cerr << line << "\n";
  }
  if (!robot.interface.empty()) {
    if (robot.interface.find(':') == std::string::npos)
      robot.interface = robot::interface_iri(robot.interface);
    algorithm::attach_robot(models->store, algorithm, robot);
  }
  write_output(output, algorithm_as_jsonld(models->store.view(), algorithm));
  return kOk;
}

}  // namespace sinew::cli
