// Where a command's result goes. A file appears only when it is complete: it is written beside its
// place and then renamed, so a fault leaves nothing half-written and the old file untouched.
#pragma once

#include <string>

namespace sinew::cli {

// Writes to `path`, or to standard output when it is empty. Throws Error naming the path.
void write_output(const std::string& path, const std::string& text);

// Reads a whole file (or standard input for "-"). Throws Error naming the path.
std::string read_input(const std::string& path);

}  // namespace sinew::cli
