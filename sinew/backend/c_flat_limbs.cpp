#include "sinew/backend/c_flat_limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "sinew/backend/c_arithmetic.h"
#include "sinew/backend/c_names.h"
#include "sinew/backend/numbers.h"
#include "sinew/program/dag/evaluate.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Node;
using program::Op;
using program::Ref;
using Sources = std::vector<LimbSource>;

// Fewer zeros than this are written one by one.
constexpr std::size_t kLeastZeros = 4;

constexpr std::size_t kWidest = 16;  // sines that are computed at once; arrays are padded to it

// Lanes of the vector that holds these limbs; those that are left over repeat the first limb.
unsigned width_of(std::uint32_t lanes) {
  unsigned width = 1;
  while (width < lanes) width *= 2;
  return width;
}

bool is_trigonometric(const Node& node) { return node.op == Op::kSin || node.op == Op::kCos; }

class Emitter {
 public:
  Emitter(const LimbProgram& program, const FlatLayout& layout, const FlatOptions& options)
      : program_(program),
        layout_(layout),
        options_(options),
        upper_(upper_case(options.name)),
        scalar_(options.scalar == Scalar::kFloat ? "float" : "double"),
        suffix_(options.scalar == Scalar::kFloat ? "f" : "") {
    for (const LimbRegion& region : program.regions) {
      names_.emplace_back(region.computation.dag.size());
      live_.push_back(program::live_nodes(region.computation));
      const unsigned width = width_of(region.lanes);
      if (width > 1) body_.widths.push_back(width);
      types_.push_back(region.lanes > 1 ? fmt::format("{}_limbs{}", options.name, width) : scalar_);
    }
    std::sort(body_.widths.begin(), body_.widths.end());
    body_.widths.erase(std::unique(body_.widths.begin(), body_.widths.end()), body_.widths.end());
  }

  LimbBody run() {
    find_results();
    sines_of_inputs();
    for (at_ = 0; at_ < program_.regions.size(); ++at_) {
      const Computation& computation = region().computation;
      std::vector<std::uint32_t> order = computation.order;
      if (order.empty()) {
        order.resize(computation.dag.size());
        std::iota(order.begin(), order.end(), 0U);
      }
      for (const std::uint32_t i : order) {
        const Op op = dag().node(i).op;
        if (!live_[at_][i] || program::arity(op) == 0 || op == Op::kLess) continue;
        value(i);
        for (const std::uint32_t k : results_of_[at_][i]) write(k);
      }
    }
    for (std::size_t at = 0; at < later_.size();) {
      const std::size_t zeros = zeros_from(at);
      if (zeros >= kLeastZeros) {
        const FlatPlace& place = layout_.results[later_[at]];
        line(fmt::format("memset({0} + {1}, 0, {2} * sizeof *{0});", place.array, place.index,
                         zeros));
        at += zeros;
      } else {
        write(later_[at++]);
      }
    }
    return std::move(body_);
  }

 private:
  // Results are written as soon as they are computed, so that they need no register to the end.
  void find_results() {
    for (const LimbRegion& region : program_.regions) {
      results_of_.emplace_back(region.computation.dag.size());
    }
    for (std::uint32_t k = 0; k < program_.results.size(); ++k) {
      const LimbSource& source = program_.results[k];
      const bool of_region = source.kind == LimbSource::Kind::kRegion;
      const Computation* computation =
          of_region ? &program_.regions[source.region].computation : nullptr;
      const Ref ref = of_region ? computation->results[source.index] : Ref{};
      if (of_region && program::arity(computation->dag.node(ref).op) > 0) {
        results_of_[source.region][ref.node()].push_back(k);
      } else {
        later_.push_back(k);
      }
    }
  }

  void write(std::uint32_t k) {
    const FlatPlace& place = layout_.results[k];
    line(fmt::format("{}[{}] = {};", place.array, place.index, text(program_.results[k])));
  }

  // How many results from this one on are 0 and lie side by side.
  std::size_t zeros_from(std::size_t at) const {
    std::size_t n = 0;
    const std::uint32_t first = layout_.results[later_[at]].index;
    for (; at + n < later_.size(); ++n) {
      const LimbSource& source = program_.results[later_[at + n]];
      if (source.kind != LimbSource::Kind::kConstant || source.value != 0.0 ||
          layout_.results[later_[at + n]].index != first + n) {
        break;
      }
    }
    return n;
  }

  const LimbRegion& region() const { return program_.regions[at_]; }
  const program::Dag& dag() const { return region().computation.dag; }
  bool in_lanes() const { return region().lanes > 1; }
  const std::string& type() const { return types_[at_]; }

  void line(std::string_view text, std::uint32_t origin = program::kNoOrigin) {
    body_.code.add({"  ", text}, origin);
  }

  std::string number(double value) const { return scalar_number(value, options_.scalar); }

  // A number where plain numbers are wanted.
  std::string text(const LimbSource& source) {
    switch (source.kind) {
      case LimbSource::Kind::kConstant:
        return number(source.value);
      case LimbSource::Kind::kCaller: {
        const FlatPlace& place = layout_.inputs[source.index];
        return fmt::format("{}[{}]", place.array, place.index);
      }
      default:
        break;
    }
    const LimbRegion& from = program_.regions[source.region];
    const Ref ref = from.computation.results[source.index];
    const Node& node = from.computation.dag.node(ref);
    const bool negative = ref.negative() != source.negative;
    if (node.op == Op::kConstant) return (negative ? "-" : "") + number(node.value);
    if (node.op == Op::kInput) {
      const std::string inner = text(from.inputs[node.index][source.lane]);
      return negative ? fmt::format("-({})", inner) : inner;
    }
    return fmt::format("{}{}{}", negative ? "-" : "", names_[source.region][ref.node()],
                       from.lanes > 1 ? fmt::format("[{}]", source.lane) : "");
  }

  // { lane 0, lane 1, … } of the region's vector type.
  template <typename Lane>
  std::string vector(Lane lane) const {
    const std::uint32_t lanes = region().lanes;
    std::string list;
    for (unsigned k = 0; k < width_of(lanes); ++k) {
      list += (k == 0 ? "{ " : ", ") + lane(k < lanes ? k : 0);
    }
    return list + " }";
  }

  // A vector of zeros of the region's type. C++ has no compound literals.
  std::string zero() {
    std::string& name = zeros_[width_of(region().lanes)];
    if (name.empty()) {
      name = given_.unique("zero");
      line(fmt::format("const {} {} = {{ 0 }};", type(), name));
    }
    return name;
  }

  // An input of the present region, by a name of the region's type.
  std::string input(const Node& node) {
    const Sources& sources = region().inputs[node.index];
    const LimbSource& first = sources[0];
    const std::string name = first.kind == LimbSource::Kind::kCaller
                                 ? given_.unique(layout_.input_names[first.index])
                                 : given_.temporary();
    if (!in_lanes()) {
      line(fmt::format("const {} {} = {};", scalar_, name, text(first)));
      return name;
    }
    if (const auto same = same_vector(sources)) {
      line(fmt::format("const {} {} = {};", type(), name, *same));
      return name;
    }
    const bool equal = std::all_of(sources.begin(), sources.end(),
                                   [&](const LimbSource& source) { return source == first; });
    if (equal) {
      const std::string number = text(first);
      line(fmt::format("const {} {} = {} - {};", type(), name, number, zero()));
      return name;
    }
    std::vector<std::string> texts;
    for (const LimbSource& source : sources) texts.push_back(text(source));
    line(fmt::format("const {} {} = {};", type(), name,
                     vector([&](std::uint32_t lane) { return texts[lane]; })));
    return name;
  }

  // The name of a vector of an earlier region that holds exactly these numbers.
  std::optional<std::string> same_vector(const Sources& sources) const {
    const LimbSource& first = sources[0];
    if (first.kind != LimbSource::Kind::kRegion) return std::nullopt;
    const LimbRegion& from = program_.regions[first.region];
    if (from.lanes != region().lanes) return std::nullopt;
    for (std::uint32_t lane = 0; lane < sources.size(); ++lane) {
      LimbSource expected = first;
      expected.lane = lane;
      if (!(sources[lane] == expected)) return std::nullopt;
    }
    const Ref ref = from.computation.results[first.index];
    if (program::arity(from.computation.dag.node(ref).op) == 0) return std::nullopt;
    return (ref.negative() != first.negative ? "-" : "") + names_[first.region][ref.node()];
  }

  const std::string& value(std::uint32_t i) {
    const Node& node = dag().node(i);
    std::string& name = names_[at_][i];
    if (!name.empty()) return name;
    if (node.op == Op::kConstant) {
      name = number(node.value);
    } else {
      compute(i, node);
    }
    return name;
  }
  std::string value(Ref ref) { return (ref.negative() ? "-" : "") + value(ref.node()); }

  void compute(std::uint32_t i, const Node& node) {
    if (node.op == Op::kInput) {
      names_[at_][i] = input(node);
      return;
    }
    if (is_trigonometric(node)) {
      sine_of(node.a.node());
      return;
    }
    const std::string expression = express(node);
    std::string& name = names_[at_][i];
    name = given_.temporary();
    body_.code.add({"  const ", type(), " ", name, " = ", expression, ";"}, node.origin);
  }

  std::string express(const Node& n) {
    if (n.op == Op::kSqrt)
      return lane_by_lane({n.a}, [&](const std::vector<std::string>& x) {
        return fmt::format("sqrt{}({})", suffix_, x[0]);
      });
    if (n.op == Op::kSelect) {
      const Node& condition = dag().node(n.a);
      return lane_by_lane({condition.a, condition.b, n.b, n.c},
                          [](const std::vector<std::string>& x) {
                            return fmt::format("{} < {} ? {} : {}", x[0], x[1], x[2], x[3]);
                          });
    }
    std::string text;
    append_arithmetic(
        text, n, [this](std::uint32_t operand) -> const std::string& { return value(operand); });
    return text;
  }

  // What vectors have no portable operator for.
  template <typename Formula>
  std::string lane_by_lane(const std::vector<Ref>& operands, Formula formula) {
    std::vector<std::string> names;
    for (const Ref ref : operands) names.push_back(value(ref));
    if (!in_lanes()) return formula(names);
    return vector([&](std::uint32_t lane) {
      std::vector<std::string> of_lane;
      for (std::size_t k = 0; k < names.size(); ++k) {
        of_lane.push_back(dag().is_constant(operands[k]) ? names[k]
                                                         : fmt::format("{}[{}]", names[k], lane));
      }
      return formula(of_lane);
    });
  }

  // Nodes of the present region that are the sine and the cosine of this one.
  void take_sines(std::uint32_t angle, const std::string& sines, const std::string& cosines,
                  std::size_t offset) {
    for (std::uint32_t i = 0; i < dag().size(); ++i) {
      const Node& node = dag().node(i);
      if (!live_[at_][i] || !is_trigonometric(node) || node.a.node() != angle) continue;
      const std::string& array = node.op == Op::kSin ? sines : cosines;
      const std::string name = given_.unique(node.op == Op::kSin ? "sine_of" : "cosine_of");
      names_[at_][i] = name;
      if (in_lanes()) {
        line(fmt::format("{0} {1}; memcpy(&{1}, {2} + {3}, sizeof {1});", type(), name, array,
                         offset),
             node.origin);
      } else {
        line(fmt::format("const {} {} = {}[{}];", scalar_, name, array, offset), node.origin);
      }
    }
  }

  // An angle that is not the caller's.
  void sine_of(std::uint32_t angle) {
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
  void sines_of_inputs() {
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
        if (angle.op != Op::kInput || !seen.try_emplace({at_, node.a.node()}, true).second)
          continue;
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
    for (const Place& place : places) {
      at_ = place.region;
      take_sines(place.angle, "sine", "cosine", place.offset);
    }
  }

  const LimbProgram& program_;
  const FlatLayout& layout_;
  const FlatOptions& options_;
  std::string upper_, scalar_, suffix_;
  std::vector<std::string> types_;               // of each region's values
  std::vector<std::vector<std::string>> names_;  // [region][node]: or the text of a constant
  std::vector<std::vector<bool>> live_;
  std::vector<std::vector<std::vector<std::uint32_t>>> results_of_;  // [region][node]
  std::vector<std::uint32_t> later_;  // results that no region computes
  std::size_t at_ = 0;                // the region
  std::size_t groups_ = 0;
  std::map<unsigned, std::string> zeros_;  // by width: a vector of zeros
  CNames given_ = {"in", "out", "angle", "sine", "cosine"};
  LimbBody body_;
};

}  // namespace

LimbBody limb_body(const LimbProgram& program, const FlatLayout& layout,
                   const FlatOptions& options) {
  return Emitter(program, layout, options).run();
}

}  // namespace sinew::backend
