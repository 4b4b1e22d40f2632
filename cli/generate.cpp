// sinew generate MODEL… --solver NAME -o DIR: source code.
#include <filesystem>
#include <iostream>

#include "generate_each.h"
#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "sinew/backend/c_target.h"
#include "sinew/program/program_json.h"

namespace sinew::cli {
namespace {

void write_file(const std::string& folder, const std::string& name, const std::string& text) {
  write_output((std::filesystem::path(folder) / name).string(), text);
}

void write_files(const std::string& folder, const backend::GeneratedCode& code, bool updates) {
  if (updates && !code.has_update) {
    std::cerr << "note: no result depends on what is slow or held through anything that an update "
                 "could compute once: "
              << code.files.front().name << " has no update\n";
  }
  for (const backend::SourceFile& file : code.files) write_file(folder, file.name, file.text);
}

void write_program(const std::string& folder, const program::Program& program) {
  write_file(folder, program.name + ".program.json", program::to_json(program));
}

}  // namespace

int run_generate(Arguments arguments) {
  CLI::App app(
      "Write the program that answers a query as source code: NAME.h, NAME.c (or .cpp, .cu) and "
      "NAME.json, which "
      "names every input and output.",
      "sinew generate");
  ModelOptions models_options;
  QueryOptions query;
  std::string name, target = "c", style = "flat", scalar = "double", trigonometry = "own";
  std::string folder = ".";
  program::PartialOptions partial;
  add_model_options(app, models_options);
  add_query_options(app, query);
  add_derivative_option(app, query);
  app.add_option("--name", name, "Name of the function and the files (default: the query's)");
  bool each = false;
  app.add_flag("--each", each,
               "A function of its own for each --solver, with files of its own, called as the "
               "solver (with --name NAME: NAME_SOLVER): the same as one call for each, in less "
               "time. Files are written when all functions are there");
  app.add_option("--target", target,
                 "c; cpp: C++ with the numbers by name (NAME.hpp); cuda: one thread a sample; or "
                 "program: the program itself as JSON")
      ->check(CLI::IsMember({"c", "cpp", "cuda", "program"}))
      ->capture_default_str();
  app.add_option("--style", style,
                 "flat: optimised straight-line code; readable: a call for each closure")
      ->check(CLI::IsMember({"flat", "readable"}))
      ->capture_default_str();
  app.add_option("--scalar", scalar, "Type of all numbers: double or float")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  app.add_option("--trigonometry", trigonometry,
                 "own: sines and cosines are part of the code; sleef: those of the library SLEEF, "
                 "to be linked with -lsleef")
      ->check(CLI::IsMember({"own", "sleef"}))
      ->capture_default_str();
  app.add_option("--slow", partial.slow,
                 "Inputs that change rarely (a name, its first part, or a quantity; may be "
                 "repeated): NAME_update computes what depends on them alone");
  app.add_option("--held", partial.held,
                 "Data blocks that are kept between updates (a name, its first part, or a "
                 "quantity; may be repeated): evaluations use their value of the last update");
  bool no_limbs = false;
  app.add_flag("--no-limbs", no_limbs,
               "Compute limbs that are alike one by one, not side by side in vectors");
  bool trace = false;
  app.add_flag("--trace", trace, "Write what each optimisation pass does to standard error");
  app.add_option("-o,--output", folder, "Folder for the files")->capture_default_str();
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (target == "program") {
    for (const char* option :
         {"--style", "--scalar", "--trigonometry", "--slow", "--held", "--no-limbs", "--trace"}) {
      if (app.count(option) == 0) continue;
      std::cerr << "sinew generate: " << option
                << " goes with --target c or --target cpp or --target cuda: it says how code is "
                   "made of the program\nsee 'sinew generate --help'\n";
      return kBadUsage;
    }
  }

  const std::vector<QueryOptions> questions =
      each ? each_solver(query) : std::vector<QueryOptions>();
  const auto models = load(models_options);
  if (target == "program") {
    std::vector<program::Program> programs;
    for (const QueryOptions& question : questions)
      programs.push_back(
          program_of(*models, models_options, question, function_name(name, question)));
    if (!each) programs.push_back(program_of(*models, models_options, query, name));
    for (const program::Program& program : programs) write_program(folder, program);
    return kOk;
  }
  backend::COptions options;
  options.style = style == "flat" ? backend::Style::kFlat : backend::Style::kReadable;
  options.scalar = scalar == "float" ? backend::Scalar::kFloat : backend::Scalar::kDouble;
  options.language = target == "cuda"  ? backend::Language::kCuda
                     : target == "cpp" ? backend::Language::kCpp
                                       : backend::Language::kC;
  options.trigonometry =
      trigonometry == "sleef" ? backend::Trigonometry::kSleef : backend::Trigonometry::kOwn;
  options.partial = partial;
  options.limbs = !no_limbs;
  if (trace) {
    options.passes.trace = [](const program::PassReport& report) {
      std::cerr << program::to_string(report) << '\n';
    };
  }
  if (each) {
    // Passes of several functions at once would be a trace of none.
    const unsigned threads = trace ? 1 : Workers::as_many_as_the_machine_has();
    for (const backend::GeneratedCode& code :
         generate_each(*models, models_options, questions, name, options, threads))
      write_files(folder, code, !partial.empty());
    return kOk;
  }
  program::Program program = program_of(*models, models_options, query, name);
  options.name = program.name;
  options.source = describe(models_options, query);
  const bool updates = !program::with_held(program, partial).empty();
  const backend::GeneratedCode code =
      with_places(*models, [&] { return backend::generate_c(std::move(program), options); });
  write_files(folder, code, updates);
  return kOk;
}

}  // namespace sinew::cli
