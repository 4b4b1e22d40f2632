#include "sinew/program/limbs/limb_signs.h"

#include <algorithm>
#include <vector>

#include "sinew/program/passes/choose_signs.h"

namespace sinew::program {
namespace {

using Kind = LimbSource::Kind;

// Nodes of all regions, numbered through.
std::vector<std::uint32_t> first_values(const LimbProgram& program) {
  std::vector<std::uint32_t> first = {0};
  for (const LimbRegion& region : program.regions) {
    first.push_back(first.back() + region.computation.dag.size());
  }
  return first;
}

class Problem {
 public:
  explicit Problem(const LimbProgram& program)
      : program_(program), first_(first_values(program)), choice_(first_.back()) {
    for (std::uint32_t r = 0; r < program.regions.size(); ++r) {
      const LimbRegion& region = program.regions[r];
      add_nodes(region.computation, first_[r], choice_);
      for (std::uint32_t i = 0; i < region.computation.dag.size(); ++i) {
        const Node& node = region.computation.dag.node(i);
        if (node.op == Op::kInput) add_input(first_[r] + i, region.inputs[node.index]);
      }
    }
    for (const LimbSource& source : program.results) {
      if (is_value(source)) choice_.want(value(source));
    }
  }

  SignChoice& choice() { return choice_; }
  std::uint32_t first(std::size_t region) const { return first_[region]; }

 private:
  Ref result_of(const LimbSource& source) const {
    return program_.regions[source.region].computation.results[source.index];
  }
  // A region's number that is no constant.
  bool is_value(const LimbSource& source) const {
    return source.kind == Kind::kRegion &&
           !program_.regions[source.region].computation.dag.is_constant(result_of(source));
  }
  Ref value(const LimbSource& source) const {
    const Ref result = result_of(source);
    return Ref::of(first_[source.region] + result.node(), result.negative() != source.negative);
  }

  void add_input(std::uint32_t input, const std::vector<LimbSource>& sources) {
    read_.clear();
    for (const LimbSource& source : sources) {
      if (is_value(source)) read_.push_back(value(source));
    }
    const bool equal = std::all_of(sources.begin(), sources.end(),
                                   [&](const LimbSource& s) { return s == sources.front(); });
    if (!read_.empty() && (equal || is_whole_vector(program_, sources))) read_.resize(1);
    const bool from_caller = std::any_of(sources.begin(), sources.end(), [](const LimbSource& s) {
      return s.kind == Kind::kCaller;
    });
    choice_.set(input, from_caller ? SignRule::kEachOfFixed : SignRule::kEach, read_);
  }

  const LimbProgram& program_;
  std::vector<std::uint32_t> first_;
  SignChoice choice_;
  std::vector<Ref> read_;
};

}  // namespace

LimbSource negated(LimbSource source) {
  if (source.kind == Kind::kConstant) {
    source.value = -source.value;
  } else {
    source.negative = !source.negative;
  }
  return source;
}

bool is_whole_vector(const LimbProgram& program, const std::vector<LimbSource>& sources) {
  const LimbSource& first = sources.front();
  if (first.kind != Kind::kRegion) return false;
  if (program.regions[first.region].lanes != sources.size()) return false;
  for (std::uint32_t lane = 0; lane < sources.size(); ++lane) {
    LimbSource expected = first;
    expected.lane = lane;
    if (!(sources[lane] == expected)) return false;
  }
  return true;
}

void choose_signs(LimbProgram& program) {
  Problem problem(program);
  problem.choice().run();
  for (std::size_t r = 0; r < program.regions.size(); ++r) {
    LimbRegion& region = program.regions[r];
    const std::uint32_t first = problem.first(r);
    for (std::uint32_t i = 0; i < region.computation.dag.size(); ++i) {
      const Node& node = region.computation.dag.node(i);
      if (node.op != Op::kInput || !problem.choice().is_turned(first + i)) continue;
      for (LimbSource& source : region.inputs[node.index]) source = negated(source);
    }
    region.computation = with_signs(region.computation, first, problem.choice());
  }
}

std::uint32_t count_negations(const LimbProgram& program) {
  return Problem(program).choice().negations();
}

}  // namespace sinew::program
