#include "sinew/synthesis/relation.h"

#include <fmt/format.h>

#include <optional>

#include "sinew/algorithm/names.h"
#include "sinew/base/error.h"

namespace sinew::synthesis {

using algorithm::short_name;

namespace {

std::optional<Id> find_frame_if_any(graph::Store& store, const graph::View& view,
                                    const std::string& name) {
  try {
    return find_frame(store, view, name);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

Relation relation_of(graph::Store& store, const graph::View& view, const Robot& robot,
                     const Asked& asked, Id frame) {
  const auto named = [&](const std::string& name) {
    if (name != kBase && name != kItself) return find_frame(store, view, name);
    const Id meant = name == kBase ? robot.root_frame : frame;
    const std::optional<Id> other = find_frame_if_any(store, view, name);
    if (other && *other != meant)
      throw Error(Problem{{},
                          std::string(store.terms().text(*other)),
                          fmt::format("'{}' may be this, or the word for another frame", name),
                          "use the whole IRI of what is meant",
                          {},
                          {}});
    return meant;
  };
  graph::Terms& terms = store.terms();
  Relation relation{.node = {}, .of = frame, .quantity = asked.quantity};
  relation.with_respect_to =
      asked.with_respect_to.empty() ? robot.root_frame : named(asked.with_respect_to);
  relation.seen_by = asked.seen_by.empty() ? relation.with_respect_to : named(asked.seen_by);
  for (const Id one : {frame, relation.with_respect_to, relation.seen_by})
    path_to(robot, view, one);  // refuses what the base does not reach
  // A pose, and what is made of one, has the directions of the frame that it is with respect to.
  const bool has_own_directions = asked.quantity.starts_with("pose") ||
                                  asked.quantity.starts_with("position-and") ||
                                  asked.quantity.starts_with("analytic");
  if (has_own_directions && relation.seen_by != relation.with_respect_to)
    throw Error(Problem{{},
                        std::string(terms.text(frame)),
                        fmt::format("its {} cannot be seen by {}", asked.quantity, asked.seen_by),
                        "it is seen by the frame that it is with respect to: ask with respect to "
                        "another frame instead",
                        {},
                        {}});
  relation.node = terms.derived(terms.iri(std::string(algorithm::kAlgorithmNamespace) + "Relation"),
                                {frame, relation.with_respect_to, relation.seen_by});
  relation.label = short_name(terms.text(frame));
  const auto mention = [&](std::string_view word, const std::string& name, Id other) {
    relation.label += fmt::format(
        ".{}.{}", word,
        name == kBase || name == kItself ? std::string_view(name) : short_name(terms.text(other)));
  };
  if (!asked.with_respect_to.empty())
    mention("wrt", asked.with_respect_to, relation.with_respect_to);
  if (relation.seen_by != relation.with_respect_to)
    mention("seen-by", asked.seen_by, relation.seen_by);
  return relation;
}

WayBetween way_between(const Robot& robot, const graph::View& view, Id one, Id other) {
  const std::vector<std::size_t> a = path_to(robot, view, one), b = path_to(robot, view, other);
  std::size_t common = 0;
  while (common < a.size() && common < b.size() && a[common] == b[common]) ++common;
  const auto from = static_cast<std::ptrdiff_t>(common);
  return {common == 0 ? robot.root_frame : robot.joints[a[common - 1]].frame,
          {a.begin() + from, a.end()},
          {b.begin() + from, b.end()}};
}

Id body_of(const Robot& robot, const graph::View& view, Id frame) {
  const Id at = body_frame(view, frame);
  for (const RobotJoint& joint : robot.joints)
    if (joint.frame == at) return joint.successor;
  return robot.root_body;
}

}  // namespace sinew::synthesis
