#include "sinew/algorithm/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "sinew/algorithm/check.h"
#include "sinew/graph/standard_iris.h"

namespace sinew::algorithm {
namespace {

using graph::Id;
using graph::Quad;
using graph::View;

// The terms of an algorithm that are there; none is added by reading, so each is looked for once.
struct Vocabulary {
  explicit Vocabulary(const graph::Terms& terms) : terms(terms) {}

  // Both have to be texts that stay: literals, or names of tables.
  Id operator()(std::string_view space, std::string_view name) const {
    const auto [known, fresh] = found.try_emplace({space.data(), name.data()});
    if (fresh) known->second = terms.find_iri(std::string(space) + std::string(name));
    return known->second;
  }
  Id sa(std::string_view name) const { return (*this)(kAlgorithmNamespace, name); }
  Id rdf(std::string_view name) const { return (*this)(graph::kRdf, name); }

  const graph::Terms& terms;

 private:
  struct HashOfPlaces {
    std::size_t operator()(const std::pair<const char*, const char*>& places) const {
      return std::hash<const char*>()(places.first) * 31 + std::hash<const char*>()(places.second);
    }
  };
  mutable std::unordered_map<std::pair<const char*, const char*>, Id, HashOfPlaces> found;
};

class Reader {
 public:
  Reader(const View& view, Id algorithm, Report& report, const graph::Places* places)
      : view_(view),
        terms_(view.terms()),
        word_(terms_),
        report_(report),
        places_(places),
        type_(word_.rdf("type")),
        first_(word_.rdf("first")),
        rest_(word_.rdf("rest")),
        nil_(word_.rdf("nil")) {
    result_.id = algorithm;
  }

  Algorithm read() {
    for (const Id closure : objects(result_.id, word_.sa("closure"))) read_closure(closure);
    for (const Id block : objects(result_.id, word_.sa("data"))) block_index(block);
    if (const Id period = one(result_.id, word_.sa("period"), "sa:period")) {
      result_.period_s = terms_.number(period);
      if (!result_.period_s || !(*result_.period_s > 0))
        error(result_.id, fmt::format("its period is {}", text(period)), "seconds, above zero");
    }
    read_schedule();
    put_in_order(result_);
    return std::move(result_);
  }

 private:
  std::string text(Id id) const { return id ? std::string(terms_.text(id)) : ""; }

  void error(Id node, std::string what, std::string remedy) {
    report_.error(places_ ? places_->find(node) : Place{}, text(node), std::move(what),
                  std::move(remedy));
  }

  std::vector<Id> objects(Id subject, Id predicate) const {
    std::vector<Id> found;
    if (!predicate) return found;
    view_.match_in(subject, predicate, {}, result_.id, [&](const Quad& quad) {
      found.push_back(quad.object);
      return true;
    });
    return found;
  }

  // The one object, or null; two are an error.
  Id one(Id subject, Id predicate, std::string_view what) {
    Id first;
    bool more = false;
    if (!predicate) return first;
    view_.match_in(subject, predicate, {}, result_.id, [&](const Quad& quad) {
      more = static_cast<bool>(first);
      if (!more) first = quad.object;
      return !more;
    });
    if (more) error(subject, fmt::format("has two values of {}", what), "state one");
    return first;
  }

  std::vector<Id> list(Id owner, Id head) {
    std::vector<Id> items;
    for (Id node = head; node != nil_;) {
      const Id item = one(node, first_, "rdf:first");
      const Id next = one(node, rest_, "rdf:rest");
      if (!item || !next || items.size() == kMaximumListLength) {
        error(owner, "its list is broken or endless",
              "every list node has one rdf:first and one rdf:rest, the last of them rdf:nil");
        break;
      }
      items.push_back(item);
      node = next;
    }
    return items;
  }

  std::uint32_t block_index(Id id) {
    const auto [place, fresh] =
        blocks_.try_emplace(id, static_cast<std::uint32_t>(result_.blocks.size()));
    if (fresh) result_.blocks.push_back(read_block(id));
    return place->second;
  }

  Block read_block(Id id) {
    Block block;
    block.id = id;
    const Id name = one(id, word_.sa("name"), "sa:name");
    const Id slot = one(id, word_.sa("slot"), "sa:slot");
    block.name = name ? text(name) : std::string(short_name(text(id)));
    block.slot = slot ? text(slot) : block.name.substr(0, block.name.find('.'));
    const Id quantity = one(id, word_.sa("quantity"), "sa:quantity");
    block.quantity = quantity ? find_quantity(text(quantity)) : nullptr;
    if (block.quantity == nullptr) {
      error(id,
            quantity ? fmt::format("there is no quantity named {}", text(quantity))
                     : "a data block without a quantity",
            "name one of sinew/algorithm/quantities.cpp by sa:quantity");
      block.quantity = &quantities().front();
    }
    block.represents = one(id, word_.sa("represents"), "sa:represents");
    for (std::size_t i = 0; i < kAttributes; ++i) {
      const std::string_view symbol = to_string(static_cast<Attribute>(i));
      block.symbols[i] = one(id, word_.sa(symbol), symbol);
    }
    read_unit(block);
    read_role(block);
    const Id size = one(id, word_.sa("size"), "sa:size");
    block.size = size ? static_cast<std::uint32_t>(terms_.integer_value(size).value_or(0))
                      : block.quantity->size;
    const Id output = one(id, word_.sa("output"), "sa:output");
    block.output = output && text(output) == "true";
    read_held(block);
    if (const Id index = one(id, word_.sa("index"), "sa:index"))
      block.index = static_cast<std::uint32_t>(terms_.integer_value(index).value_or(kNoIndex));
    if (const Id head = one(id, word_(kTreeNamespace, "value"), "tree:value")) {
      for (const Id item : list(id, head)) {
        const std::optional<double> number = terms_.number(item);
        if (!number) error(id, fmt::format("{} is not a number", text(item)), "list numbers");
        block.value.push_back(number.value_or(0));
      }
    }
    read_at_swap(block);
    return block;
  }

  void read_at_swap(Block& block) {
    const Id node = one(block.id, word_.sa("at-swap"), "sa:at-swap");
    if (!node) return;
    if (block.role != Role::kState) {
      error(block.id, "sa:at-swap of a data block that is no state",
            "state it of blocks with the role sa:state");
      return;
    }
    AtSwap rule;
    if (node == word_.sa("initialise")) {
      block.at_swap = rule;
      return;
    }
    const Id from = one(node, word_.sa("converted-from"), "sa:converted-from");
    rule.from = from ? from : block.id;
    const Id operation = one(node, word_.sa("operator"), "sa:operator");
    const Id factor = one(node, word_.sa("factor"), "sa:factor");
    if (!operation == !factor) {
      error(block.id,
            "its conversion at a swap states neither or both of sa:operator and sa:factor",
            "sa:initialise, or a node with one of them");
      return;
    }
    if (operation) {
      rule.kind = AtSwap::Kind::kOperator;
      rule.op = find_operator_by_iri(text(operation));
      const bool one_to_one = rule.op && !rule.op->external && rule.op->ports.size() == 2 &&
                              !rule.op->ports[0].many &&
                              rule.op->ports[1].direction == Direction::kOut;
      if (!one_to_one || rule.op->ports[1].quantity != block.quantity->name) {
        error(
            block.id,
            fmt::format("{} makes no {} of one data block", text(operation), block.quantity->name),
            "an operator of the catalogue with one input and one output");
        return;
      }
    } else {
      rule.kind = AtSwap::Kind::kScale;
      const Id value =
          one(factor, terms_.find_iri("http://qudt.org/schema/qudt/value"), "qudt:value");
      const Id unit = one(factor, terms_.find_iri("http://qudt.org/schema/qudt/unit"), "qudt:unit");
      const auto number = value ? terms_.number(value) : std::nullopt;
      if (!number || !unit) {
        error(block.id, "the factor of its conversion has no value or no unit",
              "[ qudt:value 2.0 ; qudt:unit unit:PER-M ]");
        return;
      }
      rule.factor = *number;
      rule.factor_unit = short_name(text(unit));
    }
    block.at_swap = rule;
  }

  void read_held(Block& block) {
    const Id held = one(block.id, word_.sa("held"), "sa:held");
    block.held = held && text(held) == "true";
    if (block.held && block.role != Role::kInput && block.role != Role::kInternal)
      error(block.id, fmt::format("a {} that is held", to_string(block.role)),
            "hold inputs and what closures compute");
  }

  // A quantity of several units has several triples; their order is the quantity's own.
  void read_unit(Block& block) {
    std::vector<std::string> found;
    for (const Id unit : objects(block.id, terms_.find_iri("http://qudt.org/schema/qudt/unit")))
      found.emplace_back(short_name(text(unit)));
    std::sort(found.begin(), found.end());
    for (const std::string_view known : {block.quantity->unit, block.quantity->unit_prismatic}) {
      std::vector<std::string> words;
      for (std::string_view rest = known; !rest.empty();) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(rest.size(), end + 1));
      }
      std::sort(words.begin(), words.end());
      if (!words.empty() && words == found) {
        block.unit = known;
        return;
      }
    }
    block.unit = fmt::format("{}", fmt::join(found, " "));
  }

  void read_role(Block& block) {
    const Id role = one(block.id, word_.sa("role"), "sa:role");
    for (std::size_t i = 0; i < kRoles; ++i) {
      const auto candidate = static_cast<Role>(i);
      if (role && role == word_.sa(to_string(candidate))) {
        block.role = candidate;
        return;
      }
    }
    error(block.id, "a data block without a role",
          "sa:role is sa:input, sa:constant, sa:internal or sa:state");
  }

  void read_closure(Id id) {
    Closure closure;
    closure.id = id;
    for (const Id type : objects(id, type_)) {
      const auto [known, fresh] = operators_.try_emplace(type);
      if (fresh) known->second = find_operator_by_iri(terms_.text(type));
      if (known->second != nullptr) closure.op = known->second;
    }
    if (closure.op == nullptr) {
      const std::vector<Id> types = objects(id, type_);
      error(id,
            types.empty() ? "a closure without a type"
                          : fmt::format("there is no operator {}", text(types.front())),
            "its type is the IRI of an operator of the catalogue");
      return;
    }
    for (const Port& port : closure.op->ports) {
      std::vector<Id> connected;
      if (const Id property = property_of(port)) {
        connected = objects(id, property);
        if (port.many && connected.size() == 1) connected = list(id, connected.front());
      }
      closure.counts.push_back(static_cast<std::uint32_t>(connected.size()));
      for (const Id block : connected) closure.arguments.push_back(block_index(block));
    }
    closure.step = one(id, word_.sa("step"), "sa:step");
    closure.about = one(id, word_.sa("about"), "sa:about");
    if (closure.op->external) read_properties(closure);
    closures_.emplace(id, static_cast<std::uint32_t>(result_.closures.size()));
    result_.closures.push_back(std::move(closure));
  }

  Id property_of(const Port& port) {
    const auto [known, fresh] = properties_.try_emplace(&port);
    if (fresh) known->second = terms_.find_iri(port.iri);
    return known->second;
  }

  // Everything that is said of an external closure beside its ports. A list is its numbers or
  // words, separated by spaces.
  void read_properties(Closure& closure) {
    view_.match_in(closure.id, {}, {}, result_.id, [&](const Quad& quad) {
      const std::string_view iri = terms_.text(quad.predicate);
      const bool known = quad.predicate == type_ || quad.predicate == word_.sa("step") ||
                         quad.predicate == word_.sa("about") ||
                         std::any_of(closure.op->ports.begin(), closure.op->ports.end(),
                                     [&](const Port& port) { return port.iri == iri; });
      if (known) return true;
      std::string value = text(quad.object);
      if (quad.object == nil_ || one(quad.object, first_, "rdf:first")) {
        value.clear();
        for (const Id item : list(closure.id, quad.object))
          value += (value.empty() ? "" : " ") + text(item);
      }
      closure.properties.push_back({std::string(short_name(iri)), std::move(value)});
      return true;
    });
    std::sort(closure.properties.begin(), closure.properties.end());
  }

  void read_schedule() {
    const Id schedule = one(result_.id, word_.sa("schedule"), "sa:schedule");
    const Id property = terms_.find_iri(kTriggerChain);
    const Id head = schedule && property ? one(schedule, property, "algo:trigger-chain") : Id{};
    if (!head) {
      error(result_.id, "an algorithm without a schedule",
            "sa:schedule names an algo:Schedule with an algo:trigger-chain");
      return;
    }
    for (const Id item : list(schedule, head)) {
      auto found = closures_.find(item);
      if (found == closures_.end()) {
        // Woven into the schedule without being listed as a closure of the algorithm.
        read_closure(item);
        found = closures_.find(item);
      }
      if (found != closures_.end()) result_.schedule.push_back(found->second);
    }
  }

  static constexpr std::string_view kTriggerChain =
      "https://comp-rob2b.github.io/metamodels/algorithm#trigger-chain";

  const View& view_;
  const graph::Terms& terms_;
  Vocabulary word_;
  Report& report_;
  const graph::Places* places_;
  Id type_, first_, rest_, nil_;
  Algorithm result_;
  std::unordered_map<Id, std::uint32_t> blocks_, closures_;
  std::unordered_map<Id, const Operator*> operators_;  // by type
  std::unordered_map<const Port*, Id> properties_;     // that connect to a port
};

}  // namespace

std::vector<Id> find_algorithms(const View& view) {
  std::vector<Id> found;
  const Vocabulary word(view.terms());
  const Id type = word.rdf("type"), algorithm = word.sa("Algorithm");
  if (!type || !algorithm) return found;
  view.match({}, type, algorithm, graph::Dataset::kUnion, [&](const Quad& quad) {
    found.push_back(quad.subject);
    return true;
  });
  return found;
}

void put_in_order(Algorithm& model) {
  std::vector<std::uint32_t> order, seen(model.blocks.size(), 0);
  const auto take = [&](std::uint32_t block) {
    if (seen[block]++ == 0) order.push_back(block);
  };
  const auto take_sorted = [&](auto&& wanted) {
    std::vector<std::uint32_t> some;
    for (std::uint32_t i = 0; i < model.blocks.size(); ++i)
      if (seen[i] == 0 && wanted(model.blocks[i])) some.push_back(i);
    std::sort(some.begin(), some.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Block &x = model.blocks[a], &y = model.blocks[b];
      return std::tie(x.index, x.name) < std::tie(y.index, y.name);
    });
    for (const std::uint32_t block : some) take(block);
  };
  take_sorted([](const Block& block) { return block.role == Role::kInput; });
  take_sorted([](const Block& block) { return block.output; });
  for (const std::uint32_t closure : model.schedule)
    for (const std::uint32_t block : model.closures[closure].arguments) take(block);
  take_sorted([](const Block&) { return true; });

  std::vector<std::uint32_t> place(order.size());
  std::vector<Block> blocks(order.size());
  for (std::uint32_t at = 0; at < order.size(); ++at) {
    place[order[at]] = at;
    blocks[at] = std::move(model.blocks[order[at]]);
  }
  model.blocks = std::move(blocks);
  for (Closure& closure : model.closures)
    for (std::uint32_t& argument : closure.arguments) argument = place[argument];
}

Algorithm read(const View& view, Id algorithm, Report& report, const graph::Places* places) {
  return Reader(view, algorithm, report, places).read();
}

Algorithm read_checked(const View& view, Id algorithm, const graph::Places* places) {
  Report report;
  Algorithm result = read(view, algorithm, report, places);
  report.throw_if_errors();
  check_algorithm(view.terms(), result, report);
  report.throw_if_errors();
  return result;
}

}  // namespace sinew::algorithm
