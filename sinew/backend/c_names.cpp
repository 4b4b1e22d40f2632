#include "sinew/backend/c_names.h"

#include <fmt/format.h>

#include <charconv>

namespace sinew::backend {

bool CNames::is_temporary(std::string_view name) const {
  if (name.size() < 2 || name[0] != 't' || name[1] < '1' || name[1] > '9') return false;
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + 1, end, number);
  return error == std::errc{} && stop == end && number <= temporaries_;
}

std::string CNames::unique(const std::string& base) {
  std::string name = base;
  if (is_temporary(name) || !taken_.insert(name).second) {
    int& number = numbers_.try_emplace(base, 2).first->second;
    do {
      const fmt::format_int digits(number++);
      name = base;
      (name += '_').append(digits.data(), digits.size());
    } while (is_temporary(name) || !taken_.insert(name).second);
  }
  others_like_them_ = others_like_them_ || (name.size() > 1 && name[0] == 't' && name[1] <= '9');
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
