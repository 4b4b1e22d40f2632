#include "sinew/data/formula.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <numbers>
#include <optional>

#include "sinew/data/scanner.h"
#include "sinew/data/spelling.h"

namespace sinew::data {
namespace {

using Op = ScalarOperation;
using Node = ScalarGraph::Node;

class Parser {
 public:
  Parser(Scanner& scanner, std::span<const std::string> inputs,
         std::span<const std::string> outputs)
      : scanner_(scanner), output_names_(outputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      names_[inputs[i]] = formula_.graph.input(static_cast<std::uint32_t>(i));
    }
    results_.resize(outputs.size());
  }

  Formula parse() {
    while (!scanner_.at_end()) {
      const bool local = scanner_.take("let");
      const Place place = scanner_.place();
      const std::string name = dotted_name();
      scanner_.expect("=");
      const Node value = expression(0);
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

  void give_output(const Place& place, const std::string& name, Node value) {
    for (std::size_t i = 0; i < output_names_.size(); ++i) {
      if (output_names_[i] != name) continue;
      if (results_[i]) fail(place, fmt::format("'{}' is given twice", name), "leave one out");
      results_[i] = value;
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

  Node expression(std::size_t depth) {
    Node left = sum(depth);
    if (scanner_.take("<")) return formula_.graph.apply(Op::kLess, left, sum(depth));
    if (scanner_.take(">")) return formula_.graph.apply(Op::kLess, sum(depth), left);
    // a <= b is not (b < a); for numbers that are no NaN it is.
    if (scanner_.take("<=")) return negated(formula_.graph.apply(Op::kLess, sum(depth), left));
    if (scanner_.take(">=")) return negated(formula_.graph.apply(Op::kLess, left, sum(depth)));
    return left;
  }

  Node negated(Node condition) {
    return formula_.graph.apply(Op::kSelect, condition, formula_.graph.constant(0),
                                formula_.graph.constant(1));
  }

  Node sum(std::size_t depth) {
    Node left = product(depth);
    while (true) {
      if (scanner_.take("+")) {
        left = formula_.graph.apply(Op::kAdd, left, product(depth));
      } else if (scanner_.take("-")) {
        left = formula_.graph.apply(Op::kSubtract, left, product(depth));
      } else {
        return left;
      }
    }
  }

  Node product(std::size_t depth) {
    Node left = factor(depth);
    while (true) {
      if (scanner_.take("*")) {
        left = formula_.graph.apply(Op::kMultiply, left, factor(depth));
      } else if (scanner_.take("/")) {
        left = formula_.graph.apply(Op::kDivide, left, factor(depth));
      } else {
        return left;
      }
    }
  }

  Node factor(std::size_t depth) {
    if (depth > kMaximumFormulaDepth) {
      scanner_.fail(fmt::format("the formula is nested more than {} deep", kMaximumFormulaDepth),
                    "name its parts with 'let'");
    }
    if (scanner_.take("-")) return formula_.graph.apply(Op::kNegate, factor(depth + 1));
    if (scanner_.take("(")) {
      const Node inner = expression(depth + 1);
      scanner_.expect(")");
      return inner;
    }
    if (scanner_.peek().kind == Word::Kind::kNumber) return number();
    const Place place = scanner_.place();
    const std::string name = dotted_name();
    if (scanner_.peek().text == "(") return call(place, name, depth);
    if (const auto known = names_.find(name); known != names_.end()) return known->second;
    if (name == "pi") return formula_.graph.constant(std::numbers::pi);
    std::vector<std::string> candidates;
    for (const auto& [known, node] : names_) candidates.push_back(known);
    fail(place, fmt::format("'{}' has no value here", name),
         did_you_mean(name, candidates, fmt::format("use one of {}", fmt::join(candidates, ", "))));
  }

  Node call(const Place& place, const std::string& name, std::size_t depth) {
    for (std::size_t i = 0; i <= std::size_t(Op::kSelect); ++i) {
      const Op operation = static_cast<Op>(i);
      if (row(operation).name != name || name.empty()) continue;
      Node operands[3] = {};
      scanner_.expect("(");
      for (int k = 0; k < row(operation).operands; ++k) {
        if (k > 0) scanner_.expect(",");
        operands[k] = expression(depth + 1);
      }
      scanner_.expect(")");
      return formula_.graph.apply(operation, operands[0], operands[1], operands[2]);
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
  Node number() {
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
    return formula_.graph.constant(value);
  }

  Scanner& scanner_;
  std::span<const std::string> output_names_;
  std::map<std::string, Node> names_;
  std::vector<std::optional<Node>> results_;
  Formula formula_;
};

}  // namespace

Formula parse_formula(std::string_view text, const Place& place,
                      std::span<const std::string> inputs, std::span<const std::string> outputs) {
  Scanner scanner(text, place, {.marks = {"<=", ">="}});
  return Parser(scanner, inputs, outputs).parse();
}

}  // namespace sinew::data
