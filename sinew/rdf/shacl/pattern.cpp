#include "sinew/rdf/shacl/pattern.h"

#include <regex>
#include <stdexcept>

namespace sinew::rdf::shacl {
namespace {

class StandardPattern : public Pattern {
 public:
  explicit StandardPattern(std::regex expression) : expression_(std::move(expression)) {}
  bool matches(std::string_view text) const override {
    return std::regex_search(text.begin(), text.end(), expression_);
  }

 private:
  std::regex expression_;
};

}  // namespace

std::shared_ptr<const Pattern> make_pattern(std::string_view pattern, std::string_view flags) {
  auto syntax = std::regex::ECMAScript;
  for (const char flag : flags) {
    if (flag == 'i') syntax |= std::regex::icase;
  }
  try {
    return std::make_shared<StandardPattern>(std::regex(pattern.begin(), pattern.end(), syntax));
  } catch (const std::regex_error& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace sinew::rdf::shacl
