#include <nlohmann/json.hpp>

#include "sinew/backend/c_parts.h"

namespace sinew::backend {
namespace {

using Json = nlohmann::ordered_json;

Json slots(const program::Program& program, const std::vector<program::Slot>& slots) {
  Json list = Json::array();
  for (const program::Slot& slot : slots) {
    const program::Variable& v = program.variables[slot.variable];
    Json item = {{"name", v.name},         {"iri", v.represents}, {"offset", slot.offset},
                 {"size", v.size},         {"unit", v.unit},      {"frame", v.frame},
                 {"quantity", v.quantity}, {"data", v.iri}};
    if (v.role == program::Role::kState) item["value"] = v.value;
    list.push_back(std::move(item));
  }
  return list;
}

// Rows and columns are named as the columns of a table are (NAME, or NAME[k] of several numbers);
// an entry is [row, column, offset in the outputs]. Those that are missing are zero in every state.
Json derivatives(const program::Program& program, const program::Interface& interface) {
  std::vector<std::uint32_t> offset(program.variables.size());
  for (const program::Slot& slot : interface.outputs) offset[slot.variable] = slot.offset;
  Json list = Json::array();
  for (const program::Derivative& derivative : program.derivatives) {
    std::vector<std::uint32_t> first(program.variables.size());
    const auto names = [&](const std::vector<std::uint32_t>& variables) {
      Json result = Json::array();
      for (const std::uint32_t variable : variables) {
        const program::Variable& v = program.variables[variable];
        first[variable] = static_cast<std::uint32_t>(result.size());
        for (std::uint32_t k = 0; k < v.size; ++k)
          result.push_back(v.size == 1 ? v.name : v.name + "[" + std::to_string(k) + "]");
      }
      return result;
    };
    Json rows = names(derivative.of), columns = names(derivative.by), entries = Json::array();
    for (const program::DerivativeEntry& entry : derivative.entries) {
      entries.push_back({first[entry.of] + entry.of_number, first[entry.by] + entry.by_number,
                         offset[entry.variable]});
    }
    list.push_back({{"name", derivative.name},
                    {"rows", std::move(rows)},
                    {"columns", std::move(columns)},
                    {"entries", std::move(entries)}});
  }
  return list;
}

Json operation_counts(const program::OperationCount& n) {
  return {{"add", n.add},   {"multiply", n.multiply}, {"divide", n.divide},
          {"sqrt", n.sqrt}, {"sincos", n.sincos},     {"select", n.select}};
}

const char* language_name(Language language) {
  return language == Language::kCuda ? "cuda" : language == Language::kCpp ? "cpp" : "c";
}

}  // namespace

std::string sidecar(const program::ScalarProgram& scalar, const program::Interface& interface,
                    const COptions& options, const GeneratedCode& counts,
                    const std::vector<LineOrigin>& origins) {
  const program::Program& program = scalar.program;
  Json constants = Json::array();
  for (const program::Variable& v : program.variables) {
    if (v.role != program::Role::kConstant) continue;
    constants.push_back({{"name", v.name},
                         {"iri", v.represents},
                         {"unit", v.unit},
                         {"frame", v.frame},
                         {"value", v.value}});
  }
  Json snaps = Json::array();
  for (const program::SnappedConstant& s : scalar.snapped) {
    snaps.push_back({{"name", program.variables[s.variable].name},
                     {"number", s.number},
                     {"from", s.from},
                     {"to", s.to}});
  }
  Json closures = Json::array();
  for (const program::Closure& c : program.closures) {
    closures.push_back(
        {{"operation", c.operation}, {"iri", c.iri}, {"step", c.step}, {"about", c.about}});
  }
  Json lines = Json::array();
  for (const LineOrigin& origin : origins) {
    lines.push_back(Json::array({origin.line, origin.closure}));
  }
  Json document = {{"sinew-generated", 1},
                   {"name", options.name},
                   {"style", options.style == Style::kFlat ? "flat" : "readable"},
                   {"language", language_name(options.language)},
                   {"scalar", options.scalar == Scalar::kFloat ? "float" : "double"},
                   {"trigonometry", options.trigonometry == Trigonometry::kSleef ? "sleef" : "own"},
                   {"source", options.source},
                   {"algorithm", program.iri},
                   {"in-size", interface.in_size},
                   {"out-size", interface.out_size},
                   {"state-size", interface.state_size},
                   {"inputs", slots(program, interface.inputs)},
                   {"outputs", slots(program, interface.outputs)},
                   {"states", slots(program, interface.states)},
                   {"derivatives", derivatives(program, interface)},
                   {"constants", std::move(constants)},
                   {"snapped", std::move(snaps)},
                   {"operations", operation_counts(counts.operations)},
                   {"closures", std::move(closures)},
                   {"lines", std::move(lines)}};
  if (counts.with_limbs) {
    document["operations-with-limbs"] = operation_counts(*counts.with_limbs);
  }
  if (!options.partial.empty()) {
    document["held-size"] = scalar.update.results.size();
    document["slow"] = options.partial.slow;
    document["held"] = options.partial.held;
    document["update-operations"] = operation_counts(counts.update);
  }
  return document.dump() + "\n";
}

}  // namespace sinew::backend
