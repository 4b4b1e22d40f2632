#include "loop.h"

#include <gtest/gtest.h>

#include "evaluator.h"
#include "sinew/model/load.h"

namespace sinew::test {

const char* const kArm = R"(<robot name="arm">
  <link name="base"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="50" velocity="5"/></joint>
  <link name="upper"><inertial><origin xyz="0 0 0.2"/><mass value="2"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.004" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/>
    <origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="50" velocity="5"/></joint>
  <link name="lower"><inertial><origin xyz="0 0 0.15"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tool"/>
    <origin xyz="0 0 0.3"/></joint>
  <link name="tool"/>
</robot>)";

namespace {

const std::string kContexts = R"("@context": [
  "https://comp-rob2b.github.io/metamodels/geometry/structural-entities.json",
  "https://comp-rob2b.github.io/metamodels/geometry/spatial-relations.json",
  "https://comp-rob2b.github.io/metamodels/geometry/coordinates.json",
  "https://comp-rob2b.github.io/metamodels/kinematic-chain/state.json",
  "https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/structural-entities.json",
  "https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/coordinates.json",
  "https://comp-rob2b.github.io/metamodels/task/map.json",
  "https://comp-rob2b.github.io/metamodels/task/constraint.json",
  "https://comp-rob2b.github.io/metamodels/task/constraint-handler.json",
  "https://comp-rob2b.github.io/metamodels/task/motion-specification.json",
  "https://comp-rob2b.github.io/metamodels/task/solver-specification.json",
  "https://comp-rob2b.github.io/metamodels/qudt.json",
  "https://w3id.org/sinew/task.json",
  { "t": "https://example.org/task/", "arm": "https://w3id.org/sinew/robots/arm/" } ])";

constexpr double kNone = 0;

}  // namespace

Loop::Loop(const std::string& nodes, cli::QueryOptions asked) {
  cli::Models models;
  Report report;
  const model::Source sources[] = {
      {"arm.urdf", kArm},
      {"task.jsonld", "{" + kContexts + ", \"@id\": \"t:task\", \"@graph\": [" + nodes + "]}"}};
  model::load(sources, {}, models.store, models.places, report);
  report.throw_if_errors();
  const graph::Id algorithm = cli::algorithm_of(models, cli::ModelOptions{}, asked, &why_);
  program_ = cli::lowered(models, algorithm, "task");
  interface_ = program::interface_of(program_);
  input_names_ = cli::column_names(program_, interface_.inputs);
  output_names_ = cli::column_names(program_, interface_.outputs);

  interpreter_ = std::make_unique<backend::Interpreter>(program_);
  compile(backend::Style::kFlat, "flat");
  compile(backend::Style::kReadable, "readable");
  if (backend::jit_available())
    jit_ = std::make_unique<backend::JitFunction>(
        backend::jit_compile(program::scalar_program(program_).computation));
  jit_in_.assign(interface_.in_size + interface_.state_size, kNone);
  for (const program::Slot& slot : interface_.states) {
    const std::vector<double>& first = program_.variables[slot.variable].value;
    for (std::size_t i = 0; i < first.size(); ++i) {
      jit_in_[interface_.in_size + slot.offset + i] = first[i];
      for (Compiled& one : compiled_) one.state[slot.offset + i] = first[i];
    }
  }
}

void Loop::compile(backend::Style style, const char* name) {
  backend::COptions options;
  options.name = "task";
  options.style = style;
  backend::CompileOptions how;
  how.flags = {"-O1", "-std=c11", "-I" SINEW_SOURCE_DIR "/sinew/math"};
  how.libraries = {SINEW_MATH_LIBRARY};
  compiled_.push_back({name, backend::compile_and_load(backend::generate_c(program_, options), how),
                       std::vector<double>(interface_.state_size + 1, kNone)});
}

Values Loop::cycle(const Values& inputs, double tolerance) {
  std::vector<double> in;
  std::size_t used = 0;
  for (const std::string& name : input_names_) {
    const auto found = inputs.find(name);
    in.push_back(found == inputs.end() ? kNone : found->second);
    used += found != inputs.end();
  }
  EXPECT_EQ(used, inputs.size()) << "an input that the program does not have";
  in.push_back(kNone);  // never empty
  std::vector<double> out(interface_.out_size + 1);
  interpreter_->evaluate(in.data(), out.data());
  const auto expect_same = [&](const double* other, const char* how) {
    for (std::size_t i = 0; i < output_names_.size(); ++i)
      EXPECT_NEAR(other[i], out[i], tolerance * (1 + std::abs(out[i])))
          << how << ": " << output_names_[i];
  };
  for (Compiled& one : compiled_) {
    std::vector<double> c_out(interface_.out_size + 1);
    if (interface_.state_size > 0)
      one.code.stateful_function()(in.data(), c_out.data(), one.state.data());
    else
      one.code.function()(in.data(), c_out.data());
    expect_same(c_out.data(), one.style);
  }
  std::vector<double> jit_out(interface_.out_size + interface_.state_size);
  if (jit_) {
    std::copy_n(in.begin(), interface_.in_size, jit_in_.begin());
    (*jit_)(jit_in_.data(), jit_out.data());
    std::copy(jit_out.begin() + interface_.out_size, jit_out.end(),
              jit_in_.begin() + interface_.in_size);
    expect_same(jit_out.data(), "machine code");
  }
  Values values;
  for (std::size_t i = 0; i < output_names_.size(); ++i) {
    values[output_names_[i]] = out[i];
  }
  return values;
}

}  // namespace sinew::test
