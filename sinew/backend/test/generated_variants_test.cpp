// Generated code other than the plain function on doubles: float, CUDA source, and programs whose
// slow part is an update of its own.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "serial_chain.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/interpreter.h"
#include "sinew/base/error.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

// Generated files, compiled and loaded; the names of its functions are up to the test.
class Compiled {
 public:
  Compiled(const backend::GeneratedCode& code, const std::string& command) {
    static int number = 0;
    folder_ = fs::path(testing::TempDir()) / fmt::format("generated_{}_{}", getpid(), number++);
    fs::create_directories(folder_);
    for (const backend::SourceFile& file : code.files) {
      std::ofstream(folder_ / file.name) << file.text;
    }
    const std::string line =
        fmt::format("cd '{}' && {} -shared -fPIC -o code.so -lm", folder_.string(), command);
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    library_ = dlopen((folder_ / "code.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr);
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;
  ~Compiled() {
    if (library_ != nullptr) dlclose(library_);
    fs::remove_all(folder_);
  }
  template <typename Function>
  Function* get(const char* name) const {
    void* symbol = dlsym(library_, name);
    EXPECT_NE(symbol, nullptr) << name;
    return reinterpret_cast<Function*>(symbol);
  }

 private:
  fs::path folder_;
  void* library_ = nullptr;
};

constexpr const char* kStrict = "-Wall -Wextra -Werror -std=c11 -pedantic";

program::Program chain() { return test::inverse_dynamics(test::mixed_chain(), true); }

backend::COptions named() {
  backend::COptions options;
  options.name = "chain";
  return options;
}

// Angles up to `largest`, some of them next to multiples of pi.
std::vector<double> random_inputs(std::size_t n, double largest, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-largest, largest);
  std::vector<double> values(n);
  for (double& value : values) {
    value = uniform(random);
    if (random() % 8 == 0) value = std::round(value / M_PI) * M_PI + 1e-9 * uniform(random);
  }
  return values;
}

// Largest error of a float program over the magnitude of the double results.
double float_error(const Compiled& code, std::size_t samples, double largest) {
  auto* one = code.get<void(const float*, float*)>("chain");
  auto* batch = code.get<void(const float*, float*, std::size_t)>("chain_batch");
  backend::Interpreter interpreter(chain());
  const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
  std::vector<float> all(in_size * samples), all_out(out_size * samples);
  std::vector<std::vector<float>> expected_bits;
  std::mt19937 random(7);
  double worst = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    std::vector<double> in = random_inputs(in_size, largest, random);
    std::vector<float> in_float(in.begin(), in.end());
    in.assign(in_float.begin(), in_float.end());  // the same inputs for both
    std::vector<double> expected(out_size);
    std::vector<float> out(out_size);
    interpreter.evaluate(in.data(), expected.data());
    one(in_float.data(), out.data());
    double scale = 1;
    for (const double x : expected) scale = std::max(scale, std::abs(x));
    for (std::size_t i = 0; i < out_size; ++i) {
      worst = std::max(worst, std::abs(out[i] - expected[i]) / scale);
    }
    for (std::size_t i = 0; i < in_size; ++i) all[i * samples + k] = in_float[i];
    expected_bits.push_back(std::move(out));
  }
  batch(all.data(), all_out.data(), samples);
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::size_t i = 0; i < out_size; ++i) {
      EXPECT_EQ(all_out[i * samples + k], expected_bits[k][i]) << "sample " << k << " result " << i;
    }
  }
  return worst;
}

TEST(GeneratedFloat, AgreesWithTheInterpreterToRoundOffAndInBatchesToTheBit) {
  backend::COptions options = named();
  options.scalar = backend::Scalar::kFloat;
  const backend::GeneratedCode code = generate_c(chain(), options);
  for (const char* compiler : {"gcc -O2", "gcc -O2 -march=native", "clang-19 -O2 -march=native"}) {
    SCOPED_TRACE(compiler);
    const Compiled compiled(code, fmt::format("{} {} chain.c", compiler, kStrict));
    // 2^-24 = 6e-8 is one rounding; a chain of seven joints rounds some hundred times.
    EXPECT_LT(float_error(compiled, 10003, 3.2), 4e-6);
    // 300 rad, but also 300 m and 300 rad/s: large terms cancel.
    EXPECT_LT(float_error(compiled, 1001, 300.0), 4e-5);
  }
}

TEST(GeneratedFloat, HandsFarAnglesToTheLibrary) {
  backend::COptions options = named();
  options.scalar = backend::Scalar::kFloat;
  const Compiled code(generate_c(chain(), options),
                      fmt::format("gcc -O2 -march=native {} chain.c", kStrict));
  auto* one = code.get<void(const float*, float*)>("chain");
  backend::Interpreter interpreter(chain());
  for (const float far : {2e5F, -3.5e7F, 1e30F}) {
    std::vector<double> in(interpreter.in_size(), 0.25), expected(interpreter.out_size());
    in[1] = far;
    std::vector<float> in_float(in.begin(), in.end()), out(expected.size());
    interpreter.evaluate(in.data(), expected.data());
    one(in_float.data(), out.data());
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_NEAR(out[i], expected[i], 1e-4 * (1 + std::abs(expected[i]))) << far;
    }
  }
  std::vector<float> in(interpreter.in_size(), 0.25F), out(interpreter.out_size());
  in[1] = NAN;
  one(in.data(), out.data());
  EXPECT_TRUE(std::isnan(out[0]));
}

TEST(GeneratedFloat, RefusesAConstantThatItCannotHold) {
  std::vector<test::ChainJoint> joints = test::mixed_chain();
  joints.back().inertia[0] = 1e200;
  backend::COptions options = named();
  options.scalar = backend::Scalar::kFloat;
  try {
    generate_c(test::inverse_dynamics(joints), options);
    FAIL() << "a mass of 1e200 kg became a float";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a float cannot hold"), std::string::npos);
  }
}

// Takes a version out of the code, as if the processor did not have what it needs.
void drop_version(backend::GeneratedCode& code, const std::string& macro) {
  std::string& text = code.files[1].text;
  const std::string line = "#define " + macro + "\n";
  const std::size_t at = text.find(line);
  ASSERT_NE(at, std::string::npos) << macro;
  text.erase(at, line.size());
}

TEST(GeneratedVersions, AgreeAndAreTheSameBitsAloneAndInABatch) {
  for (const int dropped : {0, 1, 2}) {
    SCOPED_TRACE(dropped == 0 ? "best" : dropped == 1 ? "AVX2" : "base processor");
    backend::GeneratedCode code = generate_c(chain(), named());
    if (dropped >= 1) drop_version(code, "CHAIN_AVX512");
    if (dropped >= 2) drop_version(code, "CHAIN_AVX2");
    const Compiled compiled(code, fmt::format("gcc -O2 {} chain.c", kStrict));
    auto* one = compiled.get<void(const double*, double*)>("chain");
    auto* batch = compiled.get<void(const double*, double*, std::size_t)>("chain_batch");
    backend::Interpreter interpreter(chain());
    const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
    std::mt19937 random(19);
    for (std::size_t n = 1; n < 20; ++n) {
      const std::vector<double> rows = random_inputs(in_size * n, 3.0, random);
      std::vector<double> results(out_size * n), in(in_size), out(out_size), expected(out_size);
      batch(rows.data(), results.data(), n);
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < in_size; ++i) in[i] = rows[i * n + k];
        one(in.data(), out.data());
        interpreter.evaluate(in.data(), expected.data());
        for (std::size_t i = 0; i < out_size; ++i) {
          EXPECT_EQ(results[i * n + k], out[i]) << n << " samples, sample " << k;
          EXPECT_NEAR(out[i], expected[i], 1e-12 * (1 + std::abs(expected[i])));
        }
      }
    }
  }
}

TEST(GeneratedCuda, ComputesWhatTheInterpreterComputes) {
  for (const backend::Scalar scalar : {backend::Scalar::kDouble, backend::Scalar::kFloat}) {
    backend::COptions options = named();
    options.language = backend::Language::kCuda;
    options.scalar = scalar;
    const Compiled code(generate_c(chain(), options),
                        "g++ -O2 -Wall -Wextra -Werror -D_GNU_SOURCE -x c++ chain.cu");
    backend::Interpreter interpreter(chain());
    const std::size_t n = 37, in_size = interpreter.in_size(), out_size = interpreter.out_size();
    std::mt19937 random(3);
    const std::vector<double> in = random_inputs(in_size * n, 3.0, random);
    std::vector<double> out(out_size * n);
    if (scalar == backend::Scalar::kDouble) {
      auto* launch = code.get<int(const double*, double*, std::size_t, void*)>("chain_launch");
      EXPECT_EQ(launch(in.data(), out.data(), n, nullptr), 0);
    } else {
      auto* launch = code.get<int(const float*, float*, std::size_t, void*)>("chain_launch");
      const std::vector<float> in_float(in.begin(), in.end());
      std::vector<float> out_float(out.size());
      EXPECT_EQ(launch(in_float.data(), out_float.data(), n, nullptr), 0);
      out.assign(out_float.begin(), out_float.end());
    }
    const double bound = scalar == backend::Scalar::kDouble ? 1e-12 : 1e-4;
    std::vector<double> sample(in_size), expected(out_size);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < in_size; ++i) sample[i] = in[i * n + k];
      interpreter.evaluate(sample.data(), expected.data());
      for (std::size_t i = 0; i < out_size; ++i) {
        EXPECT_NEAR(out[i * n + k], expected[i], bound * (1 + std::abs(expected[i]))) << k;
      }
    }
  }
}

// What the CUDA tool kit's headers declare and generated code uses; clang knows the rest itself.
constexpr const char* kCudaDeclarations = R"(
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define __host__ __attribute__((host))
#define __noinline__ __attribute__((noinline))
typedef __SIZE_TYPE__ size_t;
typedef int cudaError_t;
typedef void *cudaStream_t;
enum { cudaErrorInvalidValue = 1 };
struct dim3 { unsigned x, y, z; dim3(unsigned a = 1) : x(a), y(1), z(1) {} };
extern const __device__ dim3 blockIdx, blockDim, threadIdx;
__device__ double sin(double); __device__ double cos(double); __device__ double sqrt(double);
__device__ float sinf(float); __device__ float cosf(float); __device__ float sqrtf(float);
__device__ void sincos(double, double *, double *); __device__ void sincosf(float, float *, float *);
extern "C" cudaError_t cudaGetLastError();
extern "C" cudaError_t cudaConfigureCall(dim3, dim3, size_t = 0, cudaStream_t = 0);
extern "C" unsigned __cudaPushCallConfiguration(dim3, dim3, size_t = 0, void * = 0);
)";

TEST(GeneratedCuda, CompilesToCodeForAGraphicsProcessor) {
  if (std::system("clang++-19 --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no clang++-19 to compile CUDA with";
  }
  for (const bool updated : {false, true}) {
    backend::COptions options = named();
    options.language = backend::Language::kCuda;
    if (updated) options.partial.slow = {"velocity"};
    const backend::GeneratedCode code = generate_c(chain(), options);
    const fs::path folder = fs::path(testing::TempDir()) / fmt::format("cuda_{}", getpid());
    fs::create_directories(folder / "include");
    for (const backend::SourceFile& file : code.files) {
      std::ofstream(folder / file.name) << file.text;
    }
    std::ofstream(folder / "declarations.h") << kCudaDeclarations;
    // Headers of the host's C library do not matter on the device.
    std::ofstream(folder / "include" / "math.h") << "\n";
    std::ofstream(folder / "include" / "stddef.h") << "\n";
    const std::string line = fmt::format(
        "cd '{}' && clang++-19 -x cuda --cuda-device-only --cuda-gpu-arch=sm_70 -nocudainc "
        "-nocudalib -nostdinc -Iinclude -include declarations.h -Wall -Werror "
        "-Wno-unknown-cuda-version -O1 -S chain.cu -o chain.ptx",
        folder.string());
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    std::ifstream file(folder / "chain.ptx");
    const std::string ptx{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(ptx.find(".entry"), std::string::npos);
    EXPECT_NE(ptx.find("fma.rn.f64"), std::string::npos);
    fs::remove_all(folder);
  }
}

TEST(Update, MovesWhatDependsOnSlowInputsOnlyOutOfTheEvaluation) {
  backend::COptions options = named();
  const backend::GeneratedCode whole = generate_c(chain(), options);
  options.partial.slow = {"position", "velocity"};
  const backend::GeneratedCode code = generate_c(chain(), options);
  const auto sidecar = nlohmann::json::parse(code.files[2].text);
  const std::size_t held_size = sidecar.at("held-size");
  EXPECT_GT(held_size, 0U);
  // What is left is linear in the accelerations: no sine, and much less than before.
  EXPECT_EQ(code.operations.sincos, 0U);
  EXPECT_LT(code.operations.multiply, whole.operations.multiply);
  EXPECT_EQ(code.update.sincos, whole.operations.sincos);

  const Compiled compiled(code, fmt::format("gcc -O2 -march=native {} chain.c", kStrict));
  auto* update = compiled.get<void(const double*, double*)>("chain_update");
  auto* one = compiled.get<void(const double*, const double*, double*)>("chain");
  auto* batch =
      compiled.get<void(const double*, const double*, double*, std::size_t)>("chain_batch");
  backend::Interpreter interpreter(chain());
  const std::size_t in_size = interpreter.in_size(), out_size = interpreter.out_size();
  std::mt19937 random(11);
  for (int change = 0; change < 20; ++change) {
    std::vector<double> in = random_inputs(in_size, 3.0, random);
    std::vector<double> held(held_size), expected(out_size), out(out_size);
    update(in.data(), held.data());
    constexpr std::size_t kSamples = 11;
    std::vector<double> rows(in_size * kSamples), results(out_size * kSamples);
    std::vector<std::vector<double>> single;
    for (std::size_t k = 0; k < kSamples; ++k) {
      for (std::size_t i = 14; i < 21; ++i) in[i] = random_inputs(1, 3.0, random)[0];
      interpreter.evaluate(in.data(), expected.data());
      one(in.data(), held.data(), out.data());
      for (std::size_t i = 0; i < out_size; ++i) {
        EXPECT_NEAR(out[i], expected[i], 1e-12 * (1 + std::abs(expected[i])));
      }
      single.push_back(out);
      for (std::size_t i = 0; i < in_size; ++i) rows[i * kSamples + k] = in[i];
    }
    batch(rows.data(), held.data(), results.data(), kSamples);
    for (std::size_t k = 0; k < kSamples; ++k) {
      for (std::size_t i = 0; i < out_size; ++i) {
        EXPECT_EQ(results[i * kSamples + k], single[k][i]);
      }
    }
  }
}

TEST(Update, KeepsAHeldBlockUntilTheNextUpdate) {
  // The poses are held: forces then follow from the poses at the last update, whatever the
  // positions are now.
  backend::COptions options = named();
  options.partial.held = {"pose"};
  const backend::GeneratedCode code = generate_c(chain(), options);
  const std::size_t held_size = nlohmann::json::parse(code.files[2].text).at("held-size");
  const Compiled compiled(code, fmt::format("gcc -O2 {} chain.c", kStrict));
  auto* update = compiled.get<void(const double*, double*)>("chain_update");
  auto* one = compiled.get<void(const double*, const double*, double*)>("chain");
  backend::Interpreter interpreter(chain());
  std::mt19937 random(5);
  std::vector<double> in = random_inputs(interpreter.in_size(), 3.0, random);
  std::vector<double> held(held_size), expected(interpreter.out_size()), out(expected.size());
  update(in.data(), held.data());
  interpreter.evaluate(in.data(), expected.data());
  for (std::size_t i = 0; i < 7; ++i) in[i] += 0.5;  // positions move on
  one(in.data(), held.data(), out.data());
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_NEAR(out[i], expected[i], 1e-12 * (1 + std::abs(expected[i])));
  }
}

TEST(Update, NamesWhatCouldHaveBeenMeant) {
  backend::COptions options = named();
  options.partial.slow = {"payload"};
  try {
    generate_c(chain(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'payload' is no input"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("position.joint1"), std::string::npos);
  }
  options.partial = {};
  options.partial.held = {"position.joint1"};
  EXPECT_THROW(generate_c(chain(), options), Error);
}

TEST(ReadableStyle, RefusesWhatOnlyTheFlatStyleCanDo) {
  for (int what = 0; what < 3; ++what) {
    backend::COptions options = named();
    options.style = backend::Style::kReadable;
    if (what == 0) options.scalar = backend::Scalar::kFloat;
    if (what == 1) options.language = backend::Language::kCuda;
    if (what == 2) options.partial.slow = {"velocity"};
    EXPECT_THROW(generate_c(chain(), options), Error) << what;
  }
}

TEST(Update, IsStrictCppToo) {
  backend::COptions options = named();
  options.partial.slow = {"position"};
  const backend::GeneratedCode code = generate_c(chain(), options);
  for (const char* compiler : {"g++ -x c++ -O0", "clang++-19 -x c++ -O0"}) {
    SCOPED_TRACE(compiler);
    const Compiled compiled(code,
                            fmt::format("{} -Wall -Wextra -Werror -pedantic chain.c", compiler));
    EXPECT_NE(compiled.get<void(const double*, double*)>("chain_update"), nullptr);
  }
}

}  // namespace
}  // namespace sinew
