#include "sinew/world/query_program.h"

#include <algorithm>

#include "sinew/algorithm/builder.h"
#include "sinew/math/layout.h"
#include "sinew/program/interface.h"
#include "sinew/program/lower.h"
#include "sinew/world/impl.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

using algorithm::Role;
using graph::Id;

struct ProgramWriter {
  const WorldImpl& world;
  const State& state;
  graph::Store& store;
  algorithm::Builder& builder;
  algorithm::Cause cause;

  Id iri(std::string_view text) { return store.terms().iri(text); }
  Id frame(Index index) { return iri(world.family->names.text(state.frames[index].name)); }

  std::uint32_t pose(std::string_view slot, Id represents, Id of, Id wrt, Role role,
                     std::span<const double> value = {}) {
    return builder.block({.slot = slot,
                          .represents = represents,
                          .quantity = "pose",
                          .of = of,
                          .wrt = wrt,
                          .role = role,
                          .value = value});
  }
  std::uint32_t constant(Id represents, Id of, Id wrt, const Pose& X) {
    double numbers[12];
    math::Layout<math::Pose<double>>::store(to_matrix(X), numbers);
    return pose("placement", represents, of, wrt, Role::kConstant, numbers);
  }

  // X_AB of a relation, whichever way it is walked.
  std::uint32_t relation(const SymbolicStep& step) {
    const RelationRecord& relation = state.relations[step.relation_id.index];
    const Id node = iri(step.relation);
    const Id of = frame(relation.of), wrt = frame(relation.with_respect_to);
    if (step.constant) return constant(node, of, wrt, step.value);
    const Id measurement = iri(step.measurement);
    if (relation.kind == RelationKind::kFree) {
      return pose("measured", measurement, of, wrt, Role::kInput);
    }
    const bool prismatic = relation.kind == RelationKind::kPrismatic;
    const Id joint_frame = iri(step.relation + "/joint-frame");
    const std::uint32_t position = builder.block({.slot = "position",
                                                  .represents = measurement,
                                                  .quantity = "joint-position",
                                                  .of = of,
                                                  .wrt = joint_frame,
                                                  .seen_by = of,
                                                  .role = Role::kInput,
                                                  .prismatic = prismatic,
                                                  .label = algorithm::short_name(step.relation)});
    const std::uint32_t across = pose("across-joint", node, of, joint_frame, Role::kInternal);
    builder.closure(prismatic ? "position-to-pose-prismatic" : "position-to-pose-revolute",
                    {position, across}, cause);
    const std::uint32_t whole = pose("relation", node, of, wrt, Role::kInternal);
    builder.closure("compose-pose",
                    {constant(joint_frame, joint_frame, wrt, relation.placement), across, whole},
                    cause);
    return whole;
  }

  std::uint32_t write(const std::vector<SymbolicStep>& steps, Id base) {
    std::uint32_t so_far = algorithm::kNoIndex;
    for (const SymbolicStep& step : steps) {
      const RelationRecord& record = state.relations[step.relation_id.index];
      std::uint32_t next = relation(step);
      const Id from = frame(step.inverse ? record.of : record.with_respect_to);
      const Id to = frame(step.inverse ? record.with_respect_to : record.of);
      if (step.inverse) {
        const std::uint32_t reversed =
            pose("inverse", iri(step.relation), to, from, Role::kInternal);
        builder.closure("invert-pose", {next, reversed}, cause);
        next = reversed;
      }
      if (so_far == algorithm::kNoIndex) {
        so_far = next;
        continue;
      }
      const std::uint32_t composite = pose("way", to, to, base, Role::kInternal);
      builder.closure("compose-pose", {so_far, next, composite}, cause);
      so_far = composite;
    }
    return so_far;
  }
};

}  // namespace

PoseProgram make_pose_program(const World& world, const PoseQuery& query, graph::Store& store,
                              std::string_view name) {
  const WorldImpl& impl = world.impl();
  const State state = impl.published();
  const auto plan = impl.plan(query, false);
  const auto frame_name = [&](FrameId id) {
    const FrameRecord* const record = state.frames.find(id.index);
    return record ? impl.family->names.text(record->name) : std::string("an unknown frame");
  };
  if (plan->status != Status::kOk || query.of == query.with_respect_to) {
    refuse(frame_name(query.of),
           "no program for its pose with respect to " + frame_name(query.with_respect_to) + ": " +
               (plan->status == Status::kOk ? "they are the same frame"
                                            : std::string(to_string(plan->status))),
           "two frames that relations link");
  }
  PoseProgram result;
  result.structure_version = plan->structure_version;
  graph::Terms& terms = store.terms();
  const Id of = terms.iri(frame_name(query.of)), to = terms.iri(frame_name(query.with_respect_to));
  result.algorithm =
      terms.derived(terms.iri(std::string(kWorldNamespace) + "PoseProgram"), {of, to});
  {
    graph::Transaction transaction = store.begin();
    transaction.drop_graph(result.algorithm);
    algorithm::Builder builder(store, transaction, result.algorithm);
    ProgramWriter writer{
        impl, state, store, builder, {terms.iri(std::string(kWorldNamespace) + "pose-query"), of}};
    const std::uint32_t way = writer.write(plan->symbolic, to);
    // What is handed out is computed: a way of one relation is composed with nothing.
    const std::uint32_t identity = writer.constant(to, to, to, Pose{});
    const std::uint32_t answer =
        builder.block({.slot = "pose", .represents = of, .quantity = "pose", .of = of, .wrt = to});
    builder.closure("compose-pose", {identity, way, answer}, writer.cause);
    builder.output(answer);
    builder.finish();
    transaction.commit();
  }
  result.program = program::lower(store.view(), result.algorithm, name);
  const program::Interface interface = program::interface_of(result.program);
  result.in_size = interface.in_size;
  for (const program::Slot& slot : interface.inputs) {
    const program::Variable& variable = result.program.variables[slot.variable];
    const MeasurementId measurement = world.find_measurement(variable.represents);
    result.inputs.push_back(
        {measurement, state.measurements[measurement.index].quantity, slot.offset});
  }
  return result;
}

Status PoseProgram::gather(const World& world, Stamp now, std::span<double> in) const {
  if (in.size() != in_size) return Status::kNotANumber;
  for (const Input& input : inputs) {
    const World::Sample sample = world.latest(input.measurement, now);
    if (sample.status != Status::kOk) return sample.status;
    if (input.quantity == Quantity::kPose) {
      math::Layout<math::Pose<double>>::store(to_matrix(load_pose(sample.values.data())),
                                              in.data() + input.offset);
    } else {
      in[input.offset] = sample.values[0];
    }
  }
  return Status::kOk;
}

}  // namespace sinew::world
