#include "sinew/synthesis/external_wrenches.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/algorithm/names.h"
#include "sinew/synthesis/query_faults.h"

namespace sinew::synthesis {
namespace {

const RobotJoint* joint_of(const Robot& robot, Id body_frame) {
  for (const RobotJoint& joint : robot.joints)
    if (joint.frame == body_frame) return &joint;
  return nullptr;
}

// The frame of a body's first link, in which the model gives its data.
Id link_frame(const graph::View& view, const RobotJoint& joint) {
  const Id property = view.terms().find_iri(std::string(algorithm::kTreeNamespace) + "root-frame");
  const Id frame = property ? view.object(joint.successor, property) : Id{};
  return frame ? frame : joint.frame;
}

}  // namespace

std::vector<ExternalWrench> external_wrenches(graph::Store& store, const graph::View& view,
                                              const Robot& robot, const Query& query,
                                              Report& report) {
  std::vector<ExternalWrench> wrenches;
  const auto refuse = [&](const Given& given, std::string about, std::string what,
                          std::string remedy) {
    report.add(fault_in(query, given.origin, std::move(about), std::move(what), std::move(remedy)));
  };
  const auto add = [&](Id frame, const Given& given, std::string label) {
    const RobotJoint* joint = joint_of(robot, body_frame(view, frame));
    if (joint == nullptr) {
      refuse(given, std::string(view.terms().text(frame)),
             "a wrench on the base, which does not move, has no effect on any joint",
             "leave it out, or let the base float");
      return;
    }
    for (const ExternalWrench& other : wrenches)
      if (other.frame == frame)
        refuse(given, std::string(view.terms().text(frame)), "two external wrenches on one frame",
               "give it once");
    wrenches.push_back(
        {frame, joint->successor, joint->frame, given.seen_by == kBase, std::move(label)});
  };
  for (const Given& given : query.given) {
    if (given.quantity != "external-wrench") continue;
    if (!given.seen_by.empty() && given.seen_by != kItself && given.seen_by != kBase)
      refuse(given, given.of, fmt::format("an external wrench that is seen by {}", given.seen_by),
             "let it be seen by itself (the frame on which it acts) or by the base");
    if (given.of == kEveryLink) {
      for (const RobotJoint& joint : robot.joints)
        if (robot.leads_to_link(joint))
          add(link_frame(view, joint), given,
              std::string(algorithm::short_name(view.terms().text(joint.successor))));
      continue;
    }
    if (given.of.empty()) {
      refuse(given, query.name, "an external wrench without the link on which it acts",
             fmt::format("state of which frame or link it is, or of {}", kEveryLink));
      continue;
    }
    try {
      add(find_frame(store, view, given.of), given, std::string(algorithm::short_name(given.of)));
    } catch (const Error& error) {
      add_faults(report, query, given.origin, error);
    }
  }
  return wrenches;
}

}  // namespace sinew::synthesis
