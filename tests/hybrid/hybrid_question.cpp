#include "hybrid_question.h"

#include <unistd.h>

#include <fstream>

namespace sinew::test {
namespace {

const char* const kAxes[] = {"angular-x", "angular-y", "angular-z",
                             "linear-x",  "linear-y",  "linear-z"};

}  // namespace

TemporaryRobot::TemporaryRobot(const std::string& urdf) {
  static int count = 0;
  const auto file =
      std::filesystem::temp_directory_path() /
      ("sinew-hybrid-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".urdf");
  robot_ = {"random", file.string(), urdf};
  std::ofstream(file) << urdf;
}

TemporaryRobot::~TemporaryRobot() { std::filesystem::remove(robot_.file); }

std::array<double, 6> axis(int i) {
  std::array<double, 6> direction{};
  direction[static_cast<std::size_t>(i)] = 1;
  return direction;
}

std::string axis_name(const std::array<double, 6>& direction) {
  for (int i = 0; i < 6; ++i)
    if (direction == axis(i)) return kAxes[i];
  return {};
}

std::vector<std::string> constraint_options(const std::vector<DenseConstraint>& constraints) {
  std::vector<std::string> options;
  const DenseConstraint* last = nullptr;
  for (const DenseConstraint& one : constraints) {
    const bool more =
        last != nullptr && last->link == one.link && last->seen_by_itself == one.seen_by_itself;
    if (more) {
      const std::size_t at = options.back().rfind('@');
      options.back().insert(at, "," + axis_name(one.direction));
    } else {
      options.push_back(one.link + ":" + axis_name(one.direction) +
                        (one.seen_by_itself ? "@itself" : "@base"));
    }
    last = &one;
  }
  return options;
}

std::map<std::string, peers::Vector> answers(Question& question, const Problem& problem) {
  for (const DenseConstraint& one : problem.constraints)
    question.set("acceleration-energy." + one.link + "." + axis_name(one.direction), {one.energy});
  for (const DenseWrench& one : problem.wrenches) question.set("wrench." + one.link, one.wrench);
  return question.answers(problem.state, problem.force);
}

VectorXd outputs(const Question& question, const std::map<std::string, peers::Vector>& answers,
                 const std::string& quantity) {
  std::vector<const program::Variable*> found;
  for (const program::Slot& slot : program::interface_of(question.program()).outputs) {
    const program::Variable& variable = question.program().variables[slot.variable];
    if (variable.name.starts_with(quantity + ".")) found.push_back(&variable);
  }
  std::vector<double> numbers;
  for (const program::Variable* variable : found) {
    const peers::Vector& own = answers.at(variable->name);
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

}  // namespace sinew::test
