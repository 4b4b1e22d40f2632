// Compiles emitted conversions together with a few lines that use them, and runs the result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::blocks {

// A folder of its own that goes away with it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::filesystem::path path;
};

struct Emitted {
  std::string file;  // the .blocks file, below examples/conversions
  std::vector<std::pair<std::string, std::string>> conversions;  // source and target
  bool c = false;
  std::string main = {};  // the body of main(); CHECK(condition), NEAR(a, b)
  std::vector<std::string> include_folders = {};  // besides the system's
  std::string declarations = {};                  // before main: what functions are made of
  bool allow_lossy = false;
};

// Everything that was printed; "ok" when all checks held.
std::string compile_and_run(const Emitted& emitted);

// Compiles a source file of the folder to a library there; gives what the compiler says.
std::string compile_library(const std::filesystem::path& folder, const std::string& source,
                            const std::string& library);

// Runs asn1c on a module; the folder then holds its headers. False where asn1c is not installed.
bool run_asn1c(const std::filesystem::path& module, const std::filesystem::path& folder);

}  // namespace sinew::blocks
