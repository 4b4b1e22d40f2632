#include "request.h"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "sinew/base/error.h"
#include "sinew/synthesis/asked.h"

namespace sinew::cli {
namespace {

// The words of a phrase by what stands before them; the quantity by "".
std::map<std::string, std::string> phrase(const std::string& text, const std::string& option,
                                          const std::string& form) {
  const auto refuse = [&](const std::string& what) {
    throw Error({{},
                 "",
                 "'" + text + "' for " + option + ": " + what,
                 "write " + form,
                 Severity::kError,
                 {}});
  };
  std::map<std::string, std::string> parts;
  std::istringstream words(text);
  std::string word, value;
  if (!(words >> value)) refuse("it is empty");
  parts[""] = value;
  while (words >> word) {
    if (form.find("[" + word + " ") == std::string::npos) refuse("what is '" + word + "'?");
    if (!(words >> value)) refuse("nothing stands after '" + word + "'");
    if (!parts.emplace(word, value).second) refuse("'" + word + "' stands there twice");
  }
  return parts;
}

}  // namespace

synthesis::Asked parse_asked(const std::string& text) {
  auto parts = phrase(text, "--ask", "QUANTITY [of ELEMENT] [wrt FRAME] [seen-by FRAME]");
  return {parts[""], parts["of"], parts["seen-by"], parts["wrt"]};
}

synthesis::Given parse_given(const std::string& text) {
  auto parts = phrase(text, "--give", "QUANTITY [of ELEMENT] [seen-by FRAME]");
  const synthesis::GivenQuantity* row = synthesis::find_given(parts[""]);
  if (row != nullptr && row->element == synthesis::Element::kJoint && parts["of"].empty())
    parts["of"] = synthesis::kEveryJoint;
  return {parts[""], parts["of"], parts["seen-by"]};
}

std::vector<double> parse_numbers(const std::string& text, const std::string& option) {
  std::vector<double> result;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (;;) {
    double value = 0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc{} || !std::isfinite(value) || (next != end && *next != ','))
      throw Error({{},
                   "",
                   "'" + text + "' is no list of numbers for " + option,
                   "write them as 0.1,0.2",
                   Severity::kError,
                   {}});
    result.push_back(value);
    if (next == end) return result;
    at = next + 1;
  }
}

synthesis::Held parse_held(const std::string& text) {
  auto parts = phrase(text, "--hold", "QUANTITY [of ELEMENT]");
  return {parts[""], parts["of"]};
}

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
