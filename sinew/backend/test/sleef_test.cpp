// Generated C whose sines and cosines are those of SLEEF.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "serial_chain.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/interpreter.h"
#include "sinew/base/error.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

program::Program chain() { return test::inverse_dynamics(test::mixed_chain(), true); }

backend::COptions sleef(backend::Scalar scalar = backend::Scalar::kDouble) {
  backend::COptions options;
  options.name = "chain";
  options.scalar = scalar;
  options.trigonometry = backend::Trigonometry::kSleef;
  return options;
}

class GeneratedSleef : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / fmt::format("sleef_{}", getpid());
    fs::create_directories(folder_);
    if (std::system("printf '#include <sleef.h>\\nint main(void){return 0;}' | "
                    "gcc -x c - -o /dev/null -lsleef 2> /dev/null") != 0) {
      GTEST_SKIP() << "SLEEF is not installed (libsleef-dev)";
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  // The largest error over the largest expected number of each sample, of single calls and batches.
  template <typename Number>
  double worst_error(const std::string& compiler, double largest) {
    for (const backend::SourceFile& file :
         generate_c(chain(),
                    sleef(sizeof(Number) == 4 ? backend::Scalar::kFloat : backend::Scalar::kDouble))
             .files) {
      std::ofstream(folder_ / file.name) << file.text;
    }
    const std::string line = fmt::format(
        "cd '{0}' && {1} -Wall -Wextra -Werror -pedantic chain.c -shared -fPIC "
        "-o chain{2}.so -lsleef -lm",
        folder_.string(), compiler, ++number_);
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    void* library = dlopen((folder_ / fmt::format("chain{}.so", number_)).c_str(), RTLD_NOW);
    if (library == nullptr) throw std::runtime_error(dlerror());
    const auto one = reinterpret_cast<void (*)(const Number*, Number*)>(dlsym(library, "chain"));
    const auto batch = reinterpret_cast<void (*)(const Number*, Number*, std::size_t)>(
        dlsym(library, "chain_batch"));

    constexpr std::size_t kSamples = 1003;
    backend::Interpreter interpreter(chain());
    const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
    std::vector<Number> in(in_size), out(out_size), rows(in_size * kSamples),
        out_rows(out_size * kSamples);
    std::mt19937 random(4);
    std::uniform_real_distribution<Number> number(static_cast<Number>(-largest),
                                                  static_cast<Number>(largest));
    for (Number& x : rows) x = number(random);
    batch(rows.data(), out_rows.data(), kSamples);
    double worst = 0;
    std::vector<double> exact(in_size), expected(out_size);
    for (std::size_t k = 0; k < kSamples; ++k) {
      for (std::size_t i = 0; i < in_size; ++i) exact[i] = in[i] = rows[i * kSamples + k];
      interpreter.evaluate(exact.data(), expected.data());
      one(in.data(), out.data());
      double scale = 1;
      for (const double x : expected) scale = std::max(scale, std::abs(x));
      for (std::size_t i = 0; i < out_size; ++i) {
        worst = std::max(worst, std::abs(out[i] - expected[i]) / scale);
        worst = std::max(worst, std::abs(out_rows[i * kSamples + k] - expected[i]) / scale);
      }
    }
    dlclose(library);
    return worst;
  }

  fs::path folder_;
  int number_ = 0;
};

TEST_F(GeneratedSleef, AgreesWithTheInterpreterUnderEveryCompilerAndProcessor) {
  for (const char* compiler :
       {"gcc -std=c11 -O1 -march=native", "gcc -std=c11 -O1", "gcc -std=c11 -O1 -mavx2 -mfma",
        "clang-19 -std=c11 -O1 -march=native", "g++ -x c++ -O1 -march=native",
        "gcc -std=c11 -O1 -ffast-math"}) {
    SCOPED_TRACE(compiler);
    EXPECT_LT(worst_error<double>(compiler, 3.2), 1e-12);
    EXPECT_LT(worst_error<double>(compiler, 1e7), 1e-9);  // far angles, and terms that cancel
    EXPECT_LT(worst_error<float>(compiler, 3.2), 4e-6);
  }
}

TEST(GeneratedSleefSource, SaysHowToLinkIt) {
  const backend::GeneratedCode code = generate_c(chain(), sleef());
  EXPECT_NE(code.files[1].text.find("#include <sleef.h>"), std::string::npos);
  EXPECT_NE(code.files[1].text.find("-lsleef"), std::string::npos);
  EXPECT_NE(code.files[2].text.find("\"trigonometry\":\"sleef\""), std::string::npos);
}

TEST(GeneratedSleefSource, IsRefusedWhereItCannotBe) {
  backend::COptions cuda = sleef();
  cuda.language = backend::Language::kCuda;
  EXPECT_THROW(generate_c(chain(), cuda), Error);
  backend::COptions readable = sleef();
  readable.style = backend::Style::kReadable;
  EXPECT_THROW(generate_c(chain(), readable), Error);
}

}  // namespace
}  // namespace sinew
