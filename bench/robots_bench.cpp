// The solvers on whole robots, fixed and floating, beside Orocos KDL, MuJoCo and DART in one run.
//   bench/bench_robots --benchmark_filter=hyq
// Rows: SOLVER/ROBOT/ENGINE. Engines: c (the flat C, by gcc -O3 -march=native), cold (the same,
// after 32 MB of other memory have been walked through: the median), jit (machine code made in this
// process), batch (the same, time per evaluation), KDL, MuJoCo, DART (their own calls, with the
// state set; KDL's tree solvers, which have no mass matrix and no forward dynamics). The humanoid
// is the tests' own (tests/solvers/humanoid_urdf.h). Counters of c and jit: operations (additions
// and multiplications, one on a vector counted once), bytes of code, milliseconds from model files
// to C text or running code. Results are compared before anything is timed; a robot on which they
// differ ends the run. At the end a table in Markdown.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "compare.h"
#include "humanoid_urdf.h"
#include "question.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/jit.h"
#include "sinew/base/cache_lines.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace {

using namespace sinew;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kStates = 64;

double since_ms(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

struct Subject {
  std::string name, solver;  // "rnea/hyq floating"
  std::size_t in_size = 0, out_size = 0;
  CacheLineVector<double> in, batch_in;  // sample after sample; input after input
  std::shared_ptr<backend::LoadedCode> c;
  std::shared_ptr<backend::JitFunction> jit;
  std::vector<std::shared_ptr<peers::Peer>> peers;
  double operations = 0, c_bytes = 0, to_c_ms = 0, to_jit_ms = 0;
};

// What a peer says, by the names of our outputs.
void compare(const Subject& subject, test::Question& question, peers::Peer& peer,
             const peers::State& state, const peers::Vector& force) {
  const auto ours = question.answers(state, force);
  const std::string& solver = subject.solver;
  if (solver == "rnea" || solver == "aba" || solver == "crba") {
    if (solver != "rnea" && peer.name() == "KDL") return;
    const peers::Vector theirs = solver == "rnea"  ? peer.inverse_dynamics(state)
                                 : solver == "aba" ? peer.forward_dynamics(state, force)
                                                   : peer.mass_matrix(state);
    if (test::difference(question.answer(state, force), theirs) > 1e-7) {
      fail(subject.name + ": differs from " + peer.name());
    }
    return;
  }
  for (const auto& [name, value] : ours) {
    const std::string link = name.substr(name.find('.') + 1);
    const auto theirs = solver == "fpk" ? std::optional(peer.link_pose(state, link))
                                        : peer.quantity(state, "jacobian", link);
    if (theirs && test::difference(value, *theirs) > 1e-8) {
      fail(subject.name + ": " + name + " differs from " + peer.name());
    }
  }
}

Subject make(const test::Robot& robot, const std::string& short_name, const std::string& solver,
             bool floating) {
  Subject subject;
  subject.solver = solver;
  subject.name = solver + "/" + short_name + (floating ? " floating" : "");
  Clock::time_point start = Clock::now();
  test::Question question(robot, solver, floating);
  const double to_program_ms = since_ms(start);
  const program::Program& program = question.program();

  start = Clock::now();
  backend::COptions options;
  options.name = solver;
  const backend::GeneratedCode code = generate_c(program, options);
  subject.to_c_ms = to_program_ms + since_ms(start);
  const program::OperationCount& n = code.with_limbs ? *code.with_limbs : code.operations;
  subject.operations = n.add + n.multiply;
  backend::CompileOptions compile;
  compile.compiler = "gcc";
  compile.flags = {"-O3", "-march=native"};
  subject.c = std::make_shared<backend::LoadedCode>(compile_and_load(code, compile));
  subject.c_bytes = static_cast<double>(subject.c->code_bytes());
  if (backend::jit_available()) {
    start = Clock::now();
    subject.jit = std::make_shared<backend::JitFunction>(
        backend::jit_compile(program::scalar_program(program)));
    subject.to_jit_ms = to_program_ms + since_ms(start);
  }

  peers::Setup setup{robot.urdf, question.joints(), floating, {0, 0, -9.81}};
  subject.peers.push_back(peers::make_mujoco(setup));
  subject.peers.push_back(peers::make_dart(setup));
  if (!floating) subject.peers.push_back(peers::make_kdl(setup));

  std::vector<peers::State> states;
  std::vector<peers::Vector> forces;
  const program::Interface interface = program::interface_of(program);
  subject.in_size = interface.in_size;
  subject.out_size = interface.out_size;
  subject.batch_in.resize(subject.in_size * kStates);
  for (unsigned k = 0; k < kStates; ++k) {
    states.push_back(test::random_state(question.joints().size(), k, floating));
    forces.push_back(states.back().acceleration);
    const peers::Vector in = question.inputs(states.back(), forces.back());
    subject.in.insert(subject.in.end(), in.begin(), in.end());
    for (std::size_t i = 0; i < in.size(); ++i) subject.batch_in[i * kStates + k] = in[i];
  }
  for (unsigned k = 0; k < 4; ++k) {
    const peers::Vector expected = question.answer(states[k], forces[k]);
    peers::Vector out(expected.size());
    subject.c->function()(&subject.in[k * subject.in_size], out.data());
    if (test::difference(out, expected) > 1e-11) fail(subject.name + ": C differs");
    if (subject.jit) (*subject.jit)(&subject.in[k * subject.in_size], out.data());
    if (test::difference(out, expected) > 1e-11) fail(subject.name + ": JIT differs");
    for (const auto& peer : subject.peers) {
      compare(subject, question, *peer, states[k], forces[k]);
    }
  }
  for (const auto& peer : subject.peers) peer->load(states, forces);
  return subject;
}

template <typename Call>
void each_state(benchmark::State& state, Call call) {
  std::size_t k = 0;
  for (auto _ : state) {
    call(k);
    benchmark::ClobberMemory();
    k = (k + 1) % kStates;
  }
}

// The median time of a call whose code and data are no longer in the caches near the core.
double cold_ns(const Subject& s) {
  constexpr std::size_t kOtherBytes = 32U << 20U;
  static std::vector<unsigned char> other(kOtherBytes, 1);
  std::vector<double> out(s.out_size), times;
  for (std::size_t k = 0; k < kStates; ++k) {
    for (std::size_t i = 0; i < kOtherBytes; i += 64) ++other[i];
    benchmark::ClobberMemory();
    const Clock::time_point start = Clock::now();
    s.c->function()(&s.in[k * s.in_size], out.data());
    benchmark::ClobberMemory();
    times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + kStates / 2, times.end());
  return times[kStates / 2];
}

void register_subject(const Subject& s) {
  const auto out = std::make_shared<CacheLineVector<double>>(s.out_size * kStates);
  benchmark::RegisterBenchmark((s.name + "/c").c_str(), [s, out](benchmark::State& state) {
    each_state(state, [&](std::size_t k) { s.c->function()(&s.in[k * s.in_size], out->data()); });
    state.counters["operations"] = s.operations;
    state.counters["bytes"] = s.c_bytes;
    state.counters["to_code_ms"] = s.to_c_ms;
    state.counters["cold_ns"] = cold_ns(s);
  });
  if (s.jit) {
    benchmark::RegisterBenchmark((s.name + "/jit").c_str(), [s, out](benchmark::State& state) {
      each_state(state, [&](std::size_t k) { (*s.jit)(&s.in[k * s.in_size], out->data()); });
      state.counters["bytes"] = static_cast<double>(s.jit->code_bytes());
      state.counters["to_code_ms"] = s.to_jit_ms;
    });
    benchmark::RegisterBenchmark((s.name + "/batch").c_str(), [s, out](benchmark::State& state) {
      while (state.KeepRunningBatch(kStates)) {
        s.jit->batch(s.batch_in.data(), out->data(), kStates);
        benchmark::ClobberMemory();
      }
    });
  }
  for (const auto& peer : s.peers) {
    if (!peer->call(s.solver, 0)) continue;
    benchmark::RegisterBenchmark(
        (s.name + "/" + peer->name()).c_str(), [s, peer](benchmark::State& state) {
          each_state(state, [&](std::size_t k) { peer->call(s.solver, k); });
        });
  }
}

// The usual report, and the rows kept for the table.
class TableReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const std::string name = run.run_name.function_name;
      const std::size_t at = name.rfind('/');
      const std::string row = name.substr(0, at);
      if (!rows_.contains(row)) order_.push_back(row);
      rows_[row][name.substr(at + 1)] = run;
    }
  }
  void print() {
    std::printf(
        "\n| solver/robot | c | cold | jit | batch | KDL | MuJoCo | DART | operations | bytes | "
        "C text, ms |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | "
        "---: |\n");
    for (const std::string& row : order_) {
      std::printf("| %s", row.c_str());
      for (const char* engine : {"c", "jit", "batch", "KDL", "MuJoCo", "DART"}) {
        const auto at = rows_[row].find(engine);
        if (at == rows_[row].end()) {
          std::printf(" | ");
        } else {
          std::printf(" | %.3g", at->second.GetAdjustedCPUTime());
        }
        if (std::string_view(engine) == "c" && at != rows_[row].end()) {
          std::printf(" | %.3g", static_cast<double>(at->second.counters.at("cold_ns")));
        }
      }
      const auto c = rows_[row].find("c");
      for (const char* counter : {"operations", "bytes", "to_code_ms"}) {
        if (c == rows_[row].end()) {
          std::printf(" | ");
        } else {
          std::printf(" | %.4g", static_cast<double>(c->second.counters.at(counter)));
        }
      }
      std::printf(" |\n");
    }
  }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::map<std::string, Run>> rows_;
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::map<std::string, std::pair<std::string, bool>> wanted = {
      {"clean/gen3.urdf", {"gen3", false}},
      {"clean/iiwa.urdf", {"iiwa", false}},
      {"clean/general_7r.urdf", {"general 7R", false}},
      {"clean/hyq.urdf", {"hyq", true}},
      {"baxter.urdf", {"baxter", false}}};
  bool any = false;
  for (const test::Robot& robot : test::published_robots()) {
    const auto at = wanted.find(robot.name);
    if (at == wanted.end()) continue;
    any = true;
    const bool serial = robot.name != "clean/hyq.urdf" && robot.name != "baxter.urdf";
    for (const std::string solver : {"fpk", "jacobian", "rnea", "aba", "crba"}) {
      // We are asked for all tips, the peers for one.
      if (solver == "jacobian" && !serial) continue;
      register_subject(make(robot, at->second.first, solver, false));
      if (at->second.second) register_subject(make(robot, at->second.first, solver, true));
    }
  }
  if (!any) std::fprintf(stderr, "no robots in " SINEW_SHARED_DIR "/robots\n");
  const test::TemporaryUrdf humanoid(test::humanoid_urdf(), "humanoid");
  for (const std::string solver : {"fpk", "jacobian", "rnea", "aba", "crba"}) {
    register_subject(make(humanoid.robot(), "humanoid", solver, true));
  }
  TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print();
  return 0;
}
