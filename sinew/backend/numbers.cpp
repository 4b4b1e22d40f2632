#include "sinew/backend/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "sinew/backend/reserved_names.h"

namespace sinew::backend {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

template <typename Number>
std::string shortest(Number value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

std::string c_number(double value) { return shortest(value); }
std::string c_number(float value) { return shortest(value); }

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string c_identifier(std::string_view text) {
  std::string result;
  result.reserve(text.size() + 4);  // what callers put in front or behind, too
  if (text.empty() || is_digit(text.front())) result = "_";
  const std::size_t first = result.size();
  result += text;
  for (std::size_t k = first; k < result.size(); ++k) {
    if (!is_letter(result[k]) && !is_digit(result[k])) result[k] = '_';
  }
  return result;
}

bool is_c_function_name(std::string_view text) {
  if (text.empty() || !is_letter(text.front())) return false;
  if (!std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); })) {
    return false;
  }
  return !is_reserved_in_c(text);
}

std::string c_comment(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '/' && !result.empty() && result.back() == '*') result += ' ';
    if (c == '*' && !result.empty() && result.back() == '/') result += ' ';
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  // A backslash at the end would join the next line; "??/" is a backslash in old C.
  if (!result.empty() && (result.back() == '\\' || result.back() == '/')) result += ' ';
  return result;
}

}  // namespace sinew::backend
