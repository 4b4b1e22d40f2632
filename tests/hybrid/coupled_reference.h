// Hybrid dynamics where joints follow others, as one dense system in numbers longer than double,
// with the independent joints as coordinates:
//   [ M  -J^T ] [qdd]   [ tau - h + sum of J_w^T w ]
//   [ J   0   ] [ x ] = [ energies - Jdot qd       ]
// The same question to Sinew; and robots to ask about.
#pragma once

#include <random>

#include "dense_reference.h"
#include "model_solver.h"
#include "random_joints.h"

namespace sinew::test::coupled {

// An axis-aligned acceleration of the frame of a link that is imposed.
struct Imposed {
  int link = 0, axis = 0;
  bool seen_by_itself = false;
  double energy = 0;
};

struct Wrench {  // seen from the link
  int link = 0;
  VectorXd numbers;
};

struct Task {
  DenseState state;
  VectorXd force;
  std::vector<Imposed> imposed;
  std::vector<Wrench> wrenches;
  double gravity = 1, velocity = 1;  // how many times what they do counts
};

struct Solution {
  VectorXd acceleration, magnitude, constraint_force;
  MatrixXd coupling;
  VectorXd residual;
  double condition = 0;
};

Solution solve(const TestRobot& robot, const Task& task);
VectorXd acceleration_under(const TestRobot& robot, const Task& task, const VectorXd& magnitude);

// ---- tasks ----

// Some directions of some links, and wrenches on two of them.
Task random_task(const TestRobot& robot, std::mt19937& random, std::size_t count);
// Its state and its numbers.
void draw(const TestRobot& robot, std::mt19937& random, unsigned seed, Task& task);

// ---- the same of Sinew ----

cli::QueryOptions query_of(const Task& task);
void set(ModelSolver& solver, const Task& task);
VectorXd magnitudes(const Task& task, const std::map<std::string, VectorXd>& answers);
std::string frame(int link);  // its name in a query

// ---- robots ----

bool follows_in_another_branch(const TestRobot& robot);
// The first of some trees in which a joint follows one of another branch.
TestRobot coupled_tree(unsigned joints);
// A finger of three turns about parallel axes of which two follow the first: one degree of freedom.
TestRobot finger();

}  // namespace sinew::test::coupled
