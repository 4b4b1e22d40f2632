#include "sinew/backend/c_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "serial_chain.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/interpreter.h"
#include "sinew/base/error.h"

namespace sinew {
namespace {

constexpr const char* kStrict[] = {"-Wall", "-Wextra", "-Werror", "-std=c11", "-pedantic"};

// A generated function, compiled by one compiler.
struct Case {
  std::string compiler;
  backend::Style style;
  std::vector<std::string> flags;
};

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const char* compiler : {"gcc", "clang-19"}) {
    for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable}) {
      for (const char* machine : {"-march=native", "-mtune=generic"}) {
        result.push_back({compiler, style, {"-O2", machine}});
      }
    }
  }
  return result;
}

backend::LoadedCode load(const program::Program& program, const Case& c) {
  backend::COptions options;
  options.name = "chain";
  options.style = c.style;
  backend::CompileOptions compile;
  compile.compiler = c.compiler;
  compile.flags = c.flags;
  compile.flags.insert(compile.flags.end(), std::begin(kStrict), std::end(kStrict));
  if (c.style == backend::Style::kReadable) {
    compile.flags.push_back("-I" SINEW_SOURCE_DIR "/sinew/math");
    compile.libraries = {SINEW_MATH_LIBRARY};
  }
  return backend::compile_and_load(generate_c(program, options), compile);
}

std::vector<double> random_inputs(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  std::vector<double> values(n);
  for (double& value : values) value = uniform(generator);
  return values;
}

TEST(GeneratedC, ComputesWhatTheInterpreterComputes) {
  const program::Program program = test::inverse_dynamics(test::mixed_chain(), true);
  backend::Interpreter interpreter(program);
  const std::size_t in_size = interpreter.in_size();
  const std::size_t out_size = interpreter.out_size();
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.compiler + (c.style == backend::Style::kFlat ? " flat " : " readable ") +
                 c.flags.back());
    const backend::LoadedCode code = load(program, c);
    for (unsigned seed = 0; seed < 20; ++seed) {
      const std::vector<double> in = random_inputs(in_size, seed);
      std::vector<double> expected(out_size);
      std::vector<double> out(out_size);
      interpreter.evaluate(in.data(), expected.data());
      code.function()(in.data(), out.data());
      for (std::size_t i = 0; i < out_size; ++i) {
        EXPECT_NEAR(out[i], expected[i], 1e-12 * (1 + std::abs(expected[i]))) << i;
      }
    }
  }
}

}  // namespace
}  // namespace sinew
