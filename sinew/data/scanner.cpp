#include "sinew/data/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sinew/data/accessor.h"

namespace sinew::data {
namespace {

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

Scanner::Scanner(std::string_view text, Place place, const ScannerOptions& options)
    : place_(std::move(place)) {
  std::size_t line = std::max<std::size_t>(place_.line, 1);
  std::size_t i = 0;
  const auto skip_to_line_end = [&] {
    while (i < text.size() && text[i] != '\n') ++i;
  };
  const auto rest = [&] { return text.substr(i); };
  while (i < text.size()) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
      continue;
    }
    if ((options.slash_comments && rest().starts_with("//")) ||
        (options.hash_comments && c == '#')) {
      skip_to_line_end();
      continue;
    }
    if (options.slash_comments && rest().starts_with("/*")) {
      std::size_t end = text.find("*/", i + 2);
      if (end == std::string_view::npos) end = text.size();
      for (; i < std::min(end + 2, text.size()); ++i) line += text[i] == '\n';
      continue;
    }
    if (options.dash_comments && rest().starts_with("--")) {
      i += 2;
      while (i < text.size() && text[i] != '\n' && !rest().starts_with("--")) ++i;
      if (rest().starts_with("--")) i += 2;
      continue;
    }
    Word word;
    word.kind = Word::Kind::kMark;
    word.text.push_back(c);
    word.line = line;
    if (starts_name(c)) {
      std::size_t end = i;
      while (end < text.size() &&
             (in_name(text[end]) || (options.hyphens_in_names && text[end] == '-' &&
                                     end + 1 < text.size() && in_name(text[end + 1])))) {
        ++end;
      }
      word.kind = Word::Kind::kName;
      word.text = text.substr(i, end - i);
    } else if (std::isdigit(static_cast<unsigned char>(c))) {
      std::size_t end = i;
      while (end < text.size() && in_name(text[end])) ++end;
      word.kind = Word::Kind::kNumber;
      word.text = text.substr(i, end - i);
    } else if (c == '"') {
      const std::size_t end = text.find('"', i + 1);
      if (end == std::string_view::npos) {
        place_.line = line;
        fail("a string has no end", "close it with a quotation mark");
      }
      word.kind = Word::Kind::kString;
      word.text = text.substr(i + 1, end - i - 1);
      i += 2;
    } else {
      for (const std::string& mark : options.marks) {
        if (rest().starts_with(mark)) word.text = mark;
      }
    }
    i += word.text.size();
    words_.push_back(std::move(word));
  }
  words_.push_back({Word::Kind::kEnd, {}, line});
}

const Word& Scanner::peek(std::size_t ahead) const {
  return words_[std::min(at_ + ahead, words_.size() - 1)];
}

Word Scanner::next() {
  const Word word = peek();
  if (at_ + 1 < words_.size()) ++at_;
  return word;
}

bool Scanner::take(std::string_view text) {
  if (peek().kind == Word::Kind::kString || at_end() || peek().text != text) return false;
  next();
  return true;
}

void Scanner::expect(std::string_view text) {
  if (take(text)) return;
  fail(at_end() ? fmt::format("the text ends where '{}' should be", text)
                : fmt::format("'{}' where '{}' should be", peek().text, text));
}

std::string Scanner::expect_name(std::string_view what) {
  if (peek().kind == Word::Kind::kName) return next().text;
  fail(at_end() ? fmt::format("the text ends where {} should be", what)
                : fmt::format("'{}' where {} should be", peek().text, what));
}

std::size_t Scanner::expect_number(std::string_view what, std::size_t limit) {
  const auto value = index_of(peek().text);
  if (peek().kind != Word::Kind::kNumber || !value || *value > limit) {
    fail(fmt::format("'{}' is no {}", peek().text, what),
         fmt::format("write a whole number up to {}", limit));
  }
  next();
  return *value;
}

void Scanner::fail(const std::string& what, const std::string& remedy) const {
  throw Error(Problem{place(), {}, what, remedy, Severity::kError, {}});
}

Place Scanner::place() const {
  Place place = place_;
  if (!words_.empty()) place.line = peek().line;
  return place;
}

std::string Scanner::words(std::size_t from, std::size_t to) const {
  std::string text;
  for (std::size_t i = from; i < std::min(to, words_.size()); ++i) {
    const std::string& word = words_[i].text;
    const bool spaced = word.find_first_of("+-*/<>") != std::string::npos && i > from;
    text += spaced ? " " + word + " " : word == "," ? ", " : word;
  }
  return text;
}

}  // namespace sinew::data
