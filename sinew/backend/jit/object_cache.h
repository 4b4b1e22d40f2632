// Compiled objects on disk, each in a file of its own that says whose it is and whether it is
// whole: what was cut short, altered, or put under another's name is compiled again and not run.
//
// Processes and threads may write and read the same folder at the same time, and may be killed
// while they do. A file that another user (but root) owns or may write is not believed: whoever
// writes it decides what runs here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace sinew::backend {

// Larger files are no objects of ours: a robot of a thousand joints makes a hundredth of it.
inline constexpr std::size_t kLargestCachedFile = std::size_t{256} << 20;

// Empty where the file is not there, not whole, or not to be believed. Waits for nobody.
std::string read_cached(const std::filesystem::path& path);

// Keeping a compiled object is a convenience: where the folder cannot be written, or another is
// writing this very file, nothing is kept, and the next run compiles again. Whoever is killed while
// it writes leaves PATH.part, which the next one to write this file takes over.
void write_cached(const std::filesystem::path& path, const std::string& object);

// What such a file holds: a line with its own name and a checksum, and the object.
std::string sealed(std::string_view file_name, std::string_view object);
// The object in it; empty where the file is not what `sealed` makes for this name.
std::string_view unsealed(std::string_view file_name, std::string_view file);

}  // namespace sinew::backend
