#include "sinew/algorithm/check.h"

#include <fmt/format.h>

#include <cmath>
#include <memory_resource>
#include <optional>
#include <unordered_set>

#include "sinew/data/units.h"

namespace sinew::algorithm {
namespace {

using graph::Id;
using graph::Terms;

std::string text(const Terms& terms, Id id) {
  return id ? std::string(terms.text(id)) : std::string("nothing");
}

// "add-velocity-twist (step velocity, for joint3)"
std::string describe(const Terms& terms, const Closure& closure) {
  std::string words(closure.op->name);
  std::string made;
  if (closure.step) made += "step " + std::string(short_name(terms.text(closure.step)));
  if (closure.about) made += (made.empty() ? "for " : ", for ") + text(terms, closure.about);
  return made.empty() ? words : words + " (" + made + ")";
}

void check_rule(const Terms& terms, const Algorithm& algorithm, const Closure& closure,
                const FrameRule& rule, Report& report) {
  // Rules speak of single arguments; a port that takes many is checked against each of them.
  const auto each = [&](Symbol symbol, auto&& visit) {
    const auto attribute = static_cast<std::size_t>(symbol.attribute);
    if (closure.counts.empty())
      return visit(algorithm.blocks[closure.arguments[symbol.port]].symbols[attribute]);
    for_each_argument(closure, [&](const Port& port, std::uint32_t block) {
      if (&port == &closure.op->ports[symbol.port])
        visit(algorithm.blocks[block].symbols[attribute]);
    });
  };
  each(rule.left, [&](Id left) {
    each(rule.right, [&](Id right) {
      if (left == right) return;
      const std::string& port = closure.op->ports[rule.left.port].name;
      const std::string& other = closure.op->ports[rule.right.port].name;
      report.error(
          {}, text(terms, closure.id),
          fmt::format("{}: the {} of {} is {}, but the {} of {} is {}", describe(terms, closure),
                      to_string(rule.left.attribute), port, text(terms, left),
                      to_string(rule.right.attribute), other, text(terms, right)),
          fmt::format("must hold: {}", to_string(rule, *closure.op)));
    });
  });
}

// The dimension of a block that has one unit; nothing where it has several, or one that is unknown.
std::optional<data::Dimension> dimension_of(const Block& block) {
  const std::optional<data::Unit> unit = data::find_unit(block.unit);
  if (!unit) return std::nullopt;
  return unit->dimension;
}

void check_units(const Terms& terms, const Algorithm& algorithm, const Closure& closure,
                 const UnitRule& rule, Report& report) {
  data::Dimension product = rule.rest;
  std::string units;
  for (const UnitRule::Factor& factor : rule.factors) {
    // Ports that take many have quantities of known units and are in no rule.
    const Block& block = algorithm.blocks[closure.arguments[factor.port]];
    const std::optional<data::Dimension> dimension = dimension_of(block);
    if (!dimension) {
      report.error({}, text(terms, block.id),
                   fmt::format("{}: {} is in {}, which is no single known unit",
                               describe(terms, closure), block.name, block.unit),
                   "one of metamodels/units.json");
      return;
    }
    product = product * data::power(*dimension, factor.exponent);
    units += fmt::format("{}{} is in {}", units.empty() ? "" : ", ",
                         closure.op->ports[factor.port].name, block.unit);
  }
  if (product.dimensionless()) return;
  report.error({}, text(terms, closure.id),
               fmt::format("{}: the units do not fit: {}", describe(terms, closure), units),
               fmt::format("must hold: {}", rule.text));
}

// Which closure writes each block; reports a second writer.
std::vector<std::uint32_t> writers(const Terms& terms, const Algorithm& algorithm, Report& report) {
  std::vector<std::uint32_t> writer(algorithm.blocks.size(), kNoIndex);
  for (std::uint32_t at = 0; at < algorithm.closures.size(); ++at) {
    const Closure& closure = algorithm.closures[at];
    for_each_argument(closure, [&](const Port& port, std::uint32_t index) {
      if (port.direction != Direction::kOut) return;
      const Block& block = algorithm.blocks[index];
      if (closure.op->external && block.role != Role::kInput)
        report.error({}, text(terms, block.id),
                     fmt::format("{} is {} but {} fills it from outside", block.name,
                                 to_string(block.role), describe(terms, closure)),
                     "what comes from outside is an input");
      if (!closure.op->external && (block.role == Role::kInput || block.role == Role::kConstant))
        report.error({}, text(terms, block.id),
                     fmt::format("{} is {} but {} writes it", block.name, to_string(block.role),
                                 describe(terms, closure)),
                     "only internal and state data blocks are written by closures");
      if (writer[index] != kNoIndex && writer[index] != at)
        report.error({}, text(terms, block.id),
                     fmt::format("{} is written by {} and by {}", block.name,
                                 describe(terms, algorithm.closures[writer[index]]),
                                 describe(terms, closure)),
                     "a data block has one writer");
      writer[index] = at;
    });
  }
  return writer;
}

void check_order(const Terms& terms, const Algorithm& algorithm, Report& report) {
  const std::vector<std::uint32_t> writer = writers(terms, algorithm, report);
  std::vector<bool> done(algorithm.closures.size(), false);
  for (const std::uint32_t at : algorithm.schedule) {
    const Closure& closure = algorithm.closures[at];
    if (done[at])
      report.error({}, text(terms, closure.id),
                   describe(terms, closure) + " is in the schedule twice", "once is right");
    for_each_argument(closure, [&](const Port& port, std::uint32_t index) {
      const Block& block = algorithm.blocks[index];
      if (port.direction != Direction::kIn) return;
      // An input that a closure fills (`read`) is there once that has been done.
      if (block.role != Role::kInternal &&
          !(block.role == Role::kInput && writer[index] != kNoIndex))
        return;
      if (writer[index] == kNoIndex)
        report.error(
            {}, text(terms, block.id),
            fmt::format("{} reads {}, which nothing writes", describe(terms, closure), block.name),
            "make it an input or a constant, or add the closure that computes it");
      else if (!done[writer[index]])
        report.error({}, text(terms, block.id),
                     fmt::format("{} reads {} before {} writes it", describe(terms, closure),
                                 block.name, describe(terms, algorithm.closures[writer[index]])),
                     "schedule the writer first; if both need each other, there is a cycle");
    });
    done[at] = true;
  }
  for (std::uint32_t index = 0; index < algorithm.blocks.size(); ++index) {
    const Block& block = algorithm.blocks[index];
    if (block.output && block.role == Role::kInternal &&
        (writer[index] == kNoIndex || !done[writer[index]]))
      report.error({}, text(terms, block.id),
                   fmt::format("output {} is written by nothing in the schedule", block.name),
                   "add the closure that computes it to the schedule");
  }
}

class BlockNames {
 public:
  explicit BlockNames(const Algorithm& algorithm) { names_.reserve(algorithm.blocks.size()); }

  void check(const Terms& terms, const Block& block, Report& report) {
    if (!names_.insert(block.name).second)
      report.error({}, text(terms, block.id), "a second data block named " + block.name,
                   "names are unique in an algorithm");
  }

 private:
  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::unordered_set<std::string_view> names_{&memory_};
};

}  // namespace

void check_block(const Terms& terms, const Block& block, Report& report) {
  const auto error = [&](const std::string& what, std::string remedy) {
    report.error({}, text(terms, block.id), block.name + ": " + what, std::move(remedy));
  };
  const Quantity& quantity = *block.quantity;
  if (quantity.size != 0 && block.size != quantity.size)
    error(fmt::format("a {} of {} numbers", quantity.name, block.size),
          fmt::format("it has {}", quantity.size));
  if (block.size == 0) error("its size is not stated", "state how many numbers it has");
  if (block.unit.empty()) {
    error("its unit is missing", "state it");
  } else if (!quantity.unit.empty() && block.unit != quantity.unit &&
             block.unit != quantity.unit_prismatic) {
    error(fmt::format("a {} in {}", quantity.name, block.unit),
          fmt::format("convert it to {}", quantity.unit));
  }
  for (std::size_t i = 0; i < kAttributes; ++i) {
    const auto attribute = static_cast<Attribute>(i);
    if (needs(quantity, attribute) && !block.symbols[i])
      error(fmt::format("a {} without {}", quantity.name, to_string(attribute)), "name it");
  }
  const bool valued = block.role == Role::kConstant || block.role == Role::kState;
  if (valued && block.value.size() != block.size)
    error(fmt::format("{} numbers of value for a size of {}", block.value.size(), block.size),
          "a constant or state has as many numbers as its size says");
  if (!valued && !block.value.empty())
    error(fmt::format("{} data with a value", to_string(block.role)),
          "only constants and states have one");
  for (const double number : block.value)
    if (!std::isfinite(number)) error("its value is not finite", "a finite number");
}

void check_closure(const Terms& terms, const Algorithm& algorithm, const Closure& closure,
                   Report& report) {
  bool complete = true;
  std::size_t expected = 0;
  for (std::size_t port = 0; port < closure.op->ports.size(); ++port) {
    const std::size_t count = closure.counts.empty() ? 1 : closure.counts[port];
    expected += count;
    // Where other ports come first, a list may be empty: a floating base without joints.
    if (count == 1 || (closure.op->ports[port].many && (count > 0 || port > 0))) continue;
    complete = false;
    report.error({}, text(terms, closure.id),
                 fmt::format("{}: port {} has {} data blocks", describe(terms, closure),
                             closure.op->ports[port].name, count),
                 closure.op->ports[port].many ? "it takes a list" : "it takes one");
  }
  if (!complete || closure.arguments.size() != expected) {
    if (complete)
      report.error({}, text(terms, closure.id),
                   fmt::format("{}: {} data blocks for {} ports", describe(terms, closure),
                               closure.arguments.size(), expected),
                   "connect every port");
    return;
  }
  bool typed = true;
  for_each_argument(closure, [&](const Port& port, std::uint32_t index) {
    const Block& block = algorithm.blocks[index];
    if (port.quantity == kAnyQuantity || port.quantity == block.quantity->name) return;
    typed = false;
    report.error({}, text(terms, closure.id),
                 fmt::format("{}: {} is {}, a {}", describe(terms, closure), port.name, block.name,
                             block.quantity->name),
                 fmt::format("it takes a {}", port.quantity));
  });
  if (!typed) return;
  for (const FrameRule& rule : closure.op->rules)
    check_rule(terms, algorithm, closure, rule, report);
  for (const UnitRule& rule : closure.op->unit_rules)
    check_units(terms, algorithm, closure, rule, report);
}

void check_together(const Terms& terms, const Algorithm& algorithm, Report& report) {
  BlockNames names(algorithm);
  for (const Block& block : algorithm.blocks) names.check(terms, block, report);
  check_order(terms, algorithm, report);
}

void check_algorithm(const Terms& terms, const Algorithm& algorithm, Report& report) {
  BlockNames names(algorithm);
  for (const Block& block : algorithm.blocks) {
    check_block(terms, block, report);
    names.check(terms, block, report);
  }
  for (const Closure& closure : algorithm.closures)
    check_closure(terms, algorithm, closure, report);
  check_order(terms, algorithm, report);
}

}  // namespace sinew::algorithm
