// What is asked for: which models, and which question. Filled from the command line (options.h), or
// by a program that uses the pipeline itself.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sinew/synthesis/query.h"

namespace sinew::cli {

// Which models to read and how.
struct ModelOptions {
  std::vector<std::string> files;
  std::vector<std::string> catalogs;
  bool lenient = false;
  std::vector<std::string> steps = {};  // more files, with steps that are data
};

// Which query to answer on them: all that is named here, together. Where nothing is, the files must
// hold an algorithm.
struct QueryOptions {
  std::string query_file;
  std::string solver;             // or several, with commas between them
  std::vector<std::string> ask;   // each as parse_asked has it
  std::vector<std::string> give;  // each as parse_given has it
  std::string base;
  std::vector<std::string> tips;
  std::string gravity;         // "x,y,z" in m/s^2, seen from the base; "input"; empty: the model's
  std::optional<double> snap;  // NormaliseOptions::snap_tolerance, where it is not round-off
  bool floating = false;
  bool forces_apart = false;
  bool stationary_frames = false;
  std::vector<std::string> hold = {};  // each as parse_held has it

  // Drivers and policies beside those of the query (driver_options.cpp has their grammar).
  std::vector<std::string> constraints;  // "FRAME:linear-z,angular-x[@base|@itself]"
  std::string singular;                  // "in-order:1e-9", "damped:0.01", "truncated:1e-6"
  std::string drivers;                   // "together", "apart", "weighed"
  std::string limited;                   // a driver
  std::vector<std::string> derivatives;  // "OUT/IN" each: sinew/program/derivatives.h
};

// "QUANTITY [of ELEMENT] [wrt FRAME] [seen-by FRAME]"
synthesis::Asked parse_asked(const std::string& text);
// "QUANTITY [of ELEMENT] [seen-by FRAME]"; of every joint where a quantity of joints is of none.
synthesis::Given parse_given(const std::string& text);
// "QUANTITY [of ELEMENT]"
synthesis::Held parse_held(const std::string& text);

// "1" or "1,2,3": finite numbers, at least one; throws Error naming `option` otherwise.
std::vector<double> parse_numbers(const std::string& text, const std::string& option);

// "x,y,z" as three finite numbers; throws Error naming `option` otherwise.
std::array<double, 3> parse_vector3(const std::string& text, const std::string& option);

}  // namespace sinew::cli
