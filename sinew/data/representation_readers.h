// The readers behind read_representation, one for each language. Internal to the module.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sinew/data/representation.h"
#include "sinew/data/scanner.h"

namespace sinew::data {

struct RepresentationRequest {
  std::string_view context;
  std::string_view text;
  const Place& place;
  const TypeSources& sources;
};

Representation read_c99(const RepresentationRequest& request);
Representation read_eigen(const RepresentationRequest& request);
Representation read_ros(const RepresentationRequest& request);
Representation read_asn1(const RepresentationRequest& request);
Representation read_smartsoft(const RepresentationRequest& request);
Representation read_idl(const RepresentationRequest& request);
Representation read_json(const RepresentationRequest& request);

// [3][4] behind a type or a name, as C and IDL write arrays: `element` itself where there is none.
TypePointer read_extents(Scanner& scanner, TypePointer element);

// "a, b[3];" behind the type of a struct's members, as C and IDL write them; `names` are those that
// the struct has already.
void read_members_of(Scanner& scanner, const TypePointer& type, std::set<std::string>& names,
                     std::vector<Member>& members);

// Files in the source directories (not below them) whose name ends in one of `endings`, by name.
std::vector<std::filesystem::path> files_with(const TypeSources& sources,
                                              std::initializer_list<std::string_view> endings);
// The whole file; Error when it cannot be read.
std::string read_text_file(const std::filesystem::path& file);
[[noreturn]] void fail_at(const Place& place, std::string what, std::string remedy = {});

}  // namespace sinew::data
