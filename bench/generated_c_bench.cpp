// The flat C of the usual solvers, as the system's compilers make it: one call, and one sample of a
// batch.
//   bench/bench_generated_c --benchmark_filter=iiwa
// Rows: SOLVER/ROBOT/COMPILER/single|batch; counters: additions and multiplications, bytes of
// machine code, milliseconds from the program to C text.
#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>
#include <random>

#include "pipeline.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/base/cache_lines.h"
#include "sinew/program/interface.h"

namespace {

using namespace sinew;

constexpr std::size_t kStates = 64;

struct Subject {
  std::string robot, solver, compiler;
};

struct Compiled {
  backend::GeneratedCode code;
  backend::LoadedCode loaded;
  std::size_t in_size, out_size;
  double to_text_ms;
};

Compiled make(const Subject& subject) {
  cli::ModelOptions files;
  files.files = {std::string(SINEW_SHARED_DIR) + "/robots/clean/" + subject.robot + ".urdf"};
  cli::QueryOptions query;
  query.solver = subject.solver;
  query.gravity = "0,0,-9.81";
  const auto models = cli::load(files);
  const program::Program program = cli::program_of(*models, files, query, subject.solver);
  backend::COptions options;
  options.name = subject.solver;
  const auto start = std::chrono::steady_clock::now();
  backend::GeneratedCode code = generate_c(program, options);
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  backend::CompileOptions compile;
  compile.compiler = subject.compiler;
  compile.flags = {"-O3", "-march=native"};
  backend::LoadedCode loaded = compile_and_load(code, compile);
  const program::Interface interface = program::interface_of(program);
  return {std::move(code), std::move(loaded), interface.in_size, interface.out_size, ms};
}

void measure(benchmark::State& state, const Subject& subject, bool batch) {
  const Compiled compiled = make(subject);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  CacheLineVector<double> in(compiled.in_size * kStates), out(compiled.out_size * kStates);
  for (double& x : in) x = number(random);
  for (auto _ : state) {
    if (batch) {
      compiled.loaded.batch()(in.data(), out.data(), kStates);
    } else {
      for (std::size_t k = 0; k < kStates; ++k) {
        compiled.loaded.function()(in.data() + k * compiled.in_size,
                                   out.data() + k * compiled.out_size);
      }
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * kStates));
  state.counters["ns"] =
      benchmark::Counter(static_cast<double>(state.iterations() * kStates) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["operations"] = compiled.code.operations.add + compiled.code.operations.multiply;
  state.counters["bytes"] = static_cast<double>(compiled.loaded.code_bytes());
  state.counters["to_text_ms"] = compiled.to_text_ms;
}

bool installed(const std::string& compiler) {
  return std::system((compiler + " --version >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (!std::filesystem::exists(std::string(SINEW_SHARED_DIR) + "/robots/clean")) {
    std::fprintf(stderr, "no robots in %s: nothing to measure\n", SINEW_SHARED_DIR);
    return 0;
  }
  for (const char* compiler : {"gcc", "clang-19"}) {
    if (!installed(compiler)) continue;
    for (const char* robot : {"iiwa", "gen3", "general_7r"}) {
      for (const char* solver : {"rnea", "aba", "crba", "fpk"}) {
        for (const bool batch : {false, true}) {
          const Subject subject = {robot, solver, compiler};
          benchmark::RegisterBenchmark(
              (std::string(solver) + "/" + robot + "/" + compiler + (batch ? "/batch" : "/single"))
                  .c_str(),
              [subject, batch](benchmark::State& state) { measure(state, subject, batch); });
        }
      }
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
