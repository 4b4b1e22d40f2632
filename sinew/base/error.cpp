#include "sinew/base/error.h"

#include <fmt/format.h>

namespace sinew {
namespace {

std::string all_lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text;
  if (!problem.place.file.empty()) {
    text += problem.place.file;
    if (problem.place.line > 0) text += fmt::format(":{}", problem.place.line);
    text += ": ";
  }
  if (!problem.iri.empty()) text += problem.iri + ": ";
  if (problem.severity == Severity::kWarning) text += "warning: ";
  text += problem.what;
  if (!problem.remedy.empty()) text += "; " + problem.remedy;
  return text;
}

Error::Error(Problem problem) : Error(std::vector<Problem>{std::move(problem)}) {}

Error::Error(std::vector<Problem> problems)
    : std::runtime_error(all_lines(problems)), problems_(std::move(problems)) {}

void Report::error(Place place, std::string iri, std::string what, std::string remedy) {
  add({std::move(place), std::move(iri), std::move(what), std::move(remedy), Severity::kError, {}});
}

void Report::warning(Place place, std::string iri, std::string what, std::string remedy) {
  const std::string no_code;
  add({std::move(place), std::move(iri), std::move(what), std::move(remedy), Severity::kWarning,
       no_code});
}

void Report::add(Problem problem) {
  if (problem.severity == Severity::kError) ++errors_;
  if (problems_.size() >= limit_) {
    ++left_out_;
    return;
  }
  problems_.push_back(std::move(problem));
}

void Report::throw_if_errors() const {
  if (errors_ == 0) return;
  std::vector<Problem> errors;
  for (const Problem& problem : problems_) {
    if (problem.severity == Severity::kError) errors.push_back(problem);
  }
  if (left_out_ > 0) {
    Problem rest;
    rest.what = fmt::format("and {} more problems", left_out_);
    errors.push_back(std::move(rest));
  }
  throw Error(std::move(errors));
}

}  // namespace sinew
