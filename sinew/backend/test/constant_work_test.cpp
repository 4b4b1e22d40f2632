// Every call of generated code executes the same number of instructions, whatever the state.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "instruction_counts.h"
#include "serial_chain.h"
#include "sinew/backend/c_target.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr int kStates = 1000;

struct Variant {
  std::string name;
  std::string function;  // whose instructions are counted
  std::string call;
  backend::COptions options;
};

backend::COptions options_of(backend::Scalar scalar = backend::Scalar::kDouble,
                             std::vector<std::string> slow = {}) {
  backend::COptions options;
  options.name = "chain";
  options.scalar = scalar;
  options.partial.slow = std::move(slow);
  return options;
}

std::vector<Variant> variants() {
  return {{"single", "chain", "chain(in, out)", options_of()},
          // A whole block and what is left over, in whatever widths the processor has.
          {"batch", "chain_batch", "chain_batch(in, out, 11)", options_of()},
          {"float", "chain", "chain(in, out)", options_of(backend::Scalar::kFloat)},
          {"update", "chain_update", "chain_update(in, held)",
           options_of(backend::Scalar::kDouble, {"position"})},
          {"after_update", "chain", "chain(in, held, out)",
           options_of(backend::Scalar::kDouble, {"position"})}};
}

// Calls the function with one state after the other. The squares of all angles of a call (of a
// block, in a batch) stay below 1e10 in sum: beyond it the angles are looked through for those that
// only the C library's sine can do.
std::string driver(const Variant& variant) {
  const bool held = !variant.options.partial.slow.empty();
  return fmt::format(R"(
#include <stdlib.h>
#include "chain.h"
int main(void) {{
  static {0} in[11 * chain_IN_SIZE], out[11 * chain_OUT_SIZE];
  {1}
  int k, i;
  srand(1);
  for (k = 0; k < {2}; ++k) {{
    for (i = 0; i < 11 * chain_IN_SIZE; ++i) {{
      in[i] = ({0})((rand() / (double)RAND_MAX - 0.5) * (k % 10 == 0 ? {4} : 6.0));
      if (k == 7) in[i] = 0;
    }}
    {3};
  }}
  (void)out;
  return 0;
}}
)",
                     variant.options.scalar == backend::Scalar::kFloat ? "float" : "double",
                     held ? "static double held[chain_HELD_SIZE];" : "", kStates, variant.call,
                     variant.name == "batch" ? "1e4" : "1e5");
}

class ConstantWork : public testing::TestWithParam<Variant> {};

TEST_P(ConstantWork, OfGeneratedCIsTheSameNumberOfInstructionsInEveryState) {
  if (std::system("valgrind --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no valgrind to count instructions with";
  }
  const Variant& variant = GetParam();
  const fs::path folder =
      fs::path(testing::TempDir()) / fmt::format("instructions_{}_{}", variant.name, getpid());
  fs::create_directories(folder);
  const backend::GeneratedCode code =
      generate_c(test::inverse_dynamics(test::mixed_chain(), true), variant.options);
  for (const backend::SourceFile& file : code.files) {
    std::ofstream(folder / file.name) << file.text;
  }
  std::ofstream(folder / "driver.c") << driver(variant);
  const std::string line =
      fmt::format("cd '{}' && gcc -O2 driver.c chain.c -o driver -lm && {} ./driver > log 2>&1",
                  folder.string(), test::count_calls_of(variant.function));
  ASSERT_EQ(std::system(line.c_str()), 0) << line;

  const test::InstructionCounts counts = test::counted_in(folder);
  EXPECT_EQ(counts.calls, kStates);
  EXPECT_EQ(counts.different.size(), 1U) << testing::PrintToString(counts.different);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Variants, ConstantWork, testing::ValuesIn(variants()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace sinew
