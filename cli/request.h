// What is asked for: which models, and which question. Filled from the command line (options.h), or
// by a program that uses the pipeline itself.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace sinew::cli {

// Which models to read and how.
struct ModelOptions {
  std::vector<std::string> files;
  std::vector<std::string> catalogs;
  bool lenient = false;
};

// Which query to answer on them. Without a query file and a solver the files must hold an
// algorithm.
struct QueryOptions {
  std::string query_file;
  std::string solver;
  std::string base;
  std::vector<std::string> tips;
  std::string gravity;  // "x,y,z" in m/s^2, seen from the base; empty: the model's
  bool floating = false;
  std::vector<std::string> derivatives;  // "OUT/IN" each: sinew/program/derivatives.h
};

// "x,y,z" as three finite numbers; throws Error naming `option` otherwise.
std::array<double, 3> parse_vector3(const std::string& text, const std::string& option);

}  // namespace sinew::cli
