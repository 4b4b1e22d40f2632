// How many instructions calls of a function take, as callgrind counts them.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace sinew::test {

struct InstructionCounts {
  int calls = 0;
  std::set<std::string> different;  // lines such as "summary: 1234"
};

// What to put before a program: one file of counts for each call of `function`, in this folder.
inline std::string count_calls_of(const std::string& function) {
  return "valgrind --tool=callgrind --toggle-collect=" + function + " --dump-after=" + function +
         " --callgrind-out-file=count ";
}

inline InstructionCounts counted_in(const std::filesystem::path& folder) {
  InstructionCounts counts;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with("count.")) continue;
    std::ifstream file(entry.path());
    for (std::string text; std::getline(file, text);) {
      // The last file is what was collected behind the last call: nothing.
      if (!text.starts_with("summary: ") || text == "summary: 0") continue;
      counts.different.insert(text);
      ++counts.calls;
    }
  }
  return counts;
}

}  // namespace sinew::test
