#include "sinew/rdf/json/value.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>

namespace sinew::json {

struct ArrayData {
  Value* items;
  std::uint32_t size, capacity;
};

struct ObjectData {
  Member* members;
  std::uint32_t size, capacity;
  // Open addressing, position of the member + 1; made when the object outgrows linear search.
  std::uint32_t* index;
  std::uint32_t index_capacity;  // a power of two, more than twice the size
};

namespace {

constexpr std::uint32_t kLinearSearch = 12;
constexpr std::uint32_t kNotFound = std::numeric_limits<std::uint32_t>::max();

std::size_t hash(std::string_view key) { return std::hash<std::string_view>{}(key); }

void insert_into_index(ObjectData& object, std::uint32_t member) {
  const std::uint32_t mask = object.index_capacity - 1;
  auto slot = static_cast<std::uint32_t>(hash(object.members[member].name())) & mask;
  while (object.index[slot] != 0) slot = (slot + 1) & mask;
  object.index[slot] = member + 1;
}

void rebuild_index(ObjectData& object, Arena& arena) {
  if (object.size >= object.index_capacity / 2) {
    object.index_capacity = std::max<std::uint32_t>(64, object.index_capacity * 4);
    object.index = arena.allocate<std::uint32_t>(object.index_capacity);
  }
  std::memset(object.index, 0, object.index_capacity * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < object.size; ++i) insert_into_index(object, i);
}

std::uint32_t position_of(const ObjectData& object, std::string_view key) {
  if (object.index == nullptr) {
    for (std::uint32_t i = 0; i < object.size; ++i) {
      if (object.members[i].name() == key) return i;
    }
    return kNotFound;
  }
  const std::uint32_t mask = object.index_capacity - 1;
  auto slot = static_cast<std::uint32_t>(hash(key)) & mask;
  for (; object.index[slot] != 0; slot = (slot + 1) & mask) {
    if (object.members[object.index[slot] - 1].name() == key) return object.index[slot] - 1;
  }
  return kNotFound;
}

template <typename T>
void grow(T*& items, std::uint32_t size, std::uint32_t& capacity, Arena& arena) {
  capacity = capacity == 0 ? 4 : capacity * 2;
  T* larger = arena.allocate<T>(capacity);
  std::copy_n(items, size, larger);
  items = larger;
}

ArrayData& array_of(const void* data) { return *static_cast<ArrayData*>(const_cast<void*>(data)); }
ObjectData& object_of(const void* data) {
  return *static_cast<ObjectData*>(const_cast<void*>(data));
}

}  // namespace

Value Value::boolean(bool value, Position position) {
  Value result;
  result.kind_ = Kind::kBoolean;
  result.size_ = value ? 1 : 0;
  result.position_ = position;
  return result;
}

Value Value::string(std::string_view text, Position position) {
  Value result;
  result.kind_ = Kind::kString;
  result.size_ = static_cast<std::uint32_t>(text.size());
  result.position_ = position;
  result.data_ = text.data();
  return result;
}

Value Value::number(std::string_view text, Position position) {
  Value result = string(text, position);
  result.kind_ = Kind::kNumber;
  return result;
}

Value Value::array(Arena& arena, Position position) {
  Value result;
  result.kind_ = Kind::kArray;
  result.position_ = position;
  result.data_ = new (arena.allocate<ArrayData>()) ArrayData{};
  return result;
}

Value Value::object(Arena& arena, Position position) {
  Value result;
  result.kind_ = Kind::kObject;
  result.position_ = position;
  result.data_ = new (arena.allocate<ObjectData>()) ObjectData{};
  return result;
}

Value Value::at(Position position) const {
  Value result = *this;
  result.position_ = position;
  return result;
}

double Value::number() const {
  const std::string_view digits = text();
  double result = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result);
  if (error == std::errc::result_out_of_range) {
    // from_chars leaves the result alone here. The exponent's sign tells overflow from underflow
    // for every number of sane length; digits without exponent overflow.
    const std::size_t exponent = digits.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos && digits[exponent + 1] == '-';
    result = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    if (digits.front() == '-') result = -result;
  }
  return result;
}

std::span<const Value> Value::items() const {
  if (!is_array()) return {};
  return {array_of(data_).items, array_of(data_).size};
}

std::span<Value> Value::items() {
  if (!is_array()) return {};
  return {array_of(data_).items, array_of(data_).size};
}

void Value::append(Arena& arena, Value item) {
  ArrayData& array = array_of(data_);
  if (array.size == array.capacity) grow(array.items, array.size, array.capacity, arena);
  array.items[array.size++] = item;
}

std::span<const Member> Value::members() const {
  if (!is_object()) return {};
  return {object_of(data_).members, object_of(data_).size};
}

std::span<Member> Value::members() {
  if (!is_object()) return {};
  return {object_of(data_).members, object_of(data_).size};
}

const Member* Value::find_member(std::string_view key) const {
  if (!is_object()) return nullptr;
  const ObjectData& object = object_of(data_);
  const std::uint32_t member = position_of(object, key);
  return member == kNotFound ? nullptr : &object.members[member];
}

const Value* Value::find(std::string_view key) const {
  const Member* member = find_member(key);
  return member == nullptr ? nullptr : &member->value;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

Value* Value::set(Arena& arena, Value key, Value value) {
  if (Value* found = find(key.text())) {
    *found = value;
    return found;
  }
  return add(arena, key, value);
}

Value* Value::add(Arena& arena, Value key, Value value) {
  ObjectData& object = object_of(data_);
  if (object.size == object.capacity) grow(object.members, object.size, object.capacity, arena);
  object.members[object.size++] = {key, value};
  if (object.size > kLinearSearch) {
    if (object.size >= object.index_capacity / 2) {
      rebuild_index(object, arena);
    } else {
      insert_into_index(object, object.size - 1);
    }
  }
  return &object.members[object.size - 1].value;
}

void Value::erase(std::string_view key) {
  ObjectData& object = object_of(data_);
  const std::uint32_t member = position_of(object, key);
  if (member == kNotFound) return;
  std::copy(object.members + member + 1, object.members + object.size, object.members + member);
  --object.size;
  members_were_moved();
}

void Value::members_were_moved() {
  ObjectData& object = object_of(data_);
  if (object.index == nullptr) return;
  std::memset(object.index, 0, object.index_capacity * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < object.size; ++i) insert_into_index(object, i);
}

bool equal(const Value& a, const Value& b) {
  if (a.kind() != b.kind()) return false;
  switch (a.kind()) {
    case Kind::kNull:
      return true;
    case Kind::kBoolean:
      return a.is_true() == b.is_true();
    case Kind::kNumber:
      return a.text() == b.text() || a.number() == b.number();
    case Kind::kString:
      return a.text() == b.text();
    case Kind::kArray:
      return std::equal(a.items().begin(), a.items().end(), b.items().begin(), b.items().end(),
                        [](const Value& x, const Value& y) { return equal(x, y); });
    case Kind::kObject:
      if (a.members().size() != b.members().size()) return false;
      return std::all_of(a.members().begin(), a.members().end(), [&](const Member& member) {
        const Value* other = b.find(member.name());
        return other != nullptr && equal(member.value, *other);
      });
  }
  return false;
}

Value clone(const Value& value, Arena& arena) {
  if (value.is_array()) {
    Value result = Value::array(arena, value.position());
    for (const Value& item : value.items()) result.append(arena, clone(item, arena));
    return result;
  }
  if (value.is_object()) {
    Value result = Value::object(arena, value.position());
    for (const Member& member : value.members()) {
      result.add(arena, member.key, clone(member.value, arena));
    }
    return result;
  }
  return value;
}

}  // namespace sinew::json
