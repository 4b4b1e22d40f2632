// The flat style: the whole program as straight-line code on numbers.
#include <fmt/format.h>

#include "sinew/backend/c_parts.h"
#include "sinew/backend/numbers.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

class Emitter {
 public:
  Emitter(const Computation& computation, const program::Interface& interface)
      : computation_(computation), dag_(computation.dag), interface_(interface) {}

  CodeBlock run() {
    live_ = program::live_nodes(computation_);
    for (std::uint32_t i = 0; i < dag_.size(); ++i) {
      const Node& node = dag_.node(i);
      if (live_[i] && program::arity(node.op) > 0 && node.op != Op::kLess) statement(i, node);
    }
    for (std::uint32_t i = 0; i < computation_.results.size(); ++i) {
      const bool output = i < interface_.out_size;
      block_.add(fmt::format("  {}[{}] = {};", output ? "out" : "state",
                             output ? i : i - interface_.out_size,
                             signed_name(computation_.results[i])));
    }
    return std::move(block_);
  }

 private:
  std::string name(std::uint32_t i) const {
    const Node& node = dag_.node(i);
    if (node.op == Op::kConstant) return c_number(node.value);
    if (node.op == Op::kInput) {
      return node.index < interface_.in_size
                 ? fmt::format("in[{}]", node.index)
                 : fmt::format("state[{}]", node.index - interface_.in_size);
    }
    return fmt::format("t{}", i);
  }

  std::string signed_name(Ref ref) const { return (ref.negative() ? "-" : "") + name(ref.node()); }

  std::string expression(const Node& n) const {
    const auto plus = [](Ref r) { return r.negative() ? " - " : " + "; };
    switch (n.op) {
      case Op::kAdd:
        return name(n.a.node()) + plus(n.b) + name(n.b.node());
      case Op::kMultiply:
        return name(n.a.node()) + " * " + name(n.b.node());
      case Op::kFma:
        return name(n.a.node()) + " * " + name(n.b.node()) + plus(n.c) + name(n.c.node());
      case Op::kDivide:
        return name(n.a.node()) + " / " + name(n.b.node());
      case Op::kSqrt:
        return fmt::format("sqrt({})", signed_name(n.a));
      case Op::kSin:
        return fmt::format("sin({})", name(n.a.node()));
      case Op::kCos:
        return fmt::format("cos({})", name(n.a.node()));
      case Op::kSelect: {
        const Node& condition = dag_.node(n.a);
        return fmt::format("{} < {} ? {} : {}", signed_name(condition.a), signed_name(condition.b),
                           signed_name(n.b), signed_name(n.c));
      }
      case Op::kConstant:
      case Op::kInput:
      case Op::kLess:
        break;
    }
    return {};
  }

  void statement(std::uint32_t i, const Node& node) {
    block_.add(fmt::format("  const double t{} = {};", i, expression(node)), node.origin);
  }

  const Computation& computation_;
  const program::Dag& dag_;
  const program::Interface& interface_;
  std::vector<bool> live_;
  CodeBlock block_;
};

}  // namespace

RenderedSource flat_source(const program::Program&, const program::Interface& interface,
                           const Computation& computation, const Fields& common) {
  return render_with_body("c/flat.c.mustache", common, Emitter(computation, interface).run());
}

}  // namespace sinew::backend
