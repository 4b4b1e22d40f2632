// Any text as a type in one of the languages that types are described in. The first byte chooses
// the language, the rest of the first line is what a prototype says (`Fuzz.Pose`,
// `double[3]`), and what follows is the file in which the type is looked for. It is laid out, with
// every number inside the type, or refused with an Error that has a place.
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/data/representation.h"

namespace {

namespace fs = std::filesystem;

// A folder with the one file that a language is read from.
struct Sources {
  Sources()
      : folder(fs::temp_directory_path() / ("fuzz_representation." + std::to_string(getpid()))) {
    fs::create_directories(folder / "fuzz/msg");
  }
  ~Sources() { fs::remove_all(folder); }
  fs::path file(std::string_view language) const {
    if (language == "ROS") return folder / "fuzz/msg/Fuzz.msg";
    if (language == "ASN1") return folder / "fuzz.asn";
    if (language == "SMDSD") return folder / "fuzz.smdsd";
    if (language == "IDL") return folder / "fuzz.idl";
    return folder / "fuzz.h";
  }
  fs::path folder;
};

// Every number of a type lies inside it.
void check_layout(const sinew::data::Type& type) {
  using namespace sinew;
  for (const data::Accessor& path : data::list_accessors(type)) {
    const data::Accessor whole{false, {"value"}};
    const auto access = data::find_access(type, path.steps.empty() ? whole : path, nullptr);
    if (!access) std::abort();
    if (!access->in_memory || access->offsets.size() != 1) continue;
    if (access->offsets[0] + data::size_of(access->scalar) > type.size) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  static const Sources sources;
  static const std::vector<std::string> languages = data::representation_contexts();
  if (size == 0) return 0;
  const std::string& language = languages[data[0] % languages.size()];
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t line = std::min(rest.find('\n'), rest.size());
  const fs::path file = sources.file(language);
  std::ofstream(file, std::ios::binary) << rest.substr(std::min(line + 1, rest.size()));
  try {
    const auto representation = data::read_representation(
        language, rest.substr(0, line), {"fuzz.blocks", 1, 1}, {{sources.folder.string()}});
    check_layout(*representation.type);
  } catch (const Error& error) {
    if (error.problems()[0].place.file.empty()) std::abort();
  }
  fs::remove(file);
  return 0;
}
