// The parts from which the C target puts its files together; internal to `backend`.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/backend/c_target.h"
#include "sinew/backend/render.h"
#include "sinew/program/dag/dag.h"
#include "sinew/program/interface.h"
#include "sinew/program/limbs/limb_program.h"
#include "sinew/program/program.h"
#include "sinew/program/scalar_program.h"

namespace sinew::backend {

// Lines of a text that exist because of a closure.
struct LineOrigin {
  std::size_t line = 0;  // counted from 1
  std::uint32_t closure = program::kNoOrigin;
};

// Lines of code with the closure that each comes from.
struct CodeBlock {
  std::string text;  // every line ends with a newline
  std::vector<LineOrigin> origins;
  std::size_t lines = 0;

  void add(std::string_view line, std::uint32_t closure = program::kNoOrigin) {
    add({line}, closure);
  }
  // For so many lines to come, which need not be all.
  void reserve(std::size_t count, std::size_t bytes_of_a_line) {
    text.reserve(count * bytes_of_a_line);
    origins.reserve(count);
  }
  // Ends a line that was appended to the text.
  void end_line(std::uint32_t closure) {
    text += '\n';
    ++lines;
    if (closure != program::kNoOrigin) origins.push_back({lines, closure});
  }
  // A line of several pieces.
  void add(std::initializer_list<std::string_view> pieces,
           std::uint32_t closure = program::kNoOrigin);
};

// The digits of a number, as a piece of a line.
class Digits {
 public:
  explicit Digits(std::int64_t number)
      : end_(std::to_chars(text_.data(), text_.data() + text_.size(), number).ptr) {}
  operator std::string_view() const {  // NOLINT: it is one
    return {text_.data(), static_cast<std::size_t>(end_ - text_.data())};
  }

 private:
  std::array<char, 24> text_;  // more than those of any integer
  const char* end_;
};

struct RenderedSource {
  std::string text;
  std::vector<LineOrigin> origins;  // of the whole text
};

// Renders a template with each block in the place of its {{{name}}}, which stands alone on its
// line.
RenderedSource render_with_blocks(
    std::string_view path, Fields fields,
    const std::vector<std::pair<std::string, const CodeBlock*>>& blocks);

// The name, sizes and banner.
Fields common_fields(const program::ScalarProgram& scalar, const program::Interface& interface,
                     const COptions& options, const GeneratedCode& counts);

// A distinct C identifier for each variable of the program.
std::vector<std::string> variable_identifiers(const program::Program& program);

// `limbs`: null where they are computed one by one.
RenderedSource flat_source(const program::ScalarProgram& scalar,
                           const program::Interface& interface,
                           const std::vector<std::string>& identifiers, const Fields& common,
                           const COptions& options, const program::LimbProgram* limbs);
RenderedSource readable_source(const program::Program& program, const program::Interface& interface,
                               const std::vector<std::string>& identifiers, const Fields& common);

// NAME.json: names, units, frames and offsets; operations; which line of NAME.c comes from which
// closure, step and model element (docs/generated-code.md).
std::string sidecar(const program::ScalarProgram& scalar, const program::Interface& interface,
                    const COptions& options, const GeneratedCode& counts,
                    const std::vector<LineOrigin>& origins);

}  // namespace sinew::backend
