#include <fmt/format.h>

#include "sinew/rdf/sparql/plan/planner.h"

namespace sinew::rdf::sparql::plan {
namespace {

class Printer {
 public:
  Printer(const Plan& plan, const graph::Terms& terms) : plan_(plan), terms_(terms) {}

  void block(Index index, std::size_t depth) {
    const Block& block = plan_.blocks[index];
    std::string columns;
    for (const Slot slot : block.columns) columns += " " + name(slot);
    line(depth, fmt::format("select{}{}", block.distinct ? " distinct" : "", columns));
    chain(block.first, kNone, depth + 1);
    if (block.grouped) {
      line(depth, fmt::format("group by {} keys, {} aggregates", block.keys.size(),
                              block.aggregates.size()));
      chain(block.after_groups, kNone, depth + 1);
    }
    if (!block.order.empty()) line(depth, fmt::format("sort by {} keys", block.order.size()));
    if (block.offset > 0) line(depth, fmt::format("offset {}", block.offset));
    if (block.limit) line(depth, fmt::format("limit {}", *block.limit));
  }

  std::string text;

 private:
  void line(std::size_t depth, std::string_view what) {
    text.append(2 * depth, ' ').append(what).append("\n");
  }
  std::string name(Slot slot) const {
    if (plan_.initial[slot]) return terms_.to_string(plan_.initial[slot]);
    return plan_.slot_names[slot].empty() ? fmt::format("?_{}", slot)
                                          : "?" + plan_.slot_names[slot];
  }
  std::string expression(Index index) const {
    const Expression& e = plan_.expressions[index];
    switch (e.op) {
      case Operator::kConstant:
      case Operator::kVariable:
        return name(e.slot);
      case Operator::kUnbound:
        return "unbound";
      case Operator::kBound:
        return fmt::format("BOUND({})", name(e.slot));
      default:
        break;
    }
    std::string result =
        e.op == Operator::kCall ? terms_.to_string(e.function) : std::string(name_of(e.op));
    result += '(';
    for (std::uint32_t i = 0; i < e.count; ++i) {
      if (i > 0) result += ", ";
      result += expression(plan_.arguments[e.first + i]);
    }
    return result + ")";
  }
  // The groups of EXISTS inside an expression.
  void bodies(Index index, std::size_t depth) {
    const Expression& e = plan_.expressions[index];
    if (e.body != kNone) {
      line(depth, "exists");
      chain(e.body, kNone, depth + 1);
    }
    for (std::uint32_t i = 0; i < e.count; ++i) bodies(plan_.arguments[e.first + i], depth);
  }
  std::string in_graph(const Op& op) const {
    return op.graph_kind == GraphKind::kNamed ? " in " + name(op.graph) : "";
  }

  void chain(Index at, Index end, std::size_t depth) {
    while (at != end && at != kNone) {
      const Op& op = plan_.ops[at];
      switch (op.kind) {
        case OpKind::kMatch:
          line(depth, fmt::format("match {} {} {}{}  ~{:.3g}", name(op.subject), name(op.predicate),
                                  name(op.object), in_graph(op), op.estimate));
          break;
        case OpKind::kPath:
          line(depth, fmt::format("path {} to {}{}  ~{:.3g}", name(op.subject), name(op.object),
                                  in_graph(op), op.estimate));
          break;
        case OpKind::kGraphNames:
          line(depth, "graphs " + name(op.graph));
          break;
        case OpKind::kFilter:
        case OpKind::kDiffer:
          line(depth, "filter " + expression(op.item));
          bodies(op.item, depth + 1);
          break;
        case OpKind::kExtend:
          line(depth, fmt::format("bind {} = {}", name(op.subject), expression(op.item)));
          bodies(op.item, depth + 1);
          break;
        case OpKind::kOptional:
          line(depth, "optional");
          chain(op.body, op.next, depth + 1);
          break;
        case OpKind::kUnion:
          line(depth, "union");
          for (Index i = 0; i < op.item; ++i) {
            line(depth + 1, "branch");
            chain(plan_.branches[op.body + i], op.next, depth + 2);
          }
          break;
        case OpKind::kExists:
          line(depth, op.negated ? "not exists" : "exists");
          chain(op.body, kNone, depth + 1);
          break;
        case OpKind::kValues:
          line(depth, fmt::format("values: {} rows", plan_.values[op.item].row_count));
          break;
        case OpKind::kTable:
        case OpKind::kMinus:
          line(depth, op.kind == OpKind::kTable ? "join with the table" : "minus the table");
          block(plan_.tables[op.item].block, depth + 1);
          break;
        case OpKind::kRefuse:
          line(depth, "service: an error");
          break;
        case OpKind::kNothing:
        case OpKind::kJump:
        case OpKind::kOptionalEnd:
        case OpKind::kFound:
        case OpKind::kEmit:
          break;
      }
      at = op.next;
    }
  }

  const Plan& plan_;
  const graph::Terms& terms_;
};

}  // namespace

std::string explain(const Plan& plan, const graph::Terms& terms) {
  Printer printer(plan, terms);
  printer.block(0, 0);
  return std::move(printer.text);
}

}  // namespace sinew::rdf::sparql::plan
