// Words and marks of the small languages in which types are described (C, IDL, ASN.1, ROS messages,
// SmartSoft), for readers by recursive descent. Faults are thrown as Error with file and line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::data {

struct Word {
  enum class Kind : std::uint8_t { kName, kNumber, kString, kMark, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  // a string without its quotes
  std::size_t line = 0;
};

struct ScannerOptions {
  bool slash_comments = true;           // "//" to the end of the line and "/* */"
  bool hash_comments = false;           // "#" to the end of the line
  bool dash_comments = false;           // "--" to the next "--" or the end of the line (ASN.1)
  bool hyphens_in_names = false;        // "Wrappers-Vector3d" is one name
  std::vector<std::string> marks = {};  // marks of several characters: "::=", "->"
};

class Scanner {
 public:
  // `place` is where the text begins. Throws Error for a character that no word begins with.
  Scanner(std::string_view text, Place place, const ScannerOptions& options = {});

  const Word& peek(std::size_t ahead = 0) const;
  Word next();
  bool take(std::string_view text);  // the next word if it is this one
  bool at_end() const { return peek().kind == Word::Kind::kEnd; }
  // The next word, which must be this text, or a name, or a whole number; Error otherwise.
  void expect(std::string_view text);
  std::string expect_name(std::string_view what);
  std::size_t expect_number(std::string_view what, std::size_t limit);
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = {}) const;
  Place place() const;
  // How many words were taken, and the words of a stretch, for messages.
  std::size_t position() const { return at_; }
  std::string words(std::size_t from, std::size_t to) const;

 private:
  Place place_;
  std::vector<Word> words_;
  std::size_t at_ = 0;
};

}  // namespace sinew::data
