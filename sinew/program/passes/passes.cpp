#include "sinew/program/passes/passes.h"

#include <fmt/format.h>

#include <chrono>
#include <span>

#include "sinew/program/passes/factor_sums.h"
#include "sinew/program/passes/flatten_sums.h"
#include "sinew/program/passes/fuse_multiply_add.h"
#include "sinew/program/passes/merge_terms.h"
#include "sinew/program/passes/reassociate.h"
#include "sinew/program/passes/schedule.h"
#include "sinew/program/passes/share_denominators.h"
#include "sinew/program/passes/share_sums.h"

namespace sinew::program {
namespace {

struct Pass {
  std::string_view name;
  Computation (*run)(Computation);
};

// Constants, identities, value numbering and signs need no pass: the graph's constructors see to
// them whenever a pass writes a graph.

constexpr Pass kFirst[] = {
    {"share denominators", share_denominators},
    {"flatten sums", flatten_sums},
};

// Each makes work for the others: again as long as operations vanish.
constexpr Pass kSimplify[] = {
    {"merge terms", merge_terms},
    {"factor sums", factor_sums},
    {"share sums", share_sums},
};
constexpr int kMaximumRounds = 4;

constexpr Pass kLast[] = {
    {"reassociate", reassociate},
    {"fuse multiply-add", fuse_multiply_add},
    {"schedule", schedule},
};

void run(std::span<const Pass> passes, Computation& computation, const OptimiseOptions& options) {
  using Clock = std::chrono::steady_clock;
  for (const Pass& pass : passes) {
    PassReport report;
    report.name = pass.name;
    if (options.trace) report.before = count_operations(computation);
    const Clock::time_point start = Clock::now();
    computation = pass.run(std::move(computation));
    if (!options.trace) continue;
    report.time_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    report.after = count_operations(computation);
    report.nodes_after = computation.dag.size();
    options.trace(report);
  }
}

}  // namespace

Computation optimise(Computation computation, const OptimiseOptions& options) {
  run(kFirst, computation, options);
  OperationCount before = count_operations(computation);
  for (int round = 0; round < kMaximumRounds; ++round) {
    run(kSimplify, computation, options);
    const OperationCount after = count_operations(computation);
    if (after.add + after.multiply >= before.add + before.multiply) break;
    before = after;
  }
  run(kLast, computation, options);
  return computation;
}

std::string to_string(const PassReport& r) {
  return fmt::format("{}: {} + {} -> {} + {} operations, {} nodes, {:.0f} us", r.name, r.before.add,
                     r.before.multiply, r.after.add, r.after.multiply, r.nodes_after, r.time_us);
}

}  // namespace sinew::program
