#include "sinew/backend/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_set>

namespace sinew::backend {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Words that C11 or C++20 reserve, and names of the C library that generated code uses.
constexpr std::string_view kReserved[] = {
    "alignas",      "alignof",   "and",           "and_eq",
    "asm",          "auto",      "bitand",        "bitor",
    "bool",         "break",     "case",          "catch",
    "char",         "char16_t",  "char32_t",      "char8_t",
    "class",        "co_await",  "co_return",     "co_yield",
    "compl",        "concept",   "const",         "const_cast",
    "consteval",    "constexpr", "constinit",     "continue",
    "cos",          "decltype",  "default",       "delete",
    "do",           "double",    "dynamic_cast",  "else",
    "enum",         "explicit",  "export",        "extern",
    "fabs",         "false",     "float",         "fma",
    "for",          "friend",    "goto",          "if",
    "inline",       "int",       "long",          "main",
    "memcpy",       "mutable",   "namespace",     "new",
    "noexcept",     "not",       "not_eq",        "nullptr",
    "operator",     "or",        "or_eq",         "private",
    "protected",    "public",    "register",      "reinterpret_cast",
    "requires",     "restrict",  "return",        "short",
    "signed",       "sin",       "size_t",        "sizeof",
    "sqrt",         "static",    "static_assert", "static_cast",
    "struct",       "switch",    "template",      "this",
    "thread_local", "throw",     "true",          "try",
    "typedef",      "typeid",    "typename",      "union",
    "unsigned",     "using",     "virtual",       "void",
    "volatile",     "wchar_t",   "while",         "xor",
    "xor_eq",       "NULL",      "NAN",           "INFINITY",
    "HUGE_VAL",     "cosf",      "sinf",          "sqrtf",
    "sincos",       "sincosf"};

constexpr std::size_t kLongestReserved =
    std::max_element(std::begin(kReserved), std::end(kReserved),
                     [](auto a, auto b) { return a.size() < b.size(); }) -> size();

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
  std::string result(text.empty() || is_digit(text.front()) ? "_" : "");
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
  static const std::unordered_set<std::string_view> reserved(std::begin(kReserved),
                                                             std::end(kReserved));
  return text.size() > kLongestReserved || !reserved.contains(text);
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
