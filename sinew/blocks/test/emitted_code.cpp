#include "emitted_code.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <array>
#include <cstdio>
#include <fstream>

#include "sinew/blocks/elaborate.h"
#include "sinew/data/emit.h"
#include "sinew/data/plan.h"

namespace sinew::blocks {
namespace {

// What the command prints, and whether it succeeded.
std::pair<std::string, bool> run(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), count);
  return {output, pclose(pipe) == 0};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "sinew-emitted-XXXXXX").string();
  path = mkdtemp(name.data());
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

std::string compile_and_run(const Emitted& emitted) {
  const TemporaryFolder folder;
  const auto library =
      load_library(std::string(SINEW_SOURCE_DIR "/examples/conversions/") + emitted.file);
  const auto language = emitted.c ? data::SourceLanguage::kC : data::SourceLanguage::kCpp;
  const std::string suffix = emitted.c ? ".c" : ".cpp";
  std::ofstream main(folder.path / ("main" + suffix));
  for (const auto& [source, target] : emitted.conversions) {
    data::PlanOptions options;
    options.allow_lossy = emitted.allow_lossy;
    const std::string header = source + "_to_" + target + ".h";
    std::ofstream(folder.path / header) << data::emit(
        library, data::find_plan(library, source, target, options), {language, {}, emitted.file});
    main << fmt::format("#include \"{}\"\n", header);
  }
  main << "#include <math.h>\n#include <stdio.h>\n"
          "static int failures;\n"
          "#define CHECK(c) do { if (!(c)) { printf(\"%d: %s\\n\", __LINE__, #c); ++failures; } } "
          "while (0)\n"
          "#define NEAR(a, b) CHECK(fabs((a) - (b)) < 1e-12)\n"
       << emitted.declarations << "\nint main(void) {\n"
       << emitted.main << "\n  if (failures == 0) printf(\"ok\");\n  return 0;\n}\n";
  main.close();
  std::string includes = "-I/usr/include/eigen3";
  for (const std::string& include : emitted.include_folders) includes += " -isystem " + include;
  const std::string compiler = emitted.c ? "cc -std=c11" : SINEW_CXX_COMPILER " -std=c++17";
  const auto [messages, compiled] =
      run(fmt::format("cd {0} && {1} -Wall -Wextra -Werror -O1 {2} main{3} -o main -lm",
                      folder.path.string(), compiler, includes, suffix));
  if (!compiled) return messages;
  return messages + run((folder.path / "main").string()).first;
}

std::string compile_library(const std::filesystem::path& folder, const std::string& source,
                            const std::string& library) {
  return run(fmt::format("cd {} && {} -std=c++17 -O1 -shared -fPIC {} -o {}", folder.string(),
                         SINEW_CXX_COMPILER, source, library))
      .first;
}

bool run_asn1c(const std::filesystem::path& module, const std::filesystem::path& folder) {
  if (!run("which asn1c").second) return false;
  return run(fmt::format("cd {} && asn1c -fcompound-names {}", folder.string(), module.string()))
      .second;
}

}  // namespace sinew::blocks
