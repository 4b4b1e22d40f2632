// Every call of generated code executes the same number of instructions, whatever the state.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "serial_chain.h"
#include "sinew/backend/c_target.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr int kStates = 1000;

// Calls the function with one state after the other; angles stay below 1e5 rad, beyond which the C
// library's sine is called.
constexpr const char* kDriver = R"(
#include <stdlib.h>
#include "chain.h"
int main(void) {
  static double in[chain_IN_SIZE], out[chain_OUT_SIZE];
  int k, i;
  srand(1);
  for (k = 0; k < 1000; ++k) {
    for (i = 0; i < chain_IN_SIZE; ++i) in[i] = (rand() / (double)RAND_MAX - 0.5) * (k % 10 == 0 ? 1e5 : 6.0);
    if (k == 7) for (i = 0; i < chain_IN_SIZE; ++i) in[i] = 0.0;
    chain(in, out);
  }
  return 0;
}
)";

TEST(GeneratedC, ExecutesTheSameNumberOfInstructionsInEveryState) {
  if (std::system("valgrind --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no valgrind to count instructions with";
  }
  const fs::path folder = fs::path(testing::TempDir()) / fmt::format("instructions_{}", getpid());
  fs::create_directories(folder);
  backend::COptions options;
  options.name = "chain";
  const backend::GeneratedCode code =
      generate_c(test::inverse_dynamics(test::mixed_chain(), true), options);
  for (const backend::SourceFile& file : code.files) {
    std::ofstream(folder / file.name) << file.text;
  }
  std::ofstream(folder / "driver.c") << kDriver;
  const std::string line = fmt::format(
      "cd '{}' && gcc -O2 driver.c chain.c -o driver -lm && valgrind --tool=callgrind "
      "--toggle-collect=chain --dump-after=chain --callgrind-out-file=count ./driver > log 2>&1",
      folder.string());
  ASSERT_EQ(std::system(line.c_str()), 0) << line;

  std::set<std::string> counts;
  int calls = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with("count.")) continue;
    std::ifstream file(entry.path());
    for (std::string text; std::getline(file, text);) {
      // The last file is what was collected behind the last call: nothing.
      if (!text.starts_with("summary: ") || text == "summary: 0") continue;
      counts.insert(text);
      ++calls;
    }
  }
  EXPECT_EQ(calls, kStates);
  EXPECT_EQ(counts.size(), 1U) << testing::PrintToString(counts);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sinew
