// A JSON document in memory, in which every value and every key knows its line and column.
//
// A Value is a small handle: copying one shares its array or object. Whatever it points to lies in
// an Arena and lives as long as that. Objects keep the order in which their members were added.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sinew/rdf/json/arena.h"

namespace sinew::json {

// Counted from 1, the column in bytes; 0 where a value was not read from a text.
struct Position {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

enum class Kind : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };

struct Member;
struct ArrayData;
struct ObjectData;

class Value {
 public:
  Value() = default;  // null
  static Value boolean(bool value, Position position = {});
  // The text must outlive the value: it is not copied. A number's text is JSON's notation.
  static Value number(std::string_view text, Position position = {});
  static Value string(std::string_view text, Position position = {});
  static Value array(Arena& arena, Position position = {});
  static Value object(Arena& arena, Position position = {});

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::kNull; }
  bool is_boolean() const { return kind_ == Kind::kBoolean; }
  bool is_number() const { return kind_ == Kind::kNumber; }
  bool is_string() const { return kind_ == Kind::kString; }
  bool is_array() const { return kind_ == Kind::kArray; }
  bool is_object() const { return kind_ == Kind::kObject; }
  bool is_scalar() const { return is_boolean() || is_number() || is_string(); }
  Position position() const { return position_; }
  Value at(Position position) const;  // the same value, said to come from elsewhere

  bool is_true() const { return is_boolean() && size_ == 1; }
  bool is_string(std::string_view text) const { return is_string() && this->text() == text; }
  // A string's characters, a number as it was written; empty for every other kind.
  std::string_view text() const {
    if (!is_string() && !is_number()) return {};
    return {static_cast<const char*>(data_), size_};
  }
  // The nearest double to a number; infinity where it is beyond the range of a double.
  double number() const;

  // The items of an array; empty for every other kind.
  std::span<const Value> items() const;
  std::span<Value> items();
  void append(Arena& arena, Value item);

  // The members of an object; empty for every other kind.
  std::span<const Member> members() const;
  std::span<Member> members();
  const Value* find(std::string_view key) const;  // nullptr when there is no such member
  Value* find(std::string_view key);
  const Member* find_member(std::string_view key) const;
  // Adds a member, or replaces the value of the one with that key. Returns the member's value.
  Value* set(Arena& arena, Value key, Value value);
  // Adds a member that is known to be new.
  Value* add(Arena& arena, Value key, Value value);
  void erase(std::string_view key);
  // To be called after the members have been put into another order.
  void members_were_moved();

  // Equal for two handles of the same array, object or piece of text, and for those only.
  const void* identity() const { return data_; }

 private:
  Kind kind_ = Kind::kNull;
  std::uint32_t size_ = 0;  // of the text; a boolean's value
  Position position_;
  const void* data_ = nullptr;  // text, ArrayData or ObjectData
};

struct Member {
  Value key;  // a string, with the position of the key
  Value value;
  std::string_view name() const { return key.text(); }
};

// Equal as JSON: numbers by value, objects whatever the order of their members.
bool equal(const Value& a, const Value& b);

// A copy that shares nothing with the original but texts.
Value clone(const Value& value, Arena& arena);

}  // namespace sinew::json
