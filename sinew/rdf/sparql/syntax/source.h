// The text of a query or an update, and the places in it that errors point to.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sinew/base/error.h"

namespace sinew::rdf::sparql::syntax {

class Source {
 public:
  // Replaces \uXXXX and \UXXXXXXXX (SPARQL 1.1, section 19.2: before anything else is read) and
  // checks that the text is UTF-8. Throws Error if an escape or a byte is at fault.
  Source(std::string_view text, std::string name);

  const std::string& text() const { return text_; }
  Place place(std::size_t offset) const;
  // The one way to report a fault of the text: the message has name:line:column.
  [[noreturn]] void fail(std::size_t offset, std::string what, std::string remedy) const;

 private:
  std::string text_;
  std::string name_;
};

}  // namespace sinew::rdf::sparql::syntax
