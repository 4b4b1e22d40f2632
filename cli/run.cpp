// sinew run MODEL… --solver NAME --input ROWS.csv: rows in, rows out; with --robot: in a loop.
#include <algorithm>
#include <functional>
#include <iostream>
#include <span>

#include "csv.h"
#include "evaluator.h"
#include "interruption.h"
#include "live.h"
#include "options.h"
#include "output.h"
#include "pipeline.h"

namespace sinew::cli {
namespace {

// For each input number of the program, its column of the table.
std::vector<std::size_t> match_columns(const std::vector<std::string>& inputs, const Table& table,
                                       const std::string& file) {
  std::vector<std::size_t> columns;
  std::string missing;
  for (const std::string& input : inputs) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), input);
    if (found == table.columns.end()) {
      missing += (missing.empty() ? "" : ", ") + input;
      continue;
    }
    columns.push_back(static_cast<std::size_t>(found - table.columns.begin()));
  }
  if (!missing.empty()) {
    throw Error({{file, 1, 0},
                 "",
                 "has no column for the input " + missing,
                 "give every input of the program a column",
                 Severity::kError,
                 {}});
  }
  for (const std::string& column : table.columns) {
    if (std::find(inputs.begin(), inputs.end(), column) == inputs.end()) {
      std::cerr << file << ":1: warning: column " << column << " is no input of the program\n";
    }
  }
  return columns;
}

// Results are written while there are more to come, whole rows at a time.
int write_rows(const std::vector<std::string>& columns, std::size_t rows,
               const std::function<void(std::size_t row, double* out)>& evaluate,
               const std::string& path) {
  constexpr std::size_t kRowsAtOnce = 256;
  const Interruptible interruptible;
  Output output(path);
  output.write(csv_header(columns));
  for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
    const std::size_t count = std::min(kRowsAtOnce, rows - first);
    std::vector<double> results(count * columns.size());
    std::size_t done = 0;
    for (; done < count && interruption() == 0; ++done)
      evaluate(first + done, results.data() + done * columns.size());
    output.write(csv_rows(std::span(results).first(done * columns.size()), columns.size()));
    if (const int signal = interruption(); signal != 0) {
      std::cerr << "sinew run: ended by " << signal_name(signal) << " after " << first + done
                << " of " << rows << " rows"
                << (path.empty() ? "" : "; nothing is written to " + path) << "\n";
      return interrupted_exit_code(signal);
    }
  }
  output.end();
  return kOk;
}

}  // namespace

int run_run(Arguments arguments) {
  CLI::App app(
      "Evaluate a query for every row of a CSV file: columns are named like the program's inputs "
      "(position.joint1, …), one row is one evaluation. Or, with --robot, run it in a loop, or the "
      "tasks "
      "of a host model among the MODELs (docs/runtime.md), each with its own solver and rate. "
      "Ctrl-C and SIGTERM end a run in order, a second one at once; what is cut short exits with "
      "128 + the signal.",
      "sinew run");
  ModelOptions models_options;
  QueryOptions query;
  std::string input, output;
  bool interpret = false;
  add_model_options(app, models_options);
  add_query_options(app, query);
  add_derivative_option(app, query);
  app.add_option("--input", input, "CSV file with the inputs, - for standard input");
  app.add_option("-o,--output", output, "CSV file for the results (default: standard output)");
  app.add_flag("--interpret", interpret, "Evaluate closure by closure instead of compiling");
  LiveOptions live;
  add_live_options(app, live);
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (input.empty() == live.robot.empty()) {
    std::cerr << "sinew run: give --input ROWS.csv, or --robot NAME\n";
    return kBadUsage;
  }
  if (const std::string fault = misplaced_option(app, live.robot); !fault.empty()) {
    std::cerr << "sinew run: " << fault << "\nsee 'sinew run --help'\n";
    return kBadUsage;
  }
  if (!live.robot.empty()) return run_live(models_options, query, live, interpret);

  const Table rows = read_csv(read_input(input), input);
  const auto models = load(models_options);
  const program::Program program = program_of(*models, models_options, query, "");
  note_held(program);

  // Where nothing can be compiled the interpreter gives the same results, only later.
  How how = interpret ? How::kInterpreted : How::kCompiled;
  std::string why;
  if (how == How::kCompiled && !backend::jit_available(&why)) {
    std::cerr << "sinew run: interpreting, since " << why << "\n";
    how = How::kInterpreted;
  }
  Evaluator evaluator =
      with_places(*models, [&] { return Evaluator(program, how, backend::JitLevel::kFast); });

  const program::Interface& interface = evaluator.interface();
  const auto columns = match_columns(column_names(program, interface.inputs), rows, input);
  std::vector<double> in(interface.in_size);
  const auto evaluate = [&](std::size_t row, double* out) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      in[i] = rows.values[row * rows.columns.size() + columns[i]];
    }
    evaluator.evaluate(in.data(), out);
  };
  return write_rows(column_names(program, interface.outputs), rows.rows(), evaluate, output);
}

}  // namespace sinew::cli
