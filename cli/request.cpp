#include "request.h"

#include <charconv>
#include <cmath>

#include "sinew/base/error.h"

namespace sinew::cli {

std::array<double, 3> parse_vector3(const std::string& text, const std::string& option) {
  std::array<double, 3> values{};
  std::size_t count = 0;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (count < 3) {
    double value = 0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc{} || !std::isfinite(value)) break;
    values[count++] = value;
    at = next;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (count != 3 || at != end) {
    throw Error({{},
                 "",
                 "'" + text + "' is not a vector for " + option,
                 "write three numbers, for example 0,0,-9.81",
                 Severity::kError,
                 {}});
  }
  return values;
}

}  // namespace sinew::cli
