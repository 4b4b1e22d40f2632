// Digital data representations (ddr): a type described in some other language, read into a Type.
//
// - c99: `double[3]`, `float[4][4]`, `struct pose { double position[3]; … }`, the latter perhaps
// followed
//   by `in "pose.h"`, whose declaration is then used.
// - Eigen: `Matrix<double, 3, 3>`, `Matrix3d`, `Vector3f`, `Quaterniond`, `Isometry3d`,
// `AngleAxisd` …
// - ROS: `geometry_msgs/Point`, from package/msg/Point.msg in the directories of TypeSources.
// - ASN1: `Module.Type`, from the .asn and .asn1 files there; C types as the TASTE compiler
// (asn1scc)
//   makes them, or after `by asn1c` as asn1c does.
// - SMDSD: `Repository.Object`, from the .smdsd and .types files there; the objects' plain structs.
// - IDL: `module::Struct`, from the .idl files there; the plain structs of the mapping to C++11.
// - JSON: `{"x": number, "v": [number, number]}`; C++ only, over nlohmann::json.
//
// Where the text of an IDL or SMDSD representation holds a declaration itself, no file is looked
// for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/data/type.h"

namespace sinew::data {

// How deep types may be nested.
constexpr std::size_t kMaximumTypeDepth = 32;
// The most elements that a fixed array may have.
constexpr std::size_t kMaximumArrayCount = 100'000;

struct Representation {
  std::string context;
  std::string text;  // as written, spaces normalised
  TypePointer type;
  std::vector<std::string> headers;  // to include; none when the source declares the type itself
  bool header_optional = false;      // where they are not found, the source declares the type
  bool cpp_only = false;
};

// Where descriptions of types are looked for, in this order. Files are visited by name.
struct TypeSources {
  std::vector<std::string> directories;
};
// The file's own directory, then those of ROS_PACKAGE_PATH, then /usr/share.
TypeSources sources_beside(const std::string& file);

// Throws Error at `place` for an unknown context, a type that is not found or cannot be laid out.
Representation read_representation(std::string_view context, std::string_view text,
                                   const Place& place, const TypeSources& sources);

// The known contexts, for error messages and tests.
std::vector<std::string> representation_contexts();

}  // namespace sinew::data
