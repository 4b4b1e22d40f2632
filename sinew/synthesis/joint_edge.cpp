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
  kind.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(kind.front())));
}

}  // namespace sinew::synthesis
