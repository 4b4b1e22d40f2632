#include "sinew/synthesis/task_query.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/algorithm/names.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/vocab/vocab.h"

namespace sinew::synthesis {
namespace {

void ask(Query& query, std::string quantity, std::string of) {
  const bool known = std::any_of(query.asked.begin(), query.asked.end(), [&](const Asked& one) {
    return one.quantity == quantity && one.of == of;
  });
  if (!known) query.asked.push_back({std::move(quantity), std::move(of), ""});
}

// A frame whose origin is the point; null where there is none.
graph::Id frame_at(const graph::View& view, graph::Id point) {
  graph::Id found;
  const graph::Id origin = view.terms().find_iri(vocab::geom::origin);
  if (origin)
    view.match({}, origin, point, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      found = quad.subject;
      return false;
    });
  return found;
}

// The task's acceleration constraints, the most important first.
void add_constraints(Query& query, const graph::Terms& terms, const task::Solver& solver) {
  for (const task::AccelerationConstraint& constraint : solver.constraints) {
    Given given{"acceleration-constraint", std::string(terms.text(constraint.attached_to))};
    given.iri = terms.text(constraint.id);
    for (const task::AxisConstraint& axis : constraint.axes)
      given.directions.emplace_back(direction_word(axis));
    query.given.push_back(std::move(given));
  }
  if (!solver.singular) return;
  using Policy = task::Singular::Policy;
  const Policy policy = solver.singular->policy;
  query.drivers.singular = policy == Policy::kInOrder  ? Singular::kInOrder
                           : policy == Policy::kDamped ? Singular::kDamped
                                                       : Singular::kTruncated;
  query.drivers.singular_number = solver.singular->number;
}

}  // namespace

std::string_view direction_word(const task::AxisConstraint& axis) {
  constexpr std::string_view kWords[] = {"angular-x", "angular-y", "angular-z",
                                         "linear-x",  "linear-y",  "linear-z"};
  return kWords[(axis.subspace == task::Subspace::kAngular ? 0 : 3) + axis.axis];
}

Query query_of_task(const graph::View& view, const graph::Places& places,
                    std::shared_ptr<const task::Task> task, Report& report) {
  const graph::Terms& terms = view.terms();
  const task::Solver& solver = *task->solver;
  const auto text = [&](graph::Id id) { return std::string(terms.text(id)); };
  const auto error = [&](graph::Id node, std::string what, std::string remedy) {
    report.error(places.find(node), text(node), std::move(what), std::move(remedy));
  };
  const std::string every(kEveryJoint);
  Query query;
  query.name = algorithm::short_name(terms.text(solver.id));
  query.gravity = solver.gravity;
  query.given = {{"joint-position", every}};
  switch (solver.algorithm) {
    case task::Algorithm::kRecursiveNewtonEuler:
      ask(query, "joint-force", every);
      query.given.push_back({"joint-velocity", every});
      query.given.push_back({"gravity", ""});
      break;
    case task::Algorithm::kArticulatedBody:
      ask(query, "joint-acceleration", every);
      query.given.push_back({"joint-velocity", every});
      query.given.push_back({"gravity", ""});
      break;
    case task::Algorithm::kForceDistribution:
      ask(query, "control-force", every);
      query.given.push_back({"joint-velocity", every});
      break;
    case task::Algorithm::kHybrid:
      ask(query, "control-force", every);
      query.given.push_back({"joint-velocity", every});
      query.given.push_back({"gravity", ""});
      add_constraints(query, terms, solver);
      break;
  }
  if (solver.algorithm != task::Algorithm::kRecursiveNewtonEuler)
    for (const task::Driver& driver : solver.joint_accelerations)
      error(driver.id, "a driven acceleration needs inverse dynamics",
            "RecursiveNewtonEulerAlgorithm");
  const graph::Id type = terms.find_iri(graph::kRdfType);
  const auto is = [&](graph::Id node, std::string_view name) {
    const graph::Id class_name = terms.find_iri(name);
    return class_name && view.contains(node, type, class_name);
  };
  for (const graph::Id output : solver.outputs) {
    if (is(output, vocab::kc_stat::JointForceCoordinate)) {
      // Of hybrid dynamics: what actuators do in all, which is asked already.
      if (solver.algorithm != task::Algorithm::kHybrid) ask(query, "joint-force", every);
    } else if (is(output, vocab::kc_stat::JointAccelerationCoordinate)) {
      ask(query, "joint-acceleration", every);
    } else if (const auto spatial = task->spatials.find(output); spatial != task->spatials.end()) {
      const task::Spatial& one = spatial->second;
      const graph::Id frame =
          one.kind == task::SpatialKind::kPose ? one.of : frame_at(view, one.reference);
      if (one.kind == task::SpatialKind::kWrench || !frame)
        error(output, "the solver cannot hand this out", "joint quantities, poses and twists");
      else
        ask(query,
            one.kind == task::SpatialKind::kPose            ? "pose"
            : one.kind == task::SpatialKind::kVelocityTwist ? "twist"
                                                            : "acceleration-twist",
            text(frame));
    } else {
      error(output, "it is not known what this output is",
            "a JointForceCoordinate or JointAccelerationCoordinate, or coordinates of a pose or "
            "twist that the task views");
    }
  }
  query.task = std::move(task);
  return query;
}

}  // namespace sinew::synthesis
