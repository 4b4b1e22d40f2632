// JSON documents, by example: {"position": {"x": number, "y": number}, "q": [number, number]}.
#include <fmt/format.h>

#include <set>

#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

TypePointer read_value(Scanner& scanner, std::size_t depth) {
  if (depth > kMaximumTypeDepth) scanner.fail("the document is nested too deep");
  if (scanner.take("number")) {
    Type type;
    type.kind = Type::Kind::kJson;
    type.spelling = "nlohmann::json";
    return std::make_shared<const Type>(std::move(type));
  }
  std::vector<Member> members;
  if (scanner.take("[")) {
    do {
      const std::string index = std::to_string(members.size());
      members.push_back({index, read_value(scanner, depth + 1), 0, fmt::format("$[{}]", index)});
    } while (scanner.take(","));
    scanner.expect("]");
  } else {
    scanner.expect("{");
    std::set<std::string> names;
    do {
      if (scanner.peek().kind != Word::Kind::kString)
        scanner.fail("a member's name in quotes is wanted");
      const std::string name = scanner.next().text;
      if (!names.insert(name).second) scanner.fail(fmt::format("member '{}' is there twice", name));
      scanner.expect(":");
      members.push_back({name, read_value(scanner, depth + 1), 0, fmt::format("$[\"{}\"]", name)});
    } while (scanner.take(","));
    scanner.expect("}");
  }
  return struct_type("nlohmann::json", std::move(members));
}

}  // namespace

Representation read_json(const RepresentationRequest& request) {
  Scanner scanner(request.text, request.place);
  Representation result;
  result.type = read_value(scanner, 0);
  if (!scanner.at_end())
    scanner.fail(fmt::format("'{}' is left over after the document", scanner.peek().text));
  result.headers = {"nlohmann/json.hpp"};
  result.cpp_only = true;
  return result;
}

}  // namespace sinew::data
