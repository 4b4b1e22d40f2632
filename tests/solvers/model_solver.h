// A question to Sinew about a robot of random_joints.h, by any joint's names and numbers.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dense_reference.h"
#include "evaluator.h"
#include "pipeline.h"
#include "sinew/backend/c_target.h"

namespace sinew::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

inline const Eigen::Vector3d kGravity(0.4, -0.3, -9.81);

// The model is a file for as long as the program is made.
class ModelSolver {
 public:
  ModelSolver(const std::string& model, const std::string& solver, bool floating = false);
  ModelSolver(const std::string& model, const cli::QueryOptions& query);

  // Inputs by name: QUANTITY.JOINT, or QUANTITY.JOINT[k].
  std::vector<double> inputs(const TestRobot& robot, const DenseState& state,
                             const VectorXd& force = {}) const;
  std::map<std::string, VectorXd> answer(const TestRobot& robot, const DenseState& state,
                                         const VectorXd& force = {});

  // An input that is no number of the state: a wrench, a setpoint.
  void set(const std::string& input, const VectorXd& numbers) { others_[input] = numbers; }

  const program::Program& program() const { return program_; }

  // Rows and columns of matrices are in the order of the inputs, depth first; ours are not.
  std::vector<Eigen::Index> order(const TestRobot& robot) const;

 private:
  program::Program program_;
  std::unique_ptr<cli::Evaluator> evaluator_;
  std::map<std::string, VectorXd> others_;
};

// What generated C code of a program, compiled, makes of its inputs.
VectorXd evaluated_by_c(const program::Program& program, backend::Style style,
                        const std::vector<double>& in);

// force.j0, force.j1, … one after the other.
VectorXd joined(const TestRobot& robot, const std::map<std::string, VectorXd>& results,
                const std::string& quantity);

// Numbers row by row.
MatrixXd matrix(const VectorXd& numbers, Eigen::Index rows);

// The largest difference, relative to the largest number (but at least to 1).
double difference(const MatrixXd& a, const MatrixXd& b);

}  // namespace sinew::test
