#include "sinew/backend/c_constant_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/backend/c_kept_array.h"

namespace sinew::backend {

void ConstantTable::declare_pointer(CodeBlock& code) {
  code.add({"  const ", scalar_, " *number;"});
  move_pointer(code);
}

void ConstantTable::move_pointer(CodeBlock& code) {
  begin_ = numbers_.size();
  code.add(fmt::format("  number = {}_{} + {};", name_, part_, begin_ + kNearNumbers));
  point_again("number", upper_, code);
}

void ConstantTable::make_room(std::size_t numbers, CodeBlock& code) {
  if (numbers_.size() - begin_ + numbers > kReach) move_pointer(code);
}

int ConstantTable::place(std::span<const std::string> lanes, std::size_t shared) {
  while (numbers_.size() % lanes.size() != 0) numbers_.emplace_back("0");
  const std::size_t end = numbers_.size();
  const std::size_t reached = end - begin_;
  for (std::size_t back = lanes.size(); back <= std::min(shared, reached); back += lanes.size()) {
    const auto there = numbers_.end() - static_cast<std::ptrdiff_t>(back);
    if (std::equal(lanes.begin(), lanes.end(), there)) return from_pointer(end - back);
  }
  numbers_.insert(numbers_.end(), lanes.begin(), lanes.end());
  return from_pointer(end);
}

void ConstantTable::declare_table(unsigned lanes, CodeBlock& parts) {
  // Pointers may not leave the table.
  if (numbers_.size() < begin_ + kNearNumbers) numbers_.resize(begin_ + kNearNumbers, "0");
  std::string list;
  for (const std::string& number : numbers_) list += (list.empty() ? "" : ", ") + number;
  const std::string aligned =
      lanes == 1 ? "" : fmt::format("__attribute__((aligned({} * sizeof({})))) ", lanes, scalar_);
  parts.add("/* Constants of the function below, in the order of their use. */");
  parts.add(
      fmt::format("static const {} {}{}_{}[] = {{ {} }};", scalar_, aligned, name_, part_, list));
}

}  // namespace sinew::backend
