// The outcome of a conformance suite: every test passed, failed, or excluded for a reason that is
// written down in exclusions.tsv. The outcomes go to <results>/<suite>.tsv, from which w3c_table
// makes one table of all suites.
//
// A runner is an executable `RUNNER SUITES_DIR RESULTS_DIR`; its main function is
//
//   int main(int argc, char** argv) {
//     return w3c::run(argc, argv, {{"turtle", run_turtle_suite}, ...});
//   }
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::rdf::w3c {

class SuiteReport {
 public:
  SuiteReport(std::string suite, std::map<std::string, std::string> exclusions);

  // Runs a test unless it is excluded. The test returns why it failed, or nothing when it passed;
  // an exception is a failure too. Names must be unique within a suite.
  void test(const std::string& name, const std::function<std::string()>& body);
  // From now on, only tests whose name contains `part` run, and each is announced.
  void only(std::string part) { only_ = std::move(part); }
  // For what cannot even be started, such as an entry of an unknown kind.
  void fail(const std::string& name, std::string why);

  std::size_t passed() const { return count(Outcome::kPassed); }
  std::size_t failed() const { return count(Outcome::kFailed); }
  std::size_t excluded() const { return count(Outcome::kExcluded); }

  // One line a test: name, outcome, reason. Exclusions that match no test are failures.
  void finish(const std::filesystem::path& file);

 private:
  enum class Outcome { kPassed, kFailed, kExcluded };
  struct Entry {
    std::string name;
    Outcome outcome;
    std::string reason;
  };
  std::size_t count(Outcome outcome) const;
  void add(const std::string& name, Outcome outcome, std::string reason);

  std::string suite_;
  std::string only_;
  std::map<std::string, std::string> exclusions_;
  std::vector<Entry> entries_;
};

struct Suite {
  std::string name;  // the folder below SUITES_DIR
  std::function<void(const std::filesystem::path& folder, SuiteReport& report)> run;
};

// What ctest takes for "skipped".
inline constexpr int kSkipped = 77;

// 0 when everything that is not excluded passed, 1 when something failed, kSkipped when the suites
// are not on this machine, 2 on bad usage. With a third argument, only the tests whose name
// contains it run, each outcome is printed, and no results are written.
int run(int argc, char** argv, const std::vector<Suite>& suites);

// The whole of a file. Throws Error when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace sinew::rdf::w3c
