#include "model_solver.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sinew/backend/compile.h"
#include "sinew/program/interface.h"

namespace sinew::test {
namespace {

cli::QueryOptions named(const std::string& solver, bool floating) {
  cli::QueryOptions query;
  query.solver = solver;
  query.floating = floating;
  return query;
}

}  // namespace

ModelSolver::ModelSolver(const std::string& model, const std::string& solver, bool floating)
    : ModelSolver(model, named(solver, floating)) {}

ModelSolver::ModelSolver(const std::string& model, const cli::QueryOptions& asked) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("sinew-joints-" + std::to_string(::getpid()) + ".ttl");
  std::ofstream(file) << model;
  cli::ModelOptions files;
  files.files = {file.string()};
  cli::QueryOptions query = asked;
  query.gravity = "0.4,-0.3,-9.81";
  const auto models = cli::load(files);
  program_ = cli::program_of(*models, files, query, "");
  std::filesystem::remove(file);
  evaluator_ =
      std::make_unique<cli::Evaluator>(program_, cli::How::kInterpreted, backend::JitLevel::kFast);
}

std::vector<double> ModelSolver::inputs(const TestRobot& robot, const DenseState& state,
                                        const VectorXd& force) const {
  std::map<std::string, double> numbers;
  for (const TestJoint& j : robot.joints) {
    if (j.leader >= 0) continue;
    const auto put = [&](const std::string& quantity, const VectorXd& all, int at, int count) {
      for (int k = 0; k < count; ++k) {
        const std::string name = quantity + "." + j.name;
        const double number = all.size() > 0 ? all[at + k] : 0;
        numbers[count == 1 ? name : name + "[" + std::to_string(k) + "]"] = number;
        // What the numbers of a floating base are called by.
        if (j.name == "base") numbers[quantity + ".link0[" + std::to_string(k) + "]"] = number;
      }
    };
    put("position", state.position, j.position, j.positions);
    put("velocity", state.velocity, j.velocity, j.velocities);
    put("acceleration", state.acceleration, j.velocity, j.velocities);
    put("force", force, j.velocity, j.velocities);
  }
  for (const auto& [input, own] : others_)
    for (Eigen::Index k = 0; k < own.size(); ++k)
      numbers[own.size() == 1 ? input : input + "[" + std::to_string(k) + "]"] = own[k];
  std::vector<double> in;
  for (const std::string& name : cli::column_names(program_, evaluator_->interface().inputs))
    in.push_back(numbers.at(name));
  return in;
}

std::map<std::string, VectorXd> ModelSolver::answer(const TestRobot& robot, const DenseState& state,
                                                    const VectorXd& force) {
  const std::vector<double> in = inputs(robot, state, force);
  std::vector<double> out(evaluator_->interface().out_size);
  evaluator_->evaluate(in.data(), out.data());
  std::map<std::string, VectorXd> results;
  for (const auto& slot : evaluator_->interface().outputs) {
    const auto& variable = program_.variables[slot.variable];
    results[variable.name] = Eigen::Map<VectorXd>(out.data() + slot.offset, variable.size);
  }
  return results;
}

std::vector<Eigen::Index> ModelSolver::order(const TestRobot& robot) const {
  std::vector<Eigen::Index> list;
  for (const auto& slot : program::interface_of(program_).inputs) {
    const std::string& name = program_.variables[slot.variable].name;
    if (!name.starts_with("position.")) continue;
    for (const TestJoint& j : robot.joints)
      if (name.substr(9) == j.name)
        for (int k = 0; k < j.velocities; ++k) list.push_back(j.velocity + k);
  }
  return list;
}

VectorXd evaluated_by_c(const program::Program& program, backend::Style style,
                        const std::vector<double>& in) {
  backend::COptions c;
  c.name = "solver";
  c.style = style;
  const backend::LoadedCode code = backend::compile_and_load(
      backend::generate_c(program, c),
      {"cc",
       {"-O1", "-Wall", "-Wextra", "-Werror", "-std=c11", "-I" SINEW_SOURCE_DIR "/sinew/math"},
       {SINEW_MATH_LIBRARY}});
  VectorXd out(program::interface_of(program).out_size);
  code.function()(in.data(), out.data());
  return out;
}

VectorXd joined(const TestRobot& robot, const std::map<std::string, VectorXd>& results,
                const std::string& quantity) {
  VectorXd all(robot.velocities);
  for (const TestJoint& j : robot.joints) {
    if (j.leader >= 0) continue;
    const VectorXd& own = results.at(quantity + "." + j.name);
    EXPECT_EQ(own.size(), j.velocities) << j.name;
    all.segment(j.velocity, j.velocities) = own;
  }
  return all;
}

MatrixXd matrix(const VectorXd& numbers, Eigen::Index rows) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(numbers.data(), rows, numbers.size() / rows);
}

double difference(const MatrixXd& a, const MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return 1e300;
  if (a.size() == 0) return 0;
  return (a - b).cwiseAbs().maxCoeff() / std::max(1.0, b.cwiseAbs().maxCoeff());
}

}  // namespace sinew::test
