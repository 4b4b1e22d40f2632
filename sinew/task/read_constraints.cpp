// Acceleration constraints of a solver, in the order of their priorities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/graph/standard_iris.h"
#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

namespace slv = vocab::slv;
namespace st = vocab::st;

std::optional<AxisConstraint> read_axis(Reader& reader, Id node) {
  AxisConstraint constraint;
  constraint.id = node;
  if (!reader.is_a(node, slv::AccelerationConstraint) || !reader.is_a(node, slv::AxisAligned)) {
    reader.error(node, "", "it is not said which acceleration this constrains",
                 "give it the types AccelerationConstraint and AxisAligned");
    return std::nullopt;
  }
  const Id subspace = reader.required(node, slv::subspace, "the subspace");
  const Id axis = reader.required(node, slv::axis, "the axis (x, y or z)");
  constraint.energy = reader.number(node, slv::acceleration_energy, "the acceleration energy");
  if (!subspace || !axis || !constraint.energy) return std::nullopt;
  if (subspace == reader.iri(slv::angular_acceleration)) {
    constraint.subspace = Subspace::kAngular;
  } else if (subspace != reader.iri(slv::linear_acceleration)) {
    reader.error(node, slv::subspace,
                 fmt::format("<{}> is no subspace", reader.graph.text(subspace)),
                 "angular-acceleration or linear-acceleration");
    return std::nullopt;
  }
  const std::string_view axes[] = {slv::x, slv::y, slv::z};
  for (constraint.axis = 0; constraint.axis < 3; ++constraint.axis)
    if (axis == reader.iri(axes[constraint.axis])) return constraint;
  reader.error(node, slv::axis, fmt::format("<{}> is no axis", reader.graph.text(axis)),
               "x, y or z");
  return std::nullopt;
}

AccelerationConstraint read_constraint(Reader& reader, Id node) {
  AccelerationConstraint constraint;
  constraint.id = node;
  constraint.attached_to =
      reader.required(node, slv::attached_to, "the link that it is attached to");
  for (const Id axis : reader.objects(node, slv::constraints))
    if (const auto one = read_axis(reader, axis)) constraint.axes.push_back(*one);
  std::sort(constraint.axes.begin(), constraint.axes.end(), [](const auto& a, const auto& b) {
    const auto place = [](const AxisConstraint& one) {
      return (one.subspace == Subspace::kAngular ? 0 : 3) + one.axis;
    };
    return place(a) < place(b);
  });
  for (std::size_t i = 1; i < constraint.axes.size(); ++i) {
    const AxisConstraint &a = constraint.axes[i - 1], &b = constraint.axes[i];
    if (a.subspace == b.subspace && a.axis == b.axis)
      reader.error(b.id, "", fmt::format("<{}> constrains the same axis", reader.graph.text(a.id)),
                   "constrain it once");
  }
  if (constraint.axes.empty() && reader.objects(node, slv::constraints).empty())
    reader.error(node, slv::constraints, "it constrains no axis", "name what it constrains");
  return constraint;
}

// By the levels of the hierarchy that name them; what no level names comes last.
void sort_by_priority(Reader& reader, Id drivers,
                      std::vector<AccelerationConstraint>& constraints) {
  std::vector<Id> order;
  const Id first = reader.iri(graph::kRdfFirst);
  const Id rest = reader.iri(graph::kRdfRest);
  constexpr std::size_t kMaximumLevels = 100;
  std::size_t levels = 0;
  for (Id at = reader.optional(drivers, slv::prioritization_hierarchy); at;
       at = reader.graph.view.object(at, rest)) {
    const Id level = reader.graph.view.object(at, first);
    if (!level) break;  // the end of the list
    if (++levels > kMaximumLevels) {
      reader.error(drivers, slv::prioritization_hierarchy,
                   fmt::format("more than {} levels", kMaximumLevels), "fewer");
      return;
    }
    for (const Id driver : reader.objects(level, slv::motion_drivers)) {
      if (std::none_of(constraints.begin(), constraints.end(),
                       [&](const auto& one) { return one.id == driver; }))
        reader.error(level, slv::motion_drivers,
                     fmt::format("<{}> is no acceleration constraint of the solver",
                                 reader.graph.text(driver)),
                     "levels rank acceleration constraints");
      order.push_back(driver);
    }
  }
  const auto rank = [&](const AccelerationConstraint& one) {
    return std::find(order.begin(), order.end(), one.id) - order.begin();
  };
  std::sort(constraints.begin(), constraints.end(), [&](const auto& a, const auto& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return reader.graph.text(a.id) < reader.graph.text(b.id);
  });
}

}  // namespace

void read_acceleration_constraints(Reader& reader, Id drivers, Solver& solver) {
  for (const Id node : reader.objects(drivers, slv::acceleration_constraint))
    solver.constraints.push_back(read_constraint(reader, node));
  sort_by_priority(reader, drivers, solver.constraints);
}

std::optional<Singular> read_singular(Reader& reader, Id solver) {
  const Id named = reader.optional(solver, st::singular);
  if (!named) return std::nullopt;
  constexpr std::pair<std::string_view, Singular::Policy> kPolicies[] = {
      {st::in_order, Singular::Policy::kInOrder},
      {st::damped, Singular::Policy::kDamped},
      {st::truncated, Singular::Policy::kTruncated}};
  Singular singular;
  const auto* known = std::find_if(std::begin(kPolicies), std::end(kPolicies),
                                   [&](const auto& one) { return named == reader.iri(one.first); });
  if (known == std::end(kPolicies)) {
    reader.error(solver, st::singular, fmt::format("<{}> is no policy", reader.graph.text(named)),
                 "in-order, damped or truncated");
    return std::nullopt;
  }
  singular.policy = known->second;
  const Id number = reader.required(solver, st::singular_number, "the tolerance, or the damping");
  if (!number) return std::nullopt;
  singular.number = reader.graph.view.terms().number(number).value_or(std::nan(""));
  if (!std::isfinite(singular.number))
    reader.error(solver, st::singular_number, "this is no number", "for example 1e-9");
  return singular;
}

void check_constraints(Reader& reader, const Solver& solver) {
  const bool hybrid = solver.algorithm == Algorithm::kHybrid;
  if (!hybrid && !solver.constraints.empty())
    reader.error(solver.constraints.front().id, "", "its solver imposes no acceleration",
                 "AccelerationConstrainedHybridDynamicsAlgorithm");
  if (hybrid && solver.constraints.empty())
    reader.error(solver.id, "", "hybrid dynamics without an acceleration constraint",
                 "name one by acceleration-constraint, or choose ArticulatedBodyAlgorithm");
  if (hybrid && !solver.constraints.empty() && !solver.singular)
    reader.error(solver.id, st::singular,
                 "it is not said what happens where the constraints depend on each other",
                 "state \"singular\": in-order, damped or truncated, and its \"singular-number\"");
}

}  // namespace sinew::task
