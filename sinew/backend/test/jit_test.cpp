#include "sinew/backend/jit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/dag/traced.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Dag;
using program::Ref;
using program::Traced;

class Jit : public testing::TestWithParam<JitLevel> {
 protected:
  void SetUp() override {
    std::string why;
    if (!jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
  }
};

TEST(JitLibrary, IsThereWhereLlvmWasWhenThisWasBuilt) {
  std::string why;
  EXPECT_EQ(jit_available(&why), SINEW_JIT_IS_BUILT != 0) << why;
}

Computation sines_and_cosines(std::uint32_t angles) {
  Computation computation;
  computation.inputs = angles;
  for (std::uint32_t i = 0; i < angles; ++i) {
    const Ref angle = computation.dag.input(i);
    computation.results.push_back(computation.dag.sin(angle));
    computation.results.push_back(computation.dag.cos(angle));
  }
  return computation;
}

// Every operation, with every combination of signs on its operands.
Computation every_operation() {
  Computation c;
  c.inputs = 4;
  Dag& dag = c.dag;
  const Ref in[] = {dag.input(0), dag.input(1), dag.input(2), dag.input(3)};
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      const Ref a = in[0].negated_if(first);
      const Ref b = in[1].negated_if(second);
      c.results.push_back(dag.add(a, b));
      c.results.push_back(dag.multiply(a, b));
      c.results.push_back(dag.divide(a, b));
      c.results.push_back(dag.add(dag.multiply(a, in[2]), b));
      c.results.push_back(dag.add(dag.multiply(a, in[2]), dag.multiply(in[3], b)));
      c.results.push_back(dag.fma(a, b, in[2].negated_if(first)));
      c.results.push_back(dag.select(dag.less(a, b), in[2], -in[3]));
      c.results.push_back(dag.sin(dag.add(a, b)));
      c.results.push_back(-dag.cos(dag.multiply(a, b)));
    }
  }
  c.results.push_back(dag.sqrt(dag.multiply(in[0], in[0])));
  c.results.push_back(dag.constant(-2.5));
  c.results.push_back(-in[3]);
  return c;
}

double ulps(double value, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  const double spacing = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(value - exact) / spacing);
}

TEST_P(Jit, AgreesWithTheInterpreterOnEveryOperation) {
  const Computation computation = every_operation();
  const JitFunction function = jit_compile(computation, {GetParam(), ""});
  std::mt19937 random(1);
  std::uniform_real_distribution<> number(-3, 3);
  std::vector<double> out(computation.results.size());
  for (int sample = 0; sample < 1000; ++sample) {
    std::vector<double> in(computation.inputs);
    for (double& x : in) x = number(random);
    function(in.data(), out.data());
    const std::vector<double> expected = evaluate(computation, in);
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_NEAR(out[i], expected[i], 1e-13 * (1 + std::fabs(expected[i]))) << "result " << i;
    }
  }
}

TEST_P(Jit, SinesAndCosinesAreWithinOneUlpOfTheExactValueUpTo1e5) {
  for (const std::uint32_t angles : {1u, 2u, 5u, 8u, 13u, 30u}) {
    const Computation computation = sines_and_cosines(angles);
    const JitFunction function = jit_compile(computation, {GetParam(), ""});
    std::mt19937_64 random(angles);
    std::vector<double> in(angles), out(2 * angles);
    double worst = 0;
    for (int sample = 0; sample < 20000; ++sample) {
      const double range = std::pow(10.0, std::uniform_real_distribution<>(-8, 5)(random));
      for (double& x : in) x = std::uniform_real_distribution<>(-range, range)(random);
      if (sample % 7 == 0) in[0] = std::round(in[0]) * M_PI_2;  // where the remainder is tiny
      if (std::fabs(in[0]) > 1e5) in[0] = 1e5;
      function(in.data(), out.data());
      for (std::uint32_t i = 0; i < angles; ++i) {
        const long double x = in[i];
        worst = std::max(worst, ulps(out[2 * i], std::sin(x)));
        worst = std::max(worst, ulps(out[2 * i + 1], std::cos(x)));
      }
    }
    EXPECT_LE(worst, 1.0);
  }
}

// Of many angles most are computed by a loop.
TEST_P(Jit, AnglesBeyondTheFastRangeInfinitiesAndNanComeFromLibm) {
  const double odd[] = {1e9, -3e17, std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()};
  for (const std::uint32_t angles : {3u, 30u}) {
    const JitFunction function = jit_compile(sines_and_cosines(angles), {GetParam(), ""});
    std::vector<double> near(angles), plain(2 * angles);
    for (std::uint32_t i = 0; i < angles; ++i) near[i] = 0.5 - 0.25 * i;
    function(near.data(), plain.data());
    for (const double x : odd) {
      for (std::uint32_t at = 0; at < angles; ++at) {
        std::vector<double> in = near, out(2 * angles);
        in[at] = x;
        function(in.data(), out.data());
        if (std::isfinite(x)) {
          EXPECT_EQ(out[2 * at], std::sin(x));
          EXPECT_EQ(out[2 * at + 1], std::cos(x));
        } else {
          EXPECT_TRUE(std::isnan(out[2 * at]));
          EXPECT_TRUE(std::isnan(out[2 * at + 1]));
        }
        // Its neighbours are not touched.
        for (std::uint32_t i = 0; i < 2 * angles; ++i) {
          if (i / 2 == at) continue;
          EXPECT_EQ(out[i], plain[i]) << i << " of " << angles;
        }
      }
    }
  }
}

// The loop asks for the sum of all squares, which is far where no angle is.
TEST_P(Jit, ManyAnglesAtTheEndOfTheFastRangeAreAsExact) {
  const std::uint32_t angles = 30;
  const JitFunction function = jit_compile(sines_and_cosines(angles), {GetParam(), ""});
  std::vector<double> in(angles), out(2 * angles);
  for (std::uint32_t i = 0; i < angles; ++i) in[i] = (i % 2 == 0 ? 1e5 : -1e5) + 0.1 * i;
  for (double& x : in) x = std::clamp(x, -1e5, 1e5);
  function(in.data(), out.data());
  for (std::uint32_t i = 0; i < angles; ++i) {
    const long double x = in[i];
    EXPECT_LE(ulps(out[2 * i], std::sin(x)), 1.0);
    EXPECT_LE(ulps(out[2 * i + 1], std::cos(x)), 1.0);
  }
}

TEST_P(Jit, ABatchGivesTheBitsOfSingleCallsWhateverItsSize) {
  const Computation computation = every_operation();
  const JitFunction function = jit_compile(computation, {GetParam(), ""});
  const std::size_t inputs = computation.inputs, results = computation.results.size();
  std::mt19937 random(2);
  std::uniform_real_distribution<> number(-3, 3);
  for (const std::size_t n : {1u, 7u, 8u, 9u, 16u, 31u}) {
    std::vector<double> in(inputs * n), out(results * n + 1, 4.0);
    for (double& x : in) x = number(random);
    in[0] = 1e7;  // one sample leaves the fast range of sines
    function.batch(in.data(), out.data(), n);
    EXPECT_EQ(out.back(), 4.0) << "written beyond the end";
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> sample(inputs), single(results);
      for (std::size_t i = 0; i < inputs; ++i) sample[i] = in[i * n + k];
      function(sample.data(), single.data());
      for (std::size_t j = 0; j < results; ++j) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(single[j]),
                  std::bit_cast<std::uint64_t>(out[j * n + k]))
            << "sample " << k << " of " << n << ", result " << j;
      }
    }
  }
}

TEST_P(Jit, KeepsCompiledCodeInItsCacheByContent) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       ("sinew-jit-" + std::to_string(std::random_device()()));
  const JitOptions options{GetParam(), folder.string()};
  const JitFunction first = jit_compile(sines_and_cosines(2), options);
  const JitFunction second = jit_compile(sines_and_cosines(2), options);
  const JitFunction other = jit_compile(sines_and_cosines(3), options);
  EXPECT_FALSE(first.from_cache());
  EXPECT_TRUE(second.from_cache());
  EXPECT_FALSE(other.from_cache());
  EXPECT_EQ(first.code_bytes(), second.code_bytes());
  EXPECT_GT(first.code_bytes(), 0u);
  std::filesystem::remove_all(folder);
}

struct Damage {
  const char* what;
  void (*to)(std::string& file, const std::string& other);
};

// A cached file that is not what was written under its name is compiled anew, never run.
TEST_P(Jit, RunsNothingThatIsDamagedInItsCache) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       ("sinew-jit-" + std::to_string(std::random_device()()));
  const JitOptions options{GetParam(), (folder / "it").string()};
  const JitOptions elsewhere{GetParam(), (folder / "other").string()};
  const auto only_files = [](const std::string& in) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(in)) files.push_back(entry.path());
    std::ranges::sort(files, {}, [](const auto& file) { return std::filesystem::file_size(file); });
    return files;
  };
  const auto text_of = [](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const Damage damages[] = {
      {"cut to a hundred bytes", [](std::string& file, const std::string&) { file.resize(100); }},
      {"without its last byte", [](std::string& file, const std::string&) { file.pop_back(); }},
      {"empty", [](std::string& file, const std::string&) { file.clear(); }},
      {"of zeros", [](std::string& file, const std::string&) { file.assign(file.size(), 0); }},
      {"one bit of code turned", [](std::string& file, const std::string&) { file[200] ^= 4; }},
      {"another program's", [](std::string& file, const std::string& other) { file = other; }},
  };
  const double in[] = {0.3, 0.4};
  double out[4];
  jit_compile(sines_and_cosines(3), elsewhere);
  jit_compile(sines_and_cosines(2), options);
  const auto others = only_files(elsewhere.cache_folder);
  for (const Damage& damage : damages) {
    const auto files = only_files(options.cache_folder);
    ASSERT_EQ(files.size(), others.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
      std::string text = text_of(files[i]);
      damage.to(text, text_of(others[i]));
      std::ofstream(files[i], std::ios::binary) << text;
    }
    const JitFunction again = jit_compile(sines_and_cosines(2), options);
    EXPECT_FALSE(again.from_cache()) << damage.what;
    again(in, out);
    EXPECT_DOUBLE_EQ(out[0], std::sin(0.3)) << damage.what;
    EXPECT_TRUE(jit_compile(sines_and_cosines(2), options).from_cache()) << damage.what;
  }
  std::filesystem::remove_all(folder);
}

TEST_P(Jit, RefusesWhatIsTooWideForOneFunction) {
  Computation computation;
  computation.inputs = JitFunction::kMaximumWidth;
  computation.results.push_back(computation.dag.input(0));
  EXPECT_THROW(jit_compile(computation, {GetParam(), ""}), Error);
}

INSTANTIATE_TEST_SUITE_P(Levels, Jit, testing::Values(JitLevel::kFast, JitLevel::kFull),
                         [](const auto& info) {
                           return info.param == JitLevel::kFast ? "fast" : "full";
                         });

}  // namespace
}  // namespace sinew::backend
