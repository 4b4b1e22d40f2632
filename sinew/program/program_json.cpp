#include "sinew/program/program_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "sinew/base/error.h"
#include "sinew/program/validate.h"

namespace sinew::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRoles[] = {"input", "constant", "internal", "state"};  // in Role's order

[[noreturn]] void fail(const std::string& file, std::size_t line, std::string what,
                       std::string remedy) {
  throw Error(
      Problem{{file, line, 0}, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

// One object of the document, read field by field; `where` names it in errors.
class Object {
 public:
  Object(const Json& json, std::string where, const std::string& file)
      : json_(json), where_(std::move(where)), file_(file) {
    if (!json.is_object()) fault("is not an object", "write it as { ... }");
  }

  const Json& field(const char* name) {
    const auto at = json_.find(name);
    if (at == json_.end()) fault(fmt::format("has no '{}'", name), "add the field");
    ++read_;
    return *at;
  }

  std::string text(const char* name) {
    const Json& value = field(name);
    if (!value.is_string()) fault(fmt::format("has a '{}' that is not a string", name), "quote it");
    return value.get<std::string>();
  }

  bool flag(const char* name) {
    const Json& value = field(name);
    if (!value.is_boolean()) {
      fault(fmt::format("has a '{}' that is not true or false", name), "write true or false");
    }
    return value.get<bool>();
  }

  std::uint32_t count(const char* name, std::size_t maximum) {
    const Json& value = field(name);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > maximum) {
      fault(fmt::format("has a '{}' that is not a whole number from 0 to {}", name, maximum),
            "write such a number");
    }
    return static_cast<std::uint32_t>(value.get<std::uint64_t>());
  }

  const Json& list(const char* name) {
    const Json& value = field(name);
    if (!value.is_array())
      fault(fmt::format("has a '{}' that is not a list", name), "write [ ... ]");
    return value;
  }

  // Every field has been asked for, so there are no others.
  void finish(std::initializer_list<const char*> known) {
    if (read_ == json_.size()) return;
    for (const auto& [name, value] : json_.items()) {
      if (std::none_of(known.begin(), known.end(), [&](const char* k) { return name == k; })) {
        fault(fmt::format("has an unknown field '{}'", name), "leave it out");
      }
    }
  }

  [[noreturn]] void fault(const std::string& what, std::string remedy) {
    fail(file_, 0, where_ + " " + what, std::move(remedy));
  }

 private:
  const Json& json_;
  std::string where_;
  const std::string& file_;
  std::size_t read_ = 0;
};

Json parse(std::string_view text, const std::string& file) {
  if (text.size() > kMaximumProgramBytes) {
    fail(file, 0, fmt::format("the program has {} bytes of JSON", text.size()),
         fmt::format("at most {} are read", kMaximumProgramBytes));
  }
  // Depth is limited before parsing: the parser recurses on destruction.
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaximumProgramDepth) {
        fail(file, 0, "the JSON is nested too deeply",
             fmt::format("a program has at most {} levels", kMaximumProgramDepth));
      }
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(error.byte, text.size()));
    const auto line = static_cast<std::size_t>(std::count(text.begin(), end, '\n')) + 1;
    fail(file, line, fmt::format("not JSON: {}", error.what()), "correct it there");
  } catch (const Json::exception& error) {
    fail(file, 0, fmt::format("not JSON: {}", error.what()), "correct it");
  }
}

Variable read_variable(const Json& json, const std::string& file, std::size_t number) {
  Object object(json, fmt::format("variable {}", number), file);
  Variable v;
  v.name = object.text("name");
  v.iri = object.text("iri");
  v.represents = object.text("represents");
  v.quantity = object.text("quantity");
  v.unit = object.text("unit");
  v.frame = object.text("frame");
  const std::string role = object.text("role");
  const auto* at =
      std::find_if(std::begin(kRoles), std::end(kRoles), [&](const char* r) { return role == r; });
  if (at == std::end(kRoles)) {
    object.fault(fmt::format("has the role '{}'", role),
                 "roles are input, constant, internal and state");
  }
  v.role = static_cast<Role>(at - std::begin(kRoles));
  v.output = object.flag("output");
  v.size = object.count("size", kMaximumVariableSize);
  if (v.role == Role::kConstant || v.role == Role::kState) {
    for (const Json& number_json : object.list("value")) {
      if (!number_json.is_number())
        object.fault("has a value that is not a number", "write a number");
      v.value.push_back(number_json.get<double>());
    }
  }
  v.held = json.contains("held") && object.flag("held");
  if (v.held && v.role != Role::kInput && v.role != Role::kInternal)
    object.fault(fmt::format("is held, but its role is {}", role),
                 "hold inputs and what closures compute");
  object.finish({"name", "iri", "represents", "quantity", "unit", "frame", "role", "output", "held",
                 "size", "value"});
  return v;
}

std::vector<std::uint32_t> read_names(
    Object& object, const char* name,
    const std::unordered_map<std::string, std::uint32_t>& by_name) {
  std::vector<std::uint32_t> variables;
  for (const Json& item : object.list(name)) {
    const auto at = item.is_string() ? by_name.find(item.get<std::string>()) : by_name.end();
    if (at == by_name.end())
      object.fault(fmt::format("has a '{}' that is no variable", name),
                   "name variables of this program");
    variables.push_back(at->second);
  }
  return variables;
}

// Entries are written as [variable, of, number, by, number].
Derivative read_derivative(const Json& json, const std::string& file, std::size_t number,
                           const std::unordered_map<std::string, std::uint32_t>& by_name) {
  Object object(json, fmt::format("derivative {}", number), file);
  Derivative derivative;
  derivative.name = object.text("name");
  derivative.of = read_names(object, "of", by_name);
  derivative.by = read_names(object, "by", by_name);
  for (const Json& entry : object.list("entries")) {
    const auto variable = [&](std::size_t place) {
      const auto at = entry.is_array() && entry.size() == 5 && entry[place].is_string()
                          ? by_name.find(entry[place].get<std::string>())
                          : by_name.end();
      if (at == by_name.end())
        object.fault("has an entry without its variables",
                     "write [variable, of, number, by, number]");
      return at->second;
    };
    const auto count = [&](std::size_t place) {
      if (!entry[place].is_number_unsigned() ||
          entry[place].get<std::uint64_t>() > kMaximumVariableSize)
        object.fault("has an entry with a number that is none", "write a whole number");
      return static_cast<std::uint32_t>(entry[place].get<std::uint64_t>());
    };
    derivative.entries.push_back({variable(0), variable(1), count(2), variable(3), count(4)});
  }
  object.finish({"name", "of", "by", "entries"});
  return derivative;
}

Json names_of(const Program& program, const std::vector<std::uint32_t>& variables) {
  Json names = Json::array();
  for (const std::uint32_t variable : variables)
    names.push_back(program.variables.at(variable).name);
  return names;
}

Json to_json(const Program& program, const Derivative& derivative) {
  Json entries = Json::array();
  for (const DerivativeEntry& entry : derivative.entries) {
    entries.push_back(
        Json::array({program.variables.at(entry.variable).name, program.variables.at(entry.of).name,
                     entry.of_number, program.variables.at(entry.by).name, entry.by_number}));
  }
  return {{"name", derivative.name},
          {"of", names_of(program, derivative.of)},
          {"by", names_of(program, derivative.by)},
          {"entries", std::move(entries)}};
}

}  // namespace

std::string to_json(const Program& program) {
  Json variables = Json::array();
  for (const Variable& v : program.variables) {
    Json json = {{"name", v.name},
                 {"iri", v.iri},
                 {"represents", v.represents},
                 {"quantity", v.quantity},
                 {"unit", v.unit},
                 {"frame", v.frame},
                 {"role", kRoles[static_cast<std::size_t>(v.role)]},
                 {"output", v.output},
                 {"size", v.size}};
    if (v.held) json["held"] = true;
    if (v.role == Role::kConstant || v.role == Role::kState) json["value"] = v.value;
    variables.push_back(std::move(json));
  }
  Json closures = Json::array();
  for (const Closure& c : program.closures) {
    Json arguments = Json::array();
    for (const std::uint32_t argument : c.arguments) {
      arguments.push_back(program.variables.at(argument).name);
    }
    closures.push_back({{"operation", c.operation},
                        {"iri", c.iri},
                        {"step", c.step},
                        {"about", c.about},
                        {"arguments", std::move(arguments)}});
  }
  Json document = {{"sinew-program", kProgramJsonVersion},
                   {"name", program.name},
                   {"iri", program.iri},
                   {"variables", std::move(variables)},
                   {"closures", std::move(closures)},
                   {"schedule", program.schedule}};
  if (!program.derivatives.empty()) {
    Json derivatives = Json::array();
    for (const Derivative& derivative : program.derivatives)
      derivatives.push_back(to_json(program, derivative));
    document["derivatives"] = std::move(derivatives);
  }
  return document.dump(1) + "\n";
}

Program from_json(std::string_view text, const std::string& file) {
  const Json document = parse(text, file);
  Object object(document, "the program", file);
  const std::uint32_t version = object.count("sinew-program", 1000000);
  if (version != kProgramJsonVersion) {
    object.fault(fmt::format("has version {}", version),
                 fmt::format("this Sinew reads version {}", kProgramJsonVersion));
  }
  Program program;
  program.name = object.text("name");
  program.iri = object.text("iri");

  std::unordered_map<std::string, std::uint32_t> by_name;
  for (const Json& json : object.list("variables")) {
    const auto index = static_cast<std::uint32_t>(program.variables.size());
    program.variables.push_back(read_variable(json, file, index));
    by_name.emplace(program.variables.back().name, index);
  }
  for (const Json& json : object.list("closures")) {
    Object entry(json, fmt::format("closure {}", program.closures.size()), file);
    Closure closure;
    closure.operation = entry.text("operation");
    closure.iri = entry.text("iri");
    closure.step = entry.text("step");
    closure.about = entry.text("about");
    for (const Json& argument : entry.list("arguments")) {
      if (!argument.is_string()) entry.fault("has an argument that is not a name", "quote it");
      const auto at = by_name.find(argument.get<std::string>());
      if (at == by_name.end()) {
        entry.fault(fmt::format("has the argument '{}'", argument.get<std::string>()),
                    "no variable has that name");
      }
      closure.arguments.push_back(at->second);
    }
    entry.finish({"operation", "iri", "step", "about", "arguments"});
    program.closures.push_back(std::move(closure));
  }
  for (const Json& index : object.list("schedule")) {
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= program.closures.size()) {
      object.fault("schedules something that is not a closure's number",
                   fmt::format("there are {} closures", program.closures.size()));
    }
    program.schedule.push_back(static_cast<std::uint32_t>(index.get<std::uint64_t>()));
  }
  if (document.contains("derivatives")) {
    for (const Json& json : object.list("derivatives")) {
      program.derivatives.push_back(
          read_derivative(json, file, program.derivatives.size(), by_name));
    }
  }
  object.finish(
      {"sinew-program", "name", "iri", "variables", "closures", "schedule", "derivatives"});

  Report report;
  validate(program, report);
  if (report.has_errors()) {
    std::vector<Problem> problems = report.problems();
    for (Problem& problem : problems) problem.place.file = file;
    throw Error(std::move(problems));
  }
  return program;
}

}  // namespace sinew::program
