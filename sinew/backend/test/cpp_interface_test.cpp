// --target cpp: a C++ program that uses the numbers by name computes what the interpreter computes,
// whatever else was asked of the code.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "serial_chain.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/interpreter.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

backend::COptions in_cpp(const std::string& name) {
  backend::COptions options;
  options.name = name;
  options.language = backend::Language::kCpp;
  return options;
}

// What a program prints that is compiled from the generated files and this text.
std::string run(const backend::GeneratedCode& code, const std::string& main,
                const std::string& compiler) {
  static int number = 0;
  const fs::path folder =
      fs::path(testing::TempDir()) / fmt::format("cpp_interface_{}_{}", getpid(), number++);
  fs::create_directories(folder);
  for (const backend::SourceFile& file : code.files) std::ofstream(folder / file.name) << file.text;
  std::ofstream(folder / "main.cpp") << main;
  const std::string command = fmt::format(
      "cd '{}' && {} -O1 -std=c++17 -Wall -Wextra -Werror -pedantic -I '{}/sinew/math' *.cpp '{}' "
      "-Wl,-rpath,'{}' -o use && ./use > printed",
      folder.string(), compiler, SINEW_SOURCE_DIR, SINEW_MATH_LIBRARY,
      fs::path(SINEW_MATH_LIBRARY).parent_path().string());
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ostringstream printed;
  printed << std::ifstream(folder / "printed").rdbuf();
  fs::remove_all(folder);
  return printed.str();
}

constexpr const char* kMain = R"(
#include <cstdio>
#include "chain.hpp"
int main() {
  sinew::chain::In in;
  in.position_joint2 = 0.5;
  in.velocity_joint3 = -0.25;
  in.acceleration_joint7 = 2;
  @UPDATE@
  const sinew::chain::Out out = sinew::chain::evaluate(in@HELD@);
  sinew::chain::Number rows[2 * chain_IN_SIZE] = {}, results[2 * chain_OUT_SIZE];
  rows[2 * 1 + 1] = 0.5;  // position.joint2 of the second sample
  rows[2 * 9 + 1] = -0.25;
  rows[2 * 20 + 1] = 2;
  sinew::chain::evaluate(rows, @HELD2@results, 2);
  std::printf("%.17g %.17g %.17g\n", double(out.force_joint1), double(out.pose_tip[11]), double(results[2 * 18 + 1]));
}
)";

std::string main_with_held(bool held) {
  std::string text = kMain;
  const auto put = [&](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  put("@UPDATE@", held ? "sinew::chain::Held held; sinew::chain::update(in, held);" : "");
  put("@HELD@", held ? ", held" : "");
  put("@HELD2@", held ? "held, " : "");
  return text;
}

TEST(CppInterface, NamesTheNumbers) {
#ifdef SINEW_SANITIZED
  GTEST_SKIP() << "a plain program does not link the library that a sanitizer was built into";
#endif
  const program::Program chain = test::inverse_dynamics(test::mixed_chain(), true);
  backend::Interpreter interpreter(chain);
  std::vector<double> in(interpreter.in_size()), expected(interpreter.out_size());
  in[1] = 0.5, in[9] = -0.25, in[20] = 2;
  interpreter.evaluate(in.data(), expected.data());
  // The outputs are the tip's pose and then the forces from the tip inwards.

  std::vector<std::pair<std::string, backend::COptions>> cases(4, {"", in_cpp("chain")});
  cases[0].first = "flat";
  cases[1].first = "readable";
  cases[1].second.style = backend::Style::kReadable;
  cases[2].first = "float";
  cases[2].second.scalar = backend::Scalar::kFloat;
  cases[3].first = "update";
  cases[3].second.partial.slow = {"position"};
  for (const auto& [what, options] : cases) {
    for (const char* compiler : {"g++", "clang++-19"}) {
      SCOPED_TRACE(what + " " + compiler);
      std::istringstream printed(
          run(generate_c(chain, options), main_with_held(!options.partial.empty()), compiler));
      double force = NAN, height = NAN, of_batch = NAN;
      printed >> force >> height >> of_batch;
      const double bound = options.scalar == backend::Scalar::kFloat ? 1e-5 : 1e-12;
      EXPECT_NEAR(force, expected[18], bound * (1 + std::abs(expected[18])));
      EXPECT_NEAR(height, expected[11], bound * (1 + std::abs(expected[11])));
      EXPECT_NEAR(of_batch, expected[18], bound * (1 + std::abs(expected[18])));
    }
  }
}

TEST(CppInterface, StatesBeginAsTheModelSays) {
  const std::string printed = run(generate_c(test::running_sum(), in_cpp("sum")), R"(
#include <cstdio>
#include "sum.hpp"
int main() {
  sinew::sum::In in;
  in.push.fill(10);
  sinew::sum::State state;
  sinew::sum::evaluate(in, state);
  const sinew::sum::Out out = sinew::sum::evaluate(in, state);
  std::printf("%g %g %g", out.total[0], out.total[5], state.total[5]);
}
)",
                                  "g++");
  EXPECT_EQ(printed, "21 26 26");
}

}  // namespace
}  // namespace sinew
