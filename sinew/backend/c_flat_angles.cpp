#include <fmt/format.h>

#include "sinew/backend/c_flat_emitter.h"

namespace sinew::backend {

using program::Node;
using program::Op;

// Sines and cosines of a group of angles.
void FlatEmitter::angles(const AngleGroup& group) {
  if (options_.form == FlatForm::kThread) {
    angles_one_by_one(group);
    return;
  }
  constexpr std::size_t kWidest = 8;  // angles that are computed at once; arrays are padded
  const std::size_t n = group.angles.size();
  const std::size_t padded = (n + kWidest - 1) / kWidest * kWidest;
  const std::string tag = result_.angles == 0 ? "" : fmt::format("_{}", result_.angles);
  for (const char* array : {"angle", "sine", "cosine"}) given_.take(array + tag);
  const std::string lanes = block_form_ ? fmt::format("{} * {}_LANES", n, upper_) : "";
  const bool together = stages_ && padded <= kNearNumbers;
  if (together) {
    line(fmt::format("{2}_ALIGNED {3} sine{0}[{4}], *cosine{0} = sine{0} + {1};", tag, padded,
                     upper_, scalar_, 2 * padded));
  } else {
    line(fmt::format("{2}_ALIGNED {3} sine{0}[{1}], cosine{0}[{1}];", tag,
                     block_form_ ? lanes : std::to_string(padded), upper_, scalar_));
  }
  std::string from;
  if (block_form_) {
    line(fmt::format("{}_ALIGNED {} angle{}[{}];", upper_, scalar_, tag, lanes));
    for (std::size_t k = 0; k < n; ++k) {
      const Node& node = dag_.node(group.angles[k]);
      const std::string to = fmt::format("angle{} + {} * {}_LANES", tag, k, upper_);
      if (node.op == Op::kInput && !is_held(node)) {
        line(fmt::format("memcpy({}, {}, sizeof({}));", to, address(layout_.inputs[node.index]),
                         type_));
      } else {
        line(fmt::format("memcpy({}, &{}, sizeof({}));", to, value(group.angles[k]), type_));
      }
    }
    from = "angle" + tag;
  } else if (contiguous(group, padded)) {
    const std::uint32_t first = layout_.inputs[dag_.node(group.angles[0]).index].index;
    touch("in");
    from = fmt::format("in + {}", first);
  } else {
    std::string list;
    for (const std::uint32_t angle : group.angles)
      list += (list.empty() ? "" : ", ") + value(angle);
    line(fmt::format("{}_ALIGNED const {} angle{}[{}] = {{ {} }};", upper_, scalar_, tag, padded,
                     list));
    from = "angle" + tag;
  }
  line(fmt::format("{}_sincos_all({}, sine{}, cosine{}, {}, {});", prefix_, from, tag, tag,
                   block_form_ ? lanes : std::to_string(n), block_form_ ? 0 : 1));
  std::string sines = "sine" + tag, cosines = "cosine" + tag;
  int first_sine = 0;
  if (stages_) {
    line(fmt::format("const {0} *cosines{1} = cosine{1};", scalar_, tag));
    cosines = "cosines" + tag;
    pointers_.push_back(cosines);
    if (together) {
      sines = cosines;
      first_sine = -static_cast<int>(padded);
    } else {
      line(fmt::format("const {0} *sines{1} = sine{1};", scalar_, tag));
      sines = "sines" + tag;
      pointers_.push_back(sines);
      point_to(sines);
    }
    point_to(cosines);
    given_.take(sines);
    given_.take(cosines);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Node& node = dag_.node(group.angles[k]);
    const std::string angle =
        node.op == Op::kInput ? layout_.input_names[node.index] : names_[group.angles[k]];
    take(group.sines[k], "sin_" + angle, sines, first_sine + static_cast<int>(k));
    take(group.cosines[k], "cos_" + angle, cosines, static_cast<int>(k));
  }
  result_.angles += n;
}

bool FlatEmitter::is_held(const Node& node) const {
  return node.op == Op::kInput && std::string_view(layout_.inputs[node.index].array) == "held";
}

bool FlatEmitter::is_state(const Node& node) const {
  return std::string_view(layout_.inputs[node.index].array) == "state";
}

// Whether the angles are neighbours in `in`, with others behind them up to the padded size.
bool FlatEmitter::contiguous(const AngleGroup& group, std::size_t padded) const {
  const Node& head = dag_.node(group.angles[0]);
  if (head.op != Op::kInput) return false;
  const FlatPlace& first = layout_.inputs[head.index];
  for (std::size_t k = 0; k < group.angles.size(); ++k) {
    const Node& node = dag_.node(group.angles[k]);
    if (node.op != Op::kInput) return false;
    const FlatPlace& place = layout_.inputs[node.index];
    if (std::string_view(place.array) != "in" || place.index != first.index + k) return false;
  }
  return first.index + padded <= layout_.in_size;
}

// A graphics processor has a vectorised sine and cosine of its own.
void FlatEmitter::angles_one_by_one(const AngleGroup& group) {
  for (std::size_t k = 0; k < group.angles.size(); ++k) {
    const std::string angle = value(group.angles[k]);
    const std::uint32_t sine = group.sines[k], cosine = group.cosines[k];
    if (sine != AngleGroup::kNone && cosine != AngleGroup::kNone) {
      names_[sine] = given_.unique("sin_" + angle);
      names_[cosine] = given_.unique("cos_" + angle);
      line(fmt::format("{0} {1}, {2}; sincos{3}({4}, &{1}, &{2});", scalar_, names_[sine],
                       names_[cosine], suffix_, angle),
           dag_.node(sine).origin);
      continue;
    }
    const bool is_sine = sine != AngleGroup::kNone;
    const std::uint32_t node = is_sine ? sine : cosine;
    const char* function = is_sine ? "sin" : "cos";
    names_[node] = given_.unique(fmt::format("{}_{}", function, angle));
    line(fmt::format("const {} {} = {}{}({});", scalar_, names_[node], function, suffix_, angle),
         dag_.node(node).origin);
  }
  result_.angles += group.angles.size();
}

void FlatEmitter::take(std::uint32_t node, const std::string& name, const std::string& array,
                       int k) {
  if (node == AngleGroup::kNone) return;
  if (stages_) {  // read where it is used
    in_memory(node) = {name, fmt::format("{}[{}]", array, k)};
    return;
  }
  names_[node] = given_.unique(name);
  const std::uint32_t origin = dag_.node(node).origin;
  if (block_form_) {
    line(fmt::format("{0} {1}; memcpy(&{1}, {2} + {3} * {4}_LANES, sizeof {1});", type_,
                     names_[node], array, k, upper_),
         origin);
  } else {
    line(fmt::format("const {} {} = {}[{}];", scalar_, names_[node], array, k), origin);
  }
}

}  // namespace sinew::backend
