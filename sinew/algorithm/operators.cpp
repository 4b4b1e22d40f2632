#include "sinew/algorithm/operators.h"

#include <cctype>
#include <stdexcept>
#include <unordered_map>

#include "sinew/algorithm/operator_rows.h"
#include "sinew/data/units.h"

namespace sinew::algorithm {
namespace {

using Row = OperatorRow;

// External operators. What `read` writes are inputs of the algorithm: it stands for the caller. The
// others write nothing.
constexpr Row kExternalRows[] = {
    {"read", SINEW_OWN "read", "-> quantity*:any", "", "measurements of the robot sa:interface"},
    {"write", SINEW_OWN "write", "quantity*:any ->", "", "commands to the robot sa:interface"},
    {"log", SINEW_OWN "log", "quantity*:any ->", "", "one row for the recorder, under sa:label"},
    {"check-range", SINEW_OWN "check-range", "quantity*:any ->", "",
     "sa:lower <= every number <= sa:upper; otherwise sa:action"},
    {"check-flag", SINEW_OWN "check-flag", "quantity*:any ->", "",
     "every number is 0; otherwise sa:action"},
    {"probe-time", SINEW_OWN "probe-time", "", "", "how long into the cycle, under sa:label"},
};

[[noreturn]] void fault(const Row& row, std::string_view what) {
  throw std::logic_error("operator catalogue, row " + std::string(row.name) + ": " +
                         std::string(what));
}

// Takes the text before the next `separator` (or the rest) off the front of `text`.
std::string_view take(std::string_view& text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  const std::string_view head = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view{} : text.substr(at + separator.size());
  return head;
}

void parse_ports(const Row& row, Operator& op) {
  const std::string space = op.iri.substr(0, op.iri.find('#') + 1);
  Direction direction = Direction::kIn;
  for (std::string_view rest = row.ports; !rest.empty();) {
    const std::string_view word = take(rest, " ");
    if (word == "->") {
      direction = Direction::kOut;
      continue;
    }
    std::string_view quantity = word;
    std::string_view name = take(quantity, ":");
    const bool many = name.ends_with('*');
    if (many) name.remove_suffix(1);
    if (find_quantity(quantity) == nullptr && !(op.external && quantity == kAnyQuantity))
      fault(row, "unknown quantity");
    op.ports.push_back(
        {std::string(name), space + std::string(name), std::string(quantity), direction, many});
  }
}

std::uint8_t port_index(const Row& row, const Operator& op, std::string_view name) {
  for (std::size_t i = 0; i < op.ports.size(); ++i)
    if (op.ports[i].name == name) return static_cast<std::uint8_t>(i);
  fault(row, "a rule names a port that does not exist");
}

Attribute parse_attribute(const Row& row, std::string_view text) {
  if (text == "of") return Attribute::kOf;
  if (text == "wrt") return Attribute::kWrt;
  if (text == "ref") return Attribute::kReference;
  if (text == "seen") return Attribute::kSeenBy;
  fault(row, "a rule names a symbol that does not exist");
}

void parse_rules(const Row& row, Operator& op) {
  for (std::string_view rest = row.rules; !rest.empty();) {
    std::string_view right = take(rest, "; ");
    std::string_view left = take(right, " = ");
    const std::uint8_t left_port = port_index(row, op, take(left, "."));
    const std::uint8_t right_port = port_index(row, op, take(right, "."));
    if (left != "at") {
      op.rules.push_back(
          {{left_port, parse_attribute(row, left)}, {right_port, parse_attribute(row, right)}});
      continue;
    }
    for (const Attribute attribute : {Attribute::kSeenBy, Attribute::kReference})
      op.rules.push_back({{left_port, attribute},
                          {right_port, right == "at" ? attribute : parse_attribute(row, right)}});
  }
}

// "control = proportional-gain error": what is right of the sign, divided by what is left of it,
// has no dimension.
void parse_units(const Row& row, Operator& op) {
  for (std::string_view rest = row.units; !rest.empty();) {
    std::string_view right = take(rest, "; ");
    UnitRule rule{std::string(right), {}, {}};
    bool left = true;
    while (!right.empty()) {
      const std::string_view word = take(right, " ");
      if (word == "=") {
        left = false;
      } else if (std::isupper(static_cast<unsigned char>(word.front()))) {
        const auto unit = data::find_unit(word);
        if (!unit) fault(row, "a rule names a unit that does not exist");
        rule.rest = left ? rule.rest / unit->dimension : rule.rest * unit->dimension;
      } else if (word != "1") {
        rule.factors.push_back(
            {port_index(row, op, word), static_cast<std::int8_t>(left ? -1 : 1)});
      }
    }
    op.unit_rules.push_back(std::move(rule));
  }
}

struct Catalogue {
  std::vector<Operator> all;
  std::unordered_map<std::string_view, const Operator*> by_name, by_iri;

  Catalogue() {
    const std::span<const Row> tables[] = {motion_operator_rows(),   dynamics_operator_rows(),
                                           whole_operator_rows(),    control_operator_rows(),
                                           relative_operator_rows(), joint_operator_rows(),
                                           hybrid_operator_rows()};
    std::size_t count = std::size(kExternalRows);
    for (const std::span<const Row> table : tables) count += table.size();
    all.reserve(count);  // the maps point into it
    for (const std::span<const Row> table : tables)
      for (const Row& row : table) add(row, false);
    for (const Row& row : kExternalRows) add(row, true);
    for (const Operator& op : all) {
      if (!by_name.emplace(op.name, &op).second || !by_iri.emplace(op.iri, &op).second)
        throw std::logic_error("operator catalogue: two rows for " + std::string(op.name));
    }
  }

  void add(const Row& row, bool external) {
    Operator& op = all.emplace_back(
        Operator{row.name, std::string(row.iri), row.formula, {}, {}, {}, external});
    parse_ports(row, op);
    parse_rules(row, op);
    parse_units(row, op);
  }
};

const Catalogue& catalogue() {
  static const Catalogue instance;
  return instance;
}

const Operator* find(const std::unordered_map<std::string_view, const Operator*>& map,
                     std::string_view key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : found->second;
}

std::string to_string(Symbol symbol, const Operator& op) {
  return op.ports[symbol.port].name + "." + std::string(to_string(symbol.attribute));
}

}  // namespace

std::span<const Operator> operators() { return catalogue().all; }
const Operator* find_operator(std::string_view name) { return find(catalogue().by_name, name); }
const Operator* find_operator_by_iri(std::string_view iri) { return find(catalogue().by_iri, iri); }

std::string to_string(const FrameRule& rule, const Operator& op) {
  return to_string(rule.left, op) + " = " + to_string(rule.right, op);
}

}  // namespace sinew::algorithm
