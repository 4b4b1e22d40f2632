#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sinew/base/error.h"

namespace sinew::rdf::w3c {
namespace {

std::string on_one_line(std::string text) {
  for (std::size_t at = 0; (at = text.find_first_of("\t\n\r", at)) != std::string::npos;) {
    text.replace(at, 1, text[at] == '\t' ? " " : " | ");
  }
  return text;
}

// Lines of suite, test, reason; '#' begins a comment.
std::map<std::string, std::string> exclusions_of(const std::string& suite) {
  std::map<std::string, std::string> exclusions;
  std::istringstream lines(read_file(SINEW_W3C_EXCLUSIONS));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
    if (second == std::string::npos || second + 1 == line.size()) {
      throw std::runtime_error("exclusions.tsv: a line is not suite, test and reason: " + line);
    }
    if (line.substr(0, first) != suite) continue;
    exclusions[line.substr(first + 1, second - first - 1)] = line.substr(second + 1);
  }
  return exclusions;
}

}  // namespace

SuiteReport::SuiteReport(std::string suite, std::map<std::string, std::string> exclusions)
    : suite_(std::move(suite)), exclusions_(std::move(exclusions)) {}

std::size_t SuiteReport::count(Outcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count(entries_, outcome, &Entry::outcome));
}

void SuiteReport::add(const std::string& name, Outcome outcome, std::string reason) {
  if (outcome == Outcome::kFailed) {
    std::cout << "FAILED " << suite_ << "/" << name << ": " << reason << "\n";
  }
  if (std::ranges::find(entries_, name, &Entry::name) != entries_.end()) {
    entries_.push_back({name, Outcome::kFailed, "there are two tests of this name"});
  } else {
    entries_.push_back({name, outcome, on_one_line(std::move(reason))});
  }
}

void SuiteReport::test(const std::string& name, const std::function<std::string()>& body) {
  if (!only_.empty()) {
    if (name.find(only_) == std::string::npos) return;
    std::cout << "running " << suite_ << "/" << name << '\n' << std::flush;
  }
  if (const auto exclusion = exclusions_.find(name); exclusion != exclusions_.end()) {
    return add(name, Outcome::kExcluded, exclusion->second);
  }
  std::string why;
  try {
    why = body();
  } catch (const std::exception& error) {
    why = error.what();
    if (why.empty()) why = "an exception without a message";
  }
  add(name, why.empty() ? Outcome::kPassed : Outcome::kFailed, why);
}

void SuiteReport::fail(const std::string& name, std::string why) {
  add(name, Outcome::kFailed, std::move(why));
}

void SuiteReport::finish(const std::filesystem::path& file) {
  for (const auto& [name, reason] : exclusions_) {
    if (std::ranges::find(entries_, name, &Entry::name) == entries_.end()) {
      add(name, Outcome::kFailed, "exclusions.tsv names a test that does not exist");
    }
  }
  std::ofstream out(file);
  for (const Entry& entry : entries_) {
    constexpr const char* kNames[] = {"passed", "failed", "excluded"};
    out << entry.name << '\t' << kNames[static_cast<int>(entry.outcome)] << '\t' << entry.reason
        << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

int run(int argc, char** argv, const std::vector<Suite>& suites) {
  namespace fs = std::filesystem;
  if (argc < 3 || argc > 4) {
    std::cerr << "usage: " << argv[0] << " SUITES_DIR RESULTS_DIR [PART_OF_NAME]\n";
    return 2;
  }
  const fs::path folder(argv[1]), results(argv[2]);
  const std::string part = argc > 3 ? argv[3] : "";
  bool failed = false;
  for (const Suite& suite : suites) {
    if (!fs::is_directory(folder / suite.name)) {
      std::cout << "skipped: the suite " << suite.name << " is not in " << folder.string()
                << "; the conformance suites are not part of this project\n";
      return kSkipped;
    }
    const fs::path file = results / (suite.name + ".tsv");
    fs::create_directories(results);
    if (part.empty()) fs::remove(file);
    SuiteReport report(suite.name, exclusions_of(suite.name));
    if (!part.empty()) report.only(part);
    suite.run(folder / suite.name, report);
    if (part.empty()) report.finish(file);
    std::cout << fmt::format("{}: {} passed, {} failed, {} excluded\n", suite.name, report.passed(),
                             report.failed(), report.excluded());
    failed |= report.failed() > 0 || (part.empty() && report.passed() == 0);
  }
  return failed ? 1 : 0;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) {
    throw Error(Problem{{path.string(), 0, 0}, "", "cannot be read", "", Severity::kError, {}});
  }
  return text;
}

}  // namespace sinew::rdf::w3c
