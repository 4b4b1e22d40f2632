#include "sinew/data/accessor.h"

#include <cctype>

namespace sinew::data {
namespace {

bool is_name(std::string_view step) {
  if (step.empty() || std::isdigit(static_cast<unsigned char>(step[0]))) return false;
  for (const char c : step) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') return false;
  }
  return true;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else if (separator != ',' || c != ' ') {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

std::optional<std::size_t> index_of(std::string_view step) {
  if (step.empty() || step.size() > 7) return std::nullopt;
  std::size_t value = 0;
  for (const char c : step) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + std::size_t(c - '0');
  }
  return value <= kMaximumIndex ? std::optional(value) : std::nullopt;
}

std::string to_string(const Accessor& accessor) {
  std::string text;
  for (const std::string& step : accessor.steps) {
    if (!text.empty()) text += accessor.braces ? ',' : '.';
    text += step;
  }
  return accessor.braces ? "{" + text + "}" : text;
}

std::optional<Accessor> parse_accessor(std::string_view text) {
  Accessor accessor;
  if (text.size() > 2 && text.front() == '{' && text.back() == '}') {
    accessor.braces = true;
    accessor.steps = split(text.substr(1, text.size() - 2), ',');
    if (accessor.steps.size() > 2) return std::nullopt;
    for (const std::string& step : accessor.steps) {
      if (!index_of(step)) return std::nullopt;
    }
    return accessor;
  }
  accessor.steps = split(text, '.');
  for (const std::string& step : accessor.steps) {
    if (!index_of(step) && !is_name(step)) return std::nullopt;
  }
  return accessor;
}

}  // namespace sinew::data
