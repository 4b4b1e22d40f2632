// Errors with a place: every fault in a model, a query or a file is reported as
//   file:line: IRI: what is wrong, and what would be right
// A stage collects Problems in a Report, goes on as far as it safely can, and throws one Error with
// all of them. Design time only: real-time code neither throws nor includes this.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

// A position in a text. Lines and columns count from 1; 0 means unknown.
struct Place {
  std::string file;
  std::size_t line = 0;
  std::size_t column = 0;
};

enum class Severity { kError, kWarning };

struct Problem {
  Place place;
  std::string iri;     // of the node at fault; may be empty
  std::string what;    // what is wrong
  std::string remedy;  // what would be right
  Severity severity = Severity::kError;
  std::string code;  // a standard's name for the error ("loading document failed"), if it has one
};

// "file:line: IRI: what is wrong; what would be right", leaving out the parts that are not known.
std::string to_string(const Problem& problem);

// One or more problems of severity kError, thrown by the stage that cannot go on.
class Error : public std::runtime_error {
 public:
  explicit Error(Problem problem);
  explicit Error(std::vector<Problem> problems);  // precondition: not empty
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

// Collects the problems of one stage. At most `limit` are kept; the number left out is reported.
class Report {
 public:
  explicit Report(std::size_t limit = 100) : limit_(limit) {}

  void error(Place place, std::string iri, std::string what, std::string remedy);
  void warning(Place place, std::string iri, std::string what, std::string remedy);
  void add(Problem problem);

  bool has_errors() const { return errors_ > 0; }
  const std::vector<Problem>& problems() const { return problems_; }
  // Throws Error with every problem of severity kError, if there is one.
  void throw_if_errors() const;

 private:
  std::size_t limit_;
  std::size_t errors_ = 0;
  std::size_t left_out_ = 0;
  std::vector<Problem> problems_;
};

}  // namespace sinew
