// Writes the header of vocabulary constants from the contexts that a catalogue lists:
//   generate_vocab CATALOG.json OUT.h
// One C++ namespace for each metamodel, named by the prefix that its context gives to its own
// namespace (the first prefix in the file); one constant for each term, in the order of definition.
// Scoped terms count too. '-' becomes '_', a keyword gets a '_' behind it, and a leading digit an
// 'n' before it.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Json = nlohmann::ordered_json;

// The terms of one namespace IRI, in order of first definition.
struct Metamodel {
  std::string prefix;
  std::string iri;
  std::vector<std::string> names;
  std::set<std::string> known;
};

class Vocabulary {
 public:
  void read(const Json& context) {
    std::map<std::string, std::string> prefixes;
    bool own = true;
    for (const auto& [key, value] : context.items()) {
      if (!is_namespace(value)) continue;
      prefixes[key] = value;
      if (own) metamodel(value, key);
      own = false;
    }
    collect(context, prefixes);
  }

  void write(std::ostream& out) const {
    out << "// Generated from metamodels/ by sinew/vocab/generate/vocab.cpp; not to be edited.\n"
           "#pragma once\n\n#include <string_view>\n\nnamespace sinew::vocab {\n";
    for (const Metamodel& m : metamodels_) {
      if (m.names.empty()) continue;
      const std::string space = identifier(m.prefix);
      out << "\nnamespace " << space << " {\n"
          << "inline constexpr std::string_view kNamespace = \"" << m.iri << "\";\n";
      for (const std::string& name : m.names) {
        out << "inline constexpr std::string_view " << identifier(name) << " = \"" << m.iri << name
            << "\";\n";
      }
      out << "}  // namespace " << space << "\n";
    }
    out << "\n}  // namespace sinew::vocab\n";
  }

 private:
  static bool is_namespace(const Json& value) {
    if (!value.is_string()) return false;
    const auto& text = value.get_ref<const std::string&>();
    return text.find("://") != std::string::npos && (text.back() == '#' || text.back() == '/');
  }

  Metamodel& metamodel(const std::string& iri, const std::string& prefix) {
    for (Metamodel& m : metamodels_) {
      if (m.iri == iri) return m;
    }
    metamodels_.push_back({prefix, iri, {}, {}});
    return metamodels_.back();
  }

  // Every "prefix:name" that a term, scoped or not, stands for.
  void collect(const Json& context, const std::map<std::string, std::string>& prefixes) {
    for (const auto& [term, value] : context.items()) {
      if (value.is_string() && term[0] != '@') add(value, prefixes);
      if (!value.is_object()) continue;
      if (value.contains("@id")) add(value["@id"], prefixes);
      if (value.contains("@context")) collect(value["@context"], prefixes);
    }
  }

  void add(const std::string& iri, const std::map<std::string, std::string>& prefixes) {
    const std::size_t colon = iri.find(':');
    const auto prefix = prefixes.find(iri.substr(0, colon));
    if (prefix == prefixes.end()) return;
    Metamodel& m = metamodel(prefix->second, prefix->first);
    const std::string name = iri.substr(colon + 1);
    if (m.known.insert(name).second) m.names.push_back(name);
  }

  static std::string identifier(const std::string& name) {
    static const std::set<std::string> kKeywords = {
        "while", "double", "float", "int", "namespace", "operator", "register", "static", "union"};
    std::string text = name;
    for (char& c : text) {
      if (c == '-') c = '_';
    }
    if (text[0] >= '0' && text[0] <= '9') text.insert(0, "n");
    if (kKeywords.contains(text)) text += '_';
    return text;
  }

  std::vector<Metamodel> metamodels_;
};

Json parse(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return Json::parse(in);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: generate_vocab CATALOG.json OUT.h\n";
    return 2;
  }
  try {
    const std::filesystem::path catalog = arguments[1];
    Vocabulary vocabulary;
    const Json files = parse(catalog);
    for (const auto& [iri, file] : files.items()) {
      if (!file.get_ref<const std::string&>().ends_with(".json")) continue;  // shapes
      vocabulary.read(parse(catalog.parent_path() / file.get<std::string>())["@context"]);
    }
    std::ofstream out(arguments[2]);
    vocabulary.write(out);
    return out.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << arguments[1] << ": " << error.what() << "\n";
    return 1;
  }
}
