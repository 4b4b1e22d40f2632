// Generated solvers against Orocos KDL on the same robots, states and core, and the time from
// models to code.
//   bench/bench_solvers --benchmark_filter=rnea
// Rows: SOLVER/ROBOT/ENGINE, where ENGINE is compiled (machine code made in this process, one
// call), batch (the same, 8 lanes, time per evaluation) or KDL. Before anything is timed the
// results are compared; a robot on which they differ by more than 1e-9 ends the run.
#include <benchmark/benchmark.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <memory>
#include <random>
#include <sstream>

#include "pipeline.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/jit.h"
#include "sinew/base/cache_lines.h"
#include "sinew/program/scalar_program.h"

namespace {

using namespace sinew;

constexpr std::size_t kStates = 64;

KDL::Frame frame(const urdf::Pose& pose) {
  double x = 0, y = 0, z = 0, w = 1;
  pose.rotation.getQuaternion(x, y, z, w);
  return {KDL::Rotation::Quaternion(x, y, z, w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

// The chain from a serial robot's root to its last link.
KDL::Chain chain_of(const std::string& file) {
  KDL::Chain chain;
  const auto model = urdf::parseURDFFile(file);
  for (auto link = model->getRoot(); !link->child_links.empty();) {
    link = link->child_links.front();
    const urdf::Joint& joint = *link->parent_joint;
    const KDL::Frame origin = frame(joint.parent_to_joint_origin_transform);
    const KDL::Vector axis = origin.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
    KDL::Joint kdl_joint(joint.name, KDL::Joint::None);
    if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS) {
      kdl_joint = KDL::Joint(joint.name, origin.p, axis, KDL::Joint::RotAxis);
    }
    KDL::RigidBodyInertia inertia = KDL::RigidBodyInertia::Zero();
    if (link->inertial) {
      const urdf::Inertial& i = *link->inertial;
      inertia =
          frame(i.origin) *
          KDL::RigidBodyInertia(i.mass, KDL::Vector::Zero(),
                                KDL::RotationalInertia(i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz));
    }
    chain.addSegment(KDL::Segment(link->name, kdl_joint, origin, inertia));
  }
  return chain;
}

// KDL's answers, in the numbers and the order of the generated function.
class Kdl {
 public:
  Kdl(const std::string& file, std::string solver)
      : chain_(chain_of(file)),
        solver_(std::move(solver)),
        n_(chain_.getNrOfJoints()),
        q_(n_),
        qd_(n_),
        third_(n_),
        tau_(n_),
        mass_(n_),
        none_(chain_.getNrOfSegments(), KDL::Wrench::Zero()),
        inverse_(chain_, gravity()),
        forward_(chain_, gravity()),
        dynamics_(chain_, gravity()),
        position_(chain_) {}

  std::size_t results() const { return solver_ == "fpk" ? 12 : solver_ == "crba" ? n_ * n_ : n_; }

  // in: positions, then, where the solver takes them, velocities and accelerations or forces.
  void evaluate(const double* in, double* out) {
    for (unsigned i = 0; i < n_; ++i) {
      q_(i) = in[i];
      if (solver_ == "fpk" || solver_ == "crba") continue;
      qd_(i) = in[n_ + i];
      third_(i) = in[2 * n_ + i];
    }
    if (solver_ == "rnea") {
      inverse_.CartToJnt(q_, qd_, third_, none_, tau_);
      std::copy_n(tau_.data.data(), n_, out);
    } else if (solver_ == "aba") {
      forward_.CartToJnt(q_, qd_, third_, none_, tau_);
      std::copy_n(tau_.data.data(), n_, out);
    } else if (solver_ == "crba") {
      dynamics_.JntToMass(q_, mass_);
      std::copy_n(mass_.data.data(), n_ * n_, out);
    } else {
      KDL::Frame pose;
      position_.JntToCart(q_, pose);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) *out++ = pose.M(row, column);
        *out++ = pose.p(row);
      }
    }
  }

 private:
  static KDL::Vector gravity() { return {0, 0, -9.81}; }

  KDL::Chain chain_;
  std::string solver_;
  unsigned n_;
  KDL::JntArray q_, qd_, third_, tau_;
  KDL::JntSpaceInertiaMatrix mass_;
  KDL::Wrenches none_;
  KDL::ChainIdSolver_RNE inverse_;
  KDL::ChainFdSolver_RNE forward_;
  KDL::ChainDynParam dynamics_;
  KDL::ChainFkSolverPos_recursive position_;
};

cli::QueryOptions query_of(const std::string& solver) {
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  return query;
}

struct Case {
  std::string name;
  std::shared_ptr<backend::JitFunction> function;
  std::shared_ptr<Kdl> kdl;
  std::size_t inputs = 0, results = 0;
  CacheLineVector<double> in, batch_in;  // sample after sample; input after input

  Case(const std::string& robot, const std::string& file, const std::string& solver)
      : name(solver + "/" + robot) {
    const cli::ModelOptions files{{file}, {}, true};
    const auto models = cli::load(files);
    const auto scalar =
        program::scalar_program(cli::program_of(*models, files, query_of(solver), ""));
    function = std::make_shared<backend::JitFunction>(backend::jit_compile(scalar));
    kdl = std::make_shared<Kdl>(file, solver);
    inputs = scalar.computation.inputs;
    results = scalar.computation.results.size();
    std::mt19937 random(7);
    std::uniform_real_distribution<> number(-1.5, 1.5);
    in.resize(inputs * kStates);
    batch_in.resize(inputs * kStates);
    for (std::size_t k = 0; k < kStates; ++k) {
      for (std::size_t i = 0; i < inputs; ++i) {
        in[k * inputs + i] = batch_in[i * kStates + k] = number(random);
      }
    }
    check();
  }

  void check() const {
    if (kdl->results() != results) fail("KDL gives another number of results");
    std::vector<double> ours(results), theirs(results);
    for (std::size_t k = 0; k < kStates; ++k) {
      (*function)(&in[k * inputs], ours.data());
      kdl->evaluate(&in[k * inputs], theirs.data());
      for (std::size_t i = 0; i < results; ++i) {
        if (!(std::fabs(ours[i] - theirs[i]) < 1e-9 * std::max(1.0, std::fabs(theirs[i])))) {
          fail("results differ");
        }
      }
    }
  }
  [[noreturn]] void fail(const char* what) const {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), what);
    std::exit(1);
  }
};

void register_case(const Case& c) {
  benchmark::RegisterBenchmark((c.name + "/compiled").c_str(), [c](benchmark::State& state) {
    std::vector<double> out(c.results);
    std::size_t k = 0;
    for (auto _ : state) {
      (*c.function)(&c.in[k * c.inputs], out.data());
      benchmark::DoNotOptimize(out.data());
      k = (k + 1) % kStates;
    }
  });
  benchmark::RegisterBenchmark((c.name + "/batch").c_str(), [c](benchmark::State& state) {
    CacheLineVector<double> out(c.results * kStates);
    while (state.KeepRunningBatch(kStates)) {
      c.function->batch(c.batch_in.data(), out.data(), kStates);
      benchmark::DoNotOptimize(out.data());
    }
  });
  benchmark::RegisterBenchmark((c.name + "/KDL").c_str(), [c](benchmark::State& state) {
    std::vector<double> out(c.results);
    std::size_t k = 0;
    for (auto _ : state) {
      c.kdl->evaluate(&c.in[k * c.inputs], out.data());
      benchmark::DoNotOptimize(out.data());
      k = (k + 1) % kStates;
    }
  });
}

cli::ModelOptions gen3_files() {
  cli::ModelOptions files;
  for (const auto& entry : std::filesystem::directory_iterator(SINEW_SOURCE_DIR "/robots/gen3")) {
    if (entry.path().extension() == ".jsonld") files.files.push_back(entry.path());
  }
  return files;
}

void BM_models_to_program(benchmark::State& state) {
  const cli::ModelOptions files = gen3_files();
  for (auto _ : state) {
    const auto models = cli::load(files);
    benchmark::DoNotOptimize(cli::program_of(*models, files, query_of("rnea"), ""));
  }
}
BENCHMARK(BM_models_to_program)->Unit(benchmark::kMillisecond);

void BM_models_to_c(benchmark::State& state) {
  const cli::ModelOptions files = gen3_files();
  for (auto _ : state) {
    const auto models = cli::load(files);
    backend::COptions options;
    options.name = "rnea";
    benchmark::DoNotOptimize(
        backend::generate_c(cli::program_of(*models, files, query_of("rnea"), ""), options));
  }
}
BENCHMARK(BM_models_to_c)->Unit(benchmark::kMillisecond);

void BM_normalise_and_synthesise_rnea(benchmark::State& state) {
  const cli::ModelOptions files = gen3_files();
  const auto models = cli::load(files);
  for (auto _ : state) {
    benchmark::DoNotOptimize(cli::algorithm_of(*models, files, query_of("rnea")));
  }
}
BENCHMARK(BM_normalise_and_synthesise_rnea)->Unit(benchmark::kMillisecond);

void BM_program_to_machine_code(benchmark::State& state) {
  const cli::ModelOptions files = gen3_files();
  const auto models = cli::load(files);
  const auto program = cli::program_of(*models, files, query_of("rnea"), "");
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        backend::jit_compile(program::scalar_program(program), {backend::JitLevel::kFast, ""}));
  }
}
BENCHMARK(BM_program_to_machine_code)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::string robots = SINEW_SHARED_DIR "/robots/clean/";
  if (!std::filesystem::exists(robots)) {
    std::fprintf(stderr, "no robots in %s: only the times from models to code\n", robots.c_str());
  } else {
    for (const std::string solver : {"rnea", "aba", "crba", "fpk"}) {
      for (const std::string robot : {"gen3", "iiwa", "general_7r"}) {
        register_case(Case(robot, robots + robot + ".urdf", solver));
      }
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
