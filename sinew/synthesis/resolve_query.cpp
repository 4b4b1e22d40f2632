#include "sinew/synthesis/resolve_query.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/driver_list.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/query_faults.h"

namespace sinew::synthesis {
namespace {

using algorithm::kAlgorithmNamespace;

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
      if (!asked.of.empty() && asked.of != kEveryJoint) {
        if (asked.quantity == "joint-wrench")
          for (const Id joint : followers_of_the_model(robot))
            if (is_named(view, joint, asked.of)) return {joint};
        return {find_coordinate(view, robot, asked.of).joint};
      }
      for (const Coordinate& coordinate : coordinates(robot)) found.push_back(coordinate.joint);
      // A joint that follows another has no numbers of its own, but a bearing.
      if (asked.quantity == "joint-wrench")
        for (const Id joint : followers_of_the_model(robot)) found.push_back(joint);
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

}  // namespace

bool Resolved::wants(std::string_view quantity) const {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const Wanted& one) { return one.quantity->name == quantity; });
}

// There must be something to answer about.
void check_there_are_any(const Robot& robot, const AskedQuantity& row, const Asked& asked,
                         const std::vector<Id>& found) {
  const bool has_columns = row.name.ends_with("jacobian") || row.name.ends_with("matrix") ||
                           row.name == "cholesky-factor";
  if (!found.empty() && !(has_columns && robot.joints.empty())) return;
  const bool frames = row.element == Element::kFrame && !has_columns;
  throw Error(Problem{{},
                      asked.quantity,
                      frames ? "it is asked of every tip, but no link moves, so there is none"
                             : "it is asked, but the robot has no joint that moves",
                      frames ? "name the frame of which it is asked"
                             : "ask of a robot with joints that move, or let its base float",
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
      report.add(fault_in(query, asked.origin, query.name,
                          fmt::format("nothing is known of {}", asked.quantity),
                          "ask for one of " + known));
      continue;
    }
    resolved.dynamic |= row->dynamic;
    resolved.regroups &= row->regroups;
    const bool between = is_between(query, asked, *row);
    resolved.wishes.push_back(
        {std::string(between ? row->between : row->needs), asked.quantity, asked.origin});
    try {
      if (!between) check_directions(asked, *row);
      const std::vector<Id> found =
          row->name == "joint-force-share"
              ? shares(store, view, robot, query, wrenches)
              : elements(store, view, robot, query, drivers, asked, row->element);
      check_there_are_any(robot, *row, asked, found);
      for (const Id element : found) {
        if (!between) {
          resolved.wanted.push_back({row, element, {element}});
          continue;
        }
        const Relation one = relation_of(store, view, robot, asked, element);
        resolved.wanted.push_back({row, one.node, {one.of, one.with_respect_to, one.seen_by}});
        resolved.relations.push_back(one);
      }
    } catch (const Error& error) {
      const bool of_tips =
          row->element == Element::kFrame && (asked.of.empty() || asked.of == kEveryTip);
      add_faults(report, query, of_tips ? query.tips_origin : asked.origin, error);
    }
  }
  wish_for_drivers(wrenches, query, resolved);
  return resolved;
}

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

}  // namespace sinew::synthesis
