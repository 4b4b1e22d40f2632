// Derivatives of whole programs: beside complex steps through the recorded graph, beside
// differences of MuJoCo's own inverse dynamics, and the same from every back end.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "model_solver.h"
#include "question.h"
#include "random_urdf.h"
#include "sinew/backend/compile.h"
#include "sinew/base/error.h"
#include "sinew/program/derivatives.h"
#include "sinew/program/program_json.h"
#include "sinew/program/scalar_program.h"
#include "sinew/program/trace.h"

namespace sinew::test {
namespace {

using program::Computation;
using program::Op;
using Complex = std::complex<double>;

// The recorded graph on complex numbers: nothing of the rules of differentiation is in here.
std::vector<Complex> evaluate(const Computation& computation, const std::vector<Complex>& in) {
  const program::Dag& dag = computation.dag;
  std::vector<Complex> values(dag.size());
  const auto of = [&](program::Ref ref) {
    return ref.negative() ? -values[ref.node()] : values[ref.node()];
  };
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    const program::Node& n = dag.node(i);
    switch (n.op) {
      case Op::kConstant:
        values[i] = n.value;
        break;
      case Op::kInput:
        values[i] = in[n.index];
        break;
      case Op::kAdd:
        values[i] = of(n.a) + of(n.b);
        break;
      case Op::kMultiply:
        values[i] = of(n.a) * of(n.b);
        break;
      case Op::kFma:
        values[i] = of(n.a) * of(n.b) + of(n.c);
        break;
      case Op::kDivide:
        values[i] = of(n.a) / of(n.b);
        break;
      case Op::kSqrt:
        values[i] = std::sqrt(of(n.a));
        break;
      case Op::kSin:
        values[i] = std::sin(of(n.a));
        break;
      case Op::kCos:
        values[i] = std::cos(of(n.a));
        break;
      case Op::kLess:
        values[i] = of(n.a).real() < of(n.b).real() ? 1.0 : 0.0;
        break;
      case Op::kSelect:
        values[i] = of(n.a).real() != 0.0 ? of(n.b) : of(n.c);
        break;
    }
  }
  std::vector<Complex> results;
  for (const program::Ref result : computation.results) results.push_back(of(result));
  return results;
}

struct Temporary {
  explicit Temporary(const std::string& urdf)
      : file((std::filesystem::temp_directory_path() /
              ("sinew-derivative-" + std::to_string(::getpid()) + ".urdf"))
                 .string()) {
    std::ofstream(file) << urdf;
  }
  ~Temporary() { std::filesystem::remove(file); }
  std::string file;
};

program::Program program_for(const std::vector<std::string>& files, const std::string& solver,
                             std::vector<std::string> derivatives, bool floating = false) {
  cli::ModelOptions models_options;
  models_options.files = files;
  models_options.lenient = true;
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0.3,-0.2,-9.81";
  query.floating = floating;
  query.derivatives = std::move(derivatives);
  const auto models = cli::load(models_options);
  return cli::program_of(*models, models_options, query, "");
}

std::vector<double> random_inputs(const program::Program& program, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> number(-1.5, 1.5);
  std::vector<double> in(program::interface_of(program).in_size);
  for (double& x : in) x = number(random);
  return in;
}

std::vector<double> interpret(const program::Program& program, const std::vector<double>& in) {
  backend::Interpreter interpreter(program);
  std::vector<double> out(interpreter.out_size());
  interpreter.evaluate(in.data(), out.data());
  return out;
}

// Every entry against a complex step, and every entry that is left out too.
void expect_complex_steps(const program::Program& program) {
  program::Program plain = program;
  for (const program::Derivative& derivative : plain.derivatives)
    for (const program::DerivativeEntry& entry : derivative.entries)
      plain.variables[entry.variable].output = false;
  plain.derivatives.clear();
  const Computation values = program::trace(plain);
  const program::Interface interface = program::interface_of(program),
                           plain_interface = program::interface_of(plain);
  std::vector<std::uint32_t> in_at(program.variables.size()), out_at(program.variables.size()),
      value_at(program.variables.size());
  for (const auto& slot : interface.inputs) in_at[slot.variable] = slot.offset;
  for (const auto& slot : interface.outputs) out_at[slot.variable] = slot.offset;
  for (const auto& slot : plain_interface.outputs) value_at[slot.variable] = slot.offset;
  const std::vector<double> in = random_inputs(program, 7);
  const std::vector<double> out = interpret(program, in);
  constexpr double kStep = 1e-40;
  for (const program::Derivative& derivative : program.derivatives) {
    SCOPED_TRACE(derivative.name);
    std::map<std::array<std::uint32_t, 4>, double> entries;
    for (const auto& e : derivative.entries)
      entries[{e.of, e.of_number, e.by, e.by_number}] = out[out_at[e.variable]];
    for (const std::uint32_t by : derivative.by) {
      for (std::uint32_t c = 0; c < program.variables[by].size; ++c) {
        std::vector<Complex> stepped(in.begin(), in.end());
        stepped[in_at[by] + c] += Complex(0, kStep);
        const std::vector<Complex> results = evaluate(values, stepped);
        for (const std::uint32_t of : derivative.of) {
          for (std::uint32_t r = 0; r < program.variables[of].size; ++r) {
            const double expected = results[value_at[of] + r].imag() / kStep;
            const auto entry = entries.find({of, r, by, c});
            const double found = entry == entries.end() ? 0 : entry->second;
            EXPECT_NEAR(found, expected, 1e-10 * std::max(1.0, std::fabs(expected)))
                << program.variables[of].name << " " << program.variables[by].name;
          }
        }
      }
    }
  }
}

const std::vector<std::string> kGen3 = [] {
  std::vector<std::string> files;
  for (const char* name : {"chain", "dynamics", "geometry", "mounting-upright"})
    files.push_back(std::string(SINEW_SOURCE_DIR "/robots/gen3/") + name + ".jsonld");
  return files;
}();

TEST(Derivative, OfEverySolverIsTheComplexStep) {
  expect_complex_steps(
      program_for(kGen3, "rnea", {"force/position", "force/velocity", "force/acceleration"}));
  expect_complex_steps(program_for(kGen3, "aba", {"acceleration/position", "acceleration/force"}));
  expect_complex_steps(program_for(kGen3, "fpk", {"pose/position"}));
  expect_complex_steps(program_for(kGen3, "crba", {"mass-matrix/position"}));
  expect_complex_steps(program_for(kGen3, "fak", {"acceleration-twist/velocity"}));
}

TEST(Derivative, OfTreesAndFloatingBases) {
  RandomRobot random;
  random.joints = 9;
  random.floating = true;
  const Temporary file(random_urdf(random));
  expect_complex_steps(program_for({file.file}, "rnea", {"force/position", "force/velocity"}));
  expect_complex_steps(program_for({file.file}, "rnea", {"force/position"}, true));
  expect_complex_steps(program_for({file.file}, "aba", {"acceleration/force"}, true));
}

// With followers and gears; quaternions are differentiated as the four numbers that they are.
TEST(Derivative, OfJointsOfEveryKindIsTheComplexStep) {
  for (const std::uint32_t seed : {691u, 692u}) {
    RandomJoints options;
    options.joints = 7;
    options.seed = seed;
    const std::string model = turtle(random_joints(options));
    for (const auto& [solver, of] : {std::pair<std::string, std::string>{"rnea", "force"},
                                     {"bias", "bias-force"},
                                     {"fvk", "twist"},
                                     {"momentum", "centroidal-momentum"}}) {
      SCOPED_TRACE(solver);
      cli::QueryOptions query;
      query.solver = solver;
      query.derivatives = {of + "/position", of + "/velocity"};
      expect_complex_steps(ModelSolver(model, query).program());
    }
  }
}

// By other means than those of the rules: fourth-order differences of another library.
TEST(Derivative, OfInverseDynamicsIsThatOfMujoco) {
  RandomRobot random;
  random.joints = 7;
  const std::string urdf = random_urdf(random);
  const Temporary file(urdf);
  const Question values({"random", file.file, urdf}, "rnea");
  cli::ModelOptions files;
  files.files = {file.file};
  cli::QueryOptions query;
  query.solver = "rnea";
  query.gravity = "0,0,-9.81";
  query.derivatives = {"force/position", "force/velocity"};
  const auto models = cli::load(files);
  const program::Program program = cli::program_of(*models, files, query, "");
  const auto mujoco = peers::make_mujoco({urdf, values.joints(), false, {0, 0, -9.81}});
  const std::size_t n = values.joints().size();
  const peers::State state = random_state(n, 3);
  std::vector<double> in;
  std::map<std::string, std::size_t> used;
  const auto inputs = cli::column_names(program, program::interface_of(program).inputs);
  for (const std::string& name : inputs) {
    const std::string quantity = name.substr(0, name.find('.'));
    const auto& numbers = quantity == "position"   ? state.position
                          : quantity == "velocity" ? state.velocity
                                                   : state.acceleration;
    in.push_back(numbers.at(used[quantity]++));
  }
  const std::vector<double> out = interpret(program, in);
  std::map<std::string, double> found;
  const auto outputs = cli::column_names(program, program::interface_of(program).outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i) found[outputs[i]] = out[i];
  for (const std::string& quantity : {std::string("position"), std::string("velocity")}) {
    for (std::size_t column = 0; column < n; ++column) {
      const auto force = [&](double step) {
        peers::State moved = state;
        (quantity == "position" ? moved.position : moved.velocity)[column] += step;
        return mujoco->inverse_dynamics(moved);
      };
      constexpr double h = 1e-3;
      const auto a = force(-2 * h), b = force(-h), c = force(h), d = force(2 * h);
      for (std::size_t row = 0; row < n; ++row) {
        const double expected = (8 * (c[row] - b[row]) - (d[row] - a[row])) / (12 * h);
        const std::string name =
            "force." + values.joints()[row] + "/" + quantity + "." + values.joints()[column];
        const auto entry = found.find(name);
        EXPECT_NEAR(entry == found.end() ? 0 : entry->second, expected, 1e-7) << name;
      }
    }
  }
}

TEST(Derivative, OfForcesByAccelerationsIsTheMassMatrix) {
  const program::Program rnea = program_for(kGen3, "rnea", {"force/acceleration"});
  const program::Program crba = program_for(kGen3, "crba", {});
  const std::vector<double> in = random_inputs(rnea, 5), out = interpret(rnea, in);
  std::vector<double> position;
  const auto inputs = cli::column_names(rnea, program::interface_of(rnea).inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].starts_with("position.")) position.push_back(in[i]);
  const std::vector<double> mass = interpret(crba, position);
  ASSERT_EQ(out.size(), 7 + mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) EXPECT_NEAR(out[7 + i], mass[i], 1e-12);
}

TEST(Derivative, IsTheSameFromEveryBackEnd) {
  const program::Program program =
      program_for(kGen3, "rnea", {"force/position", "force.joint3/velocity"});
  constexpr std::size_t kSamples = 11;
  const std::size_t in_size = program::interface_of(program).in_size,
                    out_size = program::interface_of(program).out_size;
  std::vector<double> batch_in(in_size * kSamples), batch_out(out_size * kSamples);
  std::vector<std::vector<double>> expected;
  for (unsigned k = 0; k < kSamples; ++k) {
    const std::vector<double> in = random_inputs(program, k);
    for (std::size_t i = 0; i < in_size; ++i) batch_in[i * kSamples + k] = in[i];
    expected.push_back(interpret(program, in));
  }
  const auto expect_same = [&](const char* who) {
    SCOPED_TRACE(who);
    for (unsigned k = 0; k < kSamples; ++k)
      for (std::size_t i = 0; i < out_size; ++i)
        EXPECT_NEAR(batch_out[i * kSamples + k], expected[k][i], 1e-10);
  };
  const auto expect_single = [&](const char* who, auto&& function) {
    for (unsigned k = 0; k < kSamples; ++k) {
      std::vector<double> in = random_inputs(program, k), out(out_size);
      function(in.data(), out.data());
      for (std::size_t i = 0; i < out_size; ++i)
        EXPECT_NEAR(out[i], expected[k][i], 1e-10) << who << " " << i;
    }
  };
  backend::COptions options;
  options.name = "derivative";
  const backend::LoadedCode code =
      backend::compile_and_load(backend::generate_c(program, options), {"cc", {"-O1"}, {}});
  expect_single("C", code.function());
  code.batch()(batch_in.data(), batch_out.data(), kSamples);
  expect_same("C batch");
  if (!backend::jit_available()) return;
  const auto jit =
      backend::jit_compile(program::scalar_program(program), {backend::JitLevel::kFast, ""});
  expect_single("JIT", jit);
  jit.batch(batch_in.data(), batch_out.data(), kSamples);
  expect_same("JIT batch");
}

TEST(Derivative, LeavesOutWhatIsAlwaysZero) {
  // The first joint's own position matters to nothing: gravity is along its axis, as ever on a
  // table.
  cli::ModelOptions files;
  files.files = kGen3;
  cli::QueryOptions query;
  query.solver = "rnea";
  query.gravity = "0,0,-9.81";
  query.derivatives = {"force/position"};
  const auto models = cli::load(files);
  const program::Program program = cli::program_of(*models, files, query, "");
  EXPECT_EQ(program.derivatives.at(0).entries.size(), 42U);
  for (const auto& entry : program.derivatives.at(0).entries)
    EXPECT_NE(program.variables[entry.by].name, "position.joint1");
}

TEST(Derivative, SurvivesTheJsonForm) {
  const program::Program program = program_for(kGen3, "fpk", {"pose/position"});
  const program::Program again = program::from_json(program::to_json(program), "memory");
  const std::vector<double> in = random_inputs(program, 1);
  EXPECT_EQ(interpret(program, in), interpret(again, in));
  EXPECT_EQ(program::to_json(again), program::to_json(program));
}

TEST(Derivative, RefusesWhatIsNotThere) {
  const auto complaint = [](std::vector<std::string> derivatives) -> std::string {
    try {
      program_for(kGen3, "fpk", std::move(derivatives));
    } catch (const Error& error) {
      return error.problems().front().what + " | " + error.problems().front().remedy;
    }
    return "";
  };
  EXPECT_EQ(complaint({"force/position"}),
            "derivative 'force/position': the program has no output 'force' | name one of its "
            "outputs, or all of a quantity: pose");
  EXPECT_NE(complaint({"pose/velocity"}).find("no input 'velocity'"), std::string::npos);
  EXPECT_NE(complaint({"pose"}).find("not of the form OUT/IN"), std::string::npos);
  EXPECT_NE(complaint({"pose/position", "pose/position.joint2"}).find("asked for twice"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::test
