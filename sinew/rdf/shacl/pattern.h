// The regular expressions of sh:pattern: those of SPARQL's REGEX.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace sinew::rdf::shacl {

class Pattern {
 public:
  virtual ~Pattern() = default;
  virtual bool matches(std::string_view text) const = 0;
};

// Flags are those of SPARQL: i s m x q. Throws std::invalid_argument saying what is wrong.
std::shared_ptr<const Pattern> make_pattern(std::string_view pattern, std::string_view flags);

}  // namespace sinew::rdf::shacl
