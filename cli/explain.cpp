// sinew explain NAME.json LINE: why a generated line is there.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "options.h"
#include "output.h"
#include "sinew/base/error.h"

namespace sinew::cli {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& file, std::string what, std::string remedy) {
  throw Error({{file, 0, 0}, "", std::move(what), std::move(remedy), Severity::kError, {}});
}

Json read_sidecar(const std::string& file) {
  Json document = Json::parse(read_input(file), nullptr, false);
  if (document.is_object()) {
    const auto version = document.find("sinew-generated");
    if (version != document.end() && *version == 1) return document;
  }
  fail(file, "does not describe generated code", "name the .json that 'sinew generate' wrote");
}

// The text of a line of the C file beside the sidecar; nothing where that file is not there.
std::optional<std::string> line_of_code(const std::string& sidecar, std::size_t line) {
  const auto source = std::filesystem::path(sidecar).replace_extension(".c");
  if (!std::filesystem::exists(source)) return std::nullopt;
  std::istringstream text(read_input(source.string()));
  std::string content;
  for (std::size_t i = 0; i < line; ++i) {
    if (!std::getline(text, content)) return std::nullopt;
  }
  return content;
}

}  // namespace

int run_explain(Arguments arguments) {
  CLI::App app(
      "From a line of generated code to the closure, the synthesis step and the model element "
      "that it comes from.",
      "sinew explain");
  std::string file;
  std::size_t line = 0;
  app.add_option("SIDECAR", file, "The NAME.json that 'sinew generate' wrote beside NAME.c")
      ->required();
  app.add_option("LINE", line, "Line of NAME.c, counted from 1")
      ->required()
      ->check(CLI::PositiveNumber);
  if (const auto code = parse(app, std::move(arguments))) return *code;

  const Json document = read_sidecar(file);
  const auto text = line_of_code(file, line);
  if (text) std::cout << "line:     " << *text << "\n";
  try {
    for (const Json& entry : document.at("lines")) {
      if (entry.at(0) != line) continue;
      const Json& closure = document.at("closures").at(entry.at(1).get<std::size_t>());
      std::cout << "operator: " << closure.at("operation").get<std::string>() << "\n"
                << "closure:  " << closure.at("iri").get<std::string>() << "\n"
                << "step:     " << closure.at("step").get<std::string>() << "\n"
                << "element:  " << closure.at("about").get<std::string>() << "\n";
      return kOk;
    }
  } catch (const Json::exception& error) {
    fail(file, std::string("is damaged: ") + error.what(), "generate the code again");
  }
  fail(file, "line " + std::to_string(line) + " computes nothing that comes from the model",
       "choose a line with a computation; the first is " +
           (document["lines"].empty() ? std::string("not there")
                                      : std::to_string(document["lines"][0][0].get<int>())));
}

}  // namespace sinew::cli
