#include "options.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "sinew/model/coarse_snap.h"

namespace sinew::cli {

std::optional<int> parse(CLI::App& app, Arguments arguments) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
  try {
    app.parse(std::move(arguments));
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return kOk;
  } catch (const CLI::ParseError& error) {
    // Of a subcommand, if one was named: its own help has its options.
    std::string name = app.get_name();
    for (const CLI::App* named : app.get_subcommands()) name += " " + named->get_name();
    std::cerr << name << ": " << error.what() << "\nsee '" << name << " --help'\n";
    return kBadUsage;
  }
}

void add_model_options(CLI::App& app, ModelOptions& options) {
  app.add_option("MODEL", options.files, "Model files: JSON-LD, Turtle, TriG or URDF")->required();
  app.add_option("--catalog", options.catalogs,
                 "Folder with a catalog.json of more contexts (may be repeated)");
  app.add_option("--steps", options.steps,
                 "File with more synthesis steps (JSON-LD; they may also be among the models); may "
                 "be repeated")
      ->allow_extra_args(false);
  app.add_flag("--lenient", options.lenient,
               "Terms that no context defines, what is no element or attribute of URDF, and "
               "moments of inertia "
               "that no real body has: warn, do not refuse");
}

void add_query_options(CLI::App& app, QueryOptions& options) {
  app.add_option("--query", options.query_file, "Query model (JSON-LD)");
  app.add_option_function<std::vector<std::string>>(
      "--solver",
      [&options](const std::vector<std::string>& names) {
        for (const std::string& name : names)
          options.solver += (options.solver.empty() ? "" : ",") + name;
      },
      "Named query of solvers/, for example rnea; several, with commas or repeated, are answered "
      "by one program");
  app.add_option("--ask", options.ask,
                 "Ask for more: 'QUANTITY [of ELEMENT] [wrt FRAME] [seen-by FRAME]', for example "
                 "'twist of tool wrt link3'; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--give", options.give,
                 "Give more: 'QUANTITY [of ELEMENT] [seen-by FRAME]', for example 'external-wrench "
                 "of tool'; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--base", options.base, "Link or frame to start from (default: the only root)");
  app.add_option("--tip", options.tips,
                 "Link or frame to end at; may be repeated (default: leaves)");
  app.add_option(
      "--gravity", options.gravity,
      "Gravity vector x,y,z in m/s^2 seen from the base (default: the model's); input: it "
      "comes with each call");
  app.add_option("--snap", options.snap,
                 "Take the robot's constants within so much of 0, 1 or -1 for that, and say which "
                 "were changed (default: what round-off leaves, 1e-12 of direction cosines, 1e-14 "
                 "of the rest)")
      ->check(CLI::Range(0.0, model::kCoarsestSnap))
      ->check([](const std::string& text) {  // nan is in no range, and outside of none
        return std::string(std::isnan(std::stod(text)) ? text + " is no number" : "");
      });
  app.add_flag("--floating", options.floating, "The base moves freely");
  app.add_flag("--forces-apart", options.forces_apart,
               "Keep the share of each external wrench in each joint's force apart");
  app.add_flag(
      "--stationary-frames", options.stationary_frames,
      "Acceleration twists of the body at the point in space where the frame is (spatial), "
      "not of the frame's origin");
  app.add_option("--hold", options.hold,
                 "Had at a lower rate than the rest: 'QUANTITY [of ELEMENT]', given, asked or "
                 "computed on the way; generated code gets an update for it, 'run' and 'bench' "
                 "compute it anew each time; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--constraint", options.constraints,
                 "FRAME:DIRECTION,...[@base|@itself]: the frame's acceleration is imposed in these "
                 "directions (linear-x ... angular-z, or so many unit forces as inputs) of the "
                 "base's or its own axes; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--singular", options.singular,
                 "Where constraints depend on each other: in-order:TOLERANCE, truncated:TOLERANCE "
                 "or damped:DAMPING");
  app.add_option("--drivers", options.drivers,
                 "together, apart (also what each driver contributes) or weighed (by inputs)");
  app.add_option("--limit", options.limited,
                 "Driver (constrained frame, joint, or joint-force for all) that is scaled down "
                 "until no actuator saturates");
}

void add_derivative_option(CLI::App& app, QueryOptions& options) {
  app.add_option(
         "--derivative", options.derivatives,
         "OUT/IN, for example force/position,force.joint1/velocity: also the derivatives of "
         "these outputs by these inputs, each a quantity (all of it) or a name; outputs "
         "named like force.joint1/position.joint2, none where it is always zero")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace sinew::cli
