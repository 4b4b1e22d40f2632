#include "sinew/program/passes/choose_signs.h"

#include <utility>
#include <vector>

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

SignChoice choice_of(const Computation& computation) {
  SignChoice choice(computation.dag.size());
  add_nodes(computation, 0, choice);
  for (const Ref result : computation.results) {
    if (!computation.dag.is_constant(result)) choice.want(result);
  }
  return choice;
}

class Writer {
 public:
  Writer(const Computation& computation, std::uint32_t first, const SignChoice& choice)
      : old_(computation.dag), first_(first), choice_(choice), moved_(old_.size()) {
    negative_constants_.resize(old_.size());
  }

  Computation run(const Computation& computation) {
    const std::vector<std::uint8_t> live = live_nodes(computation);
    result_.inputs = computation.inputs;
    result_.dag.reserve_nodes(old_.size() + old_.size() / 16);
    for (std::uint32_t i = 0; i < old_.size(); ++i) {
      if (live[i]) moved_[i] = write(i).negated_if(is_turned(i));
    }
    result_.results.reserve(computation.results.size());
    for (const Ref ref : computation.results) result_.results.push_back(moved(ref));
    result_.order.reserve(computation.order.size());
    for (const std::uint32_t i : computation.order) {
      if (live[i]) result_.order.push_back(moved_[i].node());
    }
    return std::move(result_);
  }

 private:
  bool is_turned(std::uint32_t node) const { return choice_.is_turned(first_ + node); }
  Ref moved(Ref ref) const { return moved_[ref.node()].negated_if(ref.negative()); }

  Ref write(std::uint32_t i) {
    Node node = old_.node(i);
    const bool turned = is_turned(i);
    switch (node.op) {
      case Op::kConstant:
      case Op::kInput:
        break;
      case Op::kAdd:
        node.a = signed_operand(node.a, turned);
        node.b = signed_operand(node.b, turned);
        if (node.a.negative()) std::swap(node.a, node.b);
        break;
      case Op::kMultiply:
      case Op::kDivide:
        factors(node, turned);
        break;
      case Op::kFma: {
        const bool negative = turned != (moved(node.a).negative() != moved(node.b).negative());
        node.a = moved(node.a).magnitude();
        node.b = moved(node.b).magnitude();
        // A constant keeps its sign, so that all who use it have the same.
        Ref& carrier = result_.dag.is_constant(node.a) ? node.b : node.a;
        carrier = carrier.negated_if(negative);
        node.c = moved(node.c).negated_if(turned);
        break;
      }
      case Op::kSelect:
        node.a = moved(node.a);
        node.b = signed_operand(node.b, turned);
        node.c = signed_operand(node.c, turned);
        break;
      case Op::kSqrt:
      case Op::kSin:
      case Op::kCos:
      case Op::kLess:
        node.a = signed_operand(node.a, false);
        if (node.op == Op::kLess) node.b = signed_operand(node.b, false);
        break;
    }
    return result_.dag.append(node);
  }

  // A product or quotient: its sign goes to a constant factor where there is one.
  void factors(Node& node, bool turned) {
    const bool negative = turned != (moved(node.a).negative() != moved(node.b).negative());
    node.a = moved(node.a).magnitude();
    node.b = moved(node.b).magnitude();
    if (!negative) return;
    // Of an input that is a constant vector, or of what is computed with either sign.
    if (result_.dag.is_constant(node.a)) {
      node.a = negative_constant(node.a);
    } else {
      node.a = -node.a;
    }
  }

  Ref signed_operand(Ref ref, bool turned) {
    const Ref operand = moved(ref).negated_if(turned);
    return operand.negative() && result_.dag.is_constant(operand) ? negative_constant(operand)
                                                                  : operand;
  }

  // A node of its own, so that back ends have no sign to apply.
  Ref negative_constant(Ref positive) {
    const std::uint32_t index = positive.node();
    if (index >= negative_constants_.size()) negative_constants_.resize(index + 1);
    Ref& known = negative_constants_[index];
    if (known == Ref{}) {
      Node node = result_.dag.node(positive);
      node.value = -node.value;
      known = result_.dag.append(node);
    }
    return known;
  }

  const Dag& old_;
  std::uint32_t first_;
  const SignChoice& choice_;
  Computation result_;
  std::vector<Ref> moved_;               // of each old node
  std::vector<Ref> negative_constants_;  // of each new one; of none is it the first node
};

}  // namespace

void add_nodes(const Computation& computation, std::uint32_t first, SignChoice& choice) {
  const Dag& dag = computation.dag;
  // A product that one sum alone reads is fused into it.
  std::vector<std::uint8_t> uses(dag.size(), 0);
  const auto use = [&](Ref ref) { uses[ref.node()] += uses[ref.node()] < 2 ? 1 : 0; };
  const std::vector<std::uint8_t> live = live_nodes(computation);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    const int operands = arity(node.op);
    if (operands > 0) use(node.a);
    if (operands > 1) use(node.b);
    if (operands > 2) use(node.c);
  }
  for (const Ref result : computation.results) use(result);
  const auto is_fused = [&](Ref ref) {
    return dag.node(ref).op == Op::kMultiply && uses[ref.node()] == 1;
  };
  const auto of = [&](Ref ref) { return Ref{ref.bits + (first << 1U)}; };
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    const bool constant =
        arity(node.op) > 1 && (dag.is_constant(node.a) || dag.is_constant(node.b));
    switch (node.op) {
      case Op::kConstant:
      case Op::kInput:
      case Op::kSin:
      case Op::kCos:
        break;
      case Op::kAdd:
        if (constant) {
          choice.set(first + i, SignRule::kAny);
        } else {
          const bool fused = is_fused(node.a) || is_fused(node.b);
          choice.set(first + i, fused ? SignRule::kFusedSum : SignRule::kSum,
                     {of(node.a), of(node.b)});
        }
        break;
      case Op::kMultiply:
      case Op::kDivide:
        if (constant) {
          choice.set(first + i, SignRule::kAny);
        } else {
          choice.set(first + i, SignRule::kProduct, {of(node.a), of(node.b)});
        }
        break;
      case Op::kFma:
        choice.set(first + i, SignRule::kAny);
        break;
      case Op::kSqrt:
        choice.set(first + i, SignRule::kEachOfFixed, {of(node.a)});
        break;
      case Op::kLess:
        choice.set(first + i, SignRule::kEachOfFixed, {of(node.a), of(node.b)});
        break;
      case Op::kSelect: {
        std::vector<Ref> chosen;
        for (const Ref ref : {node.b, node.c}) {
          if (!dag.is_constant(ref)) chosen.push_back(of(ref));
        }
        choice.set(first + i, SignRule::kEach, chosen);
        break;
      }
    }
  }
}

Computation with_signs(const Computation& computation, std::uint32_t first,
                       const SignChoice& choice) {
  return Writer(computation, first, choice).run(computation);
}

Computation choose_signs(Computation computation) {
  SignChoice choice = choice_of(computation);
  choice.run();
  return with_signs(computation, 0, choice);
}

std::uint32_t count_negations(const Computation& computation) {
  return choice_of(computation).negations();
}

}  // namespace sinew::program
