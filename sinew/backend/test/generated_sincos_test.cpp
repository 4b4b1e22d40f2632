// The sines and cosines in generated code, against long double.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"

namespace sinew {
namespace {

// Seven joint positions to seven poses.
program::Program positions_to_poses() {
  program::Program p;
  p.name = "angles";
  for (std::uint32_t k = 0; k < 7; ++k) {
    program::Variable q, X;
    q.name = "position.joint" + std::to_string(k);
    q.role = program::Role::kInput;
    q.size = 1;
    X.name = "pose.joint" + std::to_string(k);
    X.size = 12;
    X.output = true;
    p.closures.push_back({"position-to-pose-revolute", "", "", "", {2 * k, 2 * k + 1}});
    p.schedule.push_back(k);
    p.variables.push_back(q);
    p.variables.push_back(X);
  }
  return p;
}

constexpr std::size_t kAngles = 7;
constexpr std::size_t kOut = 12 * kAngles;

struct Build {
  const char* compiler;
  const char* flag;
};

class GeneratedSincos : public testing::TestWithParam<Build> {
 protected:
  GeneratedSincos() {
    backend::COptions options;
    options.name = "angles";
    backend::CompileOptions compile;
    compile.compiler = GetParam().compiler;
    compile.flags = {"-O2", GetParam().flag};
    code_.emplace(compile_and_load(generate_c(positions_to_poses(), options), compile));
  }

  // Angle k of each sample; sine and cosine of all, by the batch function.
  void evaluate(const std::vector<double>& angles, std::vector<double>& sines,
                std::vector<double>& cosines) {
    const std::size_t n = angles.size() / kAngles;
    std::vector<double> out(kOut * n);
    code_->batch()(angles.data(), out.data(), n);
    sines.resize(angles.size());
    cosines.resize(angles.size());
    for (std::size_t j = 0; j < kAngles; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        cosines[j * n + k] = out[(12 * j + 0) * n + k];
        sines[j * n + k] = out[(12 * j + 4) * n + k];
      }
    }
  }

  std::optional<backend::LoadedCode> code_;
};

// Distance in units in the last place of the exact value.
double ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  int exponent = 0;
  std::frexp(rounded, &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::abs(value - exact) / unit);
}

TEST_P(GeneratedSincos, AreWithinOneUnitInTheLastPlaceOnAMillionAngles) {
  std::mt19937_64 generator(1);
  std::vector<double> angles;
  for (const double range : {1.6, 7.0, 200.0, 1e5}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int k = 0; k < 252000; ++k) angles.push_back(uniform(generator));
  }
  // And where it is hardest, next to the multiples of pi/2.
  for (int k = -63000; k < 63000; k += 9) {
    double angle = k * 1.5707963267948966;
    for (int step = 0; step < 3; ++step) {
      angles.push_back(angle);
      angle = std::nextafter(angle, 1e9);
    }
  }
  angles.resize(angles.size() / kAngles * kAngles);
  std::vector<double> sines, cosines;
  evaluate(angles, sines, cosines);
  double worst = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    worst = std::max(worst, ulps(sines[i], sinl(angles[i])));
    worst = std::max(worst, ulps(cosines[i], cosl(angles[i])));
  }
  RecordProperty("worst_ulps", std::to_string(worst));
  EXPECT_LE(worst, 1.0);
}

TEST_P(GeneratedSincos, AreThoseOfLibmBeyondTheirRange) {
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> angles = {1e6, -3e9, 1e300, infinite, -infinite, nan, 0.5};
  std::vector<double> sines, cosines;
  evaluate(angles, sines, cosines);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sines[i], std::sin(angles[i]));
    EXPECT_EQ(cosines[i], std::cos(angles[i]));
  }
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_TRUE(std::isnan(sines[i]));
    EXPECT_TRUE(std::isnan(cosines[i]));
  }
  // A neighbour is not disturbed: it has the same bits as among ordinary angles.
  std::vector<double> ordinary(7, 0.5), s, c;
  evaluate(ordinary, s, c);
  EXPECT_EQ(sines[6], s[6]);
  EXPECT_EQ(cosines[6], c[6]);
}

TEST_P(GeneratedSincos, AreExactAtZeroAndForTheSmallestNumbers) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> angles = {0.0, tiny, -tiny, 1e-300, -1e-20, 1e-9, 1e-4};
  std::vector<double> sines, cosines;
  evaluate(angles, sines, cosines);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(sines[i], angles[i]);
    EXPECT_EQ(cosines[i], 1.0);
  }
}

TEST_P(GeneratedSincos, AreTheSameInASingleCallAndAnywhereInABatch) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-4.0, 4.0);
  for (const std::size_t n : {1, 2, 3, 7, 8, 9, 16, 23}) {
    std::vector<double> in(kAngles * n), out(kOut * n);
    for (double& value : in) value = uniform(generator);
    code_->batch()(in.data(), out.data(), n);
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> one_in(kAngles), one_out(kOut);
      for (std::size_t i = 0; i < kAngles; ++i) one_in[i] = in[i * n + k];
      code_->function()(one_in.data(), one_out.data());
      for (std::size_t i = 0; i < kOut; ++i) EXPECT_EQ(one_out[i], out[i * n + k]);
    }
  }
}

// -D__FAST_MATH__ is the plain C that compilers without vectors get as well.
INSTANTIATE_TEST_SUITE_P(Compilers, GeneratedSincos,
                         testing::Values(Build{"gcc", "-march=native"},
                                         Build{"gcc", "-mtune=generic"},
                                         Build{"gcc", "-D__FAST_MATH__"}, Build{"gcc", "-std=c11"},
                                         Build{"clang-19", "-march=native"},
                                         Build{"clang-19", "-mtune=generic"}),
                         [](const auto& info) {
                           std::string name = std::string(info.param.compiler) + info.param.flag;
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace sinew
