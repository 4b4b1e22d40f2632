// Messages with values in them: "{part} weighs {mass} kg".
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace sinew::world {

// The message with each {x} replaced by value(x); nothing when a brace stays open or a name has no
// value.
template <typename Value>
std::optional<std::string> filled_in(const std::string& message, Value&& value) {
  std::string text;
  std::size_t at = 0;
  while (true) {
    const std::size_t open = message.find('{', at);
    text += message.substr(at, open - at);
    if (open == std::string::npos) return text;
    const std::size_t close = message.find('}', open);
    if (close == std::string::npos) return std::nullopt;
    const std::optional<std::string> name = value(message.substr(open + 1, close - open - 1));
    if (!name) return std::nullopt;
    text += *name;
    at = close + 1;
  }
}

}  // namespace sinew::world
