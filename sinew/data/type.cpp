#include "sinew/data/type.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sinew/base/spelling.h"

namespace sinew::data {
namespace {

struct ScalarRow {
  std::string_view name;
  std::size_t size;
};
constexpr std::array<ScalarRow, 10> kScalars = {{{"int8_t", 1},
                                                 {"int16_t", 2},
                                                 {"int32_t", 4},
                                                 {"int64_t", 8},
                                                 {"uint8_t", 1},
                                                 {"uint16_t", 2},
                                                 {"uint32_t", 4},
                                                 {"uint64_t", 8},
                                                 {"float", 4},
                                                 {"double", 8}}};

std::string replaced(const std::string& pattern, char mark, const std::string& text) {
  std::string result;
  for (const char c : pattern) {
    if (c == mark) {
      result += text;
    } else {
      result += c;
    }
  }
  return result;
}

std::size_t round_up(std::size_t value, std::size_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

// One step into a type. Returns the type there, or null and why.
TypePointer enter(const TypePointer& type, const std::string& step, Access& access,
                  std::string* why) {
  const auto fail = [&](std::string text) {
    if (why) *why = std::move(text);
    return TypePointer();
  };
  const auto index = index_of(step);
  if (type->kind == Type::Kind::kStruct) {
    for (const Member& member : type->members) {
      if (member.name != step) continue;
      access.source = replaced(member.access, '$', access.source);
      access.offsets.back() += member.offset;
      return member.type;
    }
    std::vector<std::string> names;
    for (const Member& member : type->members) names.push_back(member.name);
    return fail(
        fmt::format("'{}' has no member '{}'; {}", type->spelling, step,
                    did_you_mean(step, names, fmt::format("it has {}", fmt::join(names, ", ")))));
  }
  switch (type->kind) {
    case Type::Kind::kArray:
    case Type::Kind::kMatrix: {
      if (!index) return fail(fmt::format("'{}' is no index into an array", step));
      const std::size_t count = type->kind == Type::Kind::kMatrix ? type->rows : type->count;
      if (*index >= count) {
        return fail(fmt::format("index {} is outside of the {} elements", step, count));
      }
      if (type->kind == Type::Kind::kMatrix && type->columns != 1) {
        return fail("a matrix takes a row and a column, as in {0,0}");
      }
      access.source = replaced(replaced(type->element_access, '#', step), '$', access.source);
      access.offsets.back() += type->element_offset + *index * type->element->size;
      return type->element;
    }
    case Type::Kind::kVector:
    case Type::Kind::kList: {
      if (!index) return fail(fmt::format("'{}' is no index into a sequence", step));
      access.guards.push_back(
          {type->kind, access.offsets, type->element->size, *index, access.source});
      access.source = replaced(replaced(type->element_access, '#', step), '$', access.source);
      if (type->kind == Type::Kind::kVector) {
        access.offsets.push_back(*index * type->element->size);
      } else {
        access.offsets.push_back(*index * sizeof(void*));
        access.offsets.push_back(0);
      }
      return type->element;
    }
    case Type::Kind::kScalar:
    case Type::Kind::kJson:
      return fail(fmt::format("'{}' goes on after a number", step));
    default:
      return fail(fmt::format("'{}' holds no numbers that can be reached", type->spelling));
  }
}

void list(const Type& type, Accessor& path, std::vector<Accessor>& found, std::size_t limit) {
  if (found.size() >= limit) return;
  const auto descend = [&](const std::string& step, const Type& part) {
    path.steps.push_back(step);
    list(part, path, found, limit);
    path.steps.pop_back();
  };
  switch (type.kind) {
    case Type::Kind::kScalar:
    case Type::Kind::kJson:
      found.push_back(path);
      break;
    case Type::Kind::kStruct:
      for (const Member& member : type.members) descend(member.name, *member.type);
      break;
    case Type::Kind::kArray:
      for (std::size_t i = 0; i < type.count && found.size() < limit; ++i) {
        descend(std::to_string(i), *type.element);
      }
      break;
    case Type::Kind::kMatrix:
      for (std::size_t r = 0; r < type.rows; ++r) {
        for (std::size_t c = 0; c < type.columns && path.steps.empty(); ++c) {
          found.push_back({true, {std::to_string(r), std::to_string(c)}});
        }
      }
      break;
    default:
      break;
  }
}

}  // namespace

std::size_t size_of(ScalarKind kind) { return kScalars[std::size_t(kind)].size; }
std::string_view name_of(ScalarKind kind) { return kScalars[std::size_t(kind)].name; }
bool is_floating(ScalarKind kind) {
  return kind == ScalarKind::kFloat32 || kind == ScalarKind::kFloat64;
}

TypePointer scalar_type(ScalarKind kind, std::string spelling) {
  Type type;
  type.kind = Type::Kind::kScalar;
  type.scalar = kind;
  type.spelling = spelling.empty() ? std::string(name_of(kind)) : std::move(spelling);
  type.size = type.alignment = size_of(kind);
  return std::make_shared<const Type>(std::move(type));
}

TypePointer array_type(TypePointer element, std::size_t count) {
  Type type;
  type.kind = Type::Kind::kArray;
  type.size = element->size * count;
  type.alignment = element->alignment;
  type.element = std::move(element);
  type.count = count;
  type.element_access = "$[#]";
  return std::make_shared<const Type>(std::move(type));
}

TypePointer opaque_type(std::string spelling, std::size_t size, std::size_t alignment) {
  Type type;
  type.spelling = std::move(spelling);
  type.size = size;
  type.alignment = alignment;
  return std::make_shared<const Type>(std::move(type));
}

TypePointer struct_type(std::string spelling, std::vector<Member> members) {
  Type type;
  type.kind = Type::Kind::kStruct;
  type.spelling = std::move(spelling);
  for (Member& member : members) {
    if (member.access.empty()) member.access = "$." + member.name;
    member.offset = round_up(type.size, member.type->alignment);
    type.size = member.offset + member.type->size;
    type.alignment = std::max(type.alignment, member.type->alignment);
  }
  type.size = round_up(type.size, type.alignment);
  type.members = std::move(members);
  return std::make_shared<const Type>(std::move(type));
}

TypePointer find_part(const TypePointer& type, const Accessor& path, Access* access,
                      std::string* why) {
  Access local;
  Access& at = access ? *access : local;
  at.source = "$";
  at.offsets = {0};
  if (path.braces) {
    const std::size_t row = *index_of(path.steps[0]);
    const bool two = path.steps.size() == 2;
    const std::size_t column = two ? *index_of(path.steps[1]) : 0;
    if (type->kind == Type::Kind::kArray && type->element->kind == Type::Kind::kArray && two) {
      const auto inner = enter(type, path.steps[0], at, why);
      return inner ? enter(inner, path.steps[1], at, why) : nullptr;
    }
    if (!two && type->kind != Type::Kind::kMatrix) return enter(type, path.steps[0], at, why);
    if (type->kind != Type::Kind::kMatrix) {
      if (why) *why = fmt::format("{} needs a matrix", to_string(path));
      return nullptr;
    }
    if (row >= type->rows || column >= type->columns) {
      if (why) {
        *why = fmt::format("{} is outside of the {} x {} matrix", to_string(path), type->rows,
                           type->columns);
      }
      return nullptr;
    }
    at.source = replaced(
        replaced(replaced(type->element_access, '#', path.steps[0]), '%', std::to_string(column)),
        '$', at.source);
    at.offsets.back() += type->element_offset + (type->row_major ? row * type->columns + column
                                                                 : column * type->rows + row) *
                                                    type->element->size;
    return type->element;
  }
  TypePointer part = type;
  for (const std::string& step : path.steps) {
    if (step == "value" && path.steps.size() == 1 && part->kind == Type::Kind::kScalar) break;
    part = enter(part, step, at, why);
    if (!part) return nullptr;
  }
  return part;
}

std::optional<Access> find_access(const Type& type, const Accessor& path, std::string* why) {
  Access access;
  const TypePointer whole(&type, [](const Type*) {});
  const TypePointer part = find_part(whole, path, &access, why);
  if (!part) return std::nullopt;
  if (part->kind != Type::Kind::kScalar && part->kind != Type::Kind::kJson) {
    if (why) *why = fmt::format("{} is no number but a part with several", to_string(path));
    return std::nullopt;
  }
  access.scalar = part->scalar;
  access.json = part->kind == Type::Kind::kJson;
  access.in_memory = !access.json;
  return access;
}

std::vector<Accessor> list_accessors(const Type& type, std::size_t limit) {
  std::vector<Accessor> found;
  Accessor path;
  list(type, path, found, limit);
  return found;
}

}  // namespace sinew::data
