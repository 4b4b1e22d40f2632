#include "sinew/program/passes/passes.h"

#include <fmt/format.h>

#include <chrono>
#include <span>

#include "sinew/program/passes/choose_signs.h"
#include "sinew/program/passes/factor_sums.h"
#include "sinew/program/passes/flatten_sums.h"
#include "sinew/program/passes/fuse_multiply_add.h"
#include "sinew/program/passes/merge_terms.h"
#include "sinew/program/passes/polynomials.h"
#include "sinew/program/passes/reassociate.h"
#include "sinew/program/passes/schedule.h"
#include "sinew/program/passes/share_denominators.h"
#include "sinew/program/passes/share_sums.h"

namespace sinew::program {
namespace {

struct GraphPass {
  std::string_view name;
  Computation (*run)(Computation);
};
// On a graph seen as polynomials; what one pass has left unchanged the next one need not read.
struct SumPass {
  std::string_view name;
  void (*run)(Polynomials&);
};

// Constants, identities and value numbering need no pass: the graph's constructors see to them
// whenever a pass writes a graph, and give each node the one sign in which others find it.

constexpr GraphPass kFirst[] = {
    {"share denominators", share_denominators},
};
constexpr SumPass kPrepare[] = {
    {"flatten sums", flatten_sums},
};
// Each makes work for the others: again as long as operations vanish.
constexpr SumPass kSimplify[] = {
    {"merge terms", merge_terms},
    {"factor sums", factor_sums},
    {"share sums", share_sums},
};
constexpr int kMaximumRounds = 4;
constexpr SumPass kFinish[] = {
    {"reassociate", reassociate},
    {"fuse multiply-add", fuse_multiply_add},
};
constexpr GraphPass kSigns[] = {
    {"choose signs", choose_signs},
};
constexpr GraphPass kLast[] = {
    {"schedule", schedule},
};

template <typename Run>
void run(std::string_view name, const Computation& computation, const OptimiseOptions& options,
         Run pass) {
  if (!options.trace) return pass();
  using Clock = std::chrono::steady_clock;
  PassReport report;
  report.name = name;
  report.before = count_operations(computation);
  report.negations_before = count_negations(computation);
  const Clock::time_point start = Clock::now();
  pass();
  report.time_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  report.after = count_operations(computation);
  report.negations_after = count_negations(computation);
  report.nodes_after = computation.dag.size();
  options.trace(report);
}

void run(std::span<const GraphPass> passes, Computation& computation,
         const OptimiseOptions& options) {
  for (const GraphPass& pass : passes)
    run(pass.name, computation, options, [&] { computation = pass.run(std::move(computation)); });
}

void run(std::span<const SumPass> passes, Polynomials& system, const OptimiseOptions& options) {
  for (const SumPass& pass : passes)
    run(pass.name, system.graph, options, [&] { pass.run(system); });
}

}  // namespace

Computation optimise(Computation computation, const OptimiseOptions& options) {
  run(kFirst, computation, options);
  Polynomials system(std::move(computation));
  run(kPrepare, system, options);
  std::uint32_t before = system.operations();
  for (int round = 0; round < kMaximumRounds; ++round) {
    run(kSimplify, system, options);
    const std::uint32_t after = system.operations();
    if (after >= before) break;
    before = after;
  }
  run(kFinish, system, options);
  computation = std::move(system.graph);
  if (options.choose_signs) run(kSigns, computation, options);
  run(kLast, computation, options);
  return computation;
}

std::string to_string(const PassReport& r) {
  const std::string negations =
      r.negations_before == r.negations_after
          ? std::string()
          : fmt::format("{} -> {} negations, ", r.negations_before, r.negations_after);
  return fmt::format("{}: {} + {} -> {} + {} operations, {}{} nodes, {:.0f} us", r.name,
                     r.before.add, r.before.multiply, r.after.add, r.after.multiply, negations,
                     r.nodes_after, r.time_us);
}

}  // namespace sinew::program
