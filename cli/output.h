// Where a command's result goes. A file appears only when it is complete: it is written beside its
// place and then renamed, so a fault leaves nothing half-written and the old file untouched.
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace sinew::cli {

// A result that is written part by part: standard output gets each part at once, a file is there
// after end().
class Output {
 public:
  explicit Output(const std::string& path);  // empty: standard output
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  void write(const std::string& text);  // throws Error naming the path, as does
  void end();

 private:
  void require(bool good) const;

  std::string path_, part_;  // part_: what becomes path_; empty: nothing is to be renamed
  std::ofstream file_;
  std::ostream* out_;
};

// Writes to `path`, or to standard output when it is empty. Throws Error naming the path.
void write_output(const std::string& path, const std::string& text);

// Reads a whole file (or standard input for "-"). Throws Error naming the path.
std::string read_input(const std::string& path);

}  // namespace sinew::cli
