#include "sinew/program/facts.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "sinew/algorithm/names.h"
#include "sinew/algorithm/read.h"

namespace sinew::program {
namespace {

using graph::Id;

struct CostRow {
  std::string_view name;  // of its property
  std::uint32_t OperationCount::*number;
};
constexpr std::array<CostRow, 6> kCosts = {{{"additions", &OperationCount::add},
                                            {"multiplications", &OperationCount::multiply},
                                            {"divisions", &OperationCount::divide},
                                            {"square-roots", &OperationCount::sqrt},
                                            {"sines-and-cosines", &OperationCount::sincos},
                                            {"choices", &OperationCount::select}}};

// The properties that facts are written with.
struct FactNames {
  explicit FactNames(graph::Terms& terms)
      : reads(word(terms, "reads")), writes(word(terms, "writes")) {
    for (std::size_t i = 0; i < kCosts.size(); ++i) costs[i] = word(terms, kCosts[i].name);
  }
  static Id word(graph::Terms& terms, std::string_view name) {
    return terms.iri(std::string(algorithm::kAlgorithmNamespace) + std::string(name));
  }
  std::vector<Id> all() const {
    std::vector<Id> list(costs.begin(), costs.end());
    list.insert(list.end(), {reads, writes});
    return list;
  }

  Id reads, writes;
  std::array<Id, kCosts.size()> costs;
};

void remove_facts(graph::Transaction& transaction, const FactNames& names, Id algorithm) {
  std::vector<graph::Quad> old;
  for (const Id property : names.all())
    transaction.view().match_in({}, property, {}, algorithm, [&](const graph::Quad& quad) {
      old.push_back(quad);
      return true;
    });
  for (const graph::Quad& quad : old) transaction.remove(quad);
}

}  // namespace

OperationCount cost_of(const Kernel& kernel, std::span<const std::uint32_t> sizes) {
  Computation computation;
  std::vector<std::vector<Traced>> values(sizes.size());
  std::vector<Traced*> arguments;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    values[i].resize(sizes[i]);
    if (!kernel.port(i, sizes.size()).output)
      for (Traced& value : values[i])
        value = Traced(computation.dag, computation.dag.input(computation.inputs++));
    arguments.push_back(values[i].data());
  }
  if (kernel.many())
    kernel.trace_many(arguments.data(), sizes);
  else
    kernel.trace(arguments.data());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (kernel.port(i, sizes.size()).output)
      for (const Traced& value : values[i])
        computation.results.push_back(value.in(computation.dag));
  return count_operations(computation);
}

std::size_t longest_chain(const Program& program) {
  // Of each variable: how many closures must have run before it is there. What a state holds comes
  // from the evaluation before, so whoever reads it waits for nobody.
  std::vector<std::size_t> depth(program.variables.size(), 0);
  std::size_t longest = 0;
  for (const std::uint32_t index : program.schedule) {
    const Closure& closure = program.closures[index];
    const Kernel& kernel = *find_kernel(closure.operation);
    const auto is_output = [&](std::size_t i) {
      return kernel.port(i, closure.arguments.size()).output;
    };
    std::size_t deepest = 0;
    for (std::size_t i = 0; i < closure.arguments.size(); ++i)
      if (!is_output(i)) deepest = std::max(deepest, depth[closure.arguments[i]]);
    longest = std::max(longest, deepest + 1);
    for (std::size_t i = 0; i < closure.arguments.size(); ++i)
      if (is_output(i) && program.variables[closure.arguments[i]].role == Role::kInternal)
        depth[closure.arguments[i]] = deepest + 1;
  }
  return longest;
}

void write_facts(graph::Store& store, Id algorithm) {
  const algorithm::Algorithm model = algorithm::read_checked(store.view(), algorithm);
  const FactNames names(store.terms());
  graph::Transaction transaction = store.begin();
  remove_facts(transaction, names, algorithm);
  std::map<std::pair<std::string_view, std::vector<std::uint32_t>>, OperationCount> costs;
  for (const algorithm::Closure& closure : model.closures) {
    if (closure.op->external) continue;
    const Kernel& kernel = *find_kernel(closure.op->name);
    std::vector<std::uint32_t> sizes;
    for (std::size_t i = 0; i < closure.arguments.size(); ++i) {
      const algorithm::Block& block = model.blocks[closure.arguments[i]];
      sizes.push_back(block.size);
      const bool writes = kernel.port(i, closure.arguments.size()).output;
      transaction.add({closure.id, writes ? names.writes : names.reads, block.id, algorithm});
    }
    const auto [cost, fresh] = costs.try_emplace({kernel.operation, sizes});
    if (fresh) cost->second = cost_of(kernel, sizes);
    for (std::size_t i = 0; i < kCosts.size(); ++i)
      transaction.add({closure.id, names.costs[i],
                       store.terms().integer(cost->second.*kCosts[i].number), algorithm});
  }
  transaction.commit();
}

}  // namespace sinew::program
