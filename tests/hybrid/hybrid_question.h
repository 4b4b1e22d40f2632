// Asks Sinew the same as a dense problem: the same links, directions, numbers.
#pragma once

#include <filesystem>
#include <memory>

#include "dense.h"
#include "question.h"

namespace sinew::test {

// A robot that nobody drew, in a file that goes away with it.
class TemporaryRobot {
 public:
  explicit TemporaryRobot(const std::string& urdf);
  ~TemporaryRobot();
  TemporaryRobot(const TemporaryRobot&) = delete;
  TemporaryRobot& operator=(const TemporaryRobot&) = delete;
  const Robot& robot() const { return robot_; }

 private:
  Robot robot_;
};

// "LINK:linear-z,angular-x" and so on for the constraints of a problem, one option for each link
// and observer, in their order; axis-aligned directions only.
std::vector<std::string> constraint_options(const std::vector<DenseConstraint>& constraints);

// The axis-aligned direction number i: angular-x ... linear-z.
std::array<double, 6> axis(int i);
std::string axis_name(const std::array<double, 6>& direction);

// Sets force setpoints and wrenches, and answers by the names of the outputs.
std::map<std::string, peers::Vector> answers(Question& question, const Problem& problem);

// The numbers of all outputs QUANTITY.*, in their order in the program.
VectorXd outputs(const Question& question, const std::map<std::string, peers::Vector>& answers,
                 const std::string& quantity);

}  // namespace sinew::test
