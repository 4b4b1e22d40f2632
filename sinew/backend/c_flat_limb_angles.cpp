#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sinew/backend/c_flat_limb_emitter.h"

namespace sinew::backend {

using program::LimbSource;
using program::Node;
using program::Op;

namespace {

constexpr std::size_t kWidest = 16;  // sines that are computed at once; arrays are padded to it

bool is_trigonometric(const Node& node) { return node.op == Op::kSin || node.op == Op::kCos; }

}  // namespace

// Nodes of the present region that are the sine and the cosine of this one. Those of the caller's
// angles are read where they are used.
void LimbEmitter::take_sines(std::uint32_t angle, const std::string& sines,
                             const std::string& cosines, int offset) {
  for (std::uint32_t i = 0; i < dag().size(); ++i) {
    const Node& node = dag().node(i);
    if (!live_[at_][i] || !is_trigonometric(node) || node.a.node() != angle) continue;
    const std::string& array = node.op == Op::kSin ? sines : cosines;
    const char* base = node.op == Op::kSin ? "sine_of" : "cosine_of";
    if (sines == "sines") {
      in_memory_[nodes_.of(at_, i)] = {base, array, offset};
      continue;
    }
    const std::string name = given_.unique(base);
    names_[at_][i] = name;
    if (in_lanes()) {
      line(
          fmt::format("{0} {1}; memcpy(&{1}, {2} + {3}, sizeof {1});", type(), name, array, offset),
          node.origin);
    } else {
      line(fmt::format("const {} {} = {}[{}];", scalar_, name, array, offset), node.origin);
    }
  }
}

// An angle that is not the caller's.
void LimbEmitter::sine_of(std::uint32_t angle) {
  const std::string tag = fmt::format("_{}", ++groups_);
  const std::string from = value(angle);
  line(fmt::format("{1}_ALIGNED {2} angle{0}[{3}] = {{ 0 }}, sine{0}[{3}], cosine{0}[{3}];", tag,
                   upper_, scalar_, kWidest));
  if (in_lanes()) {
    line(fmt::format("memcpy(angle{}, &{}, sizeof {});", tag, from, from));
  } else {
    line(fmt::format("angle{}[0] = {};", tag, from));
  }
  const unsigned count = width_of(region().lanes);
  std::string squares;
  for (unsigned k = 0; k < count; ++k) {
    squares += fmt::format("{0}angle{1}[{2}] * angle{1}[{2}]", k == 0 ? "" : " + ", tag, k);
  }
  line(fmt::format("{0}_sincos_all(angle{1}, sine{1}, cosine{1}, {2}, {3});", options_.name, tag,
                   count, squares));
  body_.angles += count;
  take_sines(angle, "sine" + tag, "cosine" + tag, 0);
}

// All angles that the caller hands over, the lanes of a vector side by side.
void LimbEmitter::sines_of_inputs() {
  struct Place {
    std::size_t region;
    std::uint32_t angle;
    std::size_t offset;
  };
  std::vector<Place> places;
  std::vector<std::string> angles;
  std::map<std::pair<std::size_t, std::uint32_t>, bool> seen;
  for (at_ = 0; at_ < program_.regions.size(); ++at_) {
    for (std::uint32_t i = 0; i < dag().size(); ++i) {
      const Node& node = dag().node(i);
      if (!live_[at_][i] || !is_trigonometric(node)) continue;
      const Node& angle = dag().node(node.a);
      if (angle.op != Op::kInput || !seen.try_emplace({at_, node.a.node()}, true).second) continue;
      const Sources& sources = region().inputs[angle.index];
      if (!std::all_of(sources.begin(), sources.end(), [](const LimbSource& source) {
            return source.kind == LimbSource::Kind::kCaller;
          })) {
        continue;
      }
      places.push_back({at_, node.a.node(), angles.size()});
      for (unsigned k = 0; k < width_of(region().lanes); ++k) {
        angles.push_back(text(sources[k < sources.size() ? k : 0]));
      }
    }
  }
  if (angles.empty()) return;
  const std::size_t padded = (angles.size() + kWidest - 1) / kWidest * kWidest;
  std::string list, squares;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    list += (k == 0 ? "" : ", ") + angles[k];
    squares += fmt::format("{0}angle[{1}] * angle[{1}]", k == 0 ? "" : " + ", k);
  }
  line(fmt::format("{}_ALIGNED const {} angle[{}] = {{ {} }};", upper_, scalar_, padded, list));
  line(fmt::format("{}_ALIGNED {} sine[{}], cosine[{}];", upper_, scalar_, padded, padded));
  line(fmt::format("{}_sincos_all(angle, sine, cosine, {}, {});", options_.name, angles.size(),
                   squares));
  body_.angles += angles.size();
  const bool again = kept_.any();
  const int middle = again && angles.size() > kNearNumbers ? int{kNearNumbers} : 0;
  if (again) {
    sines_in_memory_ = true;
    line(fmt::format("const {0} *sines = sine + {1}, *cosines = cosine + {1};", scalar_, middle));
    point_to("sines");
    point_to("cosines");
  }
  for (const Place& place : places) {
    at_ = place.region;
    take_sines(place.angle, again ? "sines" : "sine", again ? "cosines" : "cosine",
               static_cast<int>(place.offset) - middle);
  }
}

}  // namespace sinew::backend
