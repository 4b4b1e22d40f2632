#include "sinew/synthesis/synthesise.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sinew/algorithm/attach.h"
#include "sinew/base/error.h"
#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/context.h"
#include "sinew/synthesis/control.h"
#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/driver_list.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/external_wrenches.h"
#include "sinew/synthesis/floating_base.h"
#include "sinew/synthesis/hybrid_steps.h"
#include "sinew/synthesis/plan.h"
#include "sinew/synthesis/read_query.h"
#include "sinew/synthesis/regroup.h"
#include "sinew/synthesis/step_models.h"

namespace sinew::synthesis {
namespace {

using algorithm::kAlgorithmNamespace;

// One thing that is asked: the row of the table and the element.
struct Wanted {
  const AskedQuantity* quantity;
  Id element;
  std::vector<Id> frames = {};  // the way to them matters
  bool output = true;           // false: a task needs it
};

struct Resolved {
  std::vector<Wanted> wanted;
  std::vector<Relation> relations;
  std::vector<Wish> wishes;
  bool dynamic = false;
  bool regroups = true;
};

std::string text(const graph::View& view, Id id) { return std::string(view.terms().text(id)); }

std::vector<Id> tips(graph::Store& store, const graph::View& view, const Robot& robot,
                     const Query& query) {
  if (query.tips.empty()) return leaf_frames(store, view, robot);
  std::vector<Id> frames;
  for (const std::string& name : query.tips) {
    const Id frame = find_frame(store, view, name);
    path_to(robot, view, frame);  // refuses a tip that the base does not reach
    frames.push_back(frame);
  }
  return frames;
}

// The elements that a question is about, in the order of the outputs.
std::vector<Id> elements(graph::Store& store, const graph::View& view, const Robot& robot,
                         const Query& query, const MotionDrivers& drivers, const Asked& asked,
                         Element kind) {
  std::vector<Id> found;
  switch (kind) {
    case Element::kConstraint:
    case Element::kDriver:
    case Element::kDriverJoint:
    case Element::kLimited:
      return driver_elements(store, robot, query, drivers, asked, kind);
    case Element::kRobot:
      return {robot.root_body};
    case Element::kFrame:
      if (asked.of.empty() || asked.of == kEveryTip) return tips(store, view, robot, query);
      found.push_back(find_frame(store, view, asked.of));
      path_to(robot, view, found.back());
      return found;
    case Element::kJoint:
      if (!asked.of.empty() && asked.of != kEveryJoint)
        return {find_coordinate(view, robot, asked.of).joint};
      for (const Coordinate& coordinate : coordinates(robot)) found.push_back(coordinate.joint);
      // A joint that follows another has no numbers of its own, but a bearing.
      if (asked.quantity == "joint-wrench")
        for (const RobotJoint& joint : robot.joints)
          if (joint.follows >= 0 && joint.compound < 0) found.push_back(joint.joint);
      return found;
  }
  return found;
}

// The joints that each external wrench reaches, each with that wrench.
std::vector<Id> shares(graph::Store& store, const graph::View& view, const Robot& robot,
                       const Query& query, std::span<const ExternalWrench> wrenches) {
  if (query.forces == Forces::kTogether || wrenches.empty())
    throw Error(Problem{{},
                        query.name,
                        wrenches.empty() ? "shares of joint forces, but there is no external wrench"
                                         : "shares of joint forces, but forces are added up early",
                        wrenches.empty() ? "give an external-wrench" : "let forces be kept apart",
                        {},
                        {}});
  std::vector<Id> pairs;
  for (const Coordinate& coordinate : coordinates(robot))
    for (const std::size_t part : coordinate.parts)
      for (const ExternalWrench& one : wrenches) {
        // A wrench reaches a joint on its way, and by way of those that follow it.
        const auto way = path_to(robot, view, one.frame);
        const bool reaches = std::any_of(way.begin(), way.end(), [&](std::size_t at) {
          return at == part || robot.joints[at].follows == static_cast<int>(part);
        });
        if (reaches) pairs.push_back(pair_of(store.terms(), robot.joints[part].joint, one.frame));
      }
  return pairs;
}

// Whether it takes the longer way, by what lies between two frames.
bool is_between(const Query& query, const Asked& asked, const AskedQuantity& row) {
  if (row.between.empty()) return false;
  const bool from_base = asked.with_respect_to.empty() || asked.with_respect_to == kBase;
  const bool seen_by_base = asked.seen_by.empty() || asked.seen_by == kBase;
  const bool spatial = row.name == "acceleration-twist" && query.frames == Frames::kStationary;
  return !from_base || !seen_by_base || spatial || row.between == row.needs;
}

// Of what is no motion of a frame.
void check_directions(const Asked& asked, const AskedQuantity& row) {
  if (!row.between.empty() || (asked.with_respect_to.empty() && asked.seen_by.empty())) return;
  throw Error(Problem{{},
                      asked.of,
                      fmt::format("{} is of no two frames and has directions of its own", row.name),
                      "leave out with-respect-to and seen-by",
                      {},
                      {}});
}

Resolved resolve(graph::Store& store, const graph::View& view, const Robot& robot,
                 const Query& query, std::span<const ExternalWrench> wrenches,
                 const MotionDrivers& drivers, std::span<const AskedQuantity> more,
                 Report& report) {
  Resolved resolved;
  const bool computes =
      query.task && !(query.task->controllers.empty() && query.task->monitors.empty());
  if (query.asked.empty() && !computes)
    report.error({}, query.name, "the query asks for nothing",
                 "state what is asked, or a task whose numbers are computed");
  for (const Asked& asked : query.asked) {
    const AskedQuantity* row = find_asked(asked.quantity);
    for (const AskedQuantity& one : more)
      if (one.name == asked.quantity) row = &one;
    if (row == nullptr) {
      std::string known;
      for (const AskedQuantity& one : more)
        known += (known.empty() ? "" : ", ") + std::string(one.name);
      for (const AskedQuantity& one : asked_quantities())
        known += (known.empty() ? "" : ", ") + std::string(one.name);
      report.error({}, query.name, fmt::format("nothing is known of {}", asked.quantity),
                   "ask for one of " + known);
      continue;
    }
    resolved.dynamic |= row->dynamic;
    resolved.regroups &= row->regroups;
    const bool between = is_between(query, asked, *row);
    resolved.wishes.push_back({std::string(between ? row->between : row->needs), asked.quantity});
    try {
      if (!between) check_directions(asked, *row);
      for (const Id element :
           row->name == "joint-force-share"
               ? shares(store, view, robot, query, wrenches)
               : elements(store, view, robot, query, drivers, asked, row->element)) {
        if (!between) {
          resolved.wanted.push_back({row, element, {element}});
          continue;
        }
        const Relation one = relation_of(store, view, robot, asked, element);
        resolved.wanted.push_back({row, one.node, {one.of, one.with_respect_to, one.seen_by}});
        resolved.relations.push_back(one);
      }
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) report.add(problem);
    }
  }
  return resolved;
}

void check_base(graph::Store& store, const graph::View& view, const Robot& robot,
                const Query& query) {
  if (query.base.empty()) return;
  const Id frame = find_frame(store, view, query.base);
  if (body_frame(view, frame) == robot.root_frame) return;
  throw Error(Problem{{},
                      query.base,
                      "it is not the base of the tree, which is " + text(view, robot.root_body),
                      "normalise the model from this base",
                      {},
                      {}});
}

// The gravity vector seen from the root: the query's, else the model's.
std::array<double, 3> gravity(const Context& context, std::vector<std::string>& notes) {
  if (context.query.gravity) return *context.query.gravity;
  if (context.robot.base_acceleration) {
    const std::vector<double> a = context.numbers(context.robot.base_acceleration);
    return {-a.at(3), -a.at(4), -a.at(5)};
  }
  notes.push_back("no gravity in the model and none in the query: it is zero");
  return {0, 0, 0};
}

// Wrenches, and gravity that varies, have their effect although nobody asks for it.
void wish_for_drivers(std::span<const ExternalWrench> wrenches, const Query& query,
                      Resolved& resolved) {
  if (gravity_varies(query)) resolved.wishes.push_back({"base-acceleration", "gravity"});
  if (!resolved.dynamic || wrenches.empty()) return;
  const bool from_base = std::any_of(wrenches.begin(), wrenches.end(),
                                     [](const auto& one) { return one.seen_from_base; });
  resolved.wishes.push_back(
      {from_base ? "external-wrench-from-base" : "external-wrench", "external wrenches"});
  if (query.forces == Forces::kApart)
    resolved.wishes.push_back({"force-share", "external wrenches, kept apart"});
}

// What the expansion queries and conditions see of the question.
void write_asks(graph::Store& store, graph::Transaction& transaction, Id algorithm,
                const Resolved& resolved, std::span<const ExternalWrench> wrenches,
                const MotionDrivers& drivers) {
  graph::Terms& terms = store.terms();
  const auto sa = [&](std::string_view name) {
    return terms.iri(std::string(kAlgorithmNamespace) + std::string(name));
  };
  for (const Wanted& wanted : resolved.wanted) {
    transaction.add({algorithm, sa("asks"), wanted.element, algorithm});
    transaction.add(
        {algorithm, sa("asks-" + std::string(wanted.quantity->name)), wanted.element, algorithm});
  }
  for (const ExternalWrench& one : wrenches)  // their directions are the base's
    if (one.seen_from_base) transaction.add({algorithm, sa("asks"), one.frame, algorithm});
  for (const Id frame : constrained_frames(drivers))
    transaction.add({algorithm, sa("asks"), frame, algorithm});
}

void set_scope(Context& context, const Resolved& resolved) {
  if (resolved.dynamic) return;
  for (const Wanted& wanted : resolved.wanted)
    for (const Id frame : wanted.frames)
      for (const std::size_t joint : path_to(context.robot, context.view, frame))
        context.scope.insert(context.robot.joints[joint].frame);
}

// Steps that the query's drivers call for, those that come with Sinew, and those of the graph:
// where two give the same, the first one is taken.
std::vector<Step> available_steps(const MotionDrivers& drivers, const StepModels& models,
                                  bool coupled) {
  std::vector<Step> list = hybrid_steps(drivers);
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
    if (problem.iri.empty()) problem.iri = query.iri;
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

Synthesis synthesise(graph::Store& store, const Query& query, const graph::Places* places) {
  graph::Transaction transaction = store.begin();
  const graph::View view = transaction.view();
  Robot robot = read_robot(store, view);
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
  wish_for_drivers(wrenches, query, resolved);
  std::vector<std::string> given = given_slots(query);
  std::optional<Control> control;
  if (query.task && !query.task->empty())
    control = control_of(view, robot, query, given, resolved, report);
  if (control && control->constraints) std::erase(given, "acceleration-energy");
  throw_with_query(query, report);
  std::vector<Step> uncoupled = available_steps(drivers, models, false);
  std::vector<Step> available = available_steps(drivers, models, robot.coupled());
  if (control) {
    uncoupled = steps_with(*control, uncoupled);
    available = steps_with(*control, available);
  }
  const Plan plan = plan_of(query, robot, resolved, available, uncoupled, given, report);
  if (!report.has_errors()) check_drivers_are_used(drivers, plan, report);
  throw_with_query(query, report);

  graph::Terms& terms = store.terms();
  Synthesis result;
  std::vector<Id> facts = {robot.root_frame, terms.literal(canonical_text(query))};
  if (control) add_elements(*control->task, facts);
  result.algorithm =
      terms.derived(terms.iri(std::string(kAlgorithmNamespace) + "Algorithm"), facts);
  transaction.clear(result.algorithm);
  algorithm::Builder builder(store, transaction, result.algorithm);
  const bool falls = std::any_of(given.begin(), given.end(), [](const std::string& slot) {
    return slot == "base-acceleration" || slot == "gravity";
  });
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
  if (falls && !gravity_varies(query)) context.gravity = gravity(context, result.notes);
  context.inertias = stated_inertias(context);
  if (query.regroup && resolved.regroups) regroup(context, context.inertias);
  write_asks(store, transaction, result.algorithm, resolved, wrenches, context.drivers);
  if (!control) set_scope(context, resolved);  // a task may speak of any joint
  if (control) context.control = &*control;
  make_drivers(context, report);
  throw_with_query(query, report);

  result.counts = run_sweeps(context, plan.sweeps);
  hand_out(context, resolved);
  write_driver_list(context, transaction);
  transaction.clear(context.slots_graph());
  builder.finish();
  if (control && control->period_s)
    transaction.add({result.algorithm, terms.iri(std::string(kAlgorithmNamespace) + "period"),
                     terms.real(*control->period_s), result.algorithm});
  floating.reset();
  transaction.commit();
  result.why = plan.why;
  if (control && control->task->robot_interface) attach(store, *control, result);
  return result;
}

}  // namespace sinew::synthesis
