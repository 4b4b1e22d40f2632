// Command-line parsing with CLI11, and the options that several commands share.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"

namespace sinew::cli {

// Parses; returns the exit code when the command has nothing more to do (--help, bad usage).
std::optional<int> parse(CLI::App& app, Arguments arguments);

// Which models to read and how.
struct ModelOptions {
  std::vector<std::string> files;
  std::vector<std::string> catalogs;
  bool lenient = false;
};
void add_model_options(CLI::App& app, ModelOptions& options);

// Which query to answer on them. Without --query and --solver the files must hold an algorithm.
struct QueryOptions {
  std::string query_file;
  std::string solver;
  std::string base;
  std::vector<std::string> tips;
  std::string gravity;  // "x,y,z" in m/s^2, seen from the base; empty: the model's
  bool floating = false;
};
void add_query_options(CLI::App& app, QueryOptions& options);

// "x,y,z" as three finite numbers; throws Error naming `option` otherwise.
std::vector<double> parse_vector3(const std::string& text, const std::string& option);

}  // namespace sinew::cli
