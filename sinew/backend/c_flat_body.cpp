#include "sinew/backend/c_flat_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

#include "sinew/backend/c_arithmetic.h"
#include "sinew/backend/c_flat_emitter.h"
#include "sinew/backend/c_flat_zeros.h"
#include "sinew/backend/numbers.h"
#include "sinew/base/error.h"

namespace sinew::backend {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Fewer nodes use too few constants to make up for the pointer to their table.
constexpr std::size_t kLeastInStages = 60;

}  // namespace

FlatEmitter::FlatEmitter(const Computation& computation, const FlatLayout& layout,
                         const FlatOptions& options, const FlatPlan& plan)
    : layout_(layout),
      computation_(computation),
      dag_(computation.dag),
      options_(options),
      plan_(plan),
      prefix_(options.name),
      upper_(upper_case(options.name)),
      block_form_(options.form == FlatForm::kBlock),
      scalar_(options.scalar == Scalar::kFloat ? "float" : "double"),
      suffix_(options.scalar == Scalar::kFloat ? "f" : ""),
      type_(block_form_ ? options.name + "_lanes" : scalar_),
      constant_("  const " + type_ + " "),
      names_(dag_.size()),
      memory_of_(dag_.size(), kNoSlot),
      stages_(options.form == FlatForm::kSample &&
              plan.groups.after.size() <= options.maximum_statements &&
              (plan.kept.any() || plan.groups.after.size() >= kLeastInStages)),
      table_(prefix_, upper_, scalar_, options.of + "_table") {
  for (const FlatPlace& place : layout.inputs) use(place.array);
  for (const FlatPlace& place : layout.results) use(place.array);
  use("in");
}

FlatBody FlatEmitter::run() {
  const AngleGroups& groups = plan_.groups;
  constexpr std::size_t kOfALine = 56;  // bytes, about
  result_.code.reserve(groups.after.size(), kOfALine);
  // Pointers that live while sines are computed would need registers that a call preserves.
  const bool only_inputs =
      std::all_of(groups.groups.begin(), groups.groups.end(),
                  [](const AngleGroup& group) { return group.before.empty(); });
  if (stages_ && !only_inputs) declare_kept();
  for (const AngleGroup& group : groups.groups) {
    for (const std::uint32_t node : group.before) emit(node);
    begin_step();
    angles(group);
    end_step();
  }
  if (stages_ && only_inputs) declare_kept();
  std::vector<std::uint32_t> before;
  for (std::uint32_t i = 0; i < names_.size(); ++i) {
    if (!names_[i].empty() && dag_.node(i).op != Op::kInput) before.push_back(i);
  }
  std::vector<Ref> last;  // what is read at the end
  for (const std::uint32_t k : plan_.later) last.push_back(computation_.results[k]);
  parts_ = divide_into_parts(computation_, before, groups.after, last, options_.maximum_statements);
  if (parts_.parts.empty()) {
    for (const std::uint32_t node : groups.after) emit(node);
  } else {
    call_parts(before);
  }
  begin_step();
  later_results();
  if (stages_) declare_constants();
  for (const std::string& array : arrays_) {
    if (!contains(touched_, array)) line(fmt::format("(void){};", array));
  }
  if (strided() && !contains(touched_, "n")) line("(void)n;");
  return std::move(result_);
}

void FlatEmitter::use(const std::string& array) {
  if (!contains(arrays_, array)) arrays_.push_back(array);
}

void FlatEmitter::touch(std::string_view name) {
  if (!contains(touched_, name)) touched_.emplace_back(name);
}

FlatEmitter::InMemory& FlatEmitter::in_memory(std::uint32_t node) {
  if (memory_of_[node] == kNoSlot) {
    memory_of_[node] = static_cast<std::uint32_t>(memory_.size());
    memory_.emplace_back();
  }
  return memory_[memory_of_[node]];
}

// A number of one sample: "in[3]", "in[3 * n]". What is held is the same for all samples.
std::string FlatEmitter::element(const FlatPlace& place) {
  const std::string_view array = place.array;
  const bool stride = strided() && array != "held";
  touch(array);
  if (stride) touch("n");
  const bool of_inputs = middle_of_inputs_ > 0 && array == "in";
  std::string text(of_inputs ? "inputs" : array);
  text += '[';
  text += Digits(static_cast<std::int64_t>(place.index) - (of_inputs ? middle_of_inputs_ : 0));
  return text += stride && !of_inputs ? " * n]" : "]";
}

// Where a number lies for neighbouring samples.
std::string FlatEmitter::address(const FlatPlace& place) {
  touch(place.array);
  touch("n");
  std::string text = place.array;
  text += " + ";
  text += Digits(place.index);
  return text += " * n";
}

void FlatEmitter::line(std::string_view text, std::uint32_t origin) {
  block_->add({"  ", text}, origin);
}

// TYPE NAME = VALUE;
void FlatEmitter::declare(std::string_view type, std::string_view name, std::string_view value,
                          std::uint32_t origin) {
  block_->add({"  const ", type, " ", name, " = ", value, ";"}, origin);
}

// The name of a node, which is read first if it has not been emitted, or its number.
const std::string& FlatEmitter::value(std::uint32_t i) {
  const Node& node = dag_.node(i);
  if (node.op == Op::kConstant) return constant(i, node.value);
  if (names_[i].empty()) {
    if (node.op == Op::kInput) {
      if (stages_ && !is_state(node)) return input_again(i, node);
      read_input(i, node);
    } else if (stages_) {
      read_again(i);
    } else {
      read_kept(i);
    }
  }
  return names_[i];
}

void FlatEmitter::read_input(std::uint32_t i, const Node& node) {
  names_[i] = given_.unique(layout_.input_names[node.index]);
  const FlatPlace& place = layout_.inputs[node.index];
  if (!block_form_) {
    declare(scalar_, names_[i], element(place));
    if (stages_) named_.push_back(i);
  } else if (std::string_view(place.array) == "held") {
    declare_zero();
    line(fmt::format("const {} {} = {} - zero;", type_, names_[i], element(place)));
  } else {
    line(fmt::format("{0} {1}; memcpy(&{1}, {2}, sizeof {1});", type_, names_[i], address(place)));
  }
}

void FlatEmitter::emit(std::uint32_t i) {
  const Node& node = dag_.node(i);
  if (node.op == Op::kSin || node.op == Op::kCos) return;  // the group has made it
  begin_step();
  if (is_arithmetic(node.op) && !rounds_product(i)) {
    declare_arithmetic(i, node);
    wait_in_memory(i);
    results_of(i);
    end_step();
    return;
  }
  express(node);
  names_[i] = given_.temporary();
  if (block_form_ && (node.op == Op::kSqrt || node.op == Op::kSelect)) {
    lane_by_lane(i, node);
  } else if (rounds_product(i)) {
    block_->add({"  ", type_, " ", names_[i], " = ", expression_, ";"}, node.origin);
    line(fmt::format("ROUNDED({});", names_[i]));
  } else {
    declare(type_, names_[i], expression_, node.origin);
  }
  wait_in_memory(i);
  results_of(i);
  end_step();
}

// The same as express() and declare(), at once where it belongs.
void FlatEmitter::declare_arithmetic(std::uint32_t i, const Node& node) {
  std::string& text = block_->text;
  append_arithmetic(
      text, node, [this](std::uint32_t operand) -> const std::string& { return value(operand); },
      [&] {
        names_[i] = given_.temporary();
        text += constant_;
        text += names_[i];
        text += " = ";
      });
  text += ';';
  block_->end_line(node.origin);
}

// Writes `expression_`.
void FlatEmitter::express(const Node& n) {
  expression_.clear();
  if (n.op == Op::kSqrt) {
    expression_ = fmt::format("sqrt{}({})", suffix_, value(n.a));
  } else if (n.op == Op::kSelect) {
    const Node& condition = dag_.node(n.a);
    const std::string a = value(condition.a), b = value(condition.b), x = value(n.b),
                      y = value(n.c);
    expression_ = fmt::format("{} < {} ? {} : {}", a, b, x, y);
  } else {
    append_arithmetic(
        expression_, n,
        [this](std::uint32_t operand) -> const std::string& { return value(operand); }, [] {});
  }
}

// What vectors have no portable operator for.
void FlatEmitter::lane_by_lane(std::uint32_t i, const Node& node) {
  const auto lane = [this](Ref r, const std::string& copy) {
    return dag_.is_constant(r) ? value(r) : copy + "[lane]";
  };
  line(fmt::format("{} {};", type_, names_[i]));
  line("{");
  std::vector<std::pair<Ref, std::string>> operands = {{node.a, "a"}};
  if (node.op == Op::kSelect) {
    const Node& condition = dag_.node(node.a);
    operands = {{condition.a, "a"}, {condition.b, "b"}, {node.b, "x"}, {node.c, "y"}};
  }
  for (const auto& [ref, copy] : operands) {
    if (dag_.is_constant(ref)) continue;
    line(fmt::format("  const {} {}_lanes = {};", type_, copy, value(ref)));
    line(fmt::format("  {} {}[{}_LANES];", scalar_, copy, upper_));
  }
  line(fmt::format("  {} result[{}_LANES];", scalar_, upper_));
  line("  size_t lane;");
  for (const auto& [ref, copy] : operands) {
    if (dag_.is_constant(ref)) continue;
    line(fmt::format("  memcpy({0}, &{0}_lanes, sizeof {0});", copy));
  }
  std::string expression = fmt::format("sqrt{}({})", suffix_, lane(node.a, "a"));
  if (node.op == Op::kSelect) {
    const Node& condition = dag_.node(node.a);
    expression = fmt::format("{} < {} ? {} : {}", lane(condition.a, "a"), lane(condition.b, "b"),
                             lane(node.b, "x"), lane(node.c, "y"));
  }
  line(fmt::format("  for (lane = 0; lane < {}_LANES; ++lane) result[lane] = {};", upper_,
                   expression),
       node.origin);
  line(fmt::format("  memcpy(&{0}, result, sizeof {0});", names_[i]));
  line("}");
}

void FlatEmitter::results_of(std::uint32_t node) {
  for (std::uint32_t k = plan_.result_of[node]; k != kNoSlot; k = plan_.next_result[k]) write(k);
}

void FlatEmitter::later_results() {
  for (const std::uint32_t k : plan_.later) {
    if (!dag_.is_constant(computation_.results[k])) value(computation_.results[k]);
  }
  std::vector<std::uint32_t> zeros;  // of `out`
  for (const std::uint32_t k : plan_.later) {
    const FlatPlace& place = layout_.results[k];
    if (options_.form == FlatForm::kSample && dag_.is_constant(computation_.results[k], 0.0) &&
        std::string_view(place.array) == "out") {
      zeros.push_back(place.index);
    } else {
      write(k);
    }
  }
  if (zeros.empty()) return;
  touch("out");
  write_zeros(*block_, given_, {"out", number(0.0), upper_}, zeros);
}

// A vector of zeros, once in each function. C++ has no compound literals.
void FlatEmitter::declare_zero() {
  if (!zero_) line(fmt::format("const {} zero = {{ 0 }};", type_));
  zero_ = true;
}

void FlatEmitter::write(std::uint32_t k) {
  const Ref result = computation_.results[k];
  const FlatPlace& place = layout_.results[k];
  const std::uint32_t origin = dag_.node(result).origin;
  if (!block_form_) {
    const std::string to = element(place);
    const std::string_view sign = result.negative() ? "-" : "";
    if (dag_.is_constant(result)) {
      block_->add({"  ", to, " = ", sign, number(dag_.node(result).value), ";"}, origin);
    } else {
      block_->add({"  ", to, " = ", sign, value(result.node()), ";"}, origin);
    }
    return;
  }
  const std::string sum = dag_.is_constant(result) ? value(result) + " + zero" : value(result);
  if (dag_.is_constant(result)) declare_zero();
  line(fmt::format("{{ const {0} y = {1}; memcpy({2}, &y, sizeof y); }}", type_, sum,
                   address(place)),
       origin);
}

std::string scalar_number(double value, Scalar scalar) {
  if (scalar == Scalar::kDouble) return c_number(value);
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded) || (value != 0.0 && std::abs(rounded) < FLT_MIN)) {
    throw Error(Problem{{},
                        {},
                        fmt::format("a float cannot hold the constant {}", c_number(value)),
                        "use double",
                        Severity::kError,
                        {}});
  }
  return c_number(rounded) + "f";
}

FlatBody flat_body(const Computation& computation, const FlatLayout& layout,
                   const FlatOptions& options, const FlatPlan& plan) {
  return FlatEmitter(computation, layout, options, plan).run();
}

}  // namespace sinew::backend
