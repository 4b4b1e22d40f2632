#include "sinew/data/compose.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "sinew/base/spelling.h"

namespace sinew::data {
namespace {

std::string name_of(const Port& port) { return fmt::format("{}.{}", port.closure, port.port); }

std::optional<Index> prototype_of(const Library& library, const Port& port, Report& report) {
  const auto found = library.find_prototype(port.prototype);
  if (!found) {
    std::vector<std::string> names;
    for (const Prototype& prototype : library.prototypes) names.push_back(prototype.name);
    report.error(port.place, name_of(port),
                 fmt::format("there is no data prototype '{}'", port.prototype),
                 did_you_mean(port.prototype, names, "declare it with 'dproto'"));
  }
  return found;
}

}  // namespace

std::vector<InsertedConversion> insert_conversions(const Library& library,
                                                   const std::vector<Connection>& connections,
                                                   const PlanOptions& options) {
  Report report;
  std::vector<InsertedConversion> inserted;
  std::map<std::tuple<std::string, std::string, Index>, std::size_t>
      known;  // output and wanted prototype
  for (std::size_t i = 0; i < connections.size(); ++i) {
    const auto& [output, input] = connections[i];
    const auto from = prototype_of(library, output, report),
               to = prototype_of(library, input, report);
    if (!from || !to || *from == *to) continue;
    const auto key = std::make_tuple(output.closure, output.port, *to);
    if (const auto conversion = known.find(key); conversion != known.end()) {
      inserted[conversion->second].connections.push_back(i);
      continue;
    }
    try {
      InsertedConversion conversion;
      conversion.plan = find_plan(library, *from, *to, options);
      conversion.block = fmt::format("{}.{}.as.{}", output.closure, output.port, input.prototype);
      for (const Index relation : inputs_of(library, conversion.plan)) {
        conversion.inputs.push_back(library.relations[relation].name());
      }
      conversion.closure = "convert." + conversion.block;
      conversion.connections = {i};
      known.emplace(key, inserted.size());
      inserted.push_back(std::move(conversion));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        report.error(input.place, name_of(input),
                     fmt::format("is connected to {}: {}", name_of(output), problem.what),
                     problem.remedy);
      }
    }
  }
  report.throw_if_errors();
  return inserted;
}

}  // namespace sinew::data
