// Compiled objects on disk, each in a file of its own that says whose it is and whether it is
// whole: what was cut short, altered, or put under another's name is compiled again and not run.
#pragma once

#include <filesystem>
#include <string>

namespace sinew::backend {

// Empty where the file is not there or not whole.
std::string read_cached(const std::filesystem::path& path);

// Keeping a compiled object is a convenience: where the folder cannot be written, the next run
// compiles again. Processes and threads may write and read the same file at the same time.
void write_cached(const std::filesystem::path& path, const std::string& object);

}  // namespace sinew::backend
