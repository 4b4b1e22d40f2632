// Wrenches that act on links from outside: drivers that belong to frames.
#pragma once

#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/robot.h"

namespace sinew::synthesis {

struct ExternalWrench {
  Id frame;             // about whose origin it is
  Id body, body_frame;  // on which it acts
  bool seen_from_base;  // or from the frame
  std::string label;    // of its input: wrench.LABEL
};

inline constexpr std::string_view kEveryLink = "every-link";

// In the order of the query; of every-link: in the order of the joints. One that acts on a base
// that does not move, or the second one on a frame, is reported.
std::vector<ExternalWrench> external_wrenches(graph::Store& store, const graph::View& view,
                                              const Robot& robot, const Query& query,
                                              Report& report);

}  // namespace sinew::synthesis
