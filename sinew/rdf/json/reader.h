// Reads JSON (RFC 8259) strictly: valid UTF-8, no lone surrogates, no duplicate keys, nothing after
// the value. Every fault is an Error with file, line and column.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "sinew/rdf/json/value.h"

namespace sinew::json {

// Beyond these a document is refused, so that a hostile one costs bounded time and memory.
inline constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxDepth = 200;
inline constexpr std::size_t kMaxValues = std::size_t{4} << 20;

struct Document {
  std::string file;  // for messages
  Value root;
  std::unique_ptr<Arena> arena;  // owns everything that `root` refers to, the text included
};

// `file` is the name to report faults with.
Document read(std::string_view text, std::string_view file);

// The same into an arena of the caller's. `text` is referred to and must live as long as the arena.
Value read_into(std::string_view text, std::string_view file, Arena& arena);

// True when the whole text is a number in JSON's notation.
bool is_number(std::string_view text);

}  // namespace sinew::json
