#include "command.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sinew::test {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Result run_sinew(const std::vector<std::string>& arguments, int seconds) {
  const Folder folder;
  std::string line = "timeout " + std::to_string(seconds) + " " + quoted(SINEW_EXECUTABLE);
  for (const std::string& argument : arguments) line += " " + quoted(argument);
  line += " >" + quoted((folder / "out").string()) + " 2>" + quoted((folder / "err").string()) +
          " </dev/null";
  const int status = std::system(line.c_str());
  Result result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = read_file(folder / "out");
  result.err = read_file(folder / "err");
  return result;
}

std::vector<std::filesystem::path> gen3_models() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SINEW_SOURCE_DIR "/robots/gen3")) {
    if (entry.path().extension() == ".jsonld") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Columns columns_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, word;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, word, ',');) names.push_back(word);
  Columns columns;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      std::getline(row, word, ',');
      columns[name].push_back(std::stod(word));
    }
  }
  return columns;
}

}  // namespace sinew::test
