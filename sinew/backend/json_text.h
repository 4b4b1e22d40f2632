// JSON written as text, member by member: what a program is described with has tens of thousands of
// values, for which a document in memory takes ten times as long.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::backend {

class JsonText {
 public:
  // Between begin and end of an object each value follows its key.
  JsonText& begin_object();
  JsonText& end_object();
  JsonText& begin_array();
  JsonText& end_array();
  JsonText& key(std::string_view name);  // which needs no escapes

  JsonText& value(std::string_view text);
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  JsonText& value(double number);  // the shortest text that is this number; null where it is none
  template <std::integral Integer>
  JsonText& value(Integer number) {
    separate();
    append_digits(number);
    return *this;
  }
  // [[a(e),b(e)],…] for each e of the range: integers, of which there may be very many.
  template <typename Range, typename A, typename B>
  JsonText& pairs(const Range& range, A a, B b) {
    begin_array();
    std::array<char, 4096> text;
    char* at = text.data();
    for (const auto& each : range) {
      if (at + 2 * kDigits + 4 > text.data() + text.size()) {
        text_.append(text.data(), at);
        at = text.data();
      }
      if (&each != &*std::begin(range)) *at++ = ',';
      *at++ = '[';
      at = std::to_chars(at, at + kDigits, a(each)).ptr;
      *at++ = ',';
      at = std::to_chars(at, at + kDigits, b(each)).ptr;
      *at++ = ']';
    }
    text_.append(text.data(), at);
    return end_array();
  }
  template <typename Value>
  JsonText& value(const std::vector<Value>& values) {
    begin_array();
    for (const Value& each : values) value(each);
    return end_array();
  }

  template <typename Value>
  JsonText& member(std::string_view name, const Value& its_value) {
    return key(name).value(its_value);
  }

  // Of so many bytes to come, which need not be all.
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  std::string take() { return std::move(text_); }

 private:
  static constexpr std::size_t kDigits = 24;  // more than those of any integer

  void separate();
  template <std::integral Integer>
  void append_digits(Integer number) {
    std::array<char, kDigits> digits;
    text_.append(digits.data(),
                 std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }

  std::string text_;
};

}  // namespace sinew::backend
