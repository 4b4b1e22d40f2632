#include "sinew/backend/c_target.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
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

// The inverse dynamics of the mixed chain with its tip's pose, compiled once for each case.
const backend::LoadedCode& chain(const Case& c) {
  static std::map<std::string, backend::LoadedCode> compiled;
  const std::string key =
      c.compiler + (c.style == backend::Style::kFlat ? " flat " : " readable ") + c.flags.back();
  const auto at = compiled.find(key);
  if (at != compiled.end()) return at->second;
  return compiled.emplace(key, load(test::inverse_dynamics(test::mixed_chain(), true), c))
      .first->second;
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
    const backend::LoadedCode& code = chain(c);
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

// Memory between two pages that nobody may touch, so that reading or writing one number too many is
// a fault.
class GuardedNumbers {
 public:
  explicit GuardedNumbers(std::size_t n) : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
    bytes_ = (n * sizeof(double) + page_ - 1) / page_ * page_;
    memory_ = static_cast<char*>(
        mmap(nullptr, bytes_ + 2 * page_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    mprotect(memory_ + page_, bytes_, PROT_READ | PROT_WRITE);
    at_end_ = reinterpret_cast<double*>(memory_ + page_ + bytes_) - n;
    at_start_ = reinterpret_cast<double*>(memory_ + page_);
  }
  GuardedNumbers(const GuardedNumbers&) = delete;
  GuardedNumbers& operator=(const GuardedNumbers&) = delete;
  ~GuardedNumbers() { munmap(memory_, bytes_ + 2 * page_); }
  double* at_end() { return at_end_; }      // the page behind is guarded
  double* at_start() { return at_start_; }  // the page before is guarded

 private:
  std::size_t page_, bytes_ = 0;
  char* memory_ = nullptr;
  double *at_end_ = nullptr, *at_start_ = nullptr;
};

TEST(GeneratedC, TouchesNoNumberBeyondItsArrays) {
  for (const Case& c : cases()) {
    const backend::LoadedCode& code = chain(c);
    for (const std::size_t n : {1, 3, 8, 11}) {
      GuardedNumbers in(21 * n), out(19 * n);
      const std::vector<double> values = random_inputs(21 * n, 1);
      for (const auto place : {&GuardedNumbers::at_start, &GuardedNumbers::at_end}) {
        double* from = (in.*place)();
        double* to = (out.*place)();
        std::copy(values.begin(), values.end(), from);
        code.batch()(from, to, n);
        if (n == 1) code.function()(from, to);
      }
    }
  }
}

TEST(GeneratedC, GivesTheSameBitsInASingleCallAndAnywhereInABatch) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.compiler + c.flags.back());
    const backend::LoadedCode& code = chain(c);
    for (const std::size_t n : {1, 5, 8, 16, 21}) {
      const std::vector<double> in = random_inputs(21 * n, static_cast<unsigned>(n));
      std::vector<double> out(19 * n);
      code.batch()(in.data(), out.data(), n);
      for (std::size_t k = 0; k < n; ++k) {
        std::vector<double> one_in(21), one_out(19);
        for (std::size_t i = 0; i < 21; ++i) one_in[i] = in[i * n + k];
        code.function()(one_in.data(), one_out.data());
        for (std::size_t i = 0; i < 19; ++i) EXPECT_EQ(one_out[i], out[i * n + k]) << i;
      }
    }
  }
}

TEST(GeneratedC, ComesInSeveralFunctionsWhereItIsLong) {
  const program::Program program = test::inverse_dynamics(test::mixed_chain(), true);
  backend::Interpreter interpreter(program);
  backend::COptions options;
  options.name = "chain";
  options.maximum_statements = 60;
  const backend::GeneratedCode code = generate_c(program, options);
  EXPECT_NE(code.files[1].text.find("chain_sample_part3("), std::string::npos);
  for (const char* compiler : {"gcc", "clang-19"}) {
    backend::CompileOptions compile;
    compile.compiler = compiler;
    compile.flags = {"-O1", "-march=native"};
    compile.flags.insert(compile.flags.end(), std::begin(kStrict), std::end(kStrict));
    const backend::LoadedCode loaded = compile_and_load(code, compile);
    const std::size_t n = 11;
    const std::vector<double> in = random_inputs(21 * n, 3);
    std::vector<double> out(19 * n);
    loaded.batch()(in.data(), out.data(), n);
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> one_in(21), one_out(19), expected(19);
      for (std::size_t i = 0; i < 21; ++i) one_in[i] = in[i * n + k];
      interpreter.evaluate(one_in.data(), expected.data());
      loaded.function()(one_in.data(), one_out.data());
      for (std::size_t i = 0; i < 19; ++i) {
        EXPECT_NEAR(one_out[i], expected[i], 1e-12 * (1 + std::abs(expected[i])));
        EXPECT_EQ(one_out[i], out[i * n + k]);
      }
    }
  }
}

TEST(GeneratedC, CompilesWhateverTheVariablesAreCalled) {
  program::Program program = test::inverse_dynamics(test::mixed_chain());
  const char* names[] = {"t1",   "t2",  "in",        "out",  "sine",   "sin",  "NAN",
                         "1",    "a b", "A\xc3\xa9", "*/",   "while",  "n",    "kept",
                         "lane", "y",   "angle",     "main", "sin_t1", "in_k", "state"};
  std::size_t k = 0;
  for (program::Variable& v : program.variables) {
    if (v.role == program::Role::kInput) v.name = names[k++ % std::size(names)];
  }
  for (const Case& c : cases()) EXPECT_NO_THROW(load(program, c));
}

TEST(GeneratedC, CarriesStates) {
  // total += in, six numbers at once.
  program::Program sum;
  sum.name = "sum";
  for (const auto& [name, role] :
       {std::pair("in", program::Role::kInput), std::pair("total", program::Role::kState),
        std::pair("sum", program::Role::kInternal), std::pair("zero", program::Role::kConstant)}) {
    program::Variable v;
    v.name = name;
    v.role = role;
    v.size = 6;
    v.output = v.name == "total";
    if (role != program::Role::kInput && role != program::Role::kInternal) v.value.assign(6, 0.0);
    sum.variables.push_back(v);
  }
  sum.closures = {{"accumulate-wrench", "", "", "", {1, 0, 2}},
                  {"accumulate-wrench", "", "", "", {2, 3, 1}}};
  sum.schedule = {0, 1};
  for (const Case& c : cases()) {
    const backend::LoadedCode code = load(sum, c);
    const std::vector<double> in = {1, 2, 3, 4, 5, 6};
    std::vector<double> out(6), state(6, 10.0);
    code.stateful_function()(in.data(), out.data(), state.data());
    code.stateful_function()(in.data(), out.data(), state.data());
    EXPECT_EQ(out, (std::vector<double>{12, 14, 16, 18, 20, 22}));
    EXPECT_EQ(state, out);
    const std::size_t n = 9;
    std::vector<double> in_n(6 * n, 1.0), out_n(6 * n), state_n(6 * n);
    for (std::size_t i = 0; i < state_n.size(); ++i) state_n[i] = static_cast<double>(i);
    code.stateful_batch()(in_n.data(), out_n.data(), state_n.data(), n);
    for (std::size_t i = 0; i < out_n.size(); ++i)
      EXPECT_EQ(out_n[i], 1.0 + static_cast<double>(i));
    EXPECT_EQ(state_n, out_n);
  }
}

TEST(GeneratedC, CompilesAsCppToo) {
  backend::COptions options;
  options.name = "chain";
  const backend::GeneratedCode code =
      generate_c(test::inverse_dynamics(test::mixed_chain()), options);
  for (const char* compiler : {"g++", "clang++-19"}) {
    backend::CompileOptions compile;
    compile.compiler = compiler;
    compile.flags = {"-x",        "c++",     "-std=c++17",     "-O1", "-Wall", "-Wextra",
                     "-pedantic", "-Werror", "-Wno-deprecated"};
    EXPECT_NO_THROW(compile_and_load(code, compile)) << compiler;
  }
}

TEST(GeneratedC, IsTheSameEachTime) {
  const program::Program program = test::inverse_dynamics(test::mixed_chain());
  for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable}) {
    backend::COptions options;
    options.name = "chain";
    options.style = style;
    const backend::GeneratedCode a = generate_c(program, options), b = generate_c(program, options);
    ASSERT_EQ(a.files.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.files[i].text, b.files[i].text);
  }
}

TEST(GeneratedC, SaysWhichClosureEachLineComesFrom) {
  const program::Program program = test::inverse_dynamics(test::mixed_chain());
  for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable}) {
    backend::COptions options;
    options.name = "chain";
    options.style = style;
    const backend::GeneratedCode code = generate_c(program, options);
    std::vector<std::string> lines = {""};
    for (const char ch : code.files[1].text) {
      if (ch == '\n') {
        lines.emplace_back();
      } else {
        lines.back() += ch;
      }
    }
    const auto sidecar = nlohmann::json::parse(code.files[2].text);
    std::size_t calls = 0;
    ASSERT_GT(sidecar["lines"].size(), 50U);
    for (const auto& entry : sidecar["lines"]) {
      const std::string& text = lines.at(entry[0].get<std::size_t>() - 1);
      const auto& closure = sidecar["closures"].at(entry[1].get<std::size_t>());
      if (style == backend::Style::kFlat) {
        EXPECT_NE(text.find_first_of("=("), std::string::npos) << text;
        continue;
      }
      std::string function = "sinew_" + closure["operation"].get<std::string>() + "(";
      std::replace(function.begin(), function.end(), '-', '_');
      EXPECT_NE(text.find(function), std::string::npos) << text;
      ++calls;
    }
    if (style == backend::Style::kReadable) {
      EXPECT_EQ(calls, program.closures.size());
    }
  }
}

TEST(GeneratedC, DescribesItsInterface) {
  backend::COptions options;
  options.name = "chain";
  const backend::GeneratedCode code =
      generate_c(test::inverse_dynamics(test::mixed_chain()), options);
  const auto sidecar = nlohmann::json::parse(code.files[2].text);
  EXPECT_EQ(sidecar["name"], "chain");
  EXPECT_EQ(sidecar["in-size"], 21);
  EXPECT_EQ(sidecar["inputs"][8]["name"], "velocity.joint2");
  EXPECT_EQ(sidecar["inputs"][8]["offset"], 8);
  EXPECT_EQ(sidecar["inputs"][8]["size"], 1);
  EXPECT_EQ(sidecar["inputs"][8]["iri"], "https://example.org/chain#joint2");
  EXPECT_EQ(sidecar["outputs"].size(), 7U);
  EXPECT_EQ(sidecar["operations"]["add"], code.operations.add);
  EXPECT_NE(code.files[0].text.find("chain_IN_SIZE = 21,"), std::string::npos);
}

TEST(GeneratedC, NeedsANameThatCanNameAFunction) {
  const program::Program program = test::inverse_dynamics(test::mixed_chain());
  for (const char* name : {"", "7dof", "a-b", "while", "sin", "class", "log", "y0", "gammaf",
                           "index", "linux", "M_PI", "__f", "_Bool"}) {
    backend::COptions options;
    options.name = name;
    EXPECT_THROW(generate_c(program, options), Error) << name;
  }
}

TEST(CompileAndLoad, SaysWhichCompilerIsMissing) {
  backend::COptions options;
  options.name = "chain";
  backend::CompileOptions compile;
  compile.compiler = "no-such-compiler";
  try {
    compile_and_load(generate_c(test::inverse_dynamics(test::mixed_chain()), options), compile);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'no-such-compiler'"), std::string::npos);
  }
}

TEST(CompileAndLoad, ShowsWhatTheCompilerSays) {
  backend::GeneratedCode broken;
  broken.files = {{"broken.c", "int broken(void) { return oops; }\n"}};
  try {
    compile_and_load(broken);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("oops"), std::string::npos);
  }
}

}  // namespace
}  // namespace sinew
