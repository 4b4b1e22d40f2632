// sinew: from linked models of a robot and its world to real-time software.
#include <cstdio>
#include <exception>
#include <iostream>
#include <string_view>

#include "command.h"
#include "kept_memory.h"
#include "sinew/base/error.h"

namespace {

using namespace sinew::cli;

struct Command {
  std::string_view name;
  std::string_view usage;
  std::string_view summary;
  int (*run)(Arguments);
};

constexpr Command kCommands[] = {
    {"check", "MODEL…", "conformance, units, frames, physical plausibility", run_check},
    {"import", "ROBOT.urdf -o FILE.jsonld", "write composable models", run_import},
    {"query", "MODEL… (-e TEXT | -q FILE)", "answer a SPARQL query", run_query},
    {"update", "MODEL… (-e TEXT | -q FILE)", "apply a SPARQL update", run_update},
    {"synth", "MODEL… --solver NAME -o ALGO.jsonld", "synthesise an algorithm model", run_synth},
    {"weave", "ALGO.jsonld UPDATE.rq -o ALGO2.jsonld", "rewrite an algorithm, re-validated",
     run_weave},
    {"stats", "ALGO.jsonld", "data, operators, operations, memory", run_stats},
    {"generate", "MODEL… --solver NAME -o DIR", "write source code", run_generate},
    {"run", "MODEL… --solver NAME (--input ROWS.csv | --robot mujoco)",
     "evaluate: rows in, rows out; or in a loop, with a robot", run_run},
    {"plot", "LOG.csv -o FIGURE.svg", "columns of a log over time, one above the other", run_plot},
    {"bench", "MODEL… --solver NAME", "time per evaluation, operations, code size", run_bench},
    {"explain", "NAME.json LINE", "from a generated line to its model element", run_explain},
    {"convert", "FILE SOURCE TARGET", "data conversions: explained, emitted, done", run_convert},
    {"blocks", "check|fmt|graph|text FILE", "the block language", run_blocks},
    {"world", "show|pose|within|relations|rights|query|watch|save MODEL…",
     "a scene: what is where, who says so, and how fresh it is", run_world},
};

void print_help(std::ostream& out) {
  out << "sinew: linked models of a robot and its world in, real-time software out\n\n"
         "usage: sinew COMMAND …    (sinew COMMAND --help tells more)\n\n";
  for (const Command& command : kCommands) {
    out << "  " << command.name << std::string(10 - command.name.size(), ' ') << command.summary
        << "\n            sinew " << command.name << " " << command.usage << "\n";
  }
  out << "\nsinew --version names the version\n"
         "exit code: 0 done, 1 the models or the query are at fault, 2 bad usage, 128 + n ended by "
         "signal n\n";
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  const std::string_view name = argc > 1 ? argv[1] : "";
  if (name == "--help" || name == "-h" || name == "help") {
    print_help(std::cout);
    return kOk;
  }
  if (name == "--version") {
    std::cout << "sinew " SINEW_VERSION "\n";
    return kOk;
  }
  for (const Command& command : kCommands) {
    if (command.name != name) continue;
    try {
      return command.run(Arguments(argv + 2, argv + argc));
    } catch (const sinew::Error& error) {
      std::cerr << error.what() << "\n";
      return kFault;
    } catch (const std::exception& error) {
      std::cerr << "sinew " << name << ": " << error.what() << "\n";
      return kFault;
    }
  }
  if (!name.empty()) std::cerr << "sinew: no command is named '" << name << "'\n\n";
  print_help(std::cerr);
  return kBadUsage;
}
