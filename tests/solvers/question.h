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

// A URDF on disk, and its moving joints in the project's order once it has been asked something.
struct Robot {
  std::string name;  // for messages
  std::string file;
  std::string urdf;
  bool floating = false;
};

class Question {
 public:
  // `solver`: rnea, aba, crba, fpk, …; gravity 0,0,-9.81.
  Question(const Robot& robot, const std::string& solver, std::vector<std::string> tips = {});

  // The moving joints, in the order of the program's inputs.
  const std::vector<std::string>& joints() const { return joints_; }
  const program::Program& program() const { return program_; }

  // Evaluates with inputs found by their quantity: position.*, velocity.*, acceleration.*, force.*. `force` may be
  // empty where the program takes none. Results by name (size 1) or NAME[i].
  std::map<std::string, double> answer(const peers::State& state, const peers::Vector& force = {});

  // The results QUANTITY.JOINT in joint order; of a floating base its 6 numbers first.
  peers::Vector joint_results(const std::map<std::string, double>& results,
                              const std::string& quantity) const;

 private:
  program::Program program_;
  std::unique_ptr<cli::Evaluator> evaluator_;
  std::vector<std::string> inputs_, outputs_;
  std::vector<std::string> joints_;
  std::string base_;  // the element that names a floating base's numbers
};

// Every URDF of the test material; empty where it is not there.
std::vector<Robot> published_robots();
// A state whose numbers are drawn from +-1 (positions +-pi where `wide`).
peers::State random_state(std::size_t joints, bool floating, unsigned seed);

}  // namespace sinew::test
