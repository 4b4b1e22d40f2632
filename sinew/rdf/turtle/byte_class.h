// Sets of bytes as tables, for the loops that look at every byte of a text.
#pragma once

#include <array>

namespace sinew::rdf {

using ByteClass = std::array<bool, 256>;

template <typename Predicate>
constexpr ByteClass bytes_where(Predicate predicate) {
  ByteClass table{};
  for (int i = 0; i < 256; ++i) table[i] = predicate(static_cast<unsigned char>(i));
  return table;
}

constexpr bool in(const ByteClass& table, char c) { return table[static_cast<unsigned char>(c)]; }

}  // namespace sinew::rdf
