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
void LimbEmitter::take_sines(std::uint32_t angle, const Numbers& sines, const Numbers& cosines,
                             bool again) {
  for (std::uint32_t i = 0; i < dag().size(); ++i) {
    const Node& node = dag().node(i);
    if (!live_[at_][i] || !is_trigonometric(node) || node.a.node() != angle) continue;
    const auto& [array, at] = node.op == Op::kSin ? sines : cosines;
    const char* base = node.op == Op::kSin ? "sine_of" : "cosine_of";
    if (again) {
      put_in_memory(nodes_.of(at_, i)) = {base, array, at};
      continue;
    }
    const std::string name = given_.unique(base);
    names_[at_][i] = name;
    if (in_lanes()) {
      line(fmt::format("{0} {1}; memcpy(&{1}, {2} + {3}, sizeof {1});", type(), name, array, at),
           node.origin);
    } else {
      line(fmt::format("const {} {} = {}[{}];", scalar_, name, array, at), node.origin);
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
  const unsigned count = program::vector_width(region().lanes);
  line(fmt::format("{0}_sincos_all(angle{1}, sine{1}, cosine{1}, {2}, 1);", options_.name, tag,
                   count));
  body_.angles += count;
  take_sines(angle, {"sine" + tag, 0}, {"cosine" + tag, 0}, false);
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
      for (unsigned k = 0; k < program::vector_width(region().lanes); ++k) {
        angles.push_back(text(sources[k < sources.size() ? k : 0]));
      }
    }
  }
  if (angles.empty()) return;
  const std::size_t padded = (angles.size() + kWidest - 1) / kWidest * kWidest;
  std::string list;
  for (const std::string& angle : angles) list += (list.empty() ? "" : ", ") + angle;
  line(fmt::format("{}_ALIGNED const {} angle[{}] = {{ {} }};", upper_, scalar_, padded, list));
  const bool again = kept_.any();
  const int size = static_cast<int>(padded);
  const bool together = again && padded <= kNearNumbers;
  if (together) {
    line(fmt::format("{}_ALIGNED {} sine[{}], *cosine = sine + {};", upper_, scalar_, 2 * size,
                     size));
  } else {
    line(fmt::format("{}_ALIGNED {} sine[{}], cosine[{}];", upper_, scalar_, size, size));
  }
  line(fmt::format("{}_sincos_all(angle, sine, cosine, {}, 1);", options_.name, angles.size()));
  body_.angles += angles.size();
  std::string sines = "sine", cosines = "cosine";
  int first_sine = 0, first_cosine = 0;
  if (again) {
    cosines = "cosines";
    sines = together ? cosines : "sines";
    first_sine = together ? -size : -int{kNearNumbers};
    first_cosine = together ? 0 : -int{kNearNumbers};
    line(fmt::format("const {} *cosines = cosine + {};", scalar_, -first_cosine));
    pointers_.push_back(cosines);
    if (!together) {
      line(fmt::format("const {} *sines = sine + {};", scalar_, -first_sine));
      pointers_.push_back(sines);
    }
    for (const std::string& pointer : pointers_) point_to(pointer);
  }
  for (const Place& place : places) {
    at_ = place.region;
    const int offset = static_cast<int>(place.offset);
    take_sines(place.angle, {sines, first_sine + offset}, {cosines, first_cosine + offset}, again);
  }
}

}  // namespace sinew::backend
