// Asks the whole of Sinew a question about a robot and evaluates the answer in many states.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "evaluator.h"
#include "peer.h"
#include "pipeline.h"
#include "sinew/program/program.h"

namespace sinew::test {

struct Robot {
  std::string name;  // for messages
  std::string file;
  std::string urdf;  // the file's text
};

// Every URDF of the test material; empty where it is not there.
std::vector<Robot> published_robots();
// The one of this name, which is a test's fault if there is none. Precondition: they are there.
Robot published_robot(const std::string& name);

class Question {
 public:
  // `solver`: rnea, aba, crba, fpk, …; gravity is 0,0,-9.81 seen from the base, or from the world
  // if it floats.
  Question(const Robot& robot, const std::string& solver, bool floating = false);
  // The same with any question that the command line can put.
  Question(const Robot& robot, const cli::QueryOptions& query);

  // The moving joints, in the order of the program's inputs; of a floating base only the others.
  const std::vector<std::string>& joints() const { return joints_; }
  const program::Program& program() const { return program_; }

  // The program's inputs for a state, one after the other; as `answer` takes them.
  peers::Vector inputs(const peers::State& state, const peers::Vector& force = {}) const;
  // All results, one after the other. Inputs are found by their names: position.*, velocity.*,
  // acceleration.* of the state, force.* of `force`, which may be empty where the program takes
  // none.
  peers::Vector answer(const peers::State& state, const peers::Vector& force = {});
  // The same by the names of the outputs.
  std::map<std::string, peers::Vector> answers(const peers::State& state,
                                               const peers::Vector& force = {});
  // The value of any other input: wrench.*, gravity.
  void set(const std::string& input, const peers::Vector& value) { others_[input] = value; }

 private:
  program::Program program_;
  std::unique_ptr<cli::Evaluator> evaluator_;
  std::vector<std::string> inputs_;
  std::vector<std::string> joints_;
  std::map<std::string, peers::Vector> others_;
};

// Positions are drawn from +-pi, velocities and accelerations from +-1.
peers::State random_state(std::size_t joints, unsigned seed, bool floating = false);

}  // namespace sinew::test
