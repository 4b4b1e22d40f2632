// Runs the sinew executable as a user would.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace sinew::test {

struct Result {
  int exit_code = -1;
  std::string out, err;
};

// Runs `sinew` with these arguments; a run that takes longer than `seconds` ends with exit code
// 124.
Result run_sinew(const std::vector<std::string>& arguments, int seconds = 60);

using Folder = TemporaryFolder;

void write_file(const std::filesystem::path& path, const std::string& text);
std::string read_file(const std::filesystem::path& path);

// The columns of a CSV file of numbers, by their names.
using Columns = std::map<std::string, std::vector<double>>;
Columns columns_of(const std::string& csv);

// The model files of the Gen3 that the project ships, in a fixed order.
std::vector<std::filesystem::path> gen3_models();

}  // namespace sinew::test
