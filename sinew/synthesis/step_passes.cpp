#include "sinew/synthesis/step_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/step_models.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;
using graph::Quad;

// What one run of an INSERT says, node by node in the order of their first mention.
class Description {
 public:
  Description(Context& context, const InsertPass& pass, std::span<const Quad> triples)
      : context_(context), pass_(pass), terms_(context.builder.terms()) {
    if (triples.size() > kMostInsertions)
      fail({}, fmt::format("it inserts {} triples for one visit", triples.size()),
           fmt::format("up to {}", kMostInsertions));
    for (const Quad& triple : triples) {
      const auto [found, fresh] = by_node_.try_emplace(triple.subject);
      if (fresh) order_.push_back(triple.subject);
      found->second.push_back(triple);
    }
  }

  void build() {
    const Id block_type = sa("DataBlock");
    for (const Id node : order_)
      if (type_of(node) == block_type) build_block(node);
    for (const Id node : order_) {
      const Id type = type_of(node);
      if (type != block_type && type) build_closure(node, type);
    }
    for (const Id node : order_)
      for (const Quad& triple : by_node_.at(node))
        if (!used_.contains(key(triple)))
          fail(node,
               fmt::format("{} {} means nothing here", terms_.text(triple.predicate),
                           terms_.text(triple.object)),
               "describe data blocks (a sa:DataBlock) and closures (a so:OPERATOR with its ports)");
  }

 private:
  [[noreturn]] void fail(Id node, std::string what, std::string remedy) const {
    const std::string about =
        node && terms_.is_iri(node) ? " (" + std::string(terms_.text(node)) + ")" : "";
    throw Error(
        Problem{pass_.place, pass_.step, std::move(what) + about, std::move(remedy), {}, {}});
  }

  Id sa(std::string_view name) const {
    return terms_.iri(std::string(algorithm::kAlgorithmNamespace) + std::string(name));
  }

  using Key = std::array<std::uint32_t, 3>;
  static Key key(const Quad& triple) {
    return {triple.subject.value, triple.predicate.value, triple.object.value};
  }

  std::vector<Id> take(Id node, Id predicate) {
    std::vector<Id> found;
    const auto triples = by_node_.find(node);
    if (triples == by_node_.end()) return found;
    for (const Quad& triple : triples->second)
      if (triple.predicate == predicate) {
        found.push_back(triple.object);
        used_.insert(key(triple));
      }
    return found;
  }

  Id one(Id node, Id predicate, std::string_view what, bool required) {
    const std::vector<Id> found = take(node, predicate);
    if (found.size() > 1) fail(node, fmt::format("two values of {}", what), "insert one");
    if (found.empty() && required) fail(node, fmt::format("{} is missing", what), "insert it");
    return found.empty() ? Id{} : found.front();
  }

  Id type_of(Id node) { return one(node, context_.builder.names().type, "its type", false); }

  std::vector<Id> items(Id node, Id head, std::string_view what) {
    const algorithm::Names& names = context_.builder.names();
    std::vector<Id> found;
    while (head != names.nil) {
      found.push_back(one(head, names.first, "rdf:first", true));
      if (found.size() > kMostInsertions)
        fail(node, fmt::format("an endless list of {}", what), "");
      head = one(head, names.rest, "rdf:rest", true);
    }
    return found;
  }

  void build_block(Id node) {
    const algorithm::Names& names = context_.builder.names();
    const std::string slot(terms_.text(one(node, sa("slot"), "sa:slot", true)));
    if (std::find(pass_.slots.begin(), pass_.slots.end(), slot) == pass_.slots.end())
      fail(node, fmt::format("it makes a data block for {}, which the step does not declare", slot),
           "add it to what the step gives");
    const std::string quantity(terms_.text(one(node, names.quantity, "sa:quantity", true)));
    if (algorithm::find_quantity(quantity) == nullptr)
      fail(node, fmt::format("there is no quantity {}", quantity),
           "name one of sinew/algorithm/quantities.cpp");
    algorithm::BlockSpec spec = {.slot = slot,
                                 .represents = one(node, names.represents, "sa:represents", true),
                                 .quantity = quantity};
    spec.of = one(node, names.symbols[0], "sa:of", false);
    spec.wrt = one(node, names.symbols[1], "sa:with-respect-to", false);
    spec.reference = one(node, names.symbols[2], "sa:reference-point", false);
    spec.seen_by = one(node, names.symbols[3], "sa:seen-by", false);
    const Id role = one(node, names.role, "sa:role", true);
    for (std::size_t i = 0; i < algorithm::kRoles; ++i)
      if (role == names.roles[i]) spec.role = static_cast<algorithm::Role>(i);
    if (std::find(names.roles.begin(), names.roles.end(), role) == names.roles.end())
      fail(node, fmt::format("{} is no role", terms_.text(role)),
           "sa:input, sa:constant, sa:internal or sa:state");
    if (const Id size = one(node, names.size, "sa:size", false))
      spec.size = static_cast<std::uint32_t>(terms_.integer_value(size).value_or(0));
    std::string label;
    if (const Id name = one(node, names.name, "sa:name", false)) label = terms_.text(name);
    spec.label = label;
    std::string unit;
    if (const Id own = one(node, names.unit, "qudt:unit", false))
      unit = algorithm::short_name(terms_.text(own));
    spec.unit = unit;
    std::vector<double> numbers;
    if (const Id head = one(node, names.value, "tree:value", false))
      for (const Id item : items(node, head, "tree:value")) {
        const auto number = terms_.number(item);
        if (!number) fail(node, fmt::format("{} is no number", terms_.text(item)), "list numbers");
        numbers.push_back(*number);
      }
    spec.value = numbers;
    blocks_[node] = context_.make(spec);
  }

  BlockIndex block(Id closure, Id node) {
    if (const auto made = blocks_.find(node); made != blocks_.end()) return made->second;
    const std::vector<algorithm::Block>& all = context_.builder.algorithm().blocks;
    for (BlockIndex i = 0; i < all.size(); ++i)
      if (all[i].id == node) return i;
    fail(closure, fmt::format("{} is no data block", terms_.text(node)),
         "describe it in the same INSERT, or find it by ELEMENT slot:NAME ?block");
  }

  void build_closure(Id node, Id type) {
    const algorithm::Operator* op = algorithm::find_operator_by_iri(terms_.text(type));
    if (op == nullptr)
      fail(node, fmt::format("there is no operator {}", terms_.text(type)),
           "name one of sinew/algorithm/operators_*.cpp by its IRI");
    std::vector<BlockIndex> arguments;
    std::vector<std::uint32_t> counts;
    for (const algorithm::Port& port : op->ports) {
      const Id connected = one(node, terms_.iri(port.iri), port.iri, true);
      const std::vector<Id> many =
          port.many ? items(node, connected, port.name) : std::vector<Id>{connected};
      for (const Id each : many) arguments.push_back(block(node, each));
      counts.push_back(static_cast<std::uint32_t>(many.size()));
    }
    const Id about = one(node, context_.builder.names().about, "sa:about", false);
    context_.closure_with_counts(op->name, std::move(arguments), std::move(counts),
                                 about ? about : about_);
  }

 public:
  Id about_;  // of closures that do not say
 private:
  Context& context_;
  const InsertPass& pass_;
  graph::Terms& terms_;
  std::vector<Id> order_;
  std::unordered_map<Id, std::vector<Quad>> by_node_;
  std::set<Key> used_;
  std::unordered_map<Id, BlockIndex> blocks_;
};

}  // namespace

Pass insert_pass(InsertPass pass) {
  return [pass = std::move(pass)](Context& context, const Visit& visit) {
    context.show_slots(pass.slots);
    const Id parameters[] = {visit.node, visit.parent, context.builder.algorithm().id};
    const std::vector<Quad> triples = pass.insert->triples(context.view, parameters);
    Description description(context, pass, triples);
    description.about_ = visit.node;
    try {
      description.build();
    } catch (const Error& fault) {
      // What the builder finds wrong has no place of its own: it comes from this pass.
      std::vector<Problem> problems = fault.problems();
      for (Problem& problem : problems)
        if (problem.place.file.empty()) {
          problem.place = pass.place;
          problem.what = "step " + pass.step + ": " + problem.what;
        }
      throw Error(std::move(problems));
    }
  };
}

}  // namespace sinew::synthesis
