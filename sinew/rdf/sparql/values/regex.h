// Regular expressions as XPath and XQuery functions 3.1 define them (section 5.6, and XML
// Schema 1.1, part 2, appendix G): for REGEX, REPLACE and sh:pattern.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf::sparql::values {

class Regex {
 public:
  // Flags: s m i x q. Null when the pattern or the flags are not allowed; `why` then says so.
  static std::shared_ptr<const Regex> compile(std::string_view pattern, std::string_view flags,
                                              std::string* why = nullptr);
  ~Regex();

  // Whether the text has a match, anywhere in it. Throws Error when the search takes more than
  // kMostSteps steps.
  bool search(std::string_view text) const;
  // Every match replaced. $1 to $9… stand for groups, $0 for all of the match, \$ and \\ for
  // themselves. Nothing when the pattern matches the empty text, or the replacement is not allowed.
  std::optional<std::string> replace(std::string_view text, std::string_view replacement) const;

  static constexpr unsigned kMostSteps = 10'000'000;
  static constexpr std::size_t kMostPatternBytes = 10'000;

 private:
  struct Data;
  explicit Regex(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace sinew::rdf::sparql::values
