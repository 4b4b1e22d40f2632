#include "sinew/backend/c_kept_array.h"

#include <fmt/format.h>

#include "sinew/backend/kept_values.h"

namespace sinew::backend {

void declare_kept_array(std::uint32_t size, std::string_view upper, std::string_view scalar,
                        CNames& given, std::vector<std::string>& pointers, CodeBlock& code) {
  given.take("kept_numbers");
  code.add(fmt::format("  {}_ALIGNED {} kept_numbers[{}];", upper, scalar, kept_numbers(size)));
  std::uint32_t middle = kNearNumbers;
  for (const std::string& pointer : kept_pointers(size)) {
    given.take(pointer);
    pointers.push_back(pointer);
    code.add(fmt::format("  {} *{} = kept_numbers + {};", scalar, pointer, middle));
    middle += 2 * kNearNumbers;
    point_again(pointer, upper, code);
  }
}

void point_again(std::string_view pointer, std::string_view upper, CodeBlock& code) {
  code.add({"  ", upper, "_AGAIN(", pointer, ");"});
}

}  // namespace sinew::backend
