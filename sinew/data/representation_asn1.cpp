// ASN.1 modules: enough for base types made of numbers, SEQUENCE, SEQUENCE OF and names of other
// types.
//
// The same module gives two C layouts. asn1scc (the TASTE compiler): plain structs named
// asn1SccTYPE, an array of fixed SIZE as {arr[n]}, of varying SIZE as {nCount, arr[max]}. asn1c:
// structs named TYPE_t that carry a decoding context, and lists of pointers for every SEQUENCE OF.
#include <fmt/format.h>

#include <map>

#include "sinew/base/spelling.h"
#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

const ScannerOptions kSyntax = {.slash_comments = false,
                                .dash_comments = true,
                                .hyphens_in_names = true,
                                .marks = {"::=", ".."}};

// asn1c's asn_struct_ctx_t: two shorts, an int, a pointer and a length; its list head: the array,
// two ints and a pointer to a function.
constexpr std::size_t kAsn1cContextSize = 24, kAsn1cListSize = 24;

// A type as written in a module.
struct Definition {
  enum class Kind { kReal, kInteger, kBoolean, kEnumerated, kSequence, kSequenceOf, kName, kOther };
  Kind kind = Kind::kOther;
  std::string name;  // of the referenced type
  std::size_t line = 0;
  struct Component {
    std::string name;
    std::shared_ptr<Definition> type;
    bool optional = false;
  };
  std::vector<Component> components;
  std::shared_ptr<Definition> element;
  std::size_t least = 0, most = 0;  // SIZE; most 0: not bounded
};
using DefinitionPointer = std::shared_ptr<Definition>;

struct Module {
  std::filesystem::path file;
  std::map<std::string, DefinitionPointer> types;
};

class ModuleReader {
 public:
  ModuleReader(Scanner& scanner, std::map<std::string, Module>& modules, std::filesystem::path file)
      : scanner_(scanner), modules_(modules), file_(std::move(file)) {}

  void read() {
    while (!scanner_.at_end()) {
      const std::string name = scanner_.expect_name("a module's name");
      if (scanner_.take("{")) skip_to("}");
      scanner_.expect("DEFINITIONS");
      while (!scanner_.take("::=")) {
        if (scanner_.at_end()) scanner_.fail("the module has no '::='");
        scanner_.next();
      }
      scanner_.expect("BEGIN");
      Module& module = modules_.try_emplace(name).first->second;
      module.file = file_;
      while (!scanner_.take("END")) read_assignment(module);
    }
  }

 private:
  void skip_to(std::string_view mark) {
    while (!scanner_.take(mark)) {
      if (scanner_.at_end()) scanner_.fail(fmt::format("the text ends before '{}'", mark));
      scanner_.next();
    }
  }

  void read_assignment(Module& module) {
    if (scanner_.take("IMPORTS") || scanner_.take("EXPORTS")) return skip_to(";");
    const std::string name = scanner_.expect_name("a type's name");
    if (std::islower(static_cast<unsigned char>(name[0]))) {  // a value: name Type ::= value
      while (!scanner_.take("::=")) {
        if (scanner_.at_end()) scanner_.fail("the value has no '::='");
        scanner_.next();
      }
      if (scanner_.take("{")) return skip_to("}");
      scanner_.next();
      return;
    }
    scanner_.expect("::=");
    module.types[name] = read_type(0);
  }

  DefinitionPointer read_type(std::size_t depth) {
    if (depth > kMaximumTypeDepth) scanner_.fail("types are nested too deep");
    auto type = std::make_shared<Definition>();
    type->line = scanner_.peek().line;
    if (scanner_.take("[")) skip_to("]");  // a tag
    if (!scanner_.take("IMPLICIT")) scanner_.take("EXPLICIT");
    const std::string word = scanner_.expect_name("a type");
    using Kind = Definition::Kind;
    if (word == "REAL") {
      type->kind = Kind::kReal;
      skip_constraint();
    } else if (word == "INTEGER" || word == "ENUMERATED") {
      type->kind = word == "INTEGER" ? Kind::kInteger : Kind::kEnumerated;
      if (scanner_.take("{")) skip_to("}");
      skip_constraint();
    } else if (word == "BOOLEAN") {
      type->kind = Kind::kBoolean;
    } else if (word == "SEQUENCE" || word == "SET") {
      read_sequence(*type, depth);
    } else if (word == "OCTET" || word == "BIT") {
      scanner_.expect("STRING");
      skip_constraint();
    } else {
      type->kind = word.ends_with("String") ? Kind::kOther : Kind::kName;
      type->name = word;
      skip_constraint();
    }
    return type;
  }

  void read_sequence(Definition& type, std::size_t depth) {
    if (scanner_.take("{")) {
      type.kind = Definition::Kind::kSequence;
      while (!scanner_.take("}")) {
        Definition::Component component;
        component.name = scanner_.expect_name("a component's name");
        component.type = read_type(depth + 1);
        component.optional = scanner_.take("OPTIONAL");
        if (scanner_.take("DEFAULT")) scanner_.next();
        type.components.push_back(std::move(component));
        if (!scanner_.take(",") && scanner_.peek().text != "}") scanner_.expect(",");
      }
      return;
    }
    type.kind = Definition::Kind::kSequenceOf;
    if (scanner_.take("(")) {
      scanner_.expect("SIZE");
      read_size(type);
      scanner_.expect(")");
    } else if (scanner_.take("SIZE")) {
      read_size(type);
    }
    scanner_.expect("OF");
    type.element = read_type(depth + 1);
  }

  void read_size(Definition& type) {
    scanner_.expect("(");
    type.least = type.most = scanner_.expect_number("size", kMaximumArrayCount);
    if (scanner_.take("..")) type.most = scanner_.expect_number("size", kMaximumArrayCount);
    scanner_.expect(")");
  }

  void skip_constraint() {
    if (!scanner_.take("(")) return;
    for (int depth = 1; depth > 0;) {
      if (scanner_.at_end()) scanner_.fail("a constraint has no end");
      if (scanner_.take("(")) {
        ++depth;
      } else if (scanner_.take(")")) {
        --depth;
      } else {
        scanner_.next();
      }
    }
  }

  Scanner& scanner_;
  std::map<std::string, Module>& modules_;
  std::filesystem::path file_;
};

// Definitions to C types, in one of the two compilers' manners.
class Layout {
 public:
  Layout(const std::map<std::string, Module>& modules, bool asn1c, const Place& place)
      : modules_(modules), asn1c_(asn1c), place_(place) {}

  TypePointer named(const std::string& name, std::size_t depth) {
    if (depth > kMaximumTypeDepth) fail_at(place_, fmt::format("'{}' contains itself", name));
    for (const auto& [module_name, module] : modules_) {
      const auto found = module.types.find(name);
      if (found != module.types.end()) return lay_out(*found->second, c_name(name), depth);
    }
    fail_at(place_,
            fmt::format("ASN.1 type '{}' is not defined in any module that was found", name));
  }

 private:
  static std::string with_underscores(std::string name) {
    for (char& c : name) c = c == '-' ? '_' : c;
    return name;
  }
  std::string c_name(const std::string& name) const {
    return asn1c_ ? with_underscores(name) + "_t" : "asn1Scc" + with_underscores(name);
  }

  TypePointer lay_out(const Definition& type, const std::string& spelling, std::size_t depth) {
    using Kind = Definition::Kind;
    switch (type.kind) {
      case Kind::kReal:
        return scalar_type(ScalarKind::kFloat64);
      case Kind::kInteger:
        return scalar_type(ScalarKind::kInt64, asn1c_ ? "long" : "");
      case Kind::kBoolean:
        return asn1c_ ? scalar_type(ScalarKind::kInt32, "int") : scalar_type(ScalarKind::kUint8);
      case Kind::kEnumerated:
        return scalar_type(asn1c_ ? ScalarKind::kInt64 : ScalarKind::kInt32, asn1c_ ? "long" : "");
      case Kind::kName:
        return named(type.name, depth + 1);
      case Kind::kSequence:
        return sequence(type, spelling, depth);
      case Kind::kSequenceOf:
        return sequence_of(type, spelling, depth);
      case Kind::kOther:
        break;
    }
    fail_at(place_,
            fmt::format("ASN.1 type '{}' (line {}) holds no numbers with a layout", spelling,
                        type.line),
            "use REAL, INTEGER, BOOLEAN, ENUMERATED, SEQUENCE and SEQUENCE OF");
  }

  TypePointer sequence(const Definition& type, const std::string& spelling, std::size_t depth) {
    std::vector<Member> members;
    for (const auto& component : type.components) {
      if (component.optional && asn1c_) {
        fail_at(place_,
                fmt::format("component '{}' of '{}' is OPTIONAL: it may not be there",
                            component.name, spelling),
                "convert only types whose components are always there");
      }
      const std::string name = with_underscores(component.name);
      members.push_back({name, lay_out(*component.type, spelling + "_" + name, depth + 1), 0, {}});
    }
    if (asn1c_)
      members.push_back({"_asn_ctx", opaque_type("asn_struct_ctx_t", kAsn1cContextSize, 8), 0, {}});
    Type result = *struct_type(spelling, std::move(members));
    result.declared = !asn1c_;
    return std::make_shared<const Type>(std::move(result));
  }

  TypePointer sequence_of(const Definition& type, const std::string& spelling, std::size_t depth) {
    Type result;
    result.spelling = spelling;
    result.element = lay_out(*type.element, spelling + "_elem", depth + 1);
    if (asn1c_) {
      result.kind = Type::Kind::kList;
      result.element_access = "(*$.list.array[#])";
      result.size = kAsn1cListSize + kAsn1cContextSize;
      result.alignment = 8;
      return std::make_shared<const Type>(std::move(result));
    }
    if (type.most == 0) {
      fail_at(place_, fmt::format("SEQUENCE OF '{}' has no SIZE", spelling),
              "asn1scc needs a bound, as in SEQUENCE (SIZE (3)) OF");
    }
    result.kind = Type::Kind::kArray;
    result.declared = true;
    result.count = type.most;
    result.alignment = result.element->alignment;
    if (type.least != type.most) {  // nCount comes first
      result.alignment = std::max<std::size_t>(result.alignment, 4);
      result.element_offset = std::max<std::size_t>(result.element->alignment, 4);
    }
    result.element_access = "$.arr[#]";
    const std::size_t used = result.element_offset + result.count * result.element->size;
    result.size = (used + result.alignment - 1) / result.alignment * result.alignment;
    return std::make_shared<const Type>(std::move(result));
  }

  const std::map<std::string, Module>& modules_;
  bool asn1c_;
  const Place& place_;
};

}  // namespace

Representation read_asn1(const RepresentationRequest& request) {
  std::map<std::string, Module> modules;
  Scanner scanner(request.text, request.place, kSyntax);
  const std::string module_name = scanner.expect_name("a module's name");
  scanner.expect(".");
  const std::string type_name = scanner.expect_name("a type's name");
  bool asn1c = false;
  if (scanner.take("by")) {
    const std::string compiler = scanner.expect_name("asn1c or asn1scc");
    if (compiler != "asn1c" && compiler != "asn1scc") {
      scanner.fail(fmt::format("'{}' is no known ASN.1 compiler", compiler),
                   "write asn1c or asn1scc");
    }
    asn1c = compiler == "asn1c";
  }
  if (!scanner.at_end())
    scanner.fail(fmt::format("'{}' is left over after the type", scanner.peek().text));

  for (const auto& file : files_with(request.sources, {".asn", ".asn1"})) {
    const std::string text = read_text_file(file);
    Scanner words(text, {file.string(), 1, 0}, kSyntax);
    ModuleReader(words, modules, file).read();
  }
  const auto module = modules.find(module_name);
  if (module == modules.end()) {
    std::vector<std::string> names;
    for (const auto& [name, ignored] : modules) names.push_back(name);
    fail_at(request.place, fmt::format("ASN.1 module '{}' is not found", module_name),
            did_you_mean(module_name, names,
                         fmt::format("looked in the .asn files of {}",
                                     fmt::join(request.sources.directories, ", "))));
  }
  if (!module->second.types.count(type_name)) {
    std::vector<std::string> names;
    for (const auto& [name, ignored] : module->second.types) names.push_back(name);
    fail_at(request.place,
            fmt::format("ASN.1 module '{}' has no type '{}'", module_name, type_name),
            did_you_mean(type_name, names, fmt::format("it has {}", fmt::join(names, ", "))));
  }
  Representation result;
  result.type = Layout(modules, asn1c, request.place).named(type_name, 0);
  result.headers = {asn1c ? type_name + ".h" : module->second.file.stem().string() + ".h"};
  result.header_optional = !asn1c;
  return result;
}

}  // namespace sinew::data
