#include "sinew/synthesis/synthesise.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sinew/algorithm/attach.h"
#include "sinew/algorithm/read.h"
#include "sinew/base/error.h"
#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/context.h"
#include "sinew/synthesis/control.h"
#include "sinew/synthesis/driver_list.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/external_wrenches.h"
#include "sinew/synthesis/floating_base.h"
#include "sinew/synthesis/held.h"
#include "sinew/synthesis/hybrid_steps.h"
#include "sinew/synthesis/plan.h"
#include "sinew/synthesis/query_faults.h"
#include "sinew/synthesis/read_query.h"
#include "sinew/synthesis/regroup.h"
#include "sinew/synthesis/resolve_query.h"
#include "sinew/synthesis/results.h"
#include "sinew/synthesis/step_models.h"
#include "sinew/synthesis/steps_together.h"
#include "sinew/synthesis/weightless.h"

namespace sinew::synthesis {
namespace {

using algorithm::kAlgorithmNamespace;

std::string text(const graph::View& view, Id id) { return std::string(view.terms().text(id)); }

void check_base(graph::Store& store, const graph::View& view, const Robot& robot,
                const Query& query) {
  if (query.base.empty()) return;
  const Id frame = find_frame(store, view, query.base);
  if (body_frame(view, frame) == robot.root_frame) return;
  throw Error(fault_in(query, query.base_origin, query.base,
                       "it is not the base of the tree, which is " + text(view, robot.root_body),
                       "normalise the model from this base"));
}

// The gravity vector seen from the root: the query's, else the model's.
std::array<double, 3> gravity(const graph::View& view, const Robot& robot, const Query& query,
                              std::vector<std::string>& notes) {
  if (query.gravity) return *query.gravity;
  if (robot.base_acceleration) {
    const std::vector<double> a = coordinate_numbers(view, robot.base_acceleration);
    return {-a.at(3), -a.at(4), -a.at(5)};
  }
  notes.emplace_back("no gravity in the model and none in the query: it is zero");
  return {0, 0, 0};
}

// Steps that the query's drivers call for, those for what is asked together, those that come with
// Sinew, and those of the graph: where two give the same, the first one is taken.
std::vector<Step> available_steps(const MotionDrivers& drivers, std::span<const Step> together,
                                  const StepModels& models, bool coupled) {
  std::vector<Step> list = hybrid_steps(drivers, coupled);
  list.insert(list.end(), together.begin(), together.end());
  const std::span<const Step> ours = steps_for(coupled);
  list.insert(list.end(), ours.begin(), ours.end());
  list.insert(list.end(), models.steps.begin(), models.steps.end());
  return list;
}

// The planner's sweeps, or those that somebody wrote.
Plan plan_of(const Query& query, const Robot& robot, const Resolved& resolved,
             std::span<const Step> available, std::span<const Step> uncoupled,
             std::span<const std::string> given, Report& report) {
  if (query.sweeps.empty()) {
    Report found;
    Plan plan = make_plan(available, resolved.wishes, given, found);
    Report otherwise;
    if (found.has_errors() && robot.coupled())
      make_plan(uncoupled, resolved.wishes, given, otherwise);
    if (found.has_errors() && robot.coupled() && !otherwise.has_errors())
      report.error({}, query.name,
                   "what is asked takes joints one by one, but in this robot some follow others",
                   "choose a base and tips between which no joint follows another");
    else
      for (const Problem& problem : found.problems()) report.add(problem);
    return plan;
  }
  const SweepConfiguration configuration = named_sweeps(query.sweeps);
  Plan plan;
  for (const SweepNames& names : configuration.sweeps) {
    Sweep sweep{
        names.direction == to_string(Direction::kInward) ? Direction::kInward : Direction::kOutward,
        {}};
    for (const std::string& name : names.steps) {
      const auto step = std::find_if(available.begin(), available.end(),
                                     [&](const Step& one) { return one.name == name; });
      if (step != available.end())
        sweep.steps.push_back(&*step);
      else
        report.error({}, configuration.iri, fmt::format("there is no step {}", name),
                     "name one of sinew/synthesis/steps.cpp");
      plan.why.push_back(fmt::format("{}: as {} says", name, configuration.iri));
    }
    plan.sweeps.push_back(std::move(sweep));
  }
  check_sweeps(plan.sweeps, given, configuration.iri, report);
  for (const Sweep& sweep : plan.sweeps)
    for (const Step* step : sweep.steps)
      if (step->takes_joints_one_by_one && robot.coupled())
        report.error({}, configuration.iri,
                     fmt::format("step {} takes joints one by one, but in this robot some follow "
                                 "others",
                                 step->name),
                     "leave the sweeps to the planner");
  return plan;
}

bool uses(const Plan& plan, std::string_view name) {
  return std::any_of(plan.sweeps.begin(), plan.sweeps.end(), [&](const Sweep& sweep) {
    return std::any_of(sweep.steps.begin(), sweep.steps.end(),
                       [&](const Step* step) { return step->name == name; });
  });
}

void hand_out(Context& context, const Resolved& resolved) {
  for (const Wanted& wanted : resolved.wanted) {
    if (!wanted.output) continue;
    hand_out(
        context, wanted.quantity->slot, wanted.element,
        wanted.quantity->element == Element::kRobot ? wanted.quantity->name : std::string_view());
  }
  for (const BlockIndex block : context.task_outputs) context.builder.output(block);
}

// What a task adds to the question: which forces it acts on, the frames that it measures.
Control control_of(const graph::View& view, const Robot& robot, const Query& query,
                   std::span<const std::string> given, Resolved& resolved, Report& report) {
  Control control = place_task(view, robot, query.task, report);
  AskedForces asked;
  for (const Wanted& wanted : resolved.wanted) {
    asked.full |= wanted.quantity->name == "joint-force";
    asked.bias |= wanted.quantity->name == "bias-force";
    asked.rest |= wanted.quantity->name == "gravity-force";
    asked.control |= wanted.quantity->name == "control-force";
  }
  decide(control, asked, given, report, view);
  for (const auto& [quantity, frame] : control.frames) {
    const AskedQuantity* row = find_asked(quantity);
    const bool known =
        std::any_of(resolved.wanted.begin(), resolved.wanted.end(),
                    [&](const Wanted& one) { return one.quantity == row && one.element == frame; });
    if (!known) resolved.wanted.push_back({row, frame, {frame}, false});
  }
  for (Wish& wish : wishes_of(control, asked)) resolved.wishes.push_back(std::move(wish));
  return control;
}

// The robot interface that the task names reads before the first sweep and writes after the last.
void attach(graph::Store& store, const Control& control, Synthesis& result) {
  const task::RobotInterface& robot = *control.task->robot_interface;
  algorithm::attach_robot(store, result.algorithm,
                          {text(store.view(), robot.interface), {robot.safe}});
  const std::string name = text(store.view(), robot.id);
  result.why.insert(result.why.begin(),
                    fmt::format("before the first sweep: read, as <{}> says", name));
  result.why.push_back(fmt::format("after the last sweep: write, as <{}> says", name));
}

// What tells a task from others.
void add_elements(const task::Task& task, std::vector<Id>& facts) {
  if (task.solver) facts.push_back(task.solver->id);
  if (task.robot_interface) facts.push_back(task.robot_interface->id);
  for (const task::Monitor& monitor : task.monitors) facts.push_back(monitor.id);
  for (const task::Controller& controller : task.controllers) facts.push_back(controller.id);
}

// What no element of the model is to blame for is the query's own fault.
void throw_with_query(const Query& query, const Report& report) {
  Report named;
  for (Problem problem : report.problems()) {
    if (problem.iri.empty() || (problem.iri == query.name && !query.iri.empty()))
      problem.iri = query.iri;
    if (problem.place.file.empty()) problem.place = query.place;
    named.add(std::move(problem));
  }
  named.throw_if_errors();
}

// The same robot from the world; its base's name stands for the six degrees of freedom of the base.
Robot read_floating_robot(graph::Store& store, const graph::View& view, const Robot& fixed) {
  Robot robot = read_robot(store, view);
  robot.base_acceleration = fixed.base_acceleration;
  robot.joints.front().label = algorithm::short_name(view.terms().text(fixed.root_body));
  return robot;
}

}  // namespace

Synthesis synthesise(graph::Store& store, const Query& query, const graph::Places* places,
                     AlgorithmGraph graph) {
  graph::Transaction transaction = store.begin();
  const graph::View view = transaction.view();
  Robot robot = query.floating ? read_base(store, view) : read_robot(store, view);
  check_base(store, view, robot, query);
  std::optional<FloatingBase> floating;
  if (query.floating) {
    floating.emplace(store, transaction, robot.root_body, robot.root_frame);
    robot = read_floating_robot(store, view, robot);
  }

  Report report;
  const std::vector<ExternalWrench> wrenches = external_wrenches(store, view, robot, query, report);
  MotionDrivers drivers = resolve_motion_drivers(store, view, robot, query, wrenches, report);
  const StepModels models = read_step_models(store, view, places, report);
  report.throw_if_errors();
  std::vector<AskedQuantity> answered;
  for (const AnsweredQuantity& one : models.answers) answered.push_back(one.row());
  Resolved resolved = resolve(store, view, robot, query, wrenches, drivers, answered, report);
  std::vector<std::string> given = given_slots(query);
  std::optional<Control> control;
  if (query.task && !query.task->empty())
    control = control_of(view, robot, query, given, resolved, report);
  if (control && control->constraints) std::erase(given, "acceleration-energy");
  throw_with_query(query, report);
  Synthesis result;
  const bool falls = std::any_of(given.begin(), given.end(), [](const std::string& slot) {
    return slot == "base-acceleration" || slot == "gravity";
  });
  Circumstances circumstances;
  circumstances.has_task = control.has_value();
  circumstances.gravity_is_constant = falls && !gravity_varies(query);
  if (circumstances.gravity_is_constant)
    circumstances.gravity = gravity(view, robot, query, result.notes);
  const std::vector<Step> together = steps_together(view, robot, query, resolved, circumstances);
  // Those for another robot, which tell what is at fault where some joints follow others.
  std::vector<Step> uncoupled;
  if (robot.coupled()) uncoupled = available_steps(drivers, together, models, false);
  std::vector<Step> available = available_steps(drivers, together, models, robot.coupled());
  // Bias forces are there already, or are not all that bodies need.
  if (control || resolved.wants("bias-force"))
    for (std::vector<Step>* list : {&uncoupled, &available})
      std::erase_if(*list, [](const Step& one) { return one.name == "joint-drive-with-bias"; });
  if (control) {
    uncoupled = steps_with(*control, uncoupled);
    available = steps_with(*control, available);
  }
  const Plan plan = plan_of(query, robot, resolved, available, uncoupled, given, report);
  if (!report.has_errors()) check_drivers_are_used(drivers, plan, report);
  throw_with_query(query, report);

  graph::Terms& terms = store.terms();
  std::vector<Id> facts = {robot.root_frame, terms.literal(canonical_text(query))};
  if (control) add_elements(*control->task, facts);
  result.algorithm =
      terms.derived(terms.iri(std::string(kAlgorithmNamespace) + "Algorithm"), facts);
  transaction.clear(result.algorithm);
  const bool writes = graph == AlgorithmGraph::kWritten || control || !models.steps.empty();
  algorithm::Builder builder(
      store, transaction, result.algorithm,
      writes ? algorithm::BuilderWrites::kGraph : algorithm::BuilderWrites::kNothing);
  Context context{
      .store = store,
      .view = view,
      .builder = builder,
      .robot = robot,
      .query = query,
      .reference =
          falls ? terms.derived(terms.iri(std::string(algorithm::kTreeNamespace) + "FreeFall"),
                                {robot.root_body})
                : robot.root_body};
  context.wrenches = wrenches;
  context.relations = resolved.relations;
  context.drivers = std::move(drivers);
  context.transaction = &transaction;
  context.gravity = circumstances.gravity;
  check_there_is_mass(context, report);
  throw_with_query(query, report);
  context.inertias = stated_inertias(context);
  if (query.regroup && resolved.regroups)
    regroup(context, context.inertias,
            uses(plan, "composite-inertia") ? Masses::kZero : Masses::kBalanced);
  write_asks(store, transaction, result.algorithm, resolved, wrenches, context.drivers);
  if (!control) set_scope(context, resolved);  // a task may speak of any joint
  if (control) context.control = &*control;
  make_drivers(context, report);
  throw_with_query(query, report);

  result.counts = run_sweeps(context, plan.sweeps);
  hand_out(context, resolved);
  std::vector<std::string> why_held = hold(context, resolved, report);
  throw_with_query(query, report);
  write_driver_list(context, transaction);
  transaction.clear(context.slots_graph());
  builder.finish();
  if (!control) {
    result.model = builder.take();
    algorithm::put_in_order(*result.model);
  }
  if (control && control->period_s)
    transaction.add({result.algorithm, terms.iri(std::string(kAlgorithmNamespace) + "period"),
                     terms.real(*control->period_s), result.algorithm});
  floating.reset();
  if (writes) transaction.commit();  // otherwise nothing of it stays
  result.why = plan.why;
  result.why.insert(result.why.end(), why_held.begin(), why_held.end());
  if (control && control->task->robot_interface) attach(store, *control, result);
  return result;
}

}  // namespace sinew::synthesis
