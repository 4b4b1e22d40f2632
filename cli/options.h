// Command-line parsing with CLI11, and the options that several commands share.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>

#include "command.h"
#include "request.h"

namespace sinew::cli {

// Parses; returns the exit code when the command has nothing more to do (--help, bad usage).
std::optional<int> parse(CLI::App& app, Arguments arguments);

void add_model_options(CLI::App& app, ModelOptions& options);
void add_query_options(CLI::App& app, QueryOptions& options);
// For commands that make a program.
void add_derivative_option(CLI::App& app, QueryOptions& options);

}  // namespace sinew::cli
