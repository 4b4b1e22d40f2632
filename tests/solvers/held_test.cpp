// Quantities that a query holds (--hold) keep their values from one update to the next, and nothing
// else changes: by value, on robots that nobody drew, in the interpreter, in C and in machine code.
//
// The reference is the program of the same query without the policy, evaluated closure by closure.
// What is given and held is frozen between updates. What is computed and held becomes an input of
// that program, with the value that the program itself computed at the last update.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "compare.h"
#include "question.h"
#include "random_urdf.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/graph_interpreter.h"
#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/kernels.h"
#include "sinew/program/scalar_program.h"
#include "temporary_urdf.h"

namespace sinew::test {
namespace {

using peers::Vector;
using program::Program;
using program::Role;
using program::Variable;

constexpr double kTolerance = 1e-12;
constexpr int kCycles = 12, kCyclesPerUpdate = 4;

using Names = std::set<std::string>;

Names held_names(const Program& program, bool given) {
  Names names;
  for (const Variable& variable : program.variables)
    if (variable.held && (variable.role == Role::kInput) == given) names.insert(variable.name);
  return names;
}

// `program` hands out these variables, too.
Program handing_out(Program program, const Names& names) {
  for (Variable& variable : program.variables)
    if (names.contains(variable.name)) variable.output = true;
  return program;
}

// `program` is told these variables: who writes them writes something that nobody reads.
Program told(Program program, const Names& names) {
  const std::size_t variables = program.variables.size();
  for (std::uint32_t v = 0; v < variables; ++v) {
    if (!names.contains(program.variables[v].name)) continue;
    Variable unread = program.variables[v];
    unread.name += ".unread";
    unread.iri += "-unread";
    program.variables[v].role = Role::kInput;
    program.variables[v].output = false;
    const auto place = static_cast<std::uint32_t>(program.variables.size());
    for (program::Closure& closure : program.closures) {
      const program::Kernel& kernel = *program::find_kernel(closure.operation);
      for (std::size_t k = 0; k < closure.arguments.size(); ++k)
        if (closure.arguments[k] == v && kernel.port(k, closure.arguments.size()).output)
          closure.arguments[k] = place;
    }
    program.variables.push_back(std::move(unread));
  }
  return program;
}

// By the names of variables, so that programs with different ones can be compared.
using Values = std::map<std::string, Vector>;

Values split(const Program& program, const std::vector<program::Slot>& slots, const Vector& all) {
  Values values;
  for (const program::Slot& slot : slots) {
    const Variable& variable = program.variables[slot.variable];
    const auto first = all.begin() + slot.offset;
    values[variable.name] = Vector(first, first + variable.size);
  }
  return values;
}

Values evaluated(const Program& program, const Values& given) {
  backend::Interpreter interpreter(program);
  Vector in(interpreter.in_size()), out(interpreter.out_size());
  for (const program::Slot& slot : interpreter.interface().inputs) {
    const Vector& value = given.at(program.variables[slot.variable].name);
    std::copy(value.begin(), value.end(), in.begin() + slot.offset);
  }
  interpreter.evaluate(in.data(), out.data());
  return split(program, interpreter.interface().outputs, out);
}

// The program with its policy in every back end, fed with the same cycles.
class Loop {
 public:
  explicit Loop(const Program& program)
      : program_(program),
        interface_(program::interface_of(program)),
        traced_(program::traced_program(program, program::with_held(program, {}))),
        scalar_(program::scalar_program(program, {}, program::with_held(program, {}))) {
    backend::COptions c;
    c.name = "solver";
    const backend::GeneratedCode code = backend::generate_c(program, c);
    has_update_ = code.has_update;
    c_ = backend::compile_and_load(code, {"cc", {"-O1"}, {}});
    if (backend::jit_available()) {
      jit_update_ = backend::jit_compile(scalar_.update, {backend::JitLevel::kFast, "", false});
      jit_ = backend::jit_compile(scalar_.computation, {backend::JitLevel::kFast, "", false});
    }
  }

  bool has_update() const { return has_update_; }
  const program::Interface& interface() const { return interface_; }

  // The results of one cycle by each of them, in the program's order.
  std::map<std::string, Vector> cycle(const Vector& in, bool update) {
    std::map<std::string, Vector> results;
    results["interpreter, as traced"] = interpreted(traced_, traced_held_, in, update);
    results["interpreter, optimised"] = interpreted(scalar_, scalar_held_, in, update);
    Vector out(interface_.out_size);
    if (!has_update_) {
      c_->function()(in.data(), out.data());
    } else {
      using Update = void (*)(const double*, double*);
      using Evaluate = void (*)(const double*, const double*, double*);
      using Batch = void (*)(const double*, const double*, double*, std::size_t);
      c_held_.resize(scalar_.update.results.size());
      if (update) reinterpret_cast<Update>(c_->find("solver_update"))(in.data(), c_held_.data());
      reinterpret_cast<Evaluate>(c_->find("solver"))(in.data(), c_held_.data(), out.data());
      Vector batch(out.size());
      reinterpret_cast<Batch>(c_->find("solver_batch"))(in.data(), c_held_.data(), batch.data(), 1);
      results["C, batch"] = batch;
    }
    results["C"] = out;
    if (jit_) {
      jit_held_.resize(scalar_.update.results.size());
      if (update && !jit_held_.empty()) (*jit_update_)(in.data(), jit_held_.data());
      Vector all = in;
      all.insert(all.end(), jit_held_.begin(), jit_held_.end());
      (*jit_)(all.data(), out.data());
      results["machine code"] = out;
    }
    return results;
  }

 private:
  static Vector interpreted(const program::ScalarProgram& program, Vector& held, const Vector& in,
                            bool update) {
    held.resize(program.update.results.size());
    if (update && !held.empty())
      backend::GraphInterpreter(program.update).evaluate(in.data(), held.data());
    Vector all = in;
    all.insert(all.end(), held.begin(), held.end());
    Vector out(program.computation.results.size());
    backend::GraphInterpreter(program.computation).evaluate(all.data(), out.data());
    return out;
  }

  const Program& program_;
  program::Interface interface_;
  program::ScalarProgram traced_, scalar_;
  bool has_update_ = false;
  std::optional<backend::LoadedCode> c_;
  std::optional<backend::JitFunction> jit_update_, jit_;
  Vector traced_held_, scalar_held_, c_held_, jit_held_;
};

cli::QueryOptions asking(const std::string& solver, bool floating, const std::string& gravity) {
  cli::QueryOptions query;
  query.solver = solver;
  query.floating = floating;
  query.gravity = gravity;
  return query;
}

// Numbers of one moment, for every input.
Values moment(Question& question, const program::Interface& interface, bool floating,
              unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> number(-3, 3);
  for (const program::Slot& slot : interface.inputs) {
    const Variable& variable = question.program().variables[slot.variable];
    const std::string first = variable.name.substr(0, variable.name.find('.'));
    if (Names{"position", "velocity", "acceleration", "force"}.contains(first)) continue;
    Vector value(variable.size);
    for (double& each : value) each = number(random);
    question.set(variable.name, value);
  }
  const peers::State state = random_state(question.joints().size(), seed, floating);
  const Vector force = random_state(question.joints().size() + 6, seed + 1).velocity;
  return split(question.program(), interface.inputs, question.inputs(state, force));
}

// Cycles in which everything moves, but what is given and held only where it is updated. Returns
// whether something was kept from one update to the next that made a difference.
bool expect_held(const Robot& robot, const cli::QueryOptions& query, unsigned seed) {
  cli::QueryOptions unheld = query;
  unheld.hold.clear();
  Question question(robot, query);
  const Program& program = question.program();
  const Program plain = Question(robot, unheld).program();
  const Names slow = held_names(program, true), kept = held_names(program, false);
  EXPECT_FALSE(slow.empty() && kept.empty());
  const Program source = handing_out(plain, kept), sink = told(plain, kept);
  Loop loop(program);
  const program::Interface& interface = loop.interface();

  Values given, at_update;
  bool differs = false;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const bool update = cycle % kCyclesPerUpdate == 0;
    for (auto& [name, value] :
         moment(question, interface, query.floating, 100 * seed + static_cast<unsigned>(cycle)))
      if (update || !slow.contains(name)) given[name] = value;
    if (update) at_update = evaluated(source, given);
    Values told_too = given;
    for (const std::string& name : kept) told_too[name] = at_update.at(name);
    Values expected = evaluated(sink, told_too);
    for (const std::string& name : kept) expected[name] = at_update.at(name);
    const Values anew = evaluated(plain, given);

    Vector in(interface.in_size);
    for (const program::Slot& slot : interface.inputs)
      std::ranges::copy(given.at(program.variables[slot.variable].name), in.begin() + slot.offset);
    for (const auto& [how, all] : loop.cycle(in, update)) {
      for (const auto& [name, value] : split(program, interface.outputs, all)) {
        EXPECT_LT(difference(value, expected.at(name)), kTolerance)
            << how << ", " << name << ", cycle " << cycle;
        differs |= difference(value, anew.at(name)) > 1e-6;
      }
    }
  }
  EXPECT_TRUE(!kept.empty() || !differs);
  return loop.has_update() && (differs || kept.empty());
}

struct Asked {
  const char* solver;
  bool floating;
};
constexpr Asked kAsked[] = {{"fpk", false},  {"jacobian", false}, {"rnea", false},
                            {"rnea", true},  {"aba", false},      {"aba", true},
                            {"crba", false}, {"crba", true},      {"fak", false}};

RandomRobot small(unsigned seed, bool floating) {
  RandomRobot robot;
  robot.joints = 4;
  robot.floating = floating;
  robot.seed = seed;
  return robot;
}

// Each quantity that a program computes, on the way or as a result, held by itself.
TEST(Held, WhatIsComputedKeepsItsValueFromOneUpdateToTheNext) {
  unsigned seed = 0;
  int kept = 0, all = 0;
  for (const Asked& asked : kAsked) {
    const TemporaryUrdf urdf(random_urdf(small(++seed, asked.floating)));
    cli::QueryOptions query = asking(asked.solver, asked.floating, "0.4,-0.3,-9.81");
    Names quantities;
    const Program plain = Question(urdf.robot(), query).program();
    for (const Variable& variable : plain.variables)
      if (variable.role == Role::kInternal) quantities.insert(variable.quantity);
    for (const std::string& quantity : quantities) {
      SCOPED_TRACE(std::string(asked.solver) + (asked.floating ? ", floating" : "") + ", holds " +
                   quantity);
      query.hold = {quantity};
      ++all;
      kept += expect_held(urdf.robot(), query, seed) ? 1 : 0;
    }
  }
  EXPECT_GT(kept, all / 2) << "of " << all << ": too few show that anything is kept";
}

// Positions, velocities, gravity: no result changes.
TEST(Held, WhatIsGivenChangesNoResult) {
  unsigned seed = 50;
  for (const Asked& asked : kAsked) {
    const TemporaryUrdf urdf(random_urdf(small(++seed, asked.floating)));
    cli::QueryOptions query = asking(asked.solver, asked.floating, "input");
    Names quantities;
    const Program plain = Question(urdf.robot(), query).program();
    for (const Variable& variable : plain.variables)
      if (variable.role == Role::kInput && variable.quantity.starts_with("joint-"))
        quantities.insert(variable.quantity);
    if (plain.variables.end() !=
        std::ranges::find(plain.variables, std::string("gravity"), &Variable::name))
      quantities.insert("gravity");
    for (const std::string& quantity : quantities) {
      SCOPED_TRACE(std::string(asked.solver) + (asked.floating ? ", floating" : "") + ", holds " +
                   quantity);
      query.hold = {quantity};
      expect_held(urdf.robot(), query, seed);
    }
  }
}

// Several at once, of one element each, where what is given is held beside what is computed.
TEST(Held, SeveralAreHeldTogether) {
  for (const unsigned seed : {91U, 92U, 93U}) {
    const TemporaryUrdf urdf(random_urdf(small(seed, false)));
    cli::QueryOptions query = asking("aba,fpk", false, "input");
    const Question question(urdf.robot(), query);
    query.hold = {"gravity", "joint-position of " + question.joints()[1],
                  "joint-velocity of " + question.joints()[2], "articulated-body-inertia"};
    EXPECT_TRUE(expect_held(urdf.robot(), query, seed));
  }
}

}  // namespace
}  // namespace sinew::test
