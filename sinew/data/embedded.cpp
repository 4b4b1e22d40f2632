#include "sinew/data/embedded.h"

#include <span>
#include <string>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::data {

// Generated at build time.
std::span<const std::pair<std::string_view, std::string_view>> embedded_files();

std::string_view embedded_file(std::string_view path) {
  for (const auto& [name, text] : embedded_files()) {
    if (name == path) return text;
  }
  throw Error(Problem{{std::string(path), 0, 0},
                      {},
                      "no such file within the library",
                      "see sinew/data/CMakeLists.txt",
                      Severity::kError,
                      {}});
}

}  // namespace sinew::data
