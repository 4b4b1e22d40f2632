#include "question.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

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

Question::Question(const Robot& robot, const std::string& solver) {
  cli::ModelOptions files;
  files.files = {robot.file};
  files.lenient = true;
  cli::QueryOptions query;
  query.solver = solver;
  query.gravity = "0,0,-9.81";
  const auto models = cli::load(files);
  program_ = cli::program_of(*models, files, query, "");
  evaluator_ =
      std::make_unique<cli::Evaluator>(program_, cli::How::kInterpreted, backend::JitLevel::kFast);
  inputs_ = cli::column_names(program_, evaluator_->interface().inputs);
  const std::string position = "position.";
  for (const std::string& input : inputs_) {
    if (input.starts_with(position)) joints_.push_back(input.substr(position.size()));
  }
}

peers::Vector Question::answer(const peers::State& state, const peers::Vector& force) {
  peers::Vector in;
  for (const std::string& input : inputs_) {
    const auto dot = input.find('.');
    const std::string quantity = input.substr(0, dot);
    const auto joint = std::find(joints_.begin(), joints_.end(), input.substr(dot + 1));
    if (joint == joints_.end()) throw std::runtime_error("unexpected input " + input);
    const auto index = static_cast<std::size_t>(joint - joints_.begin());
    const peers::Vector& numbers = quantity == "position"       ? state.position
                                   : quantity == "velocity"     ? state.velocity
                                   : quantity == "acceleration" ? state.acceleration
                                                                : force;
    in.push_back(numbers.at(index));
  }
  peers::Vector out(evaluator_->interface().out_size);
  evaluator_->evaluate(in.data(), out.data());
  return out;
}

peers::State random_state(std::size_t joints, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> angle(-M_PI, M_PI), number(-1, 1);
  peers::State state;
  for (std::size_t i = 0; i < joints; ++i) {
    state.position.push_back(angle(random));
    state.velocity.push_back(number(random));
    state.acceleration.push_back(number(random));
  }
  return state;
}

}  // namespace sinew::test
