#include "sinew/backend/c_flat_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "sinew/backend/angle_groups.h"
#include "sinew/backend/flat_parts.h"
#include "sinew/backend/numbers.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

class Emitter {
 public:
  Emitter(const program::Program& program, const program::Interface& interface,
          const Computation& computation, const std::string& name, FlatForm form)
      : interface_(interface),
        computation_(computation),
        dag_(computation.dag),
        prefix_(name),
        block_form_(form == FlatForm::kBlock),
        type_(block_form_ ? name + "_lanes" : "double"),
        names_(dag_.size()) {
    upper_ = name;
    std::transform(upper_.begin(), upper_.end(), upper_.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    input_names_.resize(computation.inputs);
    const std::vector<std::string> identifiers = variable_identifiers(program);
    const auto name_slots = [&](const std::vector<program::Slot>& slots, std::uint32_t first) {
      for (const program::Slot& slot : slots) {
        const std::uint32_t size = program.variables[slot.variable].size;
        for (std::uint32_t k = 0; k < size; ++k) {
          input_names_[first + slot.offset + k] =
              size == 1 ? identifiers[slot.variable]
                        : fmt::format("{}_{}", identifiers[slot.variable], k);
        }
      }
    };
    name_slots(interface.inputs, 0);
    name_slots(interface.states, interface.in_size);
  }

  FlatBody run(std::size_t maximum_statements) {
    const AngleGroups groups = group_angles(computation_);
    for (const AngleGroup& group : groups.groups) {
      for (const std::uint32_t node : group.before) emit(node);
      angles(group);
    }
    std::vector<std::uint32_t> before;
    for (std::uint32_t i = 0; i < names_.size(); ++i) {
      if (!names_[i].empty() && dag_.node(i).op != Op::kInput) before.push_back(i);
    }
    parts_ = divide_into_parts(computation_, before, groups.after, maximum_statements);
    if (parts_.parts.empty()) {
      for (const std::uint32_t node : groups.after) emit(node);
    } else {
      call_parts(before);
    }
    results();
    if (interface_.in_size == 0) line("(void)in;");
    if (block_form_ && interface_.in_size + computation_.results.size() == 0) line("(void)n;");
    if (computation_.results.empty()) line("(void)out;");
    return std::move(result_);
  }

 private:
  // Where input i (then the states) lies, as an address.
  std::string input_address(std::uint32_t i) const {
    const bool input = i < interface_.in_size;
    const std::uint32_t at = input ? i : i - interface_.in_size;
    return fmt::format("{} + {}{}", input ? "in" : "state", at, block_form_ ? " * n" : "");
  }

  void line(const std::string& text, std::uint32_t origin = program::kNoOrigin) {
    block_->add("  " + text, origin);
  }

  // A name that no other value of the function has.
  std::string unique(const std::string& base) {
    std::string name = base;
    for (int again = 2; !used_.insert(name).second; ++again)
      name = fmt::format("{}_{}", base, again);
    return name;
  }

  // Keeps what the parts need of what has been computed, and calls them; their code goes to
  // `parts`.
  void call_parts(const std::vector<std::uint32_t>& before) {
    const std::string states = interface_.state_size > 0 ? ", double *state" : "";
    const std::string row = block_form_ ? ", size_t n" : "";
    line(fmt::format("{0}_ALIGNED double kept[{1}{2}];", upper_, parts_.slots,
                     block_form_ ? fmt::format(" * {}_LANES", upper_) : ""));
    for (const std::uint32_t node : before) keep(node);
    for (std::size_t k = 0; k < parts_.parts.size(); ++k) {
      const std::string function =
          fmt::format("{}_{}_part{}", prefix_, block_form_ ? "block" : "sample", k + 1);
      line(fmt::format("{}(in, kept{}{});", function, states.empty() ? "" : ", state",
                       block_form_ ? ", n" : ""));
      block_ = &result_.parts;
      forget();
      block_->add(fmt::format("{}_APART void {}(const double *in, double *kept{}{}) {{", upper_,
                              function, states, row));
      for (const std::uint32_t node : parts_.parts[k]) {
        emit(node);
        keep(node);
      }
      line("(void)in;");
      if (!states.empty()) line("(void)state;");
      if (block_form_) line("(void)n;");
      block_->add("}");
      block_->add("");
      block_ = &result_.code;
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
      line(fmt::format("kept[{}] = {};", slot, names_[node]));
    }
  }

  void read_kept(std::uint32_t node) {
    names_[node] = unique(fmt::format("k{}", parts_.slot[node]));
    if (block_form_) {
      line(fmt::format("{0} {1}; memcpy(&{1}, kept + {2} * {3}_LANES, sizeof {1});", type_,
                       names_[node], parts_.slot[node], upper_));
    } else {
      line(fmt::format("const double {} = kept[{}];", names_[node], parts_.slot[node]));
    }
  }

  // The name of a node that has been emitted, or its number.
  std::string value(std::uint32_t i) {
    const Node& node = dag_.node(i);
    if (node.op == Op::kConstant) return c_number(node.value);
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
    names_[i] = unique(input_names_[node.index]);
    if (block_form_) {
      line(fmt::format("{0} {1}; memcpy(&{1}, {2}, sizeof {1});", type_, names_[i],
                       input_address(node.index)));
    } else {
      const bool input = node.index < interface_.in_size;
      line(fmt::format("const double {} = {}[{}];", names_[i], input ? "in" : "state",
                       input ? node.index : node.index - interface_.in_size));
    }
  }

  void emit(std::uint32_t i) {
    const Node& node = dag_.node(i);
    if (node.op == Op::kSin || node.op == Op::kCos) return;  // the group has made it
    const std::string expression = express(node);
    names_[i] = unique(fmt::format("t{}", ++count_));
    if (block_form_ && (node.op == Op::kSqrt || node.op == Op::kSelect)) {
      lane_by_lane(i, node);
      return;
    }
    line(fmt::format("const {} {} = {};", type_, names_[i], expression), node.origin);
  }

  std::string express(const Node& n) {
    const auto plus = [](Ref r) { return r.negative() ? " - " : " + "; };
    switch (n.op) {
      case Op::kAdd:
        return value(n.a) + plus(n.b) + value(n.b.node());
      case Op::kMultiply:
        return value(n.a) + " * " + value(n.b);
      case Op::kFma:
        return value(n.a) + " * " + value(n.b) + plus(n.c) + value(n.c.node());
      case Op::kDivide:
        return value(n.a) + " / " + value(n.b);
      case Op::kSqrt:
        return fmt::format("sqrt({})", value(n.a));
      case Op::kSelect: {
        const Node& condition = dag_.node(n.a);
        const std::string a = value(condition.a), b = value(condition.b), x = value(n.b),
                          y = value(n.c);
        return fmt::format("{} < {} ? {} : {}", a, b, x, y);
      }
      default:
        return {};
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
      line(fmt::format("  double {}[{}_LANES];", copy, upper_));
    }
    line(fmt::format("  double result[{}_LANES];", upper_));
    line("  size_t lane;");
    for (const auto& [ref, copy] : operands) {
      if (dag_.is_constant(ref)) continue;
      line(fmt::format("  memcpy({0}, &{0}_lanes, sizeof {0});", copy));
    }
    std::string expression = fmt::format("sqrt({})", lane(node.a, "a"));
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
    constexpr std::size_t kWidest = 8;  // lanes; arrays are padded to them
    const std::size_t n = group.angles.size();
    const std::size_t padded = (n + kWidest - 1) / kWidest * kWidest;
    const std::string tag = result_.angles == 0 ? "" : fmt::format("_{}", result_.angles);
    for (const char* array : {"angle", "sine", "cosine"}) used_.insert(array + tag);
    const std::string lanes = block_form_ ? fmt::format("{} * {}_LANES", n, upper_) : "";
    line(fmt::format("{2}_ALIGNED double sine{0}[{1}], cosine{0}[{1}];", tag,
                     block_form_ ? lanes : std::to_string(padded), upper_));
    std::string from;
    const auto each = [&](auto text) {
      std::string sum;
      for (std::size_t k = 0; k < n; ++k) sum += (k == 0 ? "" : " + ") + text(k);
      return sum;
    };
    std::string squares;
    if (block_form_) {
      line(fmt::format("{}_ALIGNED double angle{}[{}];", upper_, tag, lanes));
      for (std::size_t k = 0; k < n; ++k) {
        const Node& node = dag_.node(group.angles[k]);
        const std::string to = fmt::format("angle{} + {} * {}_LANES", tag, k, upper_);
        if (node.op == Op::kInput) {
          line(fmt::format("memcpy({}, {}, sizeof({}));", to, input_address(node.index), type_));
        } else {
          line(fmt::format("memcpy({}, &{}, sizeof({}));", to, value(group.angles[k]), type_));
        }
      }
      from = "angle" + tag;
      squares = fmt::format("{}_squares({}, {})", prefix_, from, lanes);
    } else if (contiguous(group, padded)) {
      const std::uint32_t first = dag_.node(group.angles[0]).index;
      from = fmt::format("in + {}", first);
      squares = each([&](std::size_t k) { return fmt::format("in[{0}] * in[{0}]", first + k); });
    } else {
      std::string list;
      for (const std::uint32_t angle : group.angles)
        list += (list.empty() ? "" : ", ") + value(angle);
      line(fmt::format("{}_ALIGNED const double angle{}[{}] = {{ {} }};", upper_, tag, padded,
                       list));
      from = "angle" + tag;
      squares = each([&](std::size_t k) { return fmt::format("{0}[{1}] * {0}[{1}]", from, k); });
    }
    line(fmt::format("{}_sincos_all({}, sine{}, cosine{}, {}, {});", prefix_, from, tag, tag,
                     block_form_ ? lanes : std::to_string(n), squares));
    for (std::size_t k = 0; k < n; ++k) {
      const Node& node = dag_.node(group.angles[k]);
      const std::string angle =
          node.op == Op::kInput ? input_names_[node.index] : names_[group.angles[k]];
      take(group.sines[k], "sin_" + angle, "sine" + tag, k);
      take(group.cosines[k], "cos_" + angle, "cosine" + tag, k);
    }
    result_.angles += n;
  }

  // Whether the angles are neighbouring inputs, with others behind them up to the padded size.
  bool contiguous(const AngleGroup& group, std::size_t padded) const {
    const Node& first = dag_.node(group.angles[0]);
    for (std::size_t k = 0; k < group.angles.size(); ++k) {
      const Node& node = dag_.node(group.angles[k]);
      if (node.op != Op::kInput || node.index != first.index + k) return false;
    }
    return first.index + padded <= interface_.in_size;
  }

  void take(std::uint32_t node, const std::string& name, const std::string& array, std::size_t k) {
    if (node == AngleGroup::kNone) return;
    names_[node] = unique(name);
    const std::uint32_t origin = dag_.node(node).origin;
    if (block_form_) {
      line(fmt::format("{0} {1}; memcpy(&{1}, {2} + {3} * {4}_LANES, sizeof {1});", type_,
                       names_[node], array, k, upper_),
           origin);
    } else {
      line(fmt::format("const double {} = {}[{}];", names_[node], array, k), origin);
    }
  }

  // The results may not be written before every input has been read: they are at the end.
  void results() {
    for (std::uint32_t i = 0; i < computation_.results.size(); ++i) value(computation_.results[i]);
    for (std::uint32_t i = 0; i < computation_.results.size(); ++i) {
      const Ref result = computation_.results[i];
      const bool output = i < interface_.out_size;
      const std::uint32_t at = output ? i : i - interface_.out_size;
      const char* array = output ? "out" : "state";
      const std::uint32_t origin = dag_.node(result).origin;
      if (!block_form_) {
        line(fmt::format("{}[{}] = {};", array, at, value(result)), origin);
        continue;
      }
      const std::string number =
          dag_.is_constant(result) ? value(result) + " + zero" : value(result);
      if (dag_.is_constant(result) && !zero_) {
        line(fmt::format("const {} zero = {{ 0 }};", type_));
        zero_ = true;
      }
      line(fmt::format("{{ const {0} y = {1}; memcpy({2} + {3} * n, &y, sizeof y); }}", type_,
                       number, array, at),
           origin);
    }
  }

  const program::Interface& interface_;
  const Computation& computation_;
  const program::Dag& dag_;
  std::string prefix_, upper_;
  bool block_form_;
  std::string type_;
  std::vector<std::string> names_;  // of nodes; empty: not emitted yet
  std::vector<std::string> input_names_;
  std::uint32_t count_ = 0;
  bool zero_ = false;
  FlatParts parts_;
  std::unordered_set<std::string> used_ = {
      "in",     "out", "state", "n", "kept", "angle",   "sine",    "cosine",  "lane",   "zero",
      "result", "y",   "a",     "b", "x",    "a_lanes", "b_lanes", "x_lanes", "y_lanes"};
  FlatBody result_;
  CodeBlock* block_ = &result_.code;
};

}  // namespace

FlatBody flat_body(const program::Program& program, const program::Interface& interface,
                   const Computation& computation, const std::string& name, FlatForm form,
                   std::size_t maximum_statements) {
  return Emitter(program, interface, computation, name, form).run(maximum_statements);
}

}  // namespace sinew::backend
