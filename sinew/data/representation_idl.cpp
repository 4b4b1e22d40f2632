// OMG IDL structs (DDS), by the plain form of the IDL-to-C++11 mapping: a struct with public
// members, arrays as C arrays, sequences as std::vector; and SmartSoft communication objects
// (SMDSD), whose plain structs live in the namespace REPOSITORYIDL.
#include <fmt/format.h>

#include <map>
#include <set>

#include "sinew/base/spelling.h"
#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

const std::map<std::string, ScalarKind, std::less<>> kIdlScalars = {
    {"double", ScalarKind::kFloat64},
    {"float", ScalarKind::kFloat32},
    {"octet", ScalarKind::kUint8},
    {"boolean", ScalarKind::kUint8},
    {"char", ScalarKind::kInt8},
    {"short", ScalarKind::kInt16},
    {"long", ScalarKind::kInt32},
    {"long long", ScalarKind::kInt64},
    {"unsigned short", ScalarKind::kUint16},
    {"unsigned long", ScalarKind::kUint32},
    {"unsigned long long", ScalarKind::kUint64},
    {"int8", ScalarKind::kInt8},
    {"uint8", ScalarKind::kUint8},
    {"int16", ScalarKind::kInt16},
    {"uint16", ScalarKind::kUint16},
    {"int32", ScalarKind::kInt32},
    {"uint32", ScalarKind::kUint32},
    {"int64", ScalarKind::kInt64},
    {"uint64", ScalarKind::kUint64}};

const std::map<std::string, ScalarKind, std::less<>> kSmartScalars = {
    {"Double", ScalarKind::kFloat64}, {"Float", ScalarKind::kFloat32},
    {"Boolean", ScalarKind::kUint8},  {"Int8", ScalarKind::kInt8},
    {"Int16", ScalarKind::kInt16},    {"Int32", ScalarKind::kInt32},
    {"Int64", ScalarKind::kInt64},    {"UInt8", ScalarKind::kUint8},
    {"UInt16", ScalarKind::kUint16},  {"UInt32", ScalarKind::kUint32},
    {"UInt64", ScalarKind::kUint64}};

TypePointer text_type() { return opaque_type("std::string", 32, 8); }

TypePointer vector_of(TypePointer element) {
  Type type;
  type.kind = Type::Kind::kVector;
  type.element = std::move(element);
  type.size = 24;
  type.alignment = 8;
  type.element_access = "$[#]";
  return std::make_shared<const Type>(std::move(type));
}

TypePointer declared_struct(std::string spelling, std::vector<Member> members) {
  Type type = *struct_type(std::move(spelling), std::move(members));
  type.declared = true;
  return std::make_shared<const Type>(std::move(type));
}

// Types by their full name, as "a::b", with the file that defines them.
struct Types {
  std::map<std::string, TypePointer> by_name;
  std::map<std::string, std::string> file_of;

  std::string last;  // the one defined last

  void define(const std::string& name, const std::string& file, TypePointer type) {
    by_name[name] = std::move(type);
    file_of[name] = file;
    last = name;
  }
  // Looks in `scope`, then in each scope around it.
  TypePointer find(std::string scope, const std::string& name) const {
    while (true) {
      const auto found = by_name.find(scope.empty() ? name : scope + "::" + name);
      if (found != by_name.end()) return found->second;
      if (scope.empty()) return nullptr;
      const std::size_t end = scope.rfind("::");
      scope = end == std::string::npos ? "" : scope.substr(0, end);
    }
  }
};

class IdlReader {
 public:
  IdlReader(Scanner& scanner, Types& types, std::string file)
      : scanner_(scanner), types_(types), file_(std::move(file)) {}

  void read_definitions(const std::string& scope) {
    while (!scanner_.at_end() && scanner_.peek().text != "}") {
      while (scanner_.take("@")) {  // annotations say nothing about the layout
        scanner_.next();
        if (scanner_.take("(")) {
          while (!scanner_.take(")") && !scanner_.at_end()) scanner_.next();
        }
      }
      const std::string word = scanner_.expect_name("module, struct or typedef");
      if (word == "module") {
        const std::string name = scanner_.expect_name("a module's name");
        scanner_.expect("{");
        read_definitions(joined(scope, name));
        scanner_.expect("}");
      } else if (word == "struct") {
        const std::string name = joined(scope, scanner_.expect_name("a struct's name"));
        types_.define(name, file_, read_struct(name, scope, 0));
      } else if (word == "typedef") {
        const TypePointer type = read_type(scope, 0);
        const std::string name = joined(scope, scanner_.expect_name("a name"));
        types_.define(name, file_, read_extents(scanner_, type));
      } else if (word == "const" || word == "enum" || word == "union") {
        scanner_.fail(fmt::format("'{}' is not supported", word), "describe structs of numbers");
      } else {
        scanner_.fail(fmt::format("'{}' where module, struct or typedef should be", word));
      }
      scanner_.take(";");
    }
  }

 private:
  static std::string joined(const std::string& scope, const std::string& name) {
    return scope.empty() ? name : scope + "::" + name;
  }

  TypePointer read_struct(const std::string& name, const std::string& scope, std::size_t depth) {
    if (depth > kMaximumTypeDepth) scanner_.fail("structs are nested too deep");
    scanner_.expect("{");
    std::vector<Member> members;
    std::set<std::string> names;
    while (!scanner_.take("}")) {
      while (scanner_.take("@")) scanner_.next();
      const TypePointer type = read_type(scope, depth);
      read_members_of(scanner_, type, names, members);
    }
    if (members.empty()) scanner_.fail("a struct needs at least one member");
    return declared_struct(name, std::move(members));
  }

  TypePointer read_type(const std::string& scope, std::size_t depth) {
    std::string name = scanner_.expect_name("a type");
    if (name == "sequence") {
      scanner_.expect("<");
      const TypePointer element = read_type(scope, depth + 1);
      if (scanner_.take(",")) scanner_.expect_number("bound", kMaximumArrayCount);
      scanner_.expect(">");
      return vector_of(element);
    }
    if (name == "string") return text_type();
    while ((name == "unsigned" || name == "long" || name == "unsigned long") &&
           (scanner_.peek().text == "short" || scanner_.peek().text == "long")) {
      name += " " + scanner_.next().text;
    }
    if (const auto scalar = kIdlScalars.find(name); scalar != kIdlScalars.end()) {
      return scalar_type(scalar->second);
    }
    while (scanner_.take("::")) name += "::" + scanner_.expect_name("a type's name");
    if (auto type = types_.find(scope, name)) return type;
    std::vector<std::string> names;
    for (const auto& [known, type] : types_.by_name) names.push_back(known);
    scanner_.fail(fmt::format("IDL type '{}' is not defined before its use", name),
                  did_you_mean(name, names, "define it first"));
  }

  Scanner& scanner_;
  Types& types_;
  std::string file_;
};

// CommObjectsRepository NAME version 1.0.0 { CommObject NAME { x : Double  data : Double[3] } }
class SmartReader {
 public:
  SmartReader(Scanner& scanner, Types& types, std::string file)
      : scanner_(scanner), types_(types), file_(std::move(file)) {}

  void read() {
    while (!scanner_.at_end()) {
      if (scanner_.take("CommObjectsRepository")) {
        repository_ = scanner_.expect_name("the repository's name");
        while (!scanner_.take("{")) {
          if (scanner_.at_end()) scanner_.fail("the repository has no body");
          scanner_.next();  // version 1.0.0
        }
      } else if (scanner_.take("CommObject")) {
        read_object();
      } else if (!scanner_.take("}")) {
        scanner_.fail(fmt::format("'{}' where CommObject should be", scanner_.peek().text));
      }
    }
  }

 private:
  void read_object() {
    const std::string name = scanner_.expect_name("the object's name");
    scanner_.expect("{");
    std::vector<Member> members;
    while (!scanner_.take("}")) {
      const std::string member = scanner_.expect_name("an attribute's name");
      scanner_.expect(":");
      std::string type_name = scanner_.expect_name("a type");
      std::string scope = repository_;
      if (scanner_.take(".")) {
        scope = type_name;
        type_name = scanner_.expect_name("an object's name");
      }
      TypePointer type;
      if (const auto scalar = kSmartScalars.find(type_name); scalar != kSmartScalars.end()) {
        type = scalar_type(scalar->second);
      } else if (type_name == "String") {
        type = text_type();
      } else {
        type = types_.find({}, scope + "." + type_name);
        if (!type) {
          scanner_.fail(fmt::format("communication object '{}.{}' is not defined before its use",
                                    scope, type_name));
        }
      }
      if (scanner_.take("[")) {
        if (scanner_.take("*")) {
          type = vector_of(type);
        } else {
          type = array_type(type, scanner_.expect_number("array size", kMaximumArrayCount));
        }
        scanner_.expect("]");
      }
      members.push_back({member, std::move(type), 0, {}});
      if (!scanner_.take(",")) scanner_.take(";");
    }
    if (members.empty()) scanner_.fail("a communication object needs at least one attribute");
    const std::string full = repository_.empty() ? name : repository_ + "." + name;
    const std::string spelling = repository_.empty() ? name : repository_ + "IDL::" + name;
    types_.define(full, file_, declared_struct(spelling, std::move(members)));
  }

  Scanner& scanner_;
  Types& types_;
  std::string file_;
  std::string repository_;
};

[[noreturn]] void fail_unknown(const RepresentationRequest& request, const std::string& name,
                               const Types& types, std::string_view endings) {
  std::vector<std::string> names;
  for (const auto& [known, type] : types.by_name) names.push_back(known);
  fail_at(request.place, fmt::format("{} type '{}' is not found", request.context, name),
          did_you_mean(name, names,
                       fmt::format("looked in the {} files of {}", endings,
                                   fmt::join(request.sources.directories, ", "))));
}

}  // namespace

Representation read_idl(const RepresentationRequest& request) {
  const ScannerOptions syntax = {.marks = {"::"}};
  Types types;
  Representation result;
  result.cpp_only = true;
  result.header_optional = true;
  Scanner scanner(request.text, request.place, syntax);
  if (scanner.peek().text == "struct" || scanner.peek().text == "module") {
    IdlReader(scanner, types, {}).read_definitions({});
    if (!scanner.at_end()) scanner.fail("'}' without its '{'");
    if (types.by_name.empty()) scanner.fail("no struct is described here");
    // The one written last is the one that is meant; those before it are its parts.
    result.type = types.by_name[types.last];
    return result;
  }
  std::string name = scanner.expect_name("a struct's name");
  while (scanner.take("::")) name += "::" + scanner.expect_name("a struct's name");
  if (!scanner.at_end())
    scanner.fail(fmt::format("'{}' is left over after the type", scanner.peek().text));
  for (const auto& file : files_with(request.sources, {".idl"})) {
    const std::string text = read_text_file(file);
    Scanner words(text, {file.string(), 1, 0}, {.hash_comments = true, .marks = {"::"}});
    IdlReader(words, types, file.stem().string()).read_definitions({});
  }
  const auto found = types.by_name.find(name);
  if (found == types.by_name.end()) fail_unknown(request, name, types, ".idl");
  result.type = found->second;
  result.headers = {types.file_of[name] + ".hpp"};
  return result;
}

Representation read_smartsoft(const RepresentationRequest& request) {
  Types types;
  Representation result;
  result.cpp_only = true;
  result.header_optional = true;
  Scanner scanner(request.text, request.place);
  if (scanner.peek().text == "CommObject" || scanner.peek().text == "CommObjectsRepository") {
    SmartReader(scanner, types, {}).read();
    if (types.by_name.size() != 1) scanner.fail("exactly one communication object is wanted here");
    result.type = types.by_name.begin()->second;
    return result;
  }
  std::string name = scanner.expect_name("a repository's name");
  scanner.expect(".");
  const std::string object = scanner.expect_name("an object's name");
  if (!scanner.at_end())
    scanner.fail(fmt::format("'{}' is left over after the type", scanner.peek().text));
  for (const auto& file : files_with(request.sources, {".smdsd", ".types"})) {
    const std::string text = read_text_file(file);
    Scanner words(text, {file.string(), 1, 0});
    SmartReader(words, types, file.stem().string()).read();
  }
  const auto found = types.by_name.find(name + "." + object);
  if (found == types.by_name.end()) fail_unknown(request, name + "." + object, types, ".smdsd");
  result.type = found->second;
  result.headers = {fmt::format("{}/{}.hh", name, object)};
  return result;
}

}  // namespace sinew::data
