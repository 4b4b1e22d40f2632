#include "sinew/backend/c_flat_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "sinew/backend/angle_groups.h"
#include "sinew/backend/c_arithmetic.h"
#include "sinew/backend/c_names.h"
#include "sinew/backend/flat_parts.h"
#include "sinew/backend/numbers.h"
#include "sinew/base/error.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

// Fewer zeros than this are written one by one.
constexpr std::size_t kLeastZeros = 4;

class Emitter {
 public:
  Emitter(const Computation& computation, const FlatLayout& layout, const FlatOptions& options)
      : layout_(layout),
        computation_(computation),
        dag_(computation.dag),
        options_(options),
        prefix_(options.name),
        upper_(upper_case(options.name)),
        block_form_(options.form == FlatForm::kBlock),
        scalar_(options.scalar == Scalar::kFloat ? "float" : "double"),
        suffix_(options.scalar == Scalar::kFloat ? "f" : ""),
        type_(block_form_ ? options.name + "_lanes" : scalar_),
        names_(dag_.size()),
        constants_(dag_.size()) {
    for (const FlatPlace& place : layout.inputs) use(place.array);
    for (const FlatPlace& place : layout.results) use(place.array);
    use("in");
  }

  FlatBody run() {
    find_results();
    const AngleGroups groups = group_angles(computation_);
    for (const AngleGroup& group : groups.groups) {
      for (const std::uint32_t node : group.before) emit(node);
      angles(group);
    }
    std::vector<std::uint32_t> before;
    for (std::uint32_t i = 0; i < names_.size(); ++i) {
      if (!names_[i].empty() && dag_.node(i).op != Op::kInput) before.push_back(i);
    }
    std::vector<Ref> last;  // what is read at the end
    for (const std::uint32_t k : later_) last.push_back(computation_.results[k]);
    parts_ =
        divide_into_parts(computation_, before, groups.after, last, options_.maximum_statements);
    if (parts_.parts.empty()) {
      for (const std::uint32_t node : groups.after) emit(node);
    } else {
      call_parts(before);
    }
    later_results();
    for (const std::string& array : arrays_) {
      if (!touched_.contains(array)) line(fmt::format("(void){};", array));
    }
    if (strided() && !touched_.contains("n")) line("(void)n;");
    return std::move(result_);
  }

 private:
  bool strided() const { return options_.form != FlatForm::kSample; }

  void use(const std::string& array) {
    if (std::find(arrays_.begin(), arrays_.end(), array) == arrays_.end()) arrays_.push_back(array);
  }

  // A number of one sample: "in[3]", "in[3 * n]". What is held is the same for all samples.
  std::string element(const FlatPlace& place) {
    const bool stride = strided() && std::string_view(place.array) != "held";
    touched_.insert(place.array);
    if (stride) touched_.insert("n");
    return fmt::format("{}[{}{}]", place.array, place.index, stride ? " * n" : "");
  }

  // Where a number lies for neighbouring samples.
  std::string address(const FlatPlace& place) {
    touched_.insert(place.array);
    touched_.insert("n");
    return fmt::format("{} + {} * n", place.array, place.index);
  }

  std::string number(double value) const { return scalar_number(value, options_.scalar); }

  void line(std::string_view text, std::uint32_t origin = program::kNoOrigin) {
    block_->add({"  ", text}, origin);
  }
  // TYPE NAME = VALUE;
  void declare(std::string_view type, std::string_view name, std::string_view value,
               std::uint32_t origin = program::kNoOrigin) {
    block_->add({"  const ", type, " ", name, " = ", value, ";"}, origin);
  }

  // Keeps what the parts need of what has been computed, and calls them; their code goes to
  // `parts`.
  void call_parts(const std::vector<std::uint32_t>& before) {
    std::string parameters, arguments;
    for (const std::string& array : arrays_) {
      if (array == "in" || array == "out") continue;
      // Parts write to `out` only.
      parameters += fmt::format(", const {} *{}", scalar_, array);
      arguments += ", " + array;
    }
    if (strided()) {
      parameters += ", size_t n";
      arguments += ", n";
      touched_.insert("n");
    }
    const bool has_out = std::find(arrays_.begin(), arrays_.end(), "out") != arrays_.end();
    if (has_out) {
      parameters += fmt::format(", {} *{}_RESTRICT out", scalar_, upper_);
      arguments += ", out";
    }
    for (const std::string& array : arrays_) touched_.insert(array);
    line(fmt::format("{0}_ALIGNED {3} kept[{1}{2}];", upper_, parts_.slots,
                     block_form_ ? fmt::format(" * {}_LANES", upper_) : "", scalar_));
    for (const std::uint32_t node : before) keep(node);
    for (std::size_t k = 0; k < parts_.parts.size(); ++k) {
      result_.part_names.push_back(
          fmt::format("{}{}_part{}", options_.of, block_form_ ? "_block" : "", k + 1));
      const std::string function = prefix_ + "_" + result_.part_names.back();
      line(fmt::format("{}(in, kept{});", function, arguments));
      block_ = &result_.parts;
      const bool zero_outside = std::exchange(zero_, false);
      forget();
      block_->add(fmt::format("{0}_APART void {1}(const {3} *in, {3} *kept{2}) {{", upper_,
                              function, parameters, scalar_));
      for (const std::uint32_t node : parts_.parts[k]) {
        emit(node);
        keep(node);
      }
      line("(void)in;");
      for (const std::string& array : arrays_) {
        if (array != "in") line(fmt::format("(void){};", array));
      }
      if (strided()) line("(void)n;");
      block_->add("}");
      block_->add("");
      block_ = &result_.code;
      zero_ = zero_outside;
    }
    forget();
  }

  // Values that another function has computed are read from where they are kept.
  void forget() {
    for (std::string& name : names_) name.clear();
  }

  void keep(std::uint32_t node) {
    const std::uint32_t slot = parts_.slot[node];
    if (slot == FlatParts::kNoSlot) return;
    if (block_form_) {
      line(fmt::format("memcpy(kept + {0} * {1}_LANES, &{2}, sizeof {2});", slot, upper_,
                       names_[node]));
    } else {
      const fmt::format_int index(slot);
      block_->add({"  kept[", {index.data(), index.size()}, "] = ", names_[node], ";"});
    }
  }

  void read_kept(std::uint32_t node) {
    names_[node] = given_.unique(fmt::format("k{}", parts_.slot[node]));
    if (block_form_) {
      line(fmt::format("{0} {1}; memcpy(&{1}, kept + {2} * {3}_LANES, sizeof {1});", type_,
                       names_[node], parts_.slot[node], upper_));
    } else {
      line(fmt::format("const {} {} = kept[{}];", scalar_, names_[node], parts_.slot[node]));
    }
  }

  // The name of a node, which is read first if it has not been emitted, or its number.
  const std::string& value(std::uint32_t i) {
    const Node& node = dag_.node(i);
    if (node.op == Op::kConstant) {
      if (constants_[i].empty()) constants_[i] = number(node.value);
      return constants_[i];
    }
    if (names_[i].empty()) {
      if (node.op == Op::kInput) {
        read_input(i, node);
      } else {
        read_kept(i);
      }
    }
    return names_[i];
  }
  std::string value(Ref ref) { return (ref.negative() ? "-" : "") + value(ref.node()); }

  void read_input(std::uint32_t i, const Node& node) {
    names_[i] = given_.unique(layout_.input_names[node.index]);
    const FlatPlace& place = layout_.inputs[node.index];
    if (!block_form_) {
      declare(scalar_, names_[i], element(place));
    } else if (std::string_view(place.array) == "held") {
      declare_zero();
      line(fmt::format("const {} {} = {} - zero;", type_, names_[i], element(place)));
    } else {
      line(
          fmt::format("{0} {1}; memcpy(&{1}, {2}, sizeof {1});", type_, names_[i], address(place)));
    }
  }

  void emit(std::uint32_t i) {
    const Node& node = dag_.node(i);
    if (node.op == Op::kSin || node.op == Op::kCos) return;  // the group has made it
    express(node);
    names_[i] = given_.temporary();
    if (block_form_ && (node.op == Op::kSqrt || node.op == Op::kSelect)) {
      lane_by_lane(i, node);
    } else {
      declare(type_, names_[i], expression_, node.origin);
    }
    results_of(i);
  }

  // Writes `expression_`.
  void express(const Node& n) {
    expression_.clear();
    if (n.op == Op::kSqrt) {
      expression_ = fmt::format("sqrt{}({})", suffix_, value(n.a));
    } else if (n.op == Op::kSelect) {
      const Node& condition = dag_.node(n.a);
      const std::string a = value(condition.a), b = value(condition.b), x = value(n.b),
                        y = value(n.c);
      expression_ = fmt::format("{} < {} ? {} : {}", a, b, x, y);
    } else {
      append_arithmetic(expression_, n, [this](std::uint32_t operand) -> const std::string& {
        return value(operand);
      });
    }
  }

  // What vectors have no portable operator for.
  void lane_by_lane(std::uint32_t i, const Node& node) {
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

  // Sines and cosines of a group of angles.
  void angles(const AngleGroup& group) {
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
    line(fmt::format("{2}_ALIGNED {3} sine{0}[{1}], cosine{0}[{1}];", tag,
                     block_form_ ? lanes : std::to_string(padded), upper_, scalar_));
    std::string from;
    const auto each = [&](auto text) {
      std::string sum;
      for (std::size_t k = 0; k < n; ++k) sum += (k == 0 ? "" : " + ") + text(k);
      return sum;
    };
    std::string squares;
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
      squares = fmt::format("{}_squares({}, {})", prefix_, from, lanes);
    } else if (contiguous(group, padded)) {
      const std::uint32_t first = layout_.inputs[dag_.node(group.angles[0]).index].index;
      touched_.insert("in");
      from = fmt::format("in + {}", first);
      squares = each([&](std::size_t k) { return fmt::format("in[{0}] * in[{0}]", first + k); });
    } else {
      std::string list;
      for (const std::uint32_t angle : group.angles)
        list += (list.empty() ? "" : ", ") + value(angle);
      line(fmt::format("{}_ALIGNED const {} angle{}[{}] = {{ {} }};", upper_, scalar_, tag, padded,
                       list));
      from = "angle" + tag;
      squares = each([&](std::size_t k) { return fmt::format("{0}[{1}] * {0}[{1}]", from, k); });
    }
    line(fmt::format("{}_sincos_all({}, sine{}, cosine{}, {}, {});", prefix_, from, tag, tag,
                     block_form_ ? lanes : std::to_string(n), squares));
    for (std::size_t k = 0; k < n; ++k) {
      const Node& node = dag_.node(group.angles[k]);
      const std::string angle =
          node.op == Op::kInput ? layout_.input_names[node.index] : names_[group.angles[k]];
      take(group.sines[k], "sin_" + angle, "sine" + tag, k);
      take(group.cosines[k], "cos_" + angle, "cosine" + tag, k);
    }
    result_.angles += n;
  }

  bool is_held(const Node& node) const {
    return node.op == Op::kInput && std::string_view(layout_.inputs[node.index].array) == "held";
  }

  // Whether the angles are neighbours in `in`, with others behind them up to the padded size.
  bool contiguous(const AngleGroup& group, std::size_t padded) const {
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
  void angles_one_by_one(const AngleGroup& group) {
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

  void take(std::uint32_t node, const std::string& name, const std::string& array, std::size_t k) {
    if (node == AngleGroup::kNone) return;
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

  // Results go to `out` as soon as they are computed, so that they need no register to the end.
  // States may not be written before all have been read: with what is no operation, they come last.
  void find_results() {
    results_of_.resize(dag_.size());
    for (std::uint32_t k = 0; k < computation_.results.size(); ++k) {
      const std::uint32_t node = computation_.results[k].node();
      const Op op = dag_.node(node).op;
      const bool at_once = std::string_view(layout_.results[k].array) == "out" &&
                           program::arity(op) > 0 && op != Op::kSin && op != Op::kCos;
      (at_once ? results_of_[node] : later_).push_back(k);
    }
  }

  void results_of(std::uint32_t node) {
    for (const std::uint32_t k : results_of_[node]) write(k);
  }

  void later_results() {
    for (const std::uint32_t k : later_) value(computation_.results[k]);
    for (std::size_t at = 0; at < later_.size();) {
      const std::size_t zeros = block_form_ || strided() ? 0 : zeros_from(at);
      if (zeros >= kLeastZeros) {
        const FlatPlace& place = layout_.results[later_[at]];
        touched_.insert(place.array);
        line(fmt::format("memset({0} + {1}, 0, {2} * sizeof *{0});", place.array, place.index,
                         zeros));
        at += zeros;
      } else {
        write(later_[at++]);
      }
    }
  }

  // How many results from this one on are 0 and lie side by side.
  std::size_t zeros_from(std::size_t at) const {
    std::size_t n = 0;
    const FlatPlace& first = layout_.results[later_[at]];
    for (; at + n < later_.size(); ++n) {
      const std::uint32_t k = later_[at + n];
      const FlatPlace& place = layout_.results[k];
      if (!dag_.is_constant(computation_.results[k], 0.0) || place.index != first.index + n ||
          std::string_view(place.array) != first.array) {
        break;
      }
    }
    return n;
  }

  // A vector of zeros, once in each function. C++ has no compound literals.
  void declare_zero() {
    if (!zero_) line(fmt::format("const {} zero = {{ 0 }};", type_));
    zero_ = true;
  }

  void write(std::uint32_t k) {
    const Ref result = computation_.results[k];
    const FlatPlace& place = layout_.results[k];
    const std::uint32_t origin = dag_.node(result).origin;
    if (!block_form_) {
      const std::string to = element(place);
      block_->add({"  ", to, " = ", value(result), ";"}, origin);
      return;
    }
    const std::string number = dag_.is_constant(result) ? value(result) + " + zero" : value(result);
    if (dag_.is_constant(result)) declare_zero();
    line(fmt::format("{{ const {0} y = {1}; memcpy({2}, &y, sizeof y); }}", type_, number,
                     address(place)),
         origin);
  }

  const FlatLayout& layout_;
  const Computation& computation_;
  const program::Dag& dag_;
  const FlatOptions& options_;
  std::string prefix_, upper_;
  bool block_form_;
  std::string scalar_, suffix_;  // "float", "f" behind the names of functions
  std::string type_;             // of a value
  std::vector<std::string> arrays_;
  std::unordered_set<std::string> touched_;             // arrays, and n, that the code names
  std::vector<std::string> names_;                      // of nodes; empty: not emitted yet
  std::vector<std::string> constants_;                  // their texts, once they are used
  std::string expression_;                              // of the statement that is being written
  std::vector<std::vector<std::uint32_t>> results_of_;  // of a node: written with it
  std::vector<std::uint32_t> later_;                    // results that are written at the end
  bool zero_ = false;
  FlatParts parts_;
  CNames given_ = {"in",   "out",    "state",   "held",    "n",       "kept",   "angle",
                   "sine", "cosine", "lane",    "zero",    "result",  "y",      "a",
                   "b",    "x",      "a_lanes", "b_lanes", "x_lanes", "y_lanes"};
  FlatBody result_;
  CodeBlock* block_ = &result_.code;
};

}  // namespace

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
                   const FlatOptions& options) {
  return Emitter(computation, layout, options).run();
}

}  // namespace sinew::backend
