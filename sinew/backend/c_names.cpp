#include "sinew/backend/c_names.h"

#include <fmt/format.h>

#include <charconv>

namespace sinew::backend {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void append_number(std::string& name, std::size_t number) {
  const fmt::format_int digits(number);
  (name += '_').append(digits.data(), digits.size());
}

}  // namespace

// Nothing where a name is not like a temporary's.
CNames::Like CNames::like(std::string_view name) {
  Like result;
  if (name.size() < 2 || name[0] != 't' || !is_digit(name[1]) || name[1] == '0') return {};
  const char* const end = name.data() + name.size();
  const auto number = std::from_chars(name.data() + 1, end, result.number);
  if (number.ec != std::errc{}) return {};
  const char* at = number.ptr;
  if (at == end) return result;
  if (*at != '_' || ++at == end || !is_digit(*at) || *at == '0') return {};
  const auto again = std::from_chars(at, end, result.again);
  return again.ec == std::errc{} && again.ptr == end ? result : Like{};
}

bool CNames::is_given(const Like& temporary) const {
  const auto& [number, again] = temporary;
  if (number == 0 || number > temporaries_) return false;
  return again == 0 || (again > 1 && number < again_.size() && again < again_[number]);
}

std::string CNames::unique(const std::string& base) {
  const Like temporary = like(base);
  if (is_given(temporary) && temporary.again == 0) return again(base, temporary.number);
  std::string name = base;
  if (is_given(temporary) || !taken_.insert(name).second) {
    int& number = numbers_.try_emplace(base, 2).first->second;
    do {
      name = base;
      append_number(name, static_cast<std::size_t>(number++));
    } while (is_given(like(name)) || !taken_.insert(name).second);
  }
  others_like_them_ = others_like_them_ || (name.size() > 1 && name[0] == 't' && name[1] <= '9');
  return name;
}

// A further name of a temporary's.
std::string CNames::again(const std::string& base, std::size_t number) {
  if (again_.size() <= number) again_.resize(temporaries_ + 1, 2);
  std::string name;
  do {
    name = base;
    append_number(name, again_[number]++);
  } while (others_like_them_ && taken_.contains(name));
  return name;
}

std::string CNames::temporary() {
  const fmt::format_int number(temporaries_ + 1);
  std::string name = "t";
  name.append(number.data(), number.size());
  // The name is taken by an input: then it is this one's with a number behind it.
  if (others_like_them_ && taken_.contains(name)) name = unique(name);
  ++temporaries_;
  return name;
}

}  // namespace sinew::backend
