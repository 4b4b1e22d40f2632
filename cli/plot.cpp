// sinew plot LOG.csv -o FIGURE.svg: columns of a log over time, one panel above the other, the
// phases shaded.
#include <algorithm>
#include <cmath>

#include "csv.h"
#include "figure.h"
#include "options.h"
#include "output.h"
#include "sinew/base/error.h"

namespace sinew::cli {
namespace {

std::size_t column_of(const Table& table, const std::string& name, const std::string& file) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
  std::string known;
  for (const std::string& column : table.columns) known += " " + column;
  throw Error(Problem{{file, 1, 0}, "", "has no column " + name, "it has" + known, {}, {}});
}

std::vector<double> column(const Table& table, std::size_t index) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row)
    values.push_back(table.values[row * table.columns.size() + index]);
  return values;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// "velocity [m/s]=twist.link7[5],..." or without the label and '='.
Panel panel_of(const std::string& text, const Table& table, const std::string& file) {
  const std::size_t equals = text.find('=');
  const std::string columns = equals == std::string::npos ? text : text.substr(equals + 1);
  Panel panel{equals == std::string::npos ? columns : text.substr(0, equals), {}};
  for (const std::string& name : split(columns, ','))
    panel.curves.push_back({name, column(table, column_of(table, name, file))});
  return panel;
}

// Without panels on the command line: one for each quantity (what stands before the dot).
std::vector<Panel> every_panel(const Table& table, const std::string& phase) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i];
    if (name == "tick" || name == "time" || name == phase) continue;
    const std::string quantity = name.substr(0, name.find('.'));
    auto found = std::find_if(panels.begin(), panels.end(),
                              [&](const Panel& panel) { return panel.label == quantity; });
    if (found == panels.end()) found = panels.insert(panels.end(), Panel{quantity, {}});
    found->curves.push_back({name, column(table, i)});
  }
  return panels;
}

std::vector<Phase> phases_of(const Table& table, const std::vector<double>& times,
                             const std::string& name, const std::vector<std::string>& names) {
  std::vector<Phase> phases;
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) return phases;
  const auto values = column(table, static_cast<std::size_t>(found - table.columns.begin()));
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (row > 0 && values[row] == values[row - 1]) continue;
    const double number = values[row];
    std::string text = std::to_string(std::llround(number));
    if (number >= 1 && number <= static_cast<double>(names.size()))
      text = names[static_cast<std::size_t>(number) - 1];
    phases.push_back({times[row], number == 0 ? "" : text});
  }
  return phases;
}

}  // namespace

int run_plot(Arguments arguments) {
  CLI::App app(
      "Draw columns of a log over time as SVG: panels one above the other, and the phases of a run "
      "shaded behind them.",
      "sinew plot");
  std::string file, output, title, phase = "phase", names;
  std::vector<std::string> panels;
  app.add_option("LOG", file, "CSV file that 'sinew run --record' wrote, - for standard input")
      ->required();
  app.add_option("-o,--output", output, "SVG file (default: standard output)");
  app.add_option("--panel", panels,
                 "COLUMN,COLUMN… of one panel, or LABEL=COLUMN,…; may be repeated (default: one "
                 "panel for each quantity)");
  app.add_option("--phase", phase, "Column whose changes begin a phase")->capture_default_str();
  app.add_option("--phase-names", names, "Names of phases 1, 2, …, separated by commas");
  app.add_option("--title", title, "Above the figure");
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const Table table = read_csv(read_input(file), file);
  if (table.rows() == 0)
    throw Error(
        {{file, 2, 0}, "", "has no rows, so there is nothing to draw", "record a run", {}, {}});
  Figure figure{title, column(table, column_of(table, "time", file)), {}, {}};
  for (const std::string& panel : panels) figure.panels.push_back(panel_of(panel, table, file));
  if (panels.empty()) figure.panels = every_panel(table, phase);
  figure.phases = phases_of(table, figure.times, phase,
                            names.empty() ? std::vector<std::string>{} : split(names, ','));
  write_output(output, to_svg(figure));
  return kOk;
}

}  // namespace sinew::cli
