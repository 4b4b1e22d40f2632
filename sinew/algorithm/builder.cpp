#include "sinew/algorithm/builder.h"

#include <stdexcept>
#include <utility>

#include "sinew/algorithm/check.h"

namespace sinew::algorithm {

using graph::Id;

namespace {

// Blocks, and closures, of an algorithm of some size: those of an arm's inverse dynamics.
constexpr std::size_t kExpected = 256;

}  // namespace

Builder::Builder(graph::Store& store, graph::Transaction& transaction, Id algorithm,
                 BuilderWrites writes)
    : terms_(store.terms()), transaction_(transaction), names_(terms_), writes_(writes) {
  algorithm_.id = algorithm;
  bool empty = true;
  transaction_.view().match_in({}, {}, {}, algorithm, [&](const graph::Quad&) {
    empty = false;
    return false;
  });
  if (!empty)
    throw Error(Problem{{},
                        std::string(terms_.text(algorithm)),
                        "this algorithm exists already",
                        "clear its graph first",
                        {},
                        {}});
  if (writes_ == BuilderWrites::kGraph) add(algorithm, names_.type, names_.algorithm);
  algorithm_.blocks.reserve(kExpected);
  algorithm_.closures.reserve(kExpected);
  by_slot_.reserve(kExpected);
  closures_.reserve(kExpected);
  name_uses_.reserve(kExpected);
}

void Builder::add(Id subject, Id predicate, Id object) {
  transaction_.add({subject, predicate, object, algorithm_.id});
}

std::uint32_t Builder::find(std::string_view slot, Id element) const {
  const Id literal = terms_.find_literal(slot);
  if (!literal) return kNoIndex;
  const auto found = by_slot_.find({literal, element});
  return found == by_slot_.end() ? kNoIndex : found->second;
}

std::string Builder::unique_name(std::string_view slot, std::string_view label) {
  std::pmr::string name(&memory_);
  name.reserve(slot.size() + 1 + label.size());
  name = slot;
  if (label != kWholeRobot) (name += '.') += label;
  // Elements of different namespaces may share their last segment.
  const auto known = name_uses_.try_emplace(std::move(name), 0).first;
  const std::uint32_t use = ++known->second;
  std::string unique(known->first);
  return use == 1 ? unique : unique + "-" + std::to_string(use);
}

std::uint32_t Builder::block(const BlockSpec& spec) {
  const Key key{terms_.literal(spec.slot), spec.represents};
  if (const auto found = by_slot_.find(key); found != by_slot_.end()) return found->second;
  const Quantity* quantity = find_quantity(spec.quantity);
  if (quantity == nullptr)
    throw std::logic_error("no quantity is named " + std::string(spec.quantity));

  Block block;
  block.id = terms_.derived(names_.data_block, {algorithm_.id, key.slot, spec.represents});
  block.slot = spec.slot;
  block.name = unique_name(
      spec.slot, spec.label.empty() ? short_name(terms_.text(spec.represents)) : spec.label);
  block.quantity = quantity;
  block.represents = spec.represents;
  block.symbols = {spec.of, spec.wrt, spec.reference, spec.seen_by};
  block.unit = !spec.unit.empty() ? spec.unit
               : spec.prismatic   ? quantity->unit_prismatic
                                  : quantity->unit;
  block.role = spec.role;
  block.size = quantity->size != 0 ? quantity->size : spec.size;
  block.value.assign(spec.value.begin(), spec.value.end());
  if (block.role == Role::kInput) block.index = inputs_++;
  Report report;
  check_block(terms_, block, report);
  report.throw_if_errors();

  const auto index = static_cast<std::uint32_t>(algorithm_.blocks.size());
  by_slot_.emplace(key, index);
  if (writes_ == BuilderWrites::kGraph) write(block, key.slot);
  algorithm_.blocks.push_back(std::move(block));
  return index;
}

void Builder::write(const Block& block, Id slot) {
  add(algorithm_.id, names_.data, block.id);
  add(block.id, names_.type, names_.data_block);
  add(block.id, names_.quantity, terms_.literal(block.quantity->name));
  add(block.id, names_.slot, slot);
  add(block.id, names_.represents, block.represents);
  for (std::size_t i = 0; i < kAttributes; ++i)
    if (block.symbols[i]) add(block.id, names_.symbols[i], block.symbols[i]);
  for (std::string_view rest = block.unit; !rest.empty();) {
    const std::string_view unit = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), unit.size() + 1));
    add(block.id, names_.unit, terms_.iri(std::string(kUnitNamespace) + std::string(unit)));
  }
  add(block.id, names_.role, names_.roles[static_cast<std::size_t>(block.role)]);
  add(block.id, names_.size, terms_.integer(block.size));
  if (block.value.empty()) return;
  std::vector<Id> numbers;
  numbers.reserve(block.value.size());
  for (const double number : block.value) numbers.push_back(terms_.real(number));
  add(block.id, names_.value, write_list(terms_, transaction_, names_, algorithm_.id, numbers));
}

void Builder::closure(std::string_view operation, std::initializer_list<std::uint32_t> arguments,
                      const Cause& cause) {
  const Operator* op = find_operator(operation);
  if (op == nullptr) throw std::logic_error("no operator is named " + std::string(operation));
  append(*op, arguments, {}, cause);
}

void Builder::closure_of_many(std::string_view operation, std::span<const std::uint32_t> many,
                              std::initializer_list<std::uint32_t> others, const Cause& cause) {
  const Operator* op = find_operator(operation);
  if (op == nullptr) throw std::logic_error("no operator is named " + std::string(operation));
  std::vector<std::uint32_t> arguments(many.begin(), many.end());
  arguments.insert(arguments.end(), others);
  std::vector<std::uint32_t> counts(op->ports.size(), 1);
  counts[0] = static_cast<std::uint32_t>(many.size());
  append(*op, std::move(arguments), std::move(counts), cause);
}

void Builder::closure_with_counts(std::string_view operation, std::vector<std::uint32_t> arguments,
                                  std::vector<std::uint32_t> counts, const Cause& cause) {
  const Operator* op = find_operator(operation);
  if (op == nullptr) throw std::logic_error("no operator is named " + std::string(operation));
  append(*op, std::move(arguments), std::move(counts), cause);
}

void Builder::append(const Operator& op, std::vector<std::uint32_t> arguments,
                     std::vector<std::uint32_t> counts, const Cause& cause) {
  std::vector<Id>& parts = parts_;
  parts.assign(1, algorithm_.id);
  for (const std::uint32_t argument : arguments) parts.push_back(algorithm_.blocks[argument].id);
  Closure closure;
  closure.op = &op;
  Id& role = operator_terms_[&op];
  if (!role) role = terms_.iri(op.iri);
  closure.id = terms_.derived(role, parts);
  closure.arguments = std::move(arguments);
  closure.counts = std::move(counts);
  closure.step = cause.step;
  closure.about = cause.about;
  const auto index = static_cast<std::uint32_t>(algorithm_.closures.size());
  if (!closures_.try_emplace(closure.id, index).second) return;
  Report report;
  check_closure(terms_, algorithm_, closure, report);
  report.throw_if_errors();
  algorithm_.closures.push_back(std::move(closure));
  algorithm_.schedule.push_back(index);
  if (writes_ == BuilderWrites::kGraph) write(algorithm_.closures.back());
}

void Builder::write(const Closure& closure) {
  std::vector<Id>& ports = port_terms_[closure.op->name];
  if (ports.empty())
    for (const Port& port : closure.op->ports) ports.push_back(terms_.iri(port.iri));
  add(algorithm_.id, names_.closure, closure.id);
  add(closure.id, names_.type, terms_.iri(closure.op->iri));
  std::vector<std::vector<Id>> lists(ports.size());
  for_each_argument(closure, [&](const Port& port, std::uint32_t block) {
    const auto at = static_cast<std::size_t>(&port - closure.op->ports.data());
    lists[at].push_back(algorithm_.blocks[block].id);
  });
  for (std::size_t at = 0; at < ports.size(); ++at) {
    const Id object = closure.op->ports[at].many
                          ? write_list(terms_, transaction_, names_, algorithm_.id, lists[at])
                          : lists[at].front();
    add(closure.id, ports[at], object);
  }
  if (closure.step) add(closure.id, names_.step, closure.step);
  if (closure.about) add(closure.id, names_.about, closure.about);
}

void Builder::output(std::uint32_t index, std::string_view name) {
  Block& block = algorithm_.blocks[index];
  if (block.output) return;
  block.output = true;
  if (!name.empty()) block.name = name;
  // An input that is handed on keeps its place among the inputs.
  if (block.role != Role::kInput) block.index = outputs_++;
}

void Builder::rename(std::uint32_t block, std::string name) {
  ++name_uses_[std::pmr::string(name, &memory_)];
  algorithm_.blocks[block].name = std::move(name);
}

void Builder::finish() {
  if (writes_ == BuilderWrites::kGraph) write_end();
  Report report;
  check_together(terms_, algorithm_, report);  // the others were checked when they were made
  report.throw_if_errors();
}

void Builder::write_end() {
  std::vector<Id> chain;
  chain.reserve(algorithm_.schedule.size());
  for (const std::uint32_t closure : algorithm_.schedule)
    chain.push_back(algorithm_.closures[closure].id);
  for (const Block& block : algorithm_.blocks) {
    add(block.id, names_.name, terms_.literal(block.name));
    if (block.output) add(block.id, names_.output, names_.true_literal);
    if (block.held) add(block.id, names_.held, names_.true_literal);
    if (block.index != kNoIndex) add(block.id, names_.index, terms_.integer(block.index));
  }
  const Id schedule = terms_.derived(names_.schedule_type, {algorithm_.id});
  add(algorithm_.id, names_.schedule, schedule);
  add(schedule, names_.type, names_.schedule_type);
  add(schedule, names_.trigger_chain,
      write_list(terms_, transaction_, names_, algorithm_.id, chain));
}

Id write_list(graph::Terms& terms, graph::Transaction& transaction, const Names& names, Id graph,
              std::span<const Id> items) {
  Id head = names.nil;
  for (auto item = items.rbegin(); item != items.rend(); ++item) {
    const Id node = terms.fresh_blank();
    transaction.add({node, names.first, *item, graph});
    transaction.add({node, names.rest, head, graph});
    head = node;
  }
  return head;
}

}  // namespace sinew::algorithm
