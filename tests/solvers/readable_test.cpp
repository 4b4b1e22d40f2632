// The readable style of every named query, compiled by two compilers with all warnings as errors,
// computes what the interpreter computes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "compare.h"
#include "pipeline.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/interpreter.h"
#include "sinew/base/error.h"

namespace sinew::test {
namespace {

std::vector<std::string> named_queries() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SINEW_SOURCE_DIR "/solvers")) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void compare(const cli::ModelOptions& files, const std::string& solver, bool floating) {
  SCOPED_TRACE(solver + (floating ? " on a floating base" : ""));
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  if (solver == "hybrid") {  // its blanks
    query.constraints = {floating ? "rh_foot:linear-x,linear-z" : "panda_hand:linear-z,angular-x"};
    query.singular = floating ? "damped:0.01" : "truncated:1e-6";
    query.drivers = "weighed";
  }
  const auto models = cli::load(files);
  program::Program program;
  try {
    program = cli::program_of(*models, files, query, "");
  } catch (const Error& error) {
    // A query with blanks that this test cannot fill.
    GTEST_LOG_(INFO) << solver << " needs more than a robot: " << error.what();
    return;
  }
  backend::Interpreter interpreter(program);
  backend::COptions options;
  options.name = "solver";
  options.style = backend::Style::kReadable;
  const backend::GeneratedCode code = generate_c(program, options);
  for (const char* compiler : {"gcc", "clang-19"}) {
    backend::CompileOptions compile;
    compile.compiler = compiler;
    compile.flags = {"-O1",
                     "-Wall",
                     "-Wextra",
                     "-Werror",
                     "-std=c11",
                     "-pedantic",
                     "-I" SINEW_SOURCE_DIR "/sinew/math"};
    compile.libraries = {SINEW_MATH_LIBRARY};
    const backend::LoadedCode loaded = compile_and_load(code, compile);
    if (interpreter.state_size() > 0) continue;  // compiles; states are tested with controllers
    std::mt19937 random(4);
    std::uniform_real_distribution<> number(-1, 1);
    for (int state = 0; state < 20; ++state) {
      peers::Vector in(interpreter.in_size()), expected(interpreter.out_size());
      for (double& x : in) x = number(random);
      peers::Vector out(expected.size());
      interpreter.evaluate(in.data(), expected.data());
      loaded.function()(in.data(), out.data());
      EXPECT_LT(difference(out, expected), 1e-12) << compiler;
    }
  }
}

TEST(ReadableStyle, OfEveryNamedQueryComputesWhatTheInterpreterComputes) {
  const std::string robots = SINEW_SHARED_DIR "/robots/";
  if (!std::filesystem::exists(robots)) GTEST_SKIP() << "no robots in " << robots;
  for (const std::string& solver : named_queries()) {
    compare({{robots + "panda.urdf"}, {}, true}, solver, false);
    compare({{robots + "hyq.urdf"}, {}, true}, solver, true);
  }
}

}  // namespace
}  // namespace sinew::test
