#include "sinew/backend/c_flat_limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/backend/c_arithmetic.h"
#include "sinew/backend/c_flat_limb_emitter.h"
#include "sinew/backend/c_flat_zeros.h"
#include "sinew/backend/numbers.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/limbs/limb_signs.h"

namespace sinew::backend {

using program::Computation;
using program::LimbProgram;
using program::LimbRegion;
using program::LimbSource;
using program::Node;
using program::Op;
using program::Ref;

namespace {

bool is_trigonometric(const Node& node) { return node.op == Op::kSin || node.op == Op::kCos; }

}  // namespace

LimbEmitter::LimbEmitter(const LimbProgram& program, const FlatLayout& layout,
                         const FlatOptions& options)
    : program_(program),
      layout_(layout),
      options_(options),
      upper_(upper_case(options.name)),
      scalar_(options.scalar == Scalar::kFloat ? "float" : "double"),
      suffix_(options.scalar == Scalar::kFloat ? "f" : ""),
      nodes_(program),
      memory_of_(nodes_.size(), kNoSlot),
      waiting_(nodes_.size(), nullptr),
      table_(options.name, upper_, scalar_, "limbs_table"),
      constants_(nodes_.size()) {
  for (const LimbRegion& region : program.regions) {
    names_.emplace_back(region.computation.dag.size());
    live_.push_back(program::live_nodes(region.computation));
    const unsigned width = program::vector_width(region.lanes);
    if (width > 1) body_.widths.push_back(width);
    types_.push_back(region.lanes > 1 ? fmt::format("{}_limbs{}", options.name, width) : scalar_);
  }
  std::sort(body_.widths.begin(), body_.widths.end());
  body_.widths.erase(std::unique(body_.widths.begin(), body_.widths.end()), body_.widths.end());
}

LimbBody LimbEmitter::run() {
  find_results();
  std::vector<std::vector<std::uint32_t>> orders;
  for (std::size_t k = 0; k < program_.regions.size(); ++k) {
    orders.push_back(limb_order(program_.regions[k], live_[k]));
  }
  constexpr std::size_t kOfALine = 72;  // bytes, about
  std::size_t nodes = 0;
  for (const std::vector<std::uint32_t>& order : orders) nodes += order.size();
  body_.code.reserve(nodes, kOfALine);
  kept_ = keep_values(limb_steps(program_, nodes_, orders, later_));
  sines_of_inputs();
  if (kept_.any()) declare_kept(orders);
  for (at_ = 0; at_ < program_.regions.size(); ++at_) {
    for (const std::uint32_t i : orders[at_]) {
      begin_step();
      if (!is_in_memory(nodes_.of(at_, i))) value(i);
      write_results(i);
      end_step();
    }
  }
  begin_step();
  write_later_results();
  if (kept_.any()) declare_constants();
  return std::move(body_);
}

void LimbEmitter::line(std::string_view text, std::uint32_t origin) {
  body_.code.add({"  ", text}, origin);
}

// Results are written as soon as they are computed, so that they need no register to the end.
void LimbEmitter::find_results() {
  const auto count = static_cast<std::uint32_t>(program_.results.size());
  result_of_.assign(nodes_.size(), kNoSlot);
  next_result_.assign(count, kNoSlot);
  for (std::uint32_t k = count; k-- > 0;) {
    const LimbSource& source = program_.results[k];
    const bool of_region = source.kind == LimbSource::Kind::kRegion;
    const Computation* computation =
        of_region ? &program_.regions[source.region].computation : nullptr;
    const Ref ref = of_region ? computation->results[source.index] : Ref{};
    if (of_region && program::arity(computation->dag.node(ref).op) > 0) {
      next_result_[k] = std::exchange(result_of_[nodes_.of(source.region, ref.node())], k);
    } else {
      later_.push_back(k);
    }
  }
  std::reverse(later_.begin(), later_.end());
}

void LimbEmitter::write(std::uint32_t k) {
  const FlatPlace& place = layout_.results[k];
  const std::string from = text(program_.results[k]);
  body_.code.add({"  ", place.array, "[", Digits(place.index), "] = ", from, ";"});
}

// Of a node that has just been computed. A vector of which several lanes are wanted negative is
// negated once.
void LimbEmitter::write_results(std::uint32_t node) {
  const std::uint32_t first = result_of_[nodes_.of(at_, node)];
  const auto is_negative = [&](std::uint32_t k) {
    const Source& source = program_.results[k];
    return region().computation.results[source.index].negative() != source.negative;
  };
  int negatives = 0;
  for (std::uint32_t k = first; k != kNoSlot; k = next_result_[k]) negatives += is_negative(k);
  std::string turned;
  if (in_lanes() && negatives > 1) {
    const std::string name = name_of(at_, node);
    turned = given_.temporary();
    body_.code.add({"  const ", type(), " ", turned, " = -", name, ";"});
  }
  for (std::uint32_t k = first; k != kNoSlot; k = next_result_[k]) {
    if (turned.empty() || !is_negative(k)) {
      write(k);
    } else {
      const FlatPlace& place = layout_.results[k];
      line(fmt::format("{}[{}] = {}[{}];", place.array, place.index, turned,
                       program_.results[k].lane));
    }
  }
}

// Those that no region computes: among them many zeros.
void LimbEmitter::write_later_results() {
  std::vector<std::uint32_t> zeros;
  for (const std::uint32_t k : later_) {
    if (is_zero(program_.results[k])) {
      zeros.push_back(layout_.results[k].index);
    } else {
      write(k);
    }
  }
  write_zeros(body_.code, given_, {"out", number(0.0), upper_}, zeros);
}

bool LimbEmitter::is_zero(const LimbSource& source) const {
  if (source.kind == LimbSource::Kind::kConstant) return source.value == 0.0;
  if (source.kind != LimbSource::Kind::kRegion) return false;
  const Computation& from = program_.regions[source.region].computation;
  return from.dag.is_constant(from.results[source.index], 0.0);
}

// A number of the caller's.
std::string LimbEmitter::element(const FlatPlace& place) const {
  const bool from_middle = middle_of_inputs_ != 0 && std::string_view(place.array) == "in";
  std::string text = from_middle ? "inputs" : place.array;
  text += '[';
  text += Digits(static_cast<int>(place.index) - (from_middle ? middle_of_inputs_ : 0));
  return text += ']';
}

// A number where plain numbers are wanted.
std::string LimbEmitter::text(const LimbSource& source) {
  switch (source.kind) {
    case LimbSource::Kind::kConstant:
      return number(source.value);
    case LimbSource::Kind::kCaller: {
      const FlatPlace& place = layout_.inputs[source.index];
      return element(place);
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
  return (negative ? "-" : "") + lane_of(source.region, ref.node(), source.lane);
}

// { lane 0, lane 1, … } of the region's vector type.
template <typename Lane>
std::string LimbEmitter::vector(Lane lane) const {
  const std::uint32_t lanes = region().lanes;
  std::string list;
  for (unsigned k = 0; k < program::vector_width(lanes); ++k) {
    list += k == 0 ? "{ " : ", ";
    list += lane(k < lanes ? k : 0);
  }
  return list += " }";
}

// A vector of zeros of the region's type. C++ has no compound literals.
std::string LimbEmitter::zero() {
  std::string& name = zeros_[program::vector_width(region().lanes)];
  if (name.empty()) {
    name = given_.unique("zero");
    line(fmt::format("const {} {} = {{ 0 }};", type(), name));
  }
  return name;
}

// An input of the present region, by a name of the region's type.
std::string LimbEmitter::input(const Node& node) {
  const Sources& sources = region().inputs[node.index];
  const LimbSource& first = sources[0];
  const std::string name = first.kind == LimbSource::Kind::kCaller
                               ? given_.unique(layout_.input_names[first.index])
                               : given_.temporary();
  if (!in_lanes()) {
    body_.code.add({"  const ", scalar_, " ", name, " = ", text(first), ";"});
    return name;
  }
  if (const auto same = same_vector(sources)) {
    body_.code.add({"  const ", type(), " ", name, " = ", *same, ";"});
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
  texts.reserve(sources.size());
  for (const LimbSource& source : sources) texts.push_back(text(source));
  const std::string lanes =
      vector([&](std::uint32_t lane) -> const std::string& { return texts[lane]; });
  body_.code.add({"  const ", type(), " ", name, " = ", lanes, ";"});
  return name;
}

// The name of a vector of an earlier region that holds exactly these numbers.
std::optional<std::string> LimbEmitter::same_vector(const Sources& sources) {
  const LimbSource& first = sources[0];
  if (!program::is_whole_vector(program_, sources)) return std::nullopt;
  const LimbRegion& from = program_.regions[first.region];
  const Ref ref = from.computation.results[first.index];
  if (program::arity(from.computation.dag.node(ref).op) == 0) return std::nullopt;
  return (ref.negative() != first.negative ? "-" : "") + name_of(first.region, ref.node());
}

const std::string& LimbEmitter::value(std::uint32_t i) {
  const Node& node = dag().node(i);
  std::string& name = names_[at_][i];
  if (is_constant(node)) {
    constant(i, node, name);
    return name;
  }
  if (!name.empty()) return name;
  if (is_in_memory(nodes_.of(at_, i))) {
    name_of(at_, i);
  } else {
    compute(i, node);
  }
  return name;
}

void LimbEmitter::compute(std::uint32_t i, const Node& node) {
  if (node.op == Op::kInput) {
    names_[at_][i] = input(node);
    wait_in_memory(i);
    const LimbSource& from = region().inputs[node.index][0];
    if (!in_lanes() && from.kind == LimbSource::Kind::kCaller) named_.emplace_back(at_, i);
    return;
  }
  if (is_trigonometric(node)) {
    sine_of(node.a.node());
    return;
  }
  if (is_arithmetic(node.op)) {
    std::string& text = body_.code.text;
    append_arithmetic(
        text, node, [this](std::uint32_t operand) -> const std::string& { return value(operand); },
        [&] {
          std::string& name = names_[at_][i];
          name = given_.temporary();
          text += "  const ";
          text += type();
          text += ' ';
          text += name;
          text += " = ";
        });
    text += ';';
    body_.code.end_line(node.origin);
    wait_in_memory(i);
    return;
  }
  const std::string expression = express(node);  // which may compute others
  std::string& name = names_[at_][i];
  name = given_.temporary();
  body_.code.add({"  const ", type(), " ", name, " = ", expression, ";"}, node.origin);
  wait_in_memory(i);
}

// What vectors have no portable operator for.
template <typename Formula>
std::string LimbEmitter::lane_by_lane(const std::vector<Ref>& operands, Formula formula) {
  std::vector<std::string> names;
  for (const Ref ref : operands) {
    const Node& node = dag().node(ref);
    names.push_back(node.op == Op::kConstant ? number(node.value) : value(ref));
  }
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

// A square root or a choice.
std::string LimbEmitter::express(const Node& n) {
  if (n.op == Op::kSqrt)
    return lane_by_lane({n.a}, [&](const std::vector<std::string>& x) {
      return fmt::format("sqrt{}({})", suffix_, x[0]);
    });
  const Node& condition = dag().node(n.a);
  return lane_by_lane({condition.a, condition.b, n.b, n.c}, [](const std::vector<std::string>& x) {
    return fmt::format("{} < {} ? {} : {}", x[0], x[1], x[2], x[3]);
  });
}

LimbBody limb_body(const LimbProgram& program, const FlatLayout& layout,
                   const FlatOptions& options) {
  return LimbEmitter(program, layout, options).run();
}

}  // namespace sinew::backend
