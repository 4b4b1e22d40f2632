// Where constraints depend on each other, the answer is the one that the policy names; beside
// Eigen's decompositions of the coupling that MuJoCo's and KDL's terms give.
#include <gtest/gtest.h>

#include <random>

#include "hybrid_question.h"
#include "random_urdf.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"

namespace sinew::test {
namespace {

// Two links in a plane, of 1 kg and 1 m each.
constexpr const char* kPlanar = R"(<robot name="planar">
  <link name="ground"/>
  <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0.001" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0.001" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tool"><inertial><mass value="0.1"/>
    <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="ground"/><child link="upper"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tool"/>
    <origin xyz="1 0 0"/></joint>
</robot>
)";

struct Scaled {
  MatrixXd L;
  VectorXd s, r;
};

// Each constraint scaled so that its own effect is 1; what nothing moves has scale 0.
Scaled scaled(const DenseSolution& dense) {
  Scaled result;
  result.s = dense.coupling.diagonal();
  for (double& one : result.s) one = one > 1e-14 ? 1 / std::sqrt(one) : 0;
  result.L = result.s.asDiagonal() * dense.coupling * result.s.asDiagonal();
  result.r = result.s.asDiagonal() * dense.residual;
  return result;
}

VectorXd truncated(const DenseSolution& dense, double tolerance) {
  const Scaled scale = scaled(dense);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.L);
  VectorXd inverse = eigen.eigenvalues();
  for (double& one : inverse) one = one > tolerance ? 1 / one : 0;
  return scale.s.asDiagonal() *
         (eigen.eigenvectors() *
          (inverse.asDiagonal() * (eigen.eigenvectors().transpose() * scale.r)));
}

VectorXd damped(const DenseSolution& dense, double damping) {
  const Scaled scale = scaled(dense);
  const auto n = scale.r.size();
  MatrixXd stacked(2 * n, n);
  stacked << scale.L, damping * MatrixXd::Identity(n, n);
  VectorXd right = VectorXd::Zero(2 * n);
  right.head(n) = scale.r;
  return scale.s.asDiagonal() * stacked.colPivHouseholderQr().solve(right);
}

// Constraints in their order, each kept where more than the tolerance of it is independent of those
// kept before.
VectorXd in_order(const DenseSolution& dense, double tolerance) {
  std::vector<Eigen::Index> kept;
  const auto part = [&](const std::vector<Eigen::Index>& rows) {
    MatrixXd L(rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < rows.size(); ++j)
        L(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            dense.coupling(rows[i], rows[j]);
    return L;
  };
  for (Eigen::Index k = 0; k < dense.residual.size(); ++k) {
    const double own = dense.coupling(k, k);
    double rest = own;
    if (!kept.empty()) {
      VectorXd column(kept.size());
      for (std::size_t i = 0; i < kept.size(); ++i)
        column(static_cast<Eigen::Index>(i)) = dense.coupling(kept[i], k);
      rest -= column.dot(part(kept).ldlt().solve(column));
    }
    if (rest > tolerance * own && own > 1e-14) kept.push_back(k);
  }
  VectorXd magnitude = VectorXd::Zero(dense.residual.size());
  if (kept.empty()) return magnitude;
  VectorXd r(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    r(static_cast<Eigen::Index>(i)) = dense.residual(kept[i]);
  const VectorXd x = part(kept).ldlt().solve(r);
  for (std::size_t i = 0; i < kept.size(); ++i)
    magnitude(kept[i]) = x(static_cast<Eigen::Index>(i));
  return magnitude;
}

VectorXd expected(const std::string& policy, const DenseSolution& dense) {
  if (policy == "truncated:1e-6") return truncated(dense, 1e-6);
  if (policy == "damped:0.01") return damped(dense, 0.01);
  return in_order(dense, 1e-6);
}

struct Configuration {
  const char* what;
  double shoulder, elbow;
};

// The tool is fixed to the last link, so that its frame is none of a body.
TEST(SingularConstraints, GiveTheAnswerThatThePolicyNames) {
  const TemporaryRobot file(kPlanar);
  for (const std::string policy : {"in-order:1e-6", "truncated:1e-6", "damped:0.01"}) {
    Problem problem;
    // Out of the plane nothing moves; in it, two joints cannot do three things.
    for (const int i : {5, 3, 4, 2}) problem.constraints.push_back({"tool", axis(i), false, 0});
    cli::QueryOptions query;
    query.solver = "hybrid";
    query.gravity = "0,0,-9.81";
    query.singular = policy;
    query.constraints = constraint_options(problem.constraints);
    Question question(file.robot(), query);
    const peers::Setup setup{file.robot().urdf, question.joints(), false, {0, 0, -9.81}};
    const auto peer = peers::make_kdl(setup);
    for (const Configuration& at :
         {Configuration{"bent", 0.3, 1.2}, Configuration{"stretched", 0, 0},
          Configuration{"stretched askew", 0.7, 0}, Configuration{"folded", 0.4, M_PI}}) {
      SCOPED_TRACE(policy + ", " + at.what);
      problem.state.position = {at.shoulder, at.elbow};
      problem.state.velocity = {0.5, -0.8};
      problem.state.acceleration = {0, 0};
      problem.force = {1, -2};
      double energy = 1;
      for (DenseConstraint& one : problem.constraints) one.energy = energy *= -1.5;
      const DenseSolution dense = solve_densely(*peer, problem);
      const VectorXd magnitude = expected(policy, dense);
      const auto ours = answers(question, problem);
      const VectorXd found = outputs(question, ours, "constraint-magnitude");
      ASSERT_TRUE(found.allFinite());
      EXPECT_LT((found - magnitude).norm(), 1e-6 * (1 + magnitude.norm()));
      const VectorXd acceleration = outputs(question, ours, "acceleration");
      ASSERT_TRUE(acceleration.allFinite());
      EXPECT_LT((acceleration - acceleration_under(*peer, problem, magnitude)).norm(), 1e-6);
    }
  }
}

// Six directions of an arm that is stretched out; and compiled code takes the same steps.
TEST(SingularConstraints, NeverGiveANumberThatIsNone) {
  const std::filesystem::path folder = SINEW_SHARED_DIR "/robots";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there are no robots in " << folder;
  const Robot robot{"iiwa", (folder / "clean/iiwa.urdf").string(), ""};
  for (const std::string policy : {"in-order:1e-9", "truncated:1e-9", "damped:1e-4"}) {
    SCOPED_TRACE(policy);
    cli::QueryOptions query;
    query.solver = "hybrid";
    query.gravity = "0,0,-9.81";
    query.singular = policy;
    query.constraints = {"lbr_iiwa_link_7:6"};  // as inputs: they can be zero, or the same
    cli::ModelOptions files{{robot.file}, {}, true};
    const auto models = cli::load(files);
    const program::Program program = cli::program_of(*models, files, query, "");
    cli::Evaluator interpreted(program, cli::How::kInterpreted, backend::JitLevel::kFast);
    std::vector<std::unique_ptr<cli::Evaluator>> evaluators;
    if (backend::jit_available())
      evaluators.push_back(
          std::make_unique<cli::Evaluator>(program, cli::How::kCompiled, backend::JitLevel::kFast));
    const auto names = cli::column_names(program, interpreted.interface().inputs);
    for (const bool same_directions : {false, true}) {
      std::vector<double> in(names.size(), 0.0);
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].starts_with("force.")) in[i] = 1;
        if (names[i].starts_with("acceleration-energy.")) in[i] = 2;
        if (same_directions && names[i].ends_with("[5]")) in[i] = 1;
      }
      std::vector<double> out(interpreted.interface().out_size);
      interpreted.evaluate(in.data(), out.data());
      for (const double number : out) EXPECT_TRUE(std::isfinite(number));
      for (const auto& compiled : evaluators) {
        std::vector<double> other(out.size());
        compiled->evaluate(in.data(), other.data());
        for (std::size_t i = 0; i < out.size(); ++i)
          EXPECT_NEAR(other[i], out[i], 1e-6 * (1 + std::fabs(out[i])));
      }
    }
  }
}

// The same numbers from generated C, one state at a time and in batches, also where the arm is
// stretched out.
TEST(SingularConstraints, AreTreatedAlikeByGeneratedCode) {
  const TemporaryRobot file(kPlanar);
  for (const std::string policy : {"in-order:1e-6", "truncated:1e-6", "damped:0.01"}) {
    SCOPED_TRACE(policy);
    cli::QueryOptions query;
    query.solver = "hybrid";
    query.gravity = "0,0,-9.81";
    query.singular = policy;
    query.constraints = {"tool:angular-z,linear-x,linear-y"};
    cli::ModelOptions files{{file.robot().file}, {}, true};
    const auto models = cli::load(files);
    const program::Program program = cli::program_of(*models, files, query, "solver");
    backend::Interpreter interpreter(program);
    const backend::LoadedCode code =
        backend::compile_and_load(backend::generate_c(program, {.name = "solver"}), {});
    const auto names = cli::column_names(program, program::interface_of(program).inputs);
    constexpr std::size_t kStates = 9;
    std::vector<double> batch_in(names.size() * kStates),
        batch_out(interpreter.out_size() * kStates);
    std::vector<std::vector<double>> expected;
    for (std::size_t k = 0; k < kStates; ++k) {
      std::vector<double> in(names.size()), out(interpreter.out_size()), other(out.size());
      for (std::size_t i = 0; i < in.size(); ++i) {
        in[i] = std::sin(1.0 + static_cast<double>(7 * i + k));
        if (k % 3 == 0 && names[i].starts_with("position.")) in[i] = 0;
        batch_in[i * kStates + k] = in[i];
      }
      interpreter.evaluate(in.data(), out.data());
      code.function()(in.data(), other.data());
      for (std::size_t i = 0; i < out.size(); ++i) {
        ASSERT_TRUE(std::isfinite(out[i]));
        EXPECT_NEAR(other[i], out[i], 1e-7 * (1 + std::fabs(out[i])));
      }
      expected.push_back(out);
    }
    code.batch()(batch_in.data(), batch_out.data(), kStates);
    for (std::size_t k = 0; k < kStates; ++k)
      for (std::size_t i = 0; i < expected[k].size(); ++i)
        EXPECT_NEAR(batch_out[i * kStates + k], expected[k][i],
                    1e-7 * (1 + std::fabs(expected[k][i])));
  }
}

}  // namespace
}  // namespace sinew::test
