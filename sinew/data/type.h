// Types in memory, whichever language describes them: where each number of a value lies, and how C
// or C++ source reaches it. Sizes and alignment are those of this platform's ABI (64-bit, GCC's and
// clang's C++ library).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/data/accessor.h"

namespace sinew::data {

enum class ScalarKind : std::uint8_t {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kUint8,
  kUint16,
  kUint32,
  kUint64,
  kFloat32,
  kFloat64,
};
std::size_t size_of(ScalarKind kind);
std::string_view name_of(ScalarKind kind);  // the fixed-width C name: "double", "int32_t"
bool is_floating(ScalarKind kind);

struct Type;
using TypePointer = std::shared_ptr<const Type>;

struct Member {
  std::string name;
  TypePointer type;
  std::size_t offset = 0;
  std::string access;  // source pattern, $ for the object: "$.x", "$.x()"
};

struct Type {
  enum class Kind : std::uint8_t {
    kScalar,
    kArray,  // `count` elements in a row
    kStruct,
    kMatrix,  // Eigen: rows x columns, one block of memory
    kVector,  // std::vector: count known only while it runs
    kList,    // asn1c's A_SEQUENCE_OF: an array of pointers, count known only while it runs
    kOpaque,  // memory that holds no numbers for us: strings, bookkeeping
    kJson,    // a number within a JSON document: no memory of its own
  };
  Kind kind = Kind::kOpaque;
  std::string spelling;  // in source: "double", "geometry_msgs::Point"; empty for arrays
  ScalarKind scalar = ScalarKind::kFloat64;
  std::size_t size = 0, alignment = 1;
  std::vector<Member> members;
  TypePointer element;
  std::size_t count = 0;
  std::size_t element_offset = 0;  // of the first element
  std::string element_access;      // source pattern, $ the object, # the index, % the column
  std::size_t rows = 0, columns = 0;
  bool row_major = false;
  bool declared = false;  // plain C struct whose declaration can be written out
};

TypePointer scalar_type(ScalarKind kind, std::string spelling = {});
TypePointer array_type(TypePointer element, std::size_t count);
TypePointer opaque_type(std::string spelling, std::size_t size, std::size_t alignment);
// Lays the members out in order, each at its alignment; sets offsets, size and alignment.
TypePointer struct_type(std::string spelling, std::vector<Member> members);

// A number inside a value.
struct Access {
  ScalarKind scalar = ScalarKind::kFloat64;
  std::string source;  // pattern with $ for the object: "$.im.arr[0]"
  bool json = false;   // to read it in C++: .get<double>()
  // address = object + offsets[0]; for each further offset: what lies there is a pointer, add the
  // offset.
  std::vector<std::size_t> offsets;
  bool in_memory = true;  // false within JSON
  // What must hold while it runs: a growing container must have more elements than `index`.
  struct Guard {
    Type::Kind kind;                   // kVector or kList
    std::vector<std::size_t> offsets;  // of the container, as above
    std::size_t element_size;
    std::size_t index;
    std::string source;  // pattern of the container
    friend bool operator==(const Guard&, const Guard&) = default;
  };
  std::vector<Guard> guards;
};

// The number at `path`; nothing, and why, when there is none.
std::optional<Access> find_access(const Type& type, const Accessor& path, std::string* why);
// The paths of all numbers, in memory order; containers that grow are left out. At most `limit`.
std::vector<Accessor> list_accessors(const Type& type, std::size_t limit = 1000);
// What lies at a path: any type, not only numbers; the access's source and offsets lead to it.
TypePointer find_part(const TypePointer& type, const Accessor& path, Access* access,
                      std::string* why);

}  // namespace sinew::data
