// Eigen's fixed-size types. Dynamic ones are refused: what is not there at compile time cannot be
// laid out.
#include <fmt/format.h>

#include "sinew/data/representation_readers.h"

namespace sinew::data {
namespace {

constexpr std::size_t kMaximumExtent = 64;

TypePointer matrix(ScalarKind scalar, std::size_t rows, std::size_t columns, bool row_major,
                   std::string spelling) {
  Type type;
  type.kind = Type::Kind::kMatrix;
  type.spelling = std::move(spelling);
  type.element = scalar_type(scalar);
  type.rows = rows;
  type.columns = columns;
  // A row vector is row-major whether one says so or not.
  type.row_major = row_major || (rows == 1 && columns != 1);
  type.size = rows * columns * type.element->size;
  // Sizes that are a multiple of 16 bytes are aligned for SIMD; with 256-bit vectors, of 32.
  type.alignment = type.size % 16 == 0 ? 16 : type.element->alignment;
  type.element_access = columns == 1 ? "$(#)" : "$(#, %)";
  return std::make_shared<const Type>(std::move(type));
}

// Matrix4d, Vector3f, Quaterniond …: a stem, a size where it takes one, and the scalar's letter.
TypePointer named(const std::string& name) {
  if (name.size() < 2) return nullptr;
  const char letter = name.back();
  if (letter != 'd' && letter != 'f') return nullptr;
  const ScalarKind scalar = letter == 'd' ? ScalarKind::kFloat64 : ScalarKind::kFloat32;
  std::string stem = name.substr(0, name.size() - 1);
  const std::string spelling = "Eigen::" + name;
  if (stem == "Quaternion") {
    std::vector<Member> members;
    for (const char* part : {"x", "y", "z", "w"}) {
      members.push_back({part, scalar_type(scalar), 0, fmt::format("$.{}()", part)});
    }
    return struct_type(spelling, std::move(members));
  }
  if (stem == "AngleAxis") {
    return struct_type(spelling, {{"axis", matrix(scalar, 3, 1, false, {}), 0, "$.axis()"},
                                  {"angle", scalar_type(scalar), 0, "$.angle()"}});
  }
  if (stem == "Isometry3" || stem == "Affine3") return matrix(scalar, 4, 4, false, spelling);
  const std::size_t size = std::size_t(stem.back() - '0');
  stem.pop_back();
  if (size < 2 || size > 4) return nullptr;
  if (stem == "Matrix") return matrix(scalar, size, size, false, spelling);
  if (stem == "Vector") return matrix(scalar, size, 1, false, spelling);
  if (stem == "RowVector") return matrix(scalar, 1, size, true, spelling);
  return nullptr;
}

}  // namespace

Representation read_eigen(const RepresentationRequest& request) {
  Scanner scanner(request.text, request.place, {.marks = {"::"}});
  if (scanner.take("Eigen")) scanner.expect("::");
  const std::string name = scanner.expect_name("one of Eigen's types");
  Representation result;
  result.cpp_only = true;
  result.headers = {"Eigen/Geometry"};
  if (name == "Matrix") {
    scanner.expect("<");
    const std::string scalar = scanner.expect_name("double or float");
    if (scalar != "double" && scalar != "float") {
      scanner.fail(fmt::format("a matrix of {} is not supported", scalar), "use double or float");
    }
    std::size_t extents[2];
    for (std::size_t& extent : extents) {
      scanner.expect(",");
      if (scanner.peek().text == "Dynamic" || scanner.peek().text == "-") {
        scanner.fail("a matrix of dynamic size has no layout", "give it fixed rows and columns");
      }
      extent = scanner.expect_number("number of rows or columns", kMaximumExtent);
      if (extent == 0) scanner.fail("a matrix needs at least one row and one column");
    }
    bool row_major = false;
    if (scanner.take(",")) {
      if (scanner.take("Eigen")) scanner.expect("::");
      const std::string order = scanner.expect_name("RowMajor or ColMajor");
      if (order != "RowMajor" && order != "ColMajor") {
        scanner.fail(fmt::format("'{}' is no storage order", order), "write RowMajor or ColMajor");
      }
      row_major = order == "RowMajor";
    }
    scanner.expect(">");
    result.type = matrix(scalar == "double" ? ScalarKind::kFloat64 : ScalarKind::kFloat32,
                         extents[0], extents[1], row_major,
                         fmt::format("Eigen::Matrix<{}, {}, {}{}>", scalar, extents[0], extents[1],
                                     row_major ? ", Eigen::RowMajor" : ""));
  } else {
    result.type = named(name);
    if (!result.type) {
      scanner.fail(fmt::format("'{}' is none of Eigen's fixed-size types", name),
                   "use Matrix<double, R, C>, Matrix3d, Vector3d, Quaterniond, AngleAxisd or "
                   "Isometry3d, or their float forms");
    }
  }
  if (!scanner.at_end()) {
    scanner.fail(fmt::format("'{}' is left over after the type", scanner.peek().text));
  }
  return result;
}

}  // namespace sinew::data
