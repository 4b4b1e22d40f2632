// C types: scalars, arrays, structs, nested; laid out by the platform's ABI.
//   double[3]   float[4][4]   struct pose { double position[3]; struct { double w, x; } q; }
//   pose_t in "pose.h" { … }  is written  struct pose_t { … } in "pose.h": the header is included
//   instead of declaring the struct again; the members still have to be given, as nobody else tells
//   us of them.
#include <fmt/format.h>

#include <set>

#include "sinew/base/spelling.h"
#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

struct CScalar {
  std::string_view name;
  ScalarKind kind;
};
// The integer sizes of the 64-bit Unix ABI; char's sign is left to the compiler, so only its signed
// forms.
constexpr CScalar kScalars[] = {{"double", ScalarKind::kFloat64},
                                {"float", ScalarKind::kFloat32},
                                {"int8_t", ScalarKind::kInt8},
                                {"int16_t", ScalarKind::kInt16},
                                {"int32_t", ScalarKind::kInt32},
                                {"int64_t", ScalarKind::kInt64},
                                {"uint8_t", ScalarKind::kUint8},
                                {"uint16_t", ScalarKind::kUint16},
                                {"uint32_t", ScalarKind::kUint32},
                                {"uint64_t", ScalarKind::kUint64},
                                {"signed char", ScalarKind::kInt8},
                                {"unsigned char", ScalarKind::kUint8},
                                {"short", ScalarKind::kInt16},
                                {"unsigned short", ScalarKind::kUint16},
                                {"int", ScalarKind::kInt32},
                                {"unsigned", ScalarKind::kUint32},
                                {"unsigned int", ScalarKind::kUint32},
                                {"long", ScalarKind::kInt64},
                                {"unsigned long", ScalarKind::kUint64},
                                {"long long", ScalarKind::kInt64},
                                {"unsigned long long", ScalarKind::kUint64}};
const std::set<std::string> kTypeWords = {"signed", "unsigned", "char", "short", "int", "long"};

class Reader {
 public:
  explicit Reader(Scanner& scanner) : scanner_(scanner) {}

  TypePointer read_type(std::size_t depth) {
    if (depth > kMaximumTypeDepth) {
      scanner_.fail(fmt::format("structs are nested more than {} deep", kMaximumTypeDepth));
    }
    if (scanner_.take("struct")) return read_struct(depth);
    std::string name = scanner_.expect_name("a type");
    if (kTypeWords.count(name)) {
      while (kTypeWords.count(scanner_.peek().text)) name += " " + scanner_.next().text;
    }
    for (const CScalar& scalar : kScalars) {
      if (scalar.name == name) return scalar_type(scalar.kind, name);
    }
    std::vector<std::string> names;
    for (const CScalar& scalar : kScalars) names.emplace_back(scalar.name);
    scanner_.fail(fmt::format("'{}' is no C type that is known here", name),
                  did_you_mean(name, names, "use a scalar, an array or a struct with its members"));
  }

 private:
  TypePointer read_struct(std::size_t depth) {
    std::string name;
    if (scanner_.peek().kind == Word::Kind::kName) name = scanner_.next().text;
    scanner_.expect("{");
    std::vector<Member> members;
    std::set<std::string> names;
    while (!scanner_.take("}")) {
      const TypePointer type = read_type(depth + 1);
      read_members_of(scanner_, type, names, members);
    }
    if (members.empty()) scanner_.fail("a struct needs at least one member");
    Type type = *struct_type(name.empty() ? "" : "struct " + name, std::move(members));
    type.declared = true;
    return std::make_shared<const Type>(std::move(type));
  }

  Scanner& scanner_;
};

}  // namespace

Representation read_c99(const RepresentationRequest& request) {
  Scanner scanner(request.text, request.place);
  Reader reader(scanner);
  Representation result;
  result.type = read_extents(scanner, reader.read_type(0));
  if (scanner.take("in")) {
    if (scanner.peek().kind != Word::Kind::kString) scanner.fail("'in' wants a header in quotes");
    result.headers = {scanner.next().text};
  }
  if (!scanner.at_end()) {
    scanner.fail(fmt::format("'{}' is left over after the type", scanner.peek().text));
  }
  return result;
}

}  // namespace sinew::data
