#include "sinew/data/formula.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "sinew/base/spelling.h"
#include "sinew/data/scanner.h"

namespace sinew::data {
namespace {

using Op = ScalarOperation;
using Node = ScalarGraph::Node;

// What an expression is worth: a node of the graph, its dimension (nothing: fits every other), and
// the words that say it.
struct Value {
  Node node = 0;
  std::optional<Dimension> dimension;
  std::size_t from = 0, to = 0;
};

Dimension without_angle(Dimension dimension) {
  dimension.exponents[std::size_t(BaseQuantity::kAngle)] = 0;
  return dimension;
}

std::string name_of(const Dimension& dimension) {
  return dimension.dimensionless() ? "none" : to_string(dimension);
}

std::optional<Dimension> without_angle(const std::optional<Dimension>& dimension) {
  return dimension ? std::optional(without_angle(*dimension)) : std::nullopt;
}

class Parser {
 public:
  Parser(Scanner& scanner, std::span<const FormulaParameter> inputs,
         std::span<const FormulaParameter> outputs)
      : scanner_(scanner), outputs_(outputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      names_[inputs[i].name] = {formula_.graph.input(static_cast<std::uint32_t>(i)),
                                without_angle(inputs[i].dimension), 0, 0};
    }
    for (const FormulaParameter& output : outputs) output_names_.push_back(output.name);
    results_.resize(outputs.size());
  }

  Formula parse() {
    while (!scanner_.at_end()) {
      const bool local = scanner_.take("let");
      const Place place = scanner_.place();
      const std::string name = dotted_name();
      scanner_.expect("=");
      const Value value = expression(0);
      if (local) {
        if (!names_.emplace(name, value).second) {
          fail(place, fmt::format("'{}' has a value already", name), "choose another name");
        }
      } else {
        give_output(place, name, value);
      }
      if (!scanner_.take(";")) scanner_.take(",");
    }
    for (std::size_t i = 0; i < results_.size(); ++i) {
      if (!results_[i]) {
        scanner_.fail(fmt::format("the formula does not give '{}'", output_names_[i]),
                      "give every parameter once");
      }
      formula_.outputs.push_back(*results_[i]);
    }
    return std::move(formula_);
  }

 private:
  [[noreturn]] static void fail(const Place& place, std::string what, std::string remedy) {
    throw Error(Problem{place, {}, std::move(what), std::move(remedy), Severity::kError, {}});
  }

  void give_output(const Place& place, const std::string& name, const Value& value) {
    for (std::size_t i = 0; i < output_names_.size(); ++i) {
      if (output_names_[i] != name) continue;
      if (results_[i]) fail(place, fmt::format("'{}' is given twice", name), "leave one out");
      const auto wanted = without_angle(outputs_[i].dimension);
      if (wanted && value.dimension && *wanted != *value.dimension) {
        fail(place,
             fmt::format("'{}' has the dimension {}, but '{}' has {}", name, name_of(*wanted),
                         text(value), name_of(*value.dimension)),
             "both sides have the same dimension");
      }
      results_[i] = value.node;
      return;
    }
    fail(place, fmt::format("'{}' is no parameter of the result", name),
         did_you_mean(name, output_names_,
                      fmt::format("write 'let' before it, or use one of {}",
                                  fmt::join(output_names_, ", "))));
  }

  std::string dotted_name() {
    std::string name = scanner_.expect_name("a name");
    while (scanner_.take(".")) name += "." + scanner_.expect_name("a name");
    return name;
  }

  // ---- dimensions ----

  std::string text(const Value& value) const { return scanner_.words(value.from, value.to); }

  // The dimension of two values that have to have the same one.
  std::optional<Dimension> common(const Place& place, const Value& a, const Value& b,
                                  std::string_view why) const {
    if (a.dimension && b.dimension && *a.dimension != *b.dimension) {
      fail(place,
           fmt::format("'{}' has the dimension {}, but '{}' has {}", text(a), name_of(*a.dimension),
                       text(b), name_of(*b.dimension)),
           std::string(why));
    }
    return a.dimension ? a.dimension : b.dimension;
  }

  void require_number(const Place& place, const Value& value, std::string_view function) const {
    if (!value.dimension || value.dimension->dimensionless()) return;
    fail(place,
         fmt::format("'{}' has the dimension {}, but {} takes {}", text(value),
                     name_of(*value.dimension), function,
                     function.starts_with('a') ? "a pure number" : "an angle"),
         "divide by something of the same dimension");
  }

  std::optional<Dimension> product_dimension(const Place& place, const Value& a, const Value& b,
                                             int sign) const {
    if (!a.dimension || !b.dimension) return std::nullopt;
    Dimension result;
    for (std::size_t i = 0; i < kBaseQuantities; ++i) {
      const int exponent = a.dimension->exponents[i] + sign * b.dimension->exponents[i];
      if (exponent > kMaximumExponent || exponent < -kMaximumExponent) {
        fail(place, fmt::format("a dimension's exponent is {}", exponent),
             fmt::format("exponents go to {}", kMaximumExponent));
      }
      result.exponents[i] = exponent;
    }
    return result;
  }

  std::optional<Dimension> root_dimension(const Place& place, const Value& value) const {
    if (!value.dimension) return std::nullopt;
    Dimension result = *value.dimension;
    for (int& exponent : result.exponents) {
      if (exponent % 2 != 0) {
        fail(place,
             fmt::format("'{}' has the dimension {}, which has no square root", text(value),
                         name_of(*value.dimension)),
             "take the root of a product");
      }
      exponent /= 2;
    }
    return result;
  }

  std::optional<Dimension> result_dimension(const Place& place, Op operation,
                                            const Value (&operands)[3]) const {
    const auto& [a, b, c] = operands;
    switch (operation) {
      case Op::kSine:
      case Op::kCosine:
      case Op::kTangent:
      case Op::kArcSine:
      case Op::kArcCosine:
        require_number(place, a, row(operation).name);
        return Dimension{};
      case Op::kSquareRoot:
        return root_dimension(place, a);
      case Op::kArcTangent2:
        common(place, a, b, "atan2 takes two of the same dimension");
        return Dimension{};
      case Op::kHypotenuse:
      case Op::kMinimum:
      case Op::kMaximum:
        return common(place, a, b,
                      fmt::format("{} takes two of the same dimension", row(operation).name));
      case Op::kSelect:
        return common(place, b, c, "select chooses between two of the same dimension");
      default:
        return a.dimension;
    }
  }

  // ---- expressions ----

  Value value_of(Node node, std::optional<Dimension> dimension, std::size_t from) const {
    return {node, dimension, from, scanner_.position()};
  }

  Value expression(std::size_t depth) {
    const std::size_t from = scanner_.position();
    const Value left = sum(depth);
    // a <= b is not (b < a); for numbers that are no NaN it is.
    for (const auto& [mark, turned, negate] :
         {std::tuple("<", false, false), std::tuple(">", true, false), std::tuple("<=", true, true),
          std::tuple(">=", false, true)}) {
      const Place place = scanner_.place();
      if (!scanner_.take(mark)) continue;
      const Value right = sum(depth);
      common(place, left, right, "only what has the same dimension can be compared");
      Node node = formula_.graph.apply(Op::kLess, turned ? right.node : left.node,
                                       turned ? left.node : right.node);
      if (negate) node = negated(node);
      return value_of(node, Dimension{}, from);
    }
    return left;
  }

  Node negated(Node condition) {
    return formula_.graph.apply(Op::kSelect, condition, formula_.graph.constant(0),
                                formula_.graph.constant(1));
  }

  Value sum(std::size_t depth) {
    const std::size_t from = scanner_.position();
    Value left = product(depth);
    while (true) {
      const Place place = scanner_.place();
      const bool plus = scanner_.take("+");
      if (!plus && !scanner_.take("-")) return left;
      const Value right = product(depth);
      const auto dimension = common(place, left, right,
                                    plus ? "only what has the same dimension can be added"
                                         : "only what has the same dimension can be subtracted");
      left = value_of(formula_.graph.apply(plus ? Op::kAdd : Op::kSubtract, left.node, right.node),
                      dimension, from);
    }
  }

  Value product(std::size_t depth) {
    const std::size_t from = scanner_.position();
    Value left = factor(depth);
    while (true) {
      const Place place = scanner_.place();
      const bool times = scanner_.take("*");
      if (!times && !scanner_.take("/")) return left;
      const Value right = factor(depth);
      left =
          value_of(formula_.graph.apply(times ? Op::kMultiply : Op::kDivide, left.node, right.node),
                   product_dimension(place, left, right, times ? 1 : -1), from);
    }
  }

  Value factor(std::size_t depth) {
    if (depth > kMaximumFormulaDepth) {
      scanner_.fail(fmt::format("the formula is nested more than {} deep", kMaximumFormulaDepth),
                    "name its parts with 'let'");
    }
    const std::size_t from = scanner_.position();
    if (scanner_.take("-")) {
      const Value value = factor(depth + 1);
      return value_of(formula_.graph.apply(Op::kNegate, value.node), value.dimension, from);
    }
    if (scanner_.take("(")) {
      const Value inner = expression(depth + 1);
      scanner_.expect(")");
      return value_of(inner.node, inner.dimension, from);
    }
    if (scanner_.peek().kind == Word::Kind::kNumber) return number();
    const Place place = scanner_.place();
    const std::string name = dotted_name();
    if (scanner_.peek().text == "(") return call(place, name, depth, from);
    if (const auto known = names_.find(name); known != names_.end()) {
      return value_of(known->second.node, known->second.dimension, from);
    }
    if (name == "pi") return value_of(formula_.graph.constant(std::numbers::pi), Dimension{}, from);
    std::vector<std::string> candidates;
    for (const auto& [known, value] : names_) candidates.push_back(known);
    fail(place, fmt::format("'{}' has no value here", name),
         did_you_mean(name, candidates, fmt::format("use one of {}", fmt::join(candidates, ", "))));
  }

  Value call(const Place& place, const std::string& name, std::size_t depth, std::size_t from) {
    for (std::size_t i = 0; i <= std::size_t(Op::kSelect); ++i) {
      const Op operation = static_cast<Op>(i);
      if (row(operation).name != name || name.empty()) continue;
      Value operands[3] = {};
      scanner_.expect("(");
      for (int k = 0; k < row(operation).operands; ++k) {
        if (k > 0) scanner_.expect(",");
        operands[k] = expression(depth + 1);
      }
      scanner_.expect(")");
      const Node node =
          formula_.graph.apply(operation, operands[0].node, operands[1].node, operands[2].node);
      return value_of(node, result_dimension(place, operation, operands), from);
    }
    std::vector<std::string> functions;
    for (std::size_t i = 0; i <= std::size_t(Op::kSelect); ++i) {
      if (!row(static_cast<Op>(i)).name.empty())
        functions.emplace_back(row(static_cast<Op>(i)).name);
    }
    fail(place, fmt::format("there is no function '{}'", name),
         did_you_mean(name, functions, fmt::format("use one of {}", fmt::join(functions, ", "))));
  }

  // 2, 0.5, 1e-8: the scanner cuts at '.' and '-', so the parts are joined again here.
  Value number() {
    const std::size_t from = scanner_.position();
    std::string text = scanner_.next().text;
    if (scanner_.peek().text == ".") {
      scanner_.next();
      text += ".";
      if (scanner_.peek().kind == Word::Kind::kNumber) text += scanner_.next().text;
    }
    if ((text.back() == 'e' || text.back() == 'E') &&
        (scanner_.peek().text == "-" || scanner_.peek().text == "+")) {
      text += scanner_.next().text;
      text += scanner_.next().text;
    }
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) {
      scanner_.fail(fmt::format("'{}' is no number", text));
    }
    const auto dimension = value == 0 ? std::nullopt : std::optional(Dimension{});
    return value_of(formula_.graph.constant(value), dimension, from);
  }

  Scanner& scanner_;
  std::span<const FormulaParameter> outputs_;
  std::vector<std::string> output_names_;
  std::map<std::string, Value> names_;
  std::vector<std::optional<Node>> results_;
  Formula formula_;
};

}  // namespace

Formula parse_formula(std::string_view text, const Place& place,
                      std::span<const FormulaParameter> inputs,
                      std::span<const FormulaParameter> outputs) {
  Scanner scanner(text, place, {.marks = {"<=", ">="}});
  return Parser(scanner, inputs, outputs).parse();
}

}  // namespace sinew::data
