#include "sinew/synthesis/joint_edge.h"

#include <cctype>

namespace sinew::synthesis {

JointEdge::JointEdge(const Context& context, const Visit& visit)
    : parent(visit.parent),
      child(visit.node),
      joint(visit["joint"]),
      joint_frame(visit["joint_frame"]),
      placement(visit["placement"]),
      predecessor(visit["predecessor"]),
      successor(visit["successor"]),
      kind(algorithm::short_name(context.view.terms().text(visit["kind"]))) {
  label = context.label(joint);
  kind.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(kind.front())));
}

algorithm::BlockSpec JointEdge::coordinate(std::string_view slot, std::string_view what) const {
  const bool pose = what == "position";
  return {.slot = slot,
          .represents = joint,
          .quantity = joint_quantity_name(kind, what),
          .of = pose ? child : successor,
          .wrt = pose ? joint_frame : predecessor,
          .seen_by = child,
          .prismatic = kind == "prismatic",
          .label = label};
}

std::string_view joint_quantity_name(std::string_view kind, std::string_view what) {
  const bool floats = kind == "floating";
  if (what == "position") return floats ? "floating-position" : "joint-position";
  if (what == "velocity") return floats ? "floating-velocity" : "joint-velocity";
  if (what == "acceleration") return floats ? "floating-acceleration" : "joint-acceleration";
  return floats ? "floating-force" : "joint-force";
}

}  // namespace sinew::synthesis
