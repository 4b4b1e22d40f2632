// sinew import ROBOT.urdf -o FILE.jsonld: composable models from a URDF.
#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "sinew/model/load.h"
#include "write_models.h"

namespace sinew::cli {

int run_import(Arguments arguments) {
  CLI::App app(
      "Write the composable models of a robot that a URDF describes: links, frames, joints with "
      "their "
      "limits, inertias, and references to its visual and collision geometry.",
      "sinew import");
  std::string file, base, output;
  bool lenient = false;
  app.add_option("URDF", file, "The robot's URDF")->required();
  app.add_option(
      "--iri", base,
      "What the IRIs of the robot begin with (default: https://w3id.org/sinew/robots/NAME/)");
  app.add_flag("--lenient", lenient, "What is no element of URDF: warn, do not refuse");
  app.add_option("-o,--output", output, "File for the models (default: standard output)");
  if (const auto code = parse(app, std::move(arguments))) return *code;

  Models models;
  model::LoadOptions options;
  options.lenient = lenient;
  options.urdf_base_iri = base;
  const model::Source source = model::read_source(file);
  Report report;
  if (model::kind_of_file(file) != model::FileKind::kUrdf) {
    report.error({file, 0, 0}, "", "is no URDF by its name",
                 "name a file that ends in .urdf or .xml");
    report.throw_if_errors();
  }
  model::load(std::span(&source, 1), options, models.store, models.places, report);
  print_notes(report);
  report.throw_if_errors();
  write_output(output, models_as_jsonld(models.store.view()));
  return kOk;
}

}  // namespace sinew::cli
