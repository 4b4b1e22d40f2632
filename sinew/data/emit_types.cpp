#include "sinew/data/emit_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace sinew::data {
namespace {

std::string macro_name(const std::string& text) {
  std::string result = "SINEW_HAVE_";
  for (const char c : text) result += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return result;
}

std::string struct_body(const Type& type, SourceLanguage language) {
  std::string text = "{ ";
  for (const Member& member : type.members)
    text += declare(*member.type, member.name, language) + "; ";
  return text + "}";
}

// Named types that have to be declared, what they contain first.
void collect(const Type& type, std::vector<const Type*>& types, std::set<std::string>& seen) {
  for (const Member& member : type.members) collect(*member.type, types, seen);
  if (type.element) collect(*type.element, types, seen);
  if (type.declared && !type.spelling.empty() && seen.insert(type.spelling).second)
    types.push_back(&type);
}

std::string declaration(const Type& type, SourceLanguage language) {
  if (type.kind == Type::Kind::kArray) {  // asn1scc's SEQUENCE OF
    return fmt::format(
        "typedef struct {{ {}{}; }} {};", type.element_offset > 0 ? "int nCount; " : "",
        declare(*type.element, fmt::format("arr[{}]", type.count), language), type.spelling);
  }
  if (type.spelling.starts_with("struct "))
    return type.spelling + " " + struct_body(type, language) + ";";
  if (language == SourceLanguage::kC) {
    return fmt::format("typedef struct {} {};", struct_body(type, language), type.spelling);
  }
  // C++ names may lie in namespaces: a::b::S
  std::string open, close, name = type.spelling;
  for (std::size_t colons; (colons = name.find("::")) != std::string::npos;
       name = name.substr(colons + 2)) {
    open += "namespace " + name.substr(0, colons) + " { ";
    close += " }";
  }
  return fmt::format("{}struct {} {};{}", open, name, struct_body(type, language), close);
}

std::string include(const std::string& header) {
  if (header.starts_with("Eigen/")) {
    // Debian puts Eigen into a folder that is not searched by itself.
    return fmt::format(
        "#if __has_include(<{0}>)\n#include <{0}>\n#else\n#include <eigen3/{0}>\n#endif\n", header);
  }
  const bool quoted = header.ends_with(".h") && header.find('/') == std::string::npos;
  return quoted ? fmt::format("#include \"{}\"\n", header) : fmt::format("#include <{}>\n", header);
}

bool uses(const Type& type, std::string_view word) {
  if (type.spelling.find(word) != std::string::npos) return true;
  if (type.kind == Type::Kind::kVector && word == "std::vector") return true;
  if (type.element && uses(*type.element, word)) return true;
  return std::any_of(type.members.begin(), type.members.end(),
                     [&](const Member& member) { return uses(*member.type, word); });
}

}  // namespace

std::string type_name(const Type& type, SourceLanguage language) {
  if (type.kind == Type::Kind::kVector) {
    return fmt::format("std::vector<{}>", type_name(*type.element, language));
  }
  if (type.spelling.empty() && type.kind == Type::Kind::kStruct)
    return "struct " + struct_body(type, language);
  return type.spelling;
}

std::string declare(const Type& type, const std::string& name, SourceLanguage language) {
  std::string extents;
  const Type* element = &type;
  while (element->kind == Type::Kind::kArray && element->spelling.empty()) {
    extents += fmt::format("[{}]", element->count);
    element = element->element.get();
  }
  return fmt::format("{} {}{}", type_name(*element, language), name, extents);
}

std::string emit_type_declarations(const std::vector<const Representation*>& representations,
                                   SourceLanguage language) {
  std::set<std::string> firm, optional;
  std::vector<const Type*> types;
  std::set<std::string> seen;
  bool strings = false, vectors = false;
  for (const Representation* representation : representations) {
    auto& headers = representation->header_optional ? optional : firm;
    headers.insert(representation->headers.begin(), representation->headers.end());
    strings |= uses(*representation->type, "std::string");
    vectors |= uses(*representation->type, "std::vector");
    if (!representation->headers.empty() && !representation->header_optional) continue;
    collect(*representation->type, types, seen);
  }
  std::string text;
  if (language == SourceLanguage::kCpp && strings) text += "#include <string>\n";
  if (language == SourceLanguage::kCpp && vectors) text += "#include <vector>\n";
  for (const std::string& header : firm) text += include(header);
  for (const std::string& header : optional) {
    const std::string macro = macro_name(header);
    text += fmt::format(
        "#ifdef __has_include\n#if __has_include(\"{0}\")\n#include \"{0}\"\n#define "
        "{1}\n#endif\n#endif\n",
        header, macro);
  }
  if (!text.empty()) text += "\n";
  std::string header_missing;
  for (const std::string& header : optional) {
    header_missing +=
        fmt::format("{}!defined({})", header_missing.empty() ? "" : " && ", macro_name(header));
  }
  for (const Type* type : types) {
    const std::string macro = macro_name(type->spelling);
    text += fmt::format("#if !defined({0}){1}{2}\n#define {0}\n{3}\n#endif\n", macro,
                        header_missing.empty() ? "" : " && ", header_missing,
                        declaration(*type, language));
  }
  return types.empty() ? text : text + "\n";
}

}  // namespace sinew::data
