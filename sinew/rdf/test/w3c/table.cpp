// Prints the outcomes of all conformance suites as one table. Fails when a suite that should have
// run left no results, or when a test failed.
//
//   w3c_table SUITES_DIR RESULTS_DIR SUITE...
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Row {
  std::size_t passed = 0, failed = 0;
  std::map<std::string, std::size_t> excluded;  // tests by reason
};

bool read(const fs::path& file, Row& row) {
  std::ifstream in(file);
  if (!in) return false;
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
    if (second == std::string::npos) return false;
    const std::string outcome = line.substr(first + 1, second - first - 1);
    if (outcome == "passed") {
      ++row.passed;
    } else if (outcome == "excluded") {
      ++row.excluded[line.substr(second + 1)];
    } else {
      ++row.failed;
    }
  }
  return row.passed + row.failed > 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: " << argv[0] << " SUITES_DIR RESULTS_DIR SUITE...\n";
    return 2;
  }
  if (!fs::is_directory(argv[1])) {
    std::cout << "skipped: there are no conformance suites in " << argv[1] << "\n";
    return 77;
  }
  bool good = true;
  std::cout << fmt::format("{:<18}{:>8}{:>8}{:>10}  {}\n", "suite", "passed", "failed", "excluded",
                           "because");
  for (int i = 3; i < argc; ++i) {
    Row row;
    if (!read(fs::path(argv[2]) / (std::string(argv[i]) + ".tsv"), row)) {
      std::cout << fmt::format("{:<18}{:>8}{:>8}{:>10}\n", argv[i], "-", "-", "not run");
      good = false;
      continue;
    }
    std::size_t excluded = 0;
    std::string reasons;
    for (const auto& [reason, count] : row.excluded) {
      excluded += count;
      reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", count, reason);
    }
    std::cout << fmt::format("{:<18}{:>8}{:>8}{:>10}  {}\n", argv[i], row.passed, row.failed,
                             excluded, reasons);
    good &= row.failed == 0;
  }
  return good ? 0 : 1;
}
