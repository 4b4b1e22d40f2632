#include "sinew/algorithm/names.h"

#include "sinew/graph/percent_encoding.h"
#include "sinew/graph/standard_iris.h"

namespace sinew::algorithm {
namespace {

constexpr std::string_view kPublished = "https://comp-rob2b.github.io/metamodels/algorithm#";

graph::Id join(graph::Terms& terms, std::string_view space, std::string_view name) {
  return terms.iri(std::string(space) + std::string(name));
}

}  // namespace

std::string_view to_string(Role role) {
  constexpr std::array<std::string_view, kRoles> names = {"input", "constant", "internal", "state"};
  return names[static_cast<std::size_t>(role)];
}

Names::Names(graph::Terms& terms) {
  const auto sa = [&](std::string_view name) { return join(terms, kAlgorithmNamespace, name); };
  type = terms.iri(graph::kRdfType);
  first = terms.iri(graph::kRdfFirst);
  rest = terms.iri(graph::kRdfRest);
  nil = terms.iri(graph::kRdfNil);
  algorithm = sa("Algorithm");
  data = sa("data");
  closure = sa("closure");
  schedule = sa("schedule");
  data_block = sa("DataBlock");
  quantity = sa("quantity");
  slot = sa("slot");
  name = sa("name");
  index = sa("index");
  represents = sa("represents");
  role = sa("role");
  output = sa("output");
  held = sa("held");
  size = sa("size");
  step = sa("step");
  about = sa("about");
  for (std::size_t i = 0; i < kRoles; ++i) roles[i] = sa(to_string(static_cast<Role>(i)));
  for (std::size_t i = 0; i < kAttributes; ++i)
    symbols[i] = sa(to_string(static_cast<Attribute>(i)));
  schedule_type = join(terms, kPublished, "Schedule");
  trigger_chain = join(terms, kPublished, "trigger-chain");
  value = join(terms, kTreeNamespace, "value");
  unit = terms.iri("http://qudt.org/schema/qudt/unit");
  true_literal = terms.boolean(true);
}

std::string_view short_name(std::string_view iri) {
  std::size_t begin = iri.size();
  while (begin > 0 && iri[begin - 1] != '#' && iri[begin - 1] != '/' && iri[begin - 1] != ':')
    --begin;
  return begin == iri.size() ? iri : iri.substr(begin);
}

bool is_called(std::string_view iri, std::string_view name) {
  const std::string_view own = short_name(iri);
  return own == name ||
         (own.find('%') != std::string_view::npos && graph::percent_decoded(own) == name);
}

}  // namespace sinew::algorithm
