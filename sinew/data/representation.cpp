#include "sinew/data/representation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "sinew/base/spelling.h"
#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

struct Context {
  std::string_view name;
  Representation (*read)(const RepresentationRequest&);
};
constexpr Context kContexts[] = {{"c99", read_c99},   {"Eigen", read_eigen},     {"ROS", read_ros},
                                 {"ASN1", read_asn1}, {"SMDSD", read_smartsoft}, {"IDL", read_idl},
                                 {"JSON", read_json}};

std::string spaces_normalised(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!space) {
      result += c;
    } else if (!result.empty() && result.back() != ' ') {
      result += ' ';
    }
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

}  // namespace

std::vector<std::string> representation_contexts() {
  std::vector<std::string> names;
  for (const Context& context : kContexts) names.emplace_back(context.name);
  return names;
}

Representation read_representation(std::string_view name, std::string_view text, const Place& place,
                                   const TypeSources& sources) {
  for (const Context& context : kContexts) {
    if (context.name != name) continue;
    Representation result = context.read({name, text, place, sources});
    result.context = name;
    result.text = spaces_normalised(text);
    return result;
  }
  const auto names = representation_contexts();
  fail_at(place, fmt::format("'{}' is no known kind of data representation", name),
          did_you_mean(name, names, fmt::format("use one of {}", fmt::join(names, ", "))));
}

TypeSources sources_beside(const std::string& file) {
  TypeSources sources;
  const auto parent = std::filesystem::path(file).parent_path();
  sources.directories.push_back(parent.empty() ? "." : parent.string());
  if (const char* path = std::getenv("ROS_PACKAGE_PATH")) {
    std::string_view rest = path;
    while (!rest.empty()) {
      const std::string_view directory = rest.substr(0, rest.find(':'));
      rest.remove_prefix(std::min(rest.size(), directory.size() + 1));
      if (!directory.empty()) sources.directories.emplace_back(directory);
    }
  }
  sources.directories.emplace_back("/usr/share");
  return sources;
}

std::vector<std::filesystem::path> files_with(const TypeSources& sources,
                                              std::initializer_list<std::string_view> endings) {
  std::vector<std::filesystem::path> files;
  for (const std::string& directory : sources.directories) {
    std::vector<std::filesystem::path> here;
    std::error_code ignored;  // a directory that is not there holds no files
    for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
      const std::string extension = entry.path().extension().string();
      if (std::find(endings.begin(), endings.end(), extension) != endings.end()) {
        here.push_back(entry.path());
      }
    }
    std::sort(here.begin(), here.end());
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

std::string read_text_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail_at({file.string(), 0, 0}, "the file cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

TypePointer read_extents(Scanner& scanner, TypePointer element) {
  std::vector<std::size_t> extents;
  while (scanner.take("[")) {
    extents.push_back(scanner.expect_number("array size", kMaximumArrayCount));
    if (extents.back() == 0) scanner.fail("an array needs at least one element");
    scanner.expect("]");
  }
  for (auto extent = extents.rbegin(); extent != extents.rend(); ++extent) {
    element = array_type(std::move(element), *extent);
  }
  return element;
}

void read_members_of(Scanner& scanner, const TypePointer& type, std::set<std::string>& names,
                     std::vector<Member>& members) {
  do {
    const std::string member = scanner.expect_name("a member's name");
    if (!names.insert(member).second) {
      scanner.fail(fmt::format("member '{}' is there twice", member), "rename one of them");
    }
    members.push_back({member, read_extents(scanner, type), 0, {}});
  } while (scanner.take(","));
  scanner.expect(";");
}

void fail_at(const Place& place, std::string what, std::string remedy) {
  throw Error(Problem{place, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

}  // namespace sinew::data
