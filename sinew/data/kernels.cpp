#include "sinew/data/kernels.h"

#include <fmt/format.h>

#include <bit>

namespace sinew::data {

std::uint64_t fingerprint(const Formula& formula) {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  const auto mix = [&](std::uint64_t value) {
    for (int i = 0; i < 8; ++i) {
      hash = (hash ^ (value & 0xff)) * 0x100000001b3ull;
      value >>= 8;
    }
  };
  for (const ScalarNode& node : formula.graph.nodes()) {
    mix(std::uint64_t(node.operation));
    mix(node.a);
    mix(node.b);
    mix(node.c);
    mix(std::bit_cast<std::uint64_t>(node.value));
  }
  for (const auto output : formula.outputs) mix(output);
  return hash;
}

std::string kernel_source(const Formula& formula) {
  std::string text;
  const auto& nodes = formula.graph.nodes();
  const std::vector<bool> live = formula.graph.live(formula.outputs);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!live[i]) continue;
    const ScalarNode& node = nodes[i];
    std::string value;
    if (node.operation == ScalarOperation::kInput) {
      value = fmt::format("read(inputs + from[{}])", node.a);
    } else if (node.operation == ScalarOperation::kConstant) {
      value = fmt::format("{:.17g}", node.value);
    } else {
      const std::string_view form = row(node.operation).c_form;
      for (std::size_t k = 0; k < form.size(); ++k) {
        if (form[k] != '$') {
          value += form[k];
          continue;
        }
        const char which = form[++k];
        value += fmt::format("v{}", which == 'a' ? node.a : which == 'b' ? node.b : node.c);
      }
    }
    text += fmt::format("  const double v{} = {};\n", i, value);
  }
  for (std::size_t i = 0; i < formula.outputs.size(); ++i) {
    text += fmt::format("  write(outputs + to[{}], v{});\n", i, formula.outputs[i]);
  }
  return text;
}

}  // namespace sinew::data
