#include "question.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace sinew::test {

std::vector<Robot> published_robots() {
  std::vector<Robot> robots;
  const std::filesystem::path folder = SINEW_SHARED_DIR "/robots";
  if (!std::filesystem::exists(folder)) return robots;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    robots.push_back({std::filesystem::relative(entry.path(), folder).string(),
                      entry.path().string(), text.str()});
  }
  std::sort(robots.begin(), robots.end(),
            [](const Robot& a, const Robot& b) { return a.name < b.name; });
  return robots;
}

Robot published_robot(const std::string& name) {
  for (Robot& robot : published_robots()) {
    if (robot.name == name) return std::move(robot);
  }
  throw std::invalid_argument("no robot " + name + " in " SINEW_SHARED_DIR "/robots");
}

namespace {

cli::QueryOptions options_of(const std::string& solver, bool floating) {
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  query.floating = floating;
  return query;
}

}  // namespace

Question::Question(const Robot& robot, const std::string& solver, bool floating)
    : Question(robot, options_of(solver, floating)) {}

Question::Question(const Robot& robot, const cli::QueryOptions& query) {
  cli::ModelOptions files;
  files.files = {robot.file};
  files.lenient = true;
  const auto models = cli::load(files);
  program_ = cli::program_of(*models, files, query, "");
  evaluator_ =
      std::make_unique<cli::Evaluator>(program_, cli::How::kInterpreted, backend::JitLevel::kFast);
  inputs_ = cli::column_names(program_, evaluator_->interface().inputs);
  const std::string position = "position.";
  for (const std::string& input : inputs_) {
    if (input.starts_with(position) && !input.ends_with("]")) {
      joints_.push_back(input.substr(position.size()));
    }
  }
}

peers::Vector Question::inputs(const peers::State& state, const peers::Vector& force) const {
  // Each quantity's numbers come in the order of the state: the base's, then the joints'.
  const std::map<std::string, const peers::Vector*> vectors = {
      {"position", &state.position},
      {"velocity", &state.velocity},
      {"acceleration", &state.acceleration},
      {"force", &force}};
  peers::Vector in;
  std::map<std::string, std::size_t> used;
  for (const std::string& input : inputs_) {
    const std::string block = input.substr(0, input.find('['));
    if (const auto other = others_.find(block); other != others_.end()) {
      in.push_back(other->second.at(used[block]++));
      continue;
    }
    const std::string quantity = input.substr(0, input.find('.'));
    in.push_back(vectors.at(quantity)->at(used[quantity]++));
  }
  return in;
}

peers::Vector Question::answer(const peers::State& state, const peers::Vector& force) {
  const peers::Vector in = inputs(state, force);
  peers::Vector out(evaluator_->interface().out_size);
  evaluator_->evaluate(in.data(), out.data());
  return out;
}

std::map<std::string, peers::Vector> Question::answers(const peers::State& state,
                                                       const peers::Vector& force) {
  const peers::Vector all = answer(state, force);
  std::map<std::string, peers::Vector> named;
  for (const program::Slot& slot : evaluator_->interface().outputs) {
    const program::Variable& variable = program_.variables[slot.variable];
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(slot.offset);
    named[variable.name] = peers::Vector(first, first + static_cast<std::ptrdiff_t>(variable.size));
  }
  return named;
}

peers::State random_state(std::size_t joints, unsigned seed, bool floating) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> angle(-M_PI, M_PI), number(-1, 1);
  peers::State state;
  if (floating) {
    double quaternion[4], square = 0;
    for (double& q : quaternion) {
      q = number(random);
      square += q * q;
    }
    for (int i = 0; i < 3; ++i) state.position.push_back(number(random));
    for (const double q : quaternion) state.position.push_back(q / std::sqrt(square));
    for (int i = 0; i < 6; ++i) {
      state.velocity.push_back(number(random));
      state.acceleration.push_back(number(random));
    }
  }
  for (std::size_t i = 0; i < joints; ++i) {
    state.position.push_back(angle(random));
    state.velocity.push_back(number(random));
    state.acceleration.push_back(number(random));
  }
  return state;
}

}  // namespace sinew::test
