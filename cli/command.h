// The subcommands of `sinew`. Each is one source file with one function, and one row of the table
// in main.cpp. A command prints its result on standard output (or where -o says), everything else
// on standard error, and returns one of the exit codes below. Faults are thrown as sinew::Error;
// main prints them.
#pragma once

#include <string>
#include <vector>

namespace sinew::cli {

enum ExitCode : int {
  kOk = 0,
  kFault = 1,     // the models, the query or the data are at fault
  kBadUsage = 2,  // the command line is
};

using Arguments = std::vector<std::string>;  // what follows the command's name

int run_check(Arguments arguments);
int run_import(Arguments arguments);
int run_query(Arguments arguments);
int run_update(Arguments arguments);
int run_synth(Arguments arguments);
int run_weave(Arguments arguments);
int run_stats(Arguments arguments);
int run_generate(Arguments arguments);
int run_run(Arguments arguments);
int run_plot(Arguments arguments);
int run_bench(Arguments arguments);
int run_explain(Arguments arguments);
int run_convert(Arguments arguments);
int run_blocks(Arguments arguments);
int run_world(Arguments arguments);

}  // namespace sinew::cli
