// Generated functions touch nothing but their arrays and leave no floating-point flags behind:
// single calls and batches of every size, with limbs side by side, on doubles and floats, in C and
// made in the process, and updates.
#include <gtest/gtest.h>

#include <random>

#include "guarded.h"
#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/jit.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

template <typename Number>
void fill(Guarded<Number>& numbers, std::size_t n) {
  static std::mt19937 random(3);
  std::uniform_real_distribution<Number> number(-1, 1);
  for (std::size_t i = 0; i < n; ++i) numbers[i] = number(random);
}

// `single(in, out)` and `batch(in, out, n)` on arrays of exactly their sizes.
template <typename Number, typename Single, typename Batch>
void expect_guarded(std::size_t in_size, std::size_t out_size, Single single, Batch batch) {
  for (const auto at : {Guarded<Number>::At::kEnd, Guarded<Number>::At::kStart}) {
    Guarded<Number> in(in_size, at), out(out_size, at);
    fill(in, in_size);
    EXPECT_EQ(flags_of([&] { single(in.data(), out.data()); }), 0);
    for (const std::size_t n : {1U, 2U, 7U, 8U, 9U, 15U, 16U, 17U, 31U}) {
      SCOPED_TRACE(n);
      Guarded<Number> rows(in_size * n, at), results(out_size * n, at);
      fill(rows, in_size * n);
      EXPECT_EQ(flags_of([&] { batch(rows.data(), results.data(), n); }), 0);
    }
  }
}

struct Case {
  const char* solver;
  bool expects_limbs;
};

class GuardedCalls : public testing::TestWithParam<Case> {
 protected:
  GuardedCalls()
      : humanoid_(humanoid_urdf(), "humanoid"),
        question_(humanoid_.robot(), GetParam().solver, true),
        scalar_(program::scalar_program(question_.program())),
        in_size_(scalar_.computation.inputs),
        out_size_(scalar_.computation.results.size()) {}

  TemporaryUrdf humanoid_;
  Question question_;
  program::ScalarProgram scalar_;
  std::size_t in_size_, out_size_;
};

TEST_P(GuardedCalls, OfCodeMadeInTheProcess) {
  std::string why;
  if (!backend::jit_available(&why)) GTEST_SKIP() << why;
  const auto on_doubles = backend::jit_compile(scalar_, {backend::JitLevel::kFast, ""});
  expect_guarded<double>(
      in_size_, out_size_, on_doubles,
      [&](const double* in, double* out, std::size_t n) { on_doubles.batch(in, out, n); });
  const auto on_floats = backend::jit_compile_float(scalar_, {backend::JitLevel::kFast, ""});
  expect_guarded<float>(
      in_size_, out_size_, on_floats,
      [&](const float* in, float* out, std::size_t n) { on_floats.batch(in, out, n); });
}

TEST_P(GuardedCalls, OfGeneratedC) {
  for (const backend::Scalar scalar : {backend::Scalar::kDouble, backend::Scalar::kFloat}) {
    backend::COptions options;
    options.name = "solver";
    options.scalar = scalar;
    const backend::GeneratedCode code = generate_c(question_.program(), options);
    EXPECT_EQ(code.with_limbs.has_value(), GetParam().expects_limbs);
    backend::CompileOptions compile;
    compile.compiler = "gcc";
    compile.flags = {"-O1",     "-march=native", "-Wall",    "-Wextra",
                     "-Werror", "-std=c11",      "-pedantic"};
    const backend::LoadedCode loaded = compile_and_load(code, compile);
    if (scalar == backend::Scalar::kDouble) {
      expect_guarded<double>(in_size_, out_size_, loaded.function(), loaded.batch());
    } else {
      using Single = void (*)(const float*, float*);
      using Batch = void (*)(const float*, float*, std::size_t);
      expect_guarded<float>(in_size_, out_size_, reinterpret_cast<Single>(loaded.find("solver")),
                            reinterpret_cast<Batch>(loaded.find("solver_batch")));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Humanoid, GuardedCalls,
                         testing::Values(Case{"fpk", true}, Case{"rnea", true}, Case{"aba", true}),
                         [](const auto& info) { return std::string(info.param.solver); });

// What depends on positions alone is updated; the others see it through `held`.
TEST(GuardedUpdate, AndTheEvaluationsThatFollow) {
  const TemporaryUrdf humanoid(humanoid_urdf(), "humanoid");
  const Question question(humanoid.robot(), "rnea", true);
  backend::COptions options;
  options.name = "solver";
  options.partial.slow = {"position"};
  const program::ScalarProgram scalar =
      program::scalar_program(question.program(), {}, options.partial);
  const std::size_t held_size = scalar.update.results.size();
  ASSERT_GT(held_size, 0U);
  const program::Interface interface = program::interface_of(scalar.program);
  backend::CompileOptions compile;
  compile.compiler = "gcc";
  compile.flags = {"-O1", "-march=native"};
  const backend::LoadedCode loaded =
      compile_and_load(generate_c(question.program(), options), compile);
  using Update = void (*)(const double*, double*);
  using Single = void (*)(const double*, const double*, double*);
  using Batch = void (*)(const double*, const double*, double*, std::size_t);
  const auto update = reinterpret_cast<Update>(loaded.find("solver_update"));
  const auto single = reinterpret_cast<Single>(loaded.find("solver"));
  const auto batch = reinterpret_cast<Batch>(loaded.find("solver_batch"));
  for (const auto at : {Guarded<double>::At::kEnd, Guarded<double>::At::kStart}) {
    Guarded<double> in(interface.in_size, at), held(held_size, at);
    fill(in, interface.in_size);
    EXPECT_EQ(flags_of([&] { update(in.data(), held.data()); }), 0);
    expect_guarded<double>(
        interface.in_size, interface.out_size,
        [&](const double* from, double* to) { single(from, held.data(), to); },
        [&](const double* from, double* to, std::size_t n) { batch(from, held.data(), to, n); });
  }
}

}  // namespace
}  // namespace sinew::test
