// Machine code made in the process, and code with limbs side by side, executes the same number of
// instructions in every state. The instructions are counted by valgrind, in a process of its own
// that runs this very test; valgrind's processor has AVX2 and no AVX-512, and code is made for it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "humanoid_urdf.h"
#include "instruction_counts.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/jit.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

// Counting starts when it is called and ends when it returns.
extern "C" __attribute__((noinline)) void sinew_counted_call(const std::function<void()>& call) {
  call();
}

namespace sinew::test {
namespace {

namespace fs = std::filesystem;

constexpr int kStates = 1000;
constexpr std::size_t kBatch = 11;  // a block, and what is left over
constexpr const char* kCounting = "SINEW_COUNTING_INSTRUCTIONS";

std::vector<peers::Vector> many_states(const Question& question) {
  std::vector<peers::Vector> states;
  for (unsigned seed = 0; seed < kStates; ++seed) {
    peers::State state = random_state(question.joints().size(), seed, true);
    if (seed == 7) std::fill(state.velocity.begin(), state.velocity.end(), 0.0);
    if (seed % 10 == 0)  // angles of many turns; the first seven numbers are the base's pose
      for (std::size_t i = 7; i < state.position.size(); ++i) state.position[i] *= 1e3;
    states.push_back(question.inputs(state, state.acceleration));
  }
  return states;
}

// As many of the states as `samples`, from one on, input after input.
std::vector<double> inputs_of(const std::vector<peers::Vector>& states, std::size_t first,
                              std::size_t samples) {
  std::vector<double> in(states.front().size() * samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const peers::Vector& state = states[(first + k) % states.size()];
    for (std::size_t i = 0; i < state.size(); ++i) in[i * samples + k] = state[i];
  }
  return in;
}

using Batch = std::function<void(const double* in, double* out)>;

// What is counted, and how many samples one call takes.
std::pair<Batch, std::size_t> function_of(const std::string& variant, const Question& question) {
  const program::ScalarProgram numbers = program::scalar_program(question.program());
  if (variant == "generated_limbs") {
    backend::COptions options;
    options.name = "counted";
    const backend::GeneratedCode code = generate_c(question.program(), options);
    EXPECT_TRUE(code.with_limbs.has_value());
    backend::CompileOptions compile;
    compile.flags = {"-O2"};
    const auto loaded = std::make_shared<backend::LoadedCode>(compile_and_load(code, compile));
    return {[loaded](const double* in, double* out) { loaded->function()(in, out); }, 1};
  }
  if (variant == "jit_limbs") {
    const auto jit = backend::jit_compile(numbers, {backend::JitLevel::kFull, "", false});
    return {[jit](const double* in, double* out) { jit(in, out); }, 1};
  }
  const bool batch = variant == "jit_batch";
  const auto jit =
      backend::jit_compile(numbers.computation, {backend::JitLevel::kFast, "", batch}, nullptr);
  if (batch) return {[jit](const double* in, double* out) { jit.batch(in, out, kBatch); }, kBatch};
  return {[jit](const double* in, double* out) { jit(in, out); }, 1};
}

void call_with_many_states(const std::string& variant) {
  const TemporaryUrdf urdf(humanoid_urdf(), "humanoid");
  // Compiling is what takes long under valgrind: a block of the smaller function will do.
  Question question(urdf.robot(), variant == "jit_batch" ? "fpk" : "rnea", true);
  const auto [function, samples] = function_of(variant, question);
  const program::Interface interface = program::interface_of(question.program());
  std::vector<double> out(interface.out_size * samples);
  const std::vector<peers::Vector> states = many_states(question);
  for (std::size_t first = 0; first < states.size(); ++first) {
    const std::vector<double> in = inputs_of(states, first, samples);
    sinew_counted_call([&] { function(in.data(), out.data()); });
  }
}

class ConstantWork : public testing::TestWithParam<std::string> {};

TEST_P(ConstantWork, IsTheSameNumberOfInstructionsInAThousandStates) {
  const std::string& variant = GetParam();
  if (std::getenv(kCounting) != nullptr) {
    call_with_many_states(variant);
    return;
  }
#ifdef SINEW_SANITIZED
  GTEST_SKIP() << "valgrind does not run what a sanitizer was built into";
#endif
  if (std::system("valgrind --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no valgrind to count instructions with";
  }
  std::string why;
  if (variant.starts_with("jit") && !backend::jit_available(&why)) GTEST_SKIP() << why;
  const fs::path folder =
      fs::path(testing::TempDir()) / fmt::format("counted_{}_{}", variant, ::getpid());
  fs::create_directories(folder);
  const fs::path self = fs::read_symlink("/proc/self/exe");
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::string line =
      fmt::format("cd '{}' && {}=1 {} '{}' --gtest_filter={}.{} --gtest_output= > log 2>&1",
                  folder.string(), kCounting, count_calls_of("sinew_counted_call"), self.string(),
                  test.test_suite_name(), test.name());
  ASSERT_EQ(std::system(line.c_str()), 0) << line;

  const InstructionCounts counts = counted_in(folder);
  EXPECT_EQ(counts.calls, kStates);
  EXPECT_EQ(counts.different.size(), 1U) << testing::PrintToString(counts.different);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Variants, ConstantWork,
                         testing::Values("jit_single", "jit_limbs", "jit_batch", "generated_limbs"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace sinew::test
