// From model files to C text and to machine code, stage by stage, in milliseconds of processor
// time: the least of several runs in one process. Below them what one call takes that writes all
// five functions (cli/generate_each.h): on the clock with all processors and with one, and the
// processor time of all threads together.
//   bench/bench_generation [PART OF SOLVER/ROBOT [RUNS]]     e.g. bench_generation rnea/humanoid,
//                                                            bench_generation all/humanoid 100
// The humanoid is the tests' own (tests/solvers/humanoid_urdf.h); a whole `sinew generate` adds the
// process itself: perf stat -r 5 sinew generate ….
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "generate_each.h"
#include "humanoid_urdf.h"
#include "kept_memory.h"
#include "lines_once.h"
#include "pipeline.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/jit.h"
#include "sinew/base/workers.h"
#include "sinew/program/limbs/limb_program.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace {

using namespace sinew;

constexpr const char* kSolvers[] = {"fpk", "jacobian", "rnea", "aba", "crba"};
int runs = 9;

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

enum Stage : std::size_t { kLoad, kSynthesise, kLower, kPasses, kLimbs, kWrite, kJit, kStages };
constexpr std::array<const char*, kStages> kNames = {"load",  "synthesise", "lower",   "passes",
                                                     "limbs", "write C",    "jit fast"};

struct Times {
  std::array<double, kStages> ms;
  Times() { ms.fill(1e300); }
};

// Keeps the least time of each stage.
class Watch {
 public:
  explicit Watch(Times& times) : times_(times), last_(processor_ms()) {}
  void stage(Stage stage, double less = 0.0) {
    const double now = processor_ms();
    times_.ms[stage] = std::min(times_.ms[stage], now - last_ - less);
    last_ = processor_ms();
  }

 private:
  Times& times_;
  double last_;
};

void run_once(const cli::ModelOptions& files, const cli::QueryOptions& query, Times& times) {
  Watch watch(times);
  const auto models = cli::load(files);
  watch.stage(kLoad);
  const graph::Id algorithm =
      cli::algorithm_of(*models, files, query, nullptr, synthesis::AlgorithmGraph::kIfNeeded);
  watch.stage(kSynthesise);
  const program::Program program = cli::lowered(*models, algorithm, query.solver);
  watch.stage(kLower);
  const program::ScalarProgram scalar = program::scalar_program(program);
  watch.stage(kPasses);
  const std::optional<program::LimbProgram> limbs =
      program::limb_program(scalar.program, program::count_operations(scalar.computation));
  watch.stage(kLimbs);
  backend::COptions options;
  options.name = query.solver;
  options.one_thread = true;
  // It does the passes and limbs again, whose times are taken off.
  static_cast<void>(backend::generate_c(program, options));
  watch.stage(kWrite, times.ms[kPasses] + times.ms[kLimbs]);
  if (!backend::jit_available()) return;
  backend::JitOptions fast{backend::JitLevel::kFast, "", false};
  const double before = processor_ms();
  static_cast<void>(backend::jit_compile(scalar.computation, fast, limbs ? &*limbs : nullptr));
  times.ms[kJit] = std::min(times.ms[kJit], processor_ms() - before);
}

cli::ModelOptions files_of(const test::Robot& robot) {
  cli::ModelOptions files;
  files.files = {robot.file};
  files.lenient = true;
  return files;
}

void row(const test::Robot& robot, const std::string& solver, bool floating) {
  const cli::ModelOptions files = files_of(robot);
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  Times times;
  for (int k = 0; k < runs; ++k) run_once(files, query, times);
  double to_c = 0.0, to_code = 0.0;
  for (std::size_t s = 0; s < kStages; ++s) {
    if (s != kJit) to_c += times.ms[s];
    if (s != kWrite) to_code += times.ms[s];
  }
  std::printf("| %s/%s%s", solver.c_str(), robot.name.c_str(), floating ? " floating" : "");
  const bool jit = backend::jit_available();
  for (std::size_t s = 0; s < kStages; ++s) {
    if (s == kJit && !jit) {
      std::printf(" | –");
    } else {
      std::printf(" | %.2f", times.ms[s]);
    }
  }
  std::printf(jit ? " | %.1f | %.1f |\n" : " | %.1f | – |\n", to_c, to_code);
}

struct Elapsed {
  double wall_ms = 1e300, processor_ms = 1e300;
};

// From the model files to the text of all files of all functions; the least of each.
Elapsed all_at_once(const cli::ModelOptions& files, const cli::QueryOptions& query,
                    unsigned threads) {
  const auto now = [](clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
  };
  Elapsed least;
  for (int k = 0; k < runs; ++k) {
    const double wall = now(CLOCK_MONOTONIC), processor = now(CLOCK_PROCESS_CPUTIME_ID);
    {
      const auto models = cli::load(files);
      static_cast<void>(
          cli::generate_each(*models, files, cli::each_solver(query), "", {}, threads));
    }
    least.wall_ms = std::min(least.wall_ms, now(CLOCK_MONOTONIC) - wall);
    least.processor_ms = std::min(least.processor_ms, now(CLOCK_PROCESS_CPUTIME_ID) - processor);
  }
  return least;
}

void row_of_all(const test::Robot& robot, bool floating) {
  cli::QueryOptions query;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  for (const char* solver : kSolvers)
    query.solver += (query.solver.empty() ? "" : ",") + std::string(solver);
  const unsigned threads = Workers::as_many_as_the_machine_has();
  const Elapsed beside = all_at_once(files_of(robot), query, threads);
  const Elapsed alone = all_at_once(files_of(robot), query, 1);
  std::printf("| all/%s%s | %.1f | %.1f | %.1f | %.1f |\n", robot.name.c_str(),
              floating ? " floating" : "", beside.wall_ms, beside.processor_ms, alone.wall_ms,
              alone.processor_ms);
}

}  // namespace

int main(int argc, char** argv) {
  cli::keep_memory();  // as `sinew` does
  const LinesOnce told_once;
  const std::string part = argc > 1 ? argv[1] : "";
  if (argc > 2) runs = std::atoi(argv[2]);
  std::printf("| solver/robot");
  for (const char* name : kNames) std::printf(" | %s", name);
  std::printf(" | to C text | to running code |\n| ---");
  for (std::size_t s = 0; s < kStages + 2; ++s) std::printf(" | ---:");
  std::printf(" |\n");
  const test::TemporaryUrdf humanoid(test::humanoid_urdf(), "humanoid");
  struct Subject {
    test::Robot robot;
    bool floating;
  };
  std::vector<Subject> subjects;
  for (const test::Robot& robot : test::published_robots()) {
    if (robot.name.starts_with("clean/") || robot.name == "baxter.urdf")
      subjects.push_back({robot, false});
    if (robot.name == "clean/hyq.urdf") subjects.push_back({robot, true});
  }
  test::Robot drawn = humanoid.robot();
  drawn.name = "humanoid";
  subjects.push_back({drawn, true});
  for (const Subject& subject : subjects) {
    for (const std::string solver : kSolvers)
      if ((solver + "/" + subject.robot.name).find(part) != std::string::npos)
        row(subject.robot, solver, subject.floating);
  }
  std::printf(
      "\n| all five in one call, %u threads | on the clock | processor | one thread: on the clock "
      "| processor |\n| --- | ---: | ---: | ---: | ---: |\n",
      Workers::as_many_as_the_machine_has());
  for (const Subject& subject : subjects)
    if (("all/" + subject.robot.name).find(part) != std::string::npos)
      row_of_all(subject.robot, subject.floating);
  return 0;
}
