// Runs the sinew executable as a user would.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sinew::test {

struct Result {
  int exit_code = -1;
  std::string out, err;
};

// Runs `sinew` with these arguments; a run that takes longer than `seconds` ends with exit code
// 124.
Result run_sinew(const std::vector<std::string>& arguments, int seconds = 60);

// A folder of its own for each test, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::string string() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

void write_file(const std::filesystem::path& path, const std::string& text);
std::string read_file(const std::filesystem::path& path);

// The columns of a CSV file of numbers, by their names.
using Columns = std::map<std::string, std::vector<double>>;
Columns columns_of(const std::string& csv);

// The model files of the Gen3 that the project ships, in a fixed order.
std::vector<std::filesystem::path> gen3_models();

}  // namespace sinew::test
