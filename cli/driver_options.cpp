#include "driver_options.h"

#include <charconv>

#include "sinew/base/error.h"

namespace sinew::cli {
namespace {

using synthesis::DriverList;
using synthesis::Given;
using synthesis::Singular;

[[noreturn]] void fail(const std::string& option, const std::string& text, std::string remedy) {
  throw Error(
      {{}, "", option + " " + text + ": not understood", std::move(remedy), Severity::kError, {}});
}

template <typename Number>
bool read(std::string_view text, Number& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size();
}

// FRAME:DIRECTION,...[@base|@itself]; a number of directions means inputs. An IRI has colons of its
// own: the last one counts.
Given constraint(const std::string& text) {
  Given given{"acceleration-constraint", ""};
  std::string_view rest = text;
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    given.seen_by = rest.substr(at + 1);
    rest = rest.substr(0, at);
    if (given.seen_by != "base" && given.seen_by != "itself")
      fail("--constraint", text, "end it with @base or @itself, or with neither");
  }
  const std::size_t colon = rest.rfind(':');
  given.of = rest.substr(0, colon);
  rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  if (rest.starts_with("//")) {  // an IRI and nothing else
    given.of = text;
    rest = {};
  }
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    if (!read(word, given.direction_inputs)) given.directions.emplace_back(word);
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return given;
}

void singular(const std::string& text, synthesis::DriverPolicy& policy) {
  const std::size_t colon = text.find(':');
  const std::string_view word = std::string_view(text).substr(0, colon);
  policy.singular = word == "in-order"    ? Singular::kInOrder
                    : word == "truncated" ? Singular::kTruncated
                    : word == "damped"    ? Singular::kDamped
                                          : Singular::kUnstated;
  const bool number = colon != std::string::npos &&
                      read(std::string_view(text).substr(colon + 1), policy.singular_number);
  if (policy.singular == Singular::kUnstated || !number)
    fail("--singular", text, "in-order:TOLERANCE, truncated:TOLERANCE or damped:DAMPING");
}

}  // namespace

void apply_driver_options(const QueryOptions& options, synthesis::Query& query) {
  for (const std::string& text : options.constraints) query.given.push_back(constraint(text));
  synthesis::DriverPolicy& policy = query.drivers;
  if (!options.singular.empty()) singular(options.singular, policy);
  const std::string& list = options.drivers;
  if (list == "together") policy.list = DriverList::kTogether;
  if (list == "apart") policy.list = DriverList::kApart;
  if (list == "weighed") policy.list = DriverList::kWeighed;
  if (!list.empty() && list != "together" && list != "apart" && list != "weighed")
    fail("--drivers", list, "together, apart or weighed");
  if (!options.limited.empty()) policy.limited = options.limited;
  // What these options are for is asked with them.
  if (policy.list == DriverList::kApart && list == "apart")
    query.asked.push_back({"driver-acceleration", "", ""});
  if (!options.limited.empty()) query.asked.push_back({"driver-scale", "", ""});
}

}  // namespace sinew::cli
