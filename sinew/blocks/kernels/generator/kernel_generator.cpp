// Writes made_kernels.cpp: one C++ function for each formula of the prelude.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>

#include "sinew/blocks/elaborate.h"
#include "sinew/data/kernels.h"

namespace {

using namespace sinew;

// The slots of a side of a formula, as spaces have them; for outputs without those that are
// constant.
std::vector<std::string> slots(const data::DomainDeclaration& domain, const data::FormulaSide& side,
                               const std::string& semantic, bool with_constants) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& meaning, const std::string& name,
                       const std::string& prefix) {
    for (const auto& coordinates : domain.coordinates) {
      const auto& of = coordinates.semantics;
      if (coordinates.name != name || std::find(of.begin(), of.end(), meaning) == of.end())
        continue;
      for (const auto& parameter : coordinates.parameters) {
        if (with_constants || !parameter.constant) names.push_back(prefix + parameter.name);
      }
    }
  };
  if (side.members.empty()) {
    add(semantic, side.coordinates, "");
    return names;
  }
  for (const auto& composite : domain.composites) {
    if (composite.name != semantic) continue;
    for (const std::string& member : composite.members) {
      for (const auto& [given, coordinates] : side.members) {
        if (given == member) add(member, coordinates, member + ".");
      }
    }
  }
  return names;
}

void write(const char* file) {
  blocks::Node empty;
  empty.kind = "file";
  const auto declarations = blocks::elaborate(empty);
  std::string functions, table;
  std::map<std::uint64_t, bool> written;
  for (const auto& domain : declarations.domains) {
    for (const auto& declared : domain.formulas) {
      const auto inputs = slots(domain, declared.from, declared.semantic, true);
      const auto outputs = slots(domain, declared.to, declared.semantic, false);
      const auto formula = data::parse_formula(declared.text, declared.text_place, inputs, outputs);
      const std::uint64_t fingerprint = data::fingerprint(formula);
      if (!written.emplace(fingerprint, true).second) continue;
      functions += fmt::format(
          "void formula_{:016x}(const char* inputs, const std::uint32_t* from, char* outputs,\n"
          "                              const std::uint32_t* to) {{\n{}}}\n\n",
          fingerprint, data::kernel_source(formula));
      table += fmt::format("    {{0x{0:016x}ull, formula_{0:016x}}},\n", fingerprint);
    }
  }
  std::ofstream out(file);
  out << "// Made from metamodels/blocks/geometry.blocks; do not edit.\n"
         "#include <math.h>\n\n#include \"sinew/blocks/kernels/made_kernels.h\"\n\n"
         "namespace sinew::blocks {\nnamespace {\n\n"
         "inline double read(const char* at) {\n  double value;\n  __builtin_memcpy(&value, at, "
         "sizeof value);\n"
         "  return value;\n}\n"
         "inline void write(char* at, double value) { __builtin_memcpy(at, &value, sizeof value); "
         "}\n\n"
      << functions << "constexpr data::KernelEntry kKernels[] = {\n"
      << table
      << "};\n\n}  // namespace\n\n"
         "std::span<const data::KernelEntry> made_kernels() { return kKernels; }\n\n"
         "}  // namespace sinew::blocks\n";
  if (!out.flush()) throw std::runtime_error(std::string(file) + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: kernel_generator FILE\n");
    return 2;
  }
  try {
    write(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
