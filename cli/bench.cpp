// sinew bench MODEL… --solver NAME: what the program costs on this machine.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "options.h"
#include "output.h"
#include "pipeline.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/jit.h"
#include "sinew/base/cache_lines.h"
#include "sinew/program/interface.h"
#include "sinew/program/scalar_program.h"

namespace sinew::cli {
namespace {

using Clock = std::chrono::steady_clock;

double since_ms(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr std::size_t kStates =
    64;  // different inputs, so that no branch predictor learns one by heart
constexpr auto kMeasureFor = std::chrono::milliseconds(200);

// The least time of `pass`, which evaluates kStates times, in ns per evaluation: what the machine
// does when nothing else disturbs it.
template <typename Pass>
double least_ns(Pass&& pass) {
  double least = 1e300;
  const Clock::time_point end = Clock::now() + kMeasureFor;
  do {
    const Clock::time_point start = Clock::now();
    for (int repeat = 0; repeat < 16; ++repeat) pass();
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    least = std::min(least, ns / (16 * kStates));
  } while (Clock::now() < end);
  return least;
}

struct Timing {
  double single_ns = 0, batch_ns = 0;
};

template <typename Number>
Timing measure(const backend::BasicJitFunction<Number>& function, std::size_t inputs,
               std::size_t results) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Number> number(-1, 1);
  CacheLineVector<Number> in(inputs * kStates), out(results * kStates);
  for (Number& x : in) x = number(random);
  Timing timing;
  timing.single_ns = least_ns([&] {
    for (std::size_t k = 0; k < kStates; ++k) {
      function(in.data() + k * inputs, out.data() + k * results);
    }
  });
  timing.batch_ns = least_ns([&] { function.batch(in.data(), out.data(), kStates); });
  return timing;
}

}  // namespace

int run_bench(Arguments arguments) {
  CLI::App app(
      "Time per evaluation, alone and in a batch, operations, bytes of code, and the time from "
      "model "
      "files to running code.",
      "sinew bench");
  ModelOptions models_options;
  QueryOptions query;
  std::string format = "text", level = "full", scalar = "double";
  add_model_options(app, models_options);
  add_query_options(app, query);
  add_derivative_option(app, query);
  app.add_option("--format", format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app.add_option("--scalar", scalar, "Type of all numbers: double or float")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  app.add_option("--level", level, "Effort of the compiler: fast or full")
      ->check(CLI::IsMember({"fast", "full"}))
      ->capture_default_str();
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const Clock::time_point start = Clock::now();
  const auto models = load(models_options);
  const program::Program program = program_of(*models, models_options, query, "");
  note_held(program);
  const double to_program_ms = since_ms(start);

  backend::COptions options;
  options.name = program.name;
  options.source = describe(models_options, query);
  if (scalar == "float") options.scalar = backend::Scalar::kFloat;
  const Clock::time_point c_start = Clock::now();
  const backend::GeneratedCode code =
      with_places(*models, [&] { return backend::generate_c(program, options); });
  const double to_c_ms = to_program_ms + since_ms(c_start);

  nlohmann::ordered_json report = {{"program", program.name},
                                   {"source", options.source},
                                   {"operations",
                                    {{"add", code.operations.add},
                                     {"multiply", code.operations.multiply},
                                     {"divide", code.operations.divide},
                                     {"sqrt", code.operations.sqrt},
                                     {"sincos", code.operations.sincos}}},
                                   {"model_to_c_ms", to_c_ms}};

  if (code.with_limbs) {
    report["operations_with_limbs"] = {{"add", code.with_limbs->add},
                                       {"multiply", code.with_limbs->multiply},
                                       {"divide", code.with_limbs->divide},
                                       {"sqrt", code.with_limbs->sqrt},
                                       {"sincos", code.with_limbs->sincos}};
  }

  std::string why;
  const Clock::time_point library_start = Clock::now();
  if (backend::jit_available(&why)) {
    const double library_ms = since_ms(library_start);  // the compiler's library, loaded once
    const backend::JitLevel effort =
        level == "fast" ? backend::JitLevel::kFast : backend::JitLevel::kFull;
    const auto add = [&](auto&& with) {
      // To the first call of one sample; the function for batches comes on top.
      const Clock::time_point jit_start = Clock::now();
      const program::ScalarProgram numbers = program::scalar_program(program);
      static_cast<void>(with(numbers, {effort, "", false}));
      report["model_to_code_ms"] = to_program_ms + library_ms + since_ms(jit_start);
      const auto function = with(numbers, {effort, "", true});
      const Timing timing =
          measure(function, numbers.computation.inputs, numbers.computation.results.size());
      report["ns_single"] = timing.single_ns;
      report["ns_batch"] = timing.batch_ns;
      report["code_bytes"] = function.code_bytes();
      report["batch_code_bytes"] = function.batch_code_bytes();
    };
    if (scalar == "float") {
      add([](const program::ScalarProgram& p, const backend::JitOptions& o) {
        return backend::jit_compile_float(p, o);
      });
    } else {
      add([](const program::ScalarProgram& p, const backend::JitOptions& o) {
        return backend::jit_compile(p, o);
      });
    }
  } else {
    std::cerr << "sinew bench: no times: " << why << "\n";
  }

  if (format == "json") {
    write_output("", report.dump(1) + "\n");
    return kOk;
  }
  std::string text;
  for (const auto& [key, value] : report.items()) {
    if (!value.is_object()) {
      text += fmt::format("{:<20} {}\n", key,
                          value.is_number_float() ? fmt::format("{:.1f}", value.get<double>())
                          : value.is_string()     ? value.get<std::string>()
                                                  : value.dump());
      continue;
    }
    const char* in_lanes = key == "operations" ? "" : "with limbs: ";
    for (const auto& [name, count] : value.items()) {
      text += fmt::format("{:<20} {}\n", in_lanes + name, count.dump());
    }
  }
  write_output("", text);
  return kOk;
}

}  // namespace sinew::cli
