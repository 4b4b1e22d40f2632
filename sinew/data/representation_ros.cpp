// ROS messages, from their .msg files; C++ types as roscpp's generator makes them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

// Sizes of the C++ library's containers on this platform.
constexpr std::size_t kStringSize = 32, kVectorSize = 24;

const std::map<std::string, ScalarKind, std::less<>> kScalars = {
    {"bool", ScalarKind::kUint8},     {"byte", ScalarKind::kInt8},
    {"char", ScalarKind::kUint8},     {"int8", ScalarKind::kInt8},
    {"uint8", ScalarKind::kUint8},    {"int16", ScalarKind::kInt16},
    {"uint16", ScalarKind::kUint16},  {"int32", ScalarKind::kInt32},
    {"uint32", ScalarKind::kUint32},  {"int64", ScalarKind::kInt64},
    {"uint64", ScalarKind::kUint64},  {"float32", ScalarKind::kFloat32},
    {"float64", ScalarKind::kFloat64}};

TypePointer vector_of(TypePointer element) {
  Type type;
  type.kind = Type::Kind::kVector;
  type.element = std::move(element);
  type.size = kVectorSize;
  type.alignment = 8;
  type.element_access = "$[#]";
  return std::make_shared<const Type>(std::move(type));
}

class Reader {
 public:
  explicit Reader(const RepresentationRequest& request) : request_(request) {}

  TypePointer read_message(const std::string& package, const std::string& name, std::size_t depth) {
    if (depth > kMaximumTypeDepth) {
      fail_at(request_.place,
              fmt::format("messages are nested more than {} deep", kMaximumTypeDepth),
              "a message must not contain itself");
    }
    const auto known = messages_.find(package + "/" + name);
    if (known != messages_.end()) return known->second;
    const std::filesystem::path file = find_file(package, name);
    const std::string text = read_text_file(file);
    std::vector<Member> members;
    std::size_t line = 0, begin = 0;
    while (begin < text.size()) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      read_line(std::string_view(text).substr(begin, end - begin), {file.string(), ++line, 0},
                package, members, depth);
      begin = end + 1;
    }
    if (members.empty())
      members.push_back(
          {"structure_needs_at_least_one_member", scalar_type(ScalarKind::kUint8), 0, {}});
    const TypePointer type = struct_type(fmt::format("{}::{}", package, name), std::move(members));
    messages_.emplace(package + "/" + name, type);
    return type;
  }

 private:
  std::filesystem::path find_file(const std::string& package, const std::string& name) {
    for (const std::string& directory : request_.sources.directories) {
      const std::filesystem::path root(directory);
      for (const auto& path :
           {root / package / "msg" / (name + ".msg"), root / package / (name + ".msg")}) {
        if (std::filesystem::exists(path)) return path;
      }
    }
    fail_at(request_.place, fmt::format("message {}/{} is not found", package, name),
            fmt::format("looked for {}/msg/{}.msg in {}", package, name,
                        fmt::join(request_.sources.directories, ", ")));
  }

  void read_line(std::string_view text, const Place& place, const std::string& package,
                 std::vector<Member>& members, std::size_t depth) {
    if (const std::size_t hash = text.find('#'); hash != std::string_view::npos) {
      // A string constant may hold a '#'; a constant is skipped anyway.
      text = text.substr(0, hash);
    }
    if (text.find('=') != std::string_view::npos) return;  // a constant takes no memory
    Scanner scanner(text, place, {.slash_comments = false});
    if (scanner.at_end()) return;
    std::string type = scanner.expect_name("a field's type");
    std::string of = package;
    if (scanner.take("/")) {
      of = type;
      type = scanner.expect_name("a message's name");
    } else if (type == "Header") {
      of = "std_msgs";
    }
    bool array = false, fixed = false;
    std::size_t count = 0;
    if (scanner.take("[")) {
      array = true;
      if (scanner.peek().kind == Word::Kind::kNumber) {
        fixed = true;
        count = scanner.expect_number("array size", kMaximumArrayCount);
      }
      scanner.expect("]");
    }
    const std::string name = scanner.expect_name("a field's name");
    TypePointer element = field_type(of, type, depth);
    if (array)
      element = fixed ? array_type(std::move(element), count) : vector_of(std::move(element));
    members.push_back({name, std::move(element), 0, {}});
  }

  TypePointer field_type(const std::string& package, const std::string& name, std::size_t depth) {
    if (const auto scalar = kScalars.find(name); scalar != kScalars.end())
      return scalar_type(scalar->second);
    if (name == "string") return opaque_type("std::string", kStringSize, 8);
    if (name == "time" || name == "duration") {
      const ScalarKind part = name == "time" ? ScalarKind::kUint32 : ScalarKind::kInt32;
      return struct_type(name == "time" ? "ros::Time" : "ros::Duration",
                         {{"sec", scalar_type(part), 0, {}}, {"nsec", scalar_type(part), 0, {}}});
    }
    return read_message(package, name, depth + 1);
  }

  const RepresentationRequest& request_;
  std::map<std::string, TypePointer> messages_;
};

}  // namespace

Representation read_ros(const RepresentationRequest& request) {
  Scanner scanner(request.text, request.place);
  const std::string package = scanner.expect_name("a package's name");
  scanner.expect("/");
  const std::string name = scanner.expect_name("a message's name");
  if (!scanner.at_end())
    scanner.fail(fmt::format("'{}' is left over after the message", scanner.peek().text));
  Representation result;
  result.type = Reader(request).read_message(package, name, 0);
  result.headers = {fmt::format("{}/{}.h", package, name)};
  result.cpp_only = true;
  return result;
}

}  // namespace sinew::data
