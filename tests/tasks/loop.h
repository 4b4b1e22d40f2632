// A task on a small arm, run cycle by cycle in every way that Sinew has: interpreted, as generated
// C in both styles, as machine code. All must agree; what comes out is by name.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline.h"
#include "sinew/backend/compile.h"
#include "sinew/backend/interpreter.h"
#include "sinew/backend/jit.h"
#include "sinew/program/scalar_program.h"

namespace sinew::test {

using Values = std::map<std::string, double>;  // "setpoint.error", "twist.tool[5]"

// An arm that moves in its x-z plane: joints `shoulder` and `elbow` about y, 0.3 m above the base
// and 0.4 m apart; the frame `tool` another 0.3 m on. At position zero it stretches upward.
extern const char* const kArm;

class Loop {
 public:
  // `nodes`: of the task's @graph, with the prefixes t: for the task and arm: for the robot.
  // `asked`: the options of a query; empty: the task's solver is asked. Throws Error.
  explicit Loop(const std::string& nodes, cli::QueryOptions asked = {});

  // One cycle; inputs that are not named are zero. Checks that all ways agree to `tolerance`.
  Values cycle(const Values& inputs, double tolerance = 1e-11);

  const program::Program& program() const { return program_; }
  const std::vector<std::string>& why() const { return why_; }
  std::vector<std::string> inputs() const { return input_names_; }

 private:
  struct Compiled {
    const char* style;
    backend::LoadedCode code;
    std::vector<double> state;
  };
  void compile(backend::Style style, const char* name);

  program::Program program_;
  program::Interface interface_;
  std::vector<std::string> why_, input_names_, output_names_;
  std::unique_ptr<backend::Interpreter> interpreter_;
  std::unique_ptr<backend::JitFunction> jit_;
  std::vector<Compiled> compiled_;
  std::vector<double> jit_in_;
};

}  // namespace sinew::test
