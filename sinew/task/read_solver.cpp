#include <fmt/format.h>

#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

namespace slv = vocab::slv;

std::vector<Driver> drivers(Reader& reader, Id of, std::string_view property,
                            std::string_view quantity, std::string_view what) {
  std::vector<Driver> found;
  for (const Id node : reader.objects(of, property)) {
    Driver driver;
    driver.id = node;
    driver.quantity = reader.required(node, quantity, what);
    driver.attached_to = reader.required(node, slv::attached_to, "what it is attached to");
    if (driver.quantity && driver.attached_to) found.push_back(driver);
  }
  return found;
}

// The coordinates of drivers of joints must say so.
void check_joints(Reader& reader, const std::vector<Driver>& drivers, JointKind kind,
                  std::string_view type) {
  for (const Driver& driver : drivers)
    if (read_joint_kind(reader, driver.quantity) != kind)
      reader.error(driver.quantity, "", fmt::format("this is no {}", type),
                   fmt::format("give it the type {}", type));
}

void read_drivers(Reader& reader, Id node, Solver& solver) {
  const Id drivers_node = reader.required(node, slv::motion_drivers, "the motion drivers");
  if (!drivers_node) return;
  read_acceleration_constraints(reader, drivers_node, solver);
  solver.cartesian_forces =
      drivers(reader, drivers_node, slv::cartesian_force, slv::force, "the wrench");
  solver.joint_forces =
      drivers(reader, drivers_node, slv::joint_force, slv::force, "the joint's force");
  solver.joint_accelerations = drivers(reader, drivers_node, slv::joint_acceleration,
                                       slv::acceleration, "the joint's acceleration");
  for (const Driver& driver : solver.cartesian_forces) {
    if (!read_spatial(reader, driver.quantity)) continue;
    if (reader.task.spatials.at(driver.quantity).kind != SpatialKind::kWrench)
      reader.error(driver.quantity, "", "this is no wrench", "name a WrenchCoordinate");
  }
  check_joints(reader, solver.joint_forces, JointKind::kForce, "JointForceCoordinate");
  check_joints(reader, solver.joint_accelerations, JointKind::kAcceleration,
               "JointAccelerationCoordinate");
}

std::optional<Algorithm> algorithm_of(Reader& reader, Id node) {
  constexpr std::pair<std::string_view, Algorithm> kAlgorithms[] = {
      {slv::RecursiveNewtonEulerAlgorithm, Algorithm::kRecursiveNewtonEuler},
      {slv::ArticulatedBodyAlgorithm, Algorithm::kArticulatedBody},
      {slv::AccelerationConstrainedHybridDynamicsAlgorithm, Algorithm::kHybrid}};
  const Id named = reader.required(node, slv::solver, "the algorithm");
  if (!named) return std::nullopt;
  for (const auto& [iri, algorithm] : kAlgorithms)
    if (named == reader.iri(iri)) return algorithm;
  reader.error(node, slv::solver, fmt::format("<{}> is no algorithm", reader.graph.text(named)),
               "RecursiveNewtonEulerAlgorithm, ArticulatedBodyAlgorithm or "
               "AccelerationConstrainedHybridDynamicsAlgorithm");
  return std::nullopt;
}

// Of an acceleration of the root, or of a field's vector.
void read_gravity(Reader& reader, Id node, Solver& solver) {
  const Id gravity = reader.optional(node, slv::gravity);
  if (!gravity) return;
  const auto& ids = reader.graph.ids;
  if (!reader.is_a(gravity, vocab::geom_coord::AccelerationTwistCoordinate)) {
    reader.error(gravity, "", "a gravity that is no acceleration of the root",
                 "name an AccelerationTwistCoordinate, minus the gravity vector");
    return;
  }
  const auto linear = reader.graph.list_of_three(gravity, ids.linear_acceleration);
  const auto scale =
      reader.graph.scale(gravity, model::dimension::kAcceleration, "the acceleration");
  if (linear && scale)
    solver.gravity = {-linear->x * *scale, -linear->y * *scale, -linear->z * *scale};
}

}  // namespace

void read_solver(Reader& reader) {
  const std::vector<Id> full = reader.graph.all(reader.iri(slv::SolverWithInputAndOutput));
  const std::vector<Id> transposed = reader.graph.all(reader.iri(slv::ForceDistributionSolver));
  for (const Id node : reader.graph.all(reader.iri(slv::VelocityCompositionSolver)))
    reader.error(node, "", "a solver of velocities drives nothing",
                 "ask for the twist by a query; a task's solver distributes forces");
  if (full.size() + transposed.size() > 1) {
    const Id second = full.size() > 1 ? full[1] : transposed[full.empty() ? 1 : 0];
    reader.error(second, "", "a second solver", "state one for one algorithm");
    return;
  }
  Solver solver;
  if (!full.empty()) {
    solver.id = full.front();
    const auto algorithm = algorithm_of(reader, solver.id);
    if (!algorithm) return;
    solver.algorithm = *algorithm;
    read_drivers(reader, solver.id, solver);
    solver.singular = read_singular(reader, solver.id);
    check_constraints(reader, solver);
    solver.outputs = reader.objects(solver.id, slv::output);
    solver.root = reader.required(solver.id, slv::root, "the root frame");
    read_gravity(reader, solver.id, solver);
  } else if (!transposed.empty()) {
    solver.id = transposed.front();
    solver.algorithm = Algorithm::kForceDistribution;
    const Id force = reader.required(solver.id, slv::force, "the wrench to distribute");
    if (!force || !read_spatial(reader, force)) return;
    solver.cartesian_forces.push_back({solver.id, force, reader.task.spatials.at(force).of});
  } else {
    return;
  }
  reader.task.solver = std::move(solver);
}

}  // namespace sinew::task
