// Digital data representations (ddr): a type described in some other language, read into a Type.
//
//   context  text, and where the description comes from
//   c99      double[3] | double[4][4] | struct { double x, y; } | struct pose { … } | NAME, with
//   `in "header.h"` Eigen    Matrix<double, 3, 3>, Matrix3d, Vector3f, Quaterniond, Isometry3d,
//   AngleAxisd … ROS      geometry_msgs/Point; from package/msg/Point.msg in the directories of
//   TypeSources ASN1     Module.Type; from *.asn and *.asn1 files there. C types as the TASTE
//   compiler (asn1scc) makes them;
//            "Module.Type by asn1c" as asn1c does
//   SMDSD    Repository.Object; from *.smdsd and *.types files there; the plain structs of the
//   objects IDL      module::Struct; from *.idl files there; the C++11 mapping's plain structs JSON
//   {"x": number, "v": [number, number]}; C++ only, over nlohmann::json
//
// Where C99, ASN1, IDL and SMDSD text itself holds a declaration (struct S { … }), no file is
// looked for.
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
  std::string
      header;  // to include; empty when the source declares the type itself or it is built in
  bool header_optional = false;  // where the header is not found, the source declares the type
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
