// What all back ends compute on a hundred thousand states, against the interpreter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

constexpr std::size_t kStates = 100000;
constexpr std::size_t kChunk = 1000;  // states of one batch

// Joint angles over a whole turn; some next to multiples of pi, some many turns away, up to the
// angles for which the C library is called. Other numbers from +-1; quaternions of length 1.
class States {
 public:
  explicit States(const program::Program& program) {
    for (const program::Slot& slot : program::interface_of(program).inputs) {
      const program::Variable& v = program.variables[slot.variable];
      const bool position = v.name.starts_with("position.");
      kinds_.insert(kinds_.end(), v.size, position && v.size == 1 ? Kind::kAngle : Kind::kNumber);
      if (position && v.size == 7) quaternion_ = slot.offset + 3;
    }
  }

  void draw(double* in) {
    std::uniform_real_distribution<> number(-1, 1);
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      in[i] = number(random_);
      if (kinds_[i] == Kind::kNumber) continue;
      const unsigned kind = random_() % 32;
      const double turns = kind == 0 ? 2e4 : kind < 3 ? 100.0 : 1.0;
      in[i] *= turns * M_PI;
      if (kind >= 28) in[i] = std::round(in[i] / M_PI) * M_PI + 1e-9 * number(random_);
    }
    if (quaternion_ == 0) return;
    double length = 0;
    for (std::size_t i = 0; i < 4; ++i) length += in[quaternion_ + i] * in[quaternion_ + i];
    for (std::size_t i = 0; i < 4; ++i) in[quaternion_ + i] /= std::sqrt(length);
  }

 private:
  enum class Kind { kAngle, kNumber };
  std::vector<Kind> kinds_;
  std::size_t quaternion_ = 0;  // where it starts; 0: there is none
  std::mt19937 random_{11};
};

struct Bounds {
  double with_double, with_float;
};

// The largest differences, relative to the largest number of a state's results, but at least to 1.
struct Differences {
  double single = 0, batch = 0, of_float = 0, c = 0, c_batch = 0;
};

template <typename Number>
void compare(const double* expected, const Number* out, std::size_t n, std::size_t stride,
             double& worst) {
  double scale = 1, apart = 0;
  for (std::size_t i = 0; i < n; ++i) {
    scale = std::max(scale, std::abs(expected[i]));
    const double off = std::abs(static_cast<double>(out[i * stride]) - expected[i]);
    apart = off <= apart ? apart : off;  // also what is no number
  }
  worst = apart / scale <= worst ? worst : apart / scale;
}

Differences differences(const program::Program& program, const backend::LoadedCode* c) {
  const program::ScalarProgram scalar = program::scalar_program(program);
  const backend::JitFunction jit = backend::jit_compile(scalar, {backend::JitLevel::kFast, ""});
  const backend::JitFloatFunction on_floats =
      backend::jit_compile_float(scalar, {backend::JitLevel::kFast, "", false});
  backend::Interpreter interpreter(program);
  const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
  States states(program);
  Differences worst;
  std::vector<double> in(in_size * kChunk), out(out_size), expected(out_size * kChunk),
      in_rows(in_size * kChunk), out_rows(out_size * kChunk), rounded(in_size), near(out_size);
  std::vector<float> in_float(in_size), out_float(out_size);
  for (std::size_t done = 0; done < kStates; done += kChunk) {
    for (std::size_t k = 0; k < kChunk; ++k) {
      double* const state = &in[k * in_size];
      states.draw(state);
      for (std::size_t i = 0; i < in_size; ++i) in_rows[i * kChunk + k] = state[i];
      interpreter.evaluate(state, &expected[k * out_size]);
      jit(state, out.data());
      compare(&expected[k * out_size], out.data(), out_size, 1, worst.single);
      if (c != nullptr) {
        c->function()(state, out.data());
        compare(&expected[k * out_size], out.data(), out_size, 1, worst.c);
      }
      // What floats are given, they are given exactly.
      std::copy_n(state, in_size, in_float.begin());
      std::copy(in_float.begin(), in_float.end(), rounded.begin());
      interpreter.evaluate(rounded.data(), near.data());
      on_floats(in_float.data(), out_float.data());
      compare(near.data(), out_float.data(), out_size, 1, worst.of_float);
    }
    jit.batch(in_rows.data(), out_rows.data(), kChunk);
    for (std::size_t k = 0; k < kChunk; ++k) {
      compare(&expected[k * out_size], &out_rows[k], out_size, kChunk, worst.batch);
    }
    if (c == nullptr) continue;
    c->batch()(in_rows.data(), out_rows.data(), kChunk);
    for (std::size_t k = 0; k < kChunk; ++k) {
      compare(&expected[k * out_size], &out_rows[k], out_size, kChunk, worst.c_batch);
    }
  }
  return worst;
}

struct Case {
  std::string solver;
  Bounds bounds;
  bool c = false;  // compiled by gcc, too
};

void expect_agreement(const Robot& robot, bool floating, const std::vector<Case>& cases) {
  for (const auto& [solver, bounds, with_c] : cases) {
    SCOPED_TRACE(solver + " " + robot.name);
    const Question question(robot, solver, floating);
    std::optional<backend::LoadedCode> c;
    if (with_c) {
      backend::COptions options;
      options.name = "solver";
      backend::CompileOptions compile;
      compile.compiler = "gcc";
      compile.flags = {"-O1", "-march=native"};
      c.emplace(compile_and_load(generate_c(question.program(), options), compile));
    }
    const Differences found = differences(question.program(), c ? &*c : nullptr);
    EXPECT_LT(found.single, bounds.with_double);
    EXPECT_LT(found.batch, bounds.with_double);
    EXPECT_LT(found.c, bounds.with_double);
    EXPECT_LT(found.c_batch, bounds.with_double);
    EXPECT_LT(found.of_float, bounds.with_float);
  }
}

class Accuracy : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    if (!backend::jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
  }
};

// Forward dynamics multiply round-off by the condition of the mass matrix.
TEST_F(Accuracy, OfPublishedRobotsOnAHundredThousandStates) {
  const auto robots = published_robots();
  if (robots.empty()) GTEST_SKIP() << "there are no robots in " SINEW_SHARED_DIR;
  for (const Robot& robot : robots) {
    if (robot.name == "clean/gen3.urdf") {
      expect_agreement(robot, false,
                       {{"fpk", {1e-12, 2e-6}},
                        {"rnea", {1e-12, 2e-6}, true},
                        {"aba", {1e-12, 2e-4}, true},
                        {"crba", {1e-12, 2e-6}}});
    } else if (robot.name == "clean/hyq.urdf") {
      expect_agreement(
          robot, true,
          {{"rnea", {1e-12, 2e-6}, true}, {"aba", {1e-12, 2e-4}}, {"crba", {1e-12, 2e-6}}});
    }
  }
}

TEST_F(Accuracy, OfAHumanoidOnAHundredThousandStates) {
  const TemporaryUrdf humanoid(humanoid_urdf(), "humanoid");
  expect_agreement(humanoid.robot(), true,
                   {{"fpk", {1e-12, 2e-6}}, {"rnea", {1e-12, 2e-6}}, {"aba", {1e-12, 2e-4}}});
}

}  // namespace
}  // namespace sinew::test
