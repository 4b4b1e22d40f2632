#include "sinew/backend/c_parts.h"
#include "sinew/backend/json_text.h"

namespace sinew::backend {
namespace {

void write_slots(JsonText& json, std::string_view name, const program::Program& program,
                 const std::vector<program::Slot>& slots) {
  json.key(name).begin_array();
  for (const program::Slot& slot : slots) {
    const program::Variable& v = program.variables[slot.variable];
    json.begin_object().member("name", v.name).member("iri", v.represents);
    json.member("offset", slot.offset).member("size", v.size).member("unit", v.unit);
    json.member("frame", v.frame).member("quantity", v.quantity).member("data", v.iri);
    if (v.role == program::Role::kState) json.member("value", v.value);
    json.end_object();
  }
  json.end_array();
}

// Rows and columns are named as the columns of a table are (NAME, or NAME[k] of several numbers);
// an entry is [row, column, offset in the outputs]. Those that are missing are zero in every state.
void write_derivatives(JsonText& json, const program::Program& program,
                       const program::Interface& interface) {
  std::vector<std::uint32_t> offset(program.variables.size());
  for (const program::Slot& slot : interface.outputs) offset[slot.variable] = slot.offset;
  json.key("derivatives").begin_array();
  for (const program::Derivative& derivative : program.derivatives) {
    std::vector<std::uint32_t> first(program.variables.size());
    const auto names = [&](const std::vector<std::uint32_t>& variables) {
      std::vector<std::string> result;
      for (const std::uint32_t variable : variables) {
        const program::Variable& v = program.variables[variable];
        first[variable] = static_cast<std::uint32_t>(result.size());
        for (std::uint32_t k = 0; k < v.size; ++k)
          result.push_back(v.size == 1 ? v.name : v.name + "[" + std::to_string(k) + "]");
      }
      return result;
    };
    json.begin_object().member("name", derivative.name);
    json.member("rows", names(derivative.of)).member("columns", names(derivative.by));
    json.key("entries").begin_array();
    for (const program::DerivativeEntry& entry : derivative.entries) {
      json.begin_array().value(first[entry.of] + entry.of_number);
      json.value(first[entry.by] + entry.by_number).value(offset[entry.variable]).end_array();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

void write_operations(JsonText& json, std::string_view name, const program::OperationCount& n) {
  json.key(name).begin_object().member("add", n.add).member("multiply", n.multiply);
  json.member("divide", n.divide).member("sqrt", n.sqrt).member("sincos", n.sincos);
  json.member("select", n.select).end_object();
}

const char* language_name(Language language) {
  return language == Language::kCuda ? "cuda" : language == Language::kCpp ? "cpp" : "c";
}

}  // namespace

std::string sidecar(const program::ScalarProgram& scalar, const program::Interface& interface,
                    const COptions& options, const GeneratedCode& counts,
                    const std::vector<LineOrigin>& origins) {
  const program::Program& program = scalar.program;
  JsonText json;
  constexpr std::size_t kOfAClosure = 320, kOfALine = 12;  // bytes, about
  json.reserve(program.closures.size() * kOfAClosure + origins.size() * kOfALine);
  json.begin_object().member("sinew-generated", 1).member("name", options.name);
  json.member("style", options.style == Style::kFlat ? "flat" : "readable");
  json.member("language", language_name(options.language));
  json.member("scalar", options.scalar == Scalar::kFloat ? "float" : "double");
  json.member("trigonometry", options.trigonometry == Trigonometry::kSleef ? "sleef" : "own");
  json.member("source", options.source).member("algorithm", program.iri);
  json.member("in-size", interface.in_size).member("out-size", interface.out_size);
  json.member("state-size", interface.state_size);
  write_slots(json, "inputs", program, interface.inputs);
  write_slots(json, "outputs", program, interface.outputs);
  write_slots(json, "states", program, interface.states);
  write_derivatives(json, program, interface);
  json.key("constants").begin_array();
  for (const program::Variable& v : program.variables) {
    if (v.role != program::Role::kConstant) continue;
    json.begin_object().member("name", v.name).member("iri", v.represents);
    json.member("unit", v.unit).member("frame", v.frame).member("value", v.value).end_object();
  }
  json.end_array().key("snapped").begin_array();
  for (const program::SnappedConstant& s : scalar.snapped) {
    json.begin_object().member("name", program.variables[s.variable].name);
    json.member("number", s.number).member("from", s.from).member("to", s.to).end_object();
  }
  json.end_array();
  write_operations(json, "operations", counts.operations);
  json.key("closures").begin_array();
  for (const program::Closure& c : program.closures) {
    json.begin_object().member("operation", c.operation).member("iri", c.iri);
    json.member("step", c.step).member("about", c.about).end_object();
  }
  json.end_array().key("lines").pairs(
      origins, [](const LineOrigin& origin) { return origin.line; },
      [](const LineOrigin& origin) { return origin.closure; });
  if (counts.with_limbs) write_operations(json, "operations-with-limbs", *counts.with_limbs);
  if (!options.partial.empty()) {
    json.member("held-size", scalar.update.results.size());
    json.member("slow", options.partial.slow).member("held", options.partial.held);
    write_operations(json, "update-operations", counts.update);
  }
  json.end_object();
  return json.take() + "\n";
}

}  // namespace sinew::backend
