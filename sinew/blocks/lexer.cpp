#include "sinew/blocks/lexer.h"

#include <fmt/format.h>

#include <cctype>

#include "sinew/blocks/syntax.h"

namespace sinew::blocks {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_alpha(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_alnum(char c) { return is_alpha(c) || is_digit(c); }

constexpr std::string_view kMarks[] = {"<->", "<=>", "::", "->", "=>", "<=", "...", "{",
                                       "}",   "(",   ")",  "[",  "]",  "<",  ">",   "=",
                                       ",",   ";",   ".",  ":",  "|",  "?",  "-"};

}  // namespace

Lexer::Lexer(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  if (text.size() > kMaximumFileSize) {
    fail({file_, 0, 0}, fmt::format("the file has {} bytes", text.size()),
         fmt::format("at most {} are read: split it and import the parts", kMaximumFileSize));
  }
  scan();
}

void Lexer::fail(const Place& place, std::string what, std::string remedy) const {
  throw Error(Problem{place, {}, std::move(what), std::move(remedy), Severity::kError, {}});
}

void Lexer::skip_spaces() {
  std::size_t newlines = 0;  // since the last word or comment
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n') {
      if (++newlines == 2 && (comments_.empty() || !comments_.back().empty()))
        comments_.emplace_back();
      ++line_;
      line_begin_ = at_ + 1;
      fresh_line_ = true;
      ++at_;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      ++at_;
    } else if (text_.substr(at_).starts_with("//") || text_.substr(at_).starts_with("/*")) {
      const bool block = text_[at_ + 1] == '*';
      const std::size_t begin = at_, begin_line = line_;
      std::size_t end = text_.find(block ? "*/" : "\n", at_ + 2);
      if (block && end == std::string_view::npos) {
        fail({file_, line_, at_ - line_begin_ + 1}, "a comment has no end", "close it with */");
      }
      end = end == std::string_view::npos ? text_.size() : end + (block ? 2 : 0);
      for (; at_ < end; ++at_) {
        if (text_[at_] != '\n') continue;
        ++line_;
        line_begin_ = at_ + 1;
      }
      std::string comment(text_.substr(begin, end - begin));
      while (!comment.empty() && (comment.back() == '\r' || comment.back() == ' '))
        comment.pop_back();
      // A remark is the one comment behind a word on its line with nothing after it.
      const std::size_t line_end = text_.find_first_not_of(" \t\r", at_);
      const bool ends_line = line_end == std::string_view::npos || text_[line_end] == '\n';
      if (begin_line == last_line_ && remark_.empty() && comments_.empty() && ends_line &&
          begin_line == line_) {
        remark_ = std::move(comment);
      } else {
        comments_.push_back(std::move(comment));
      }
      newlines = 0;
    } else {
      return;
    }
  }
}

void Lexer::scan() {
  skip_spaces();
  token_ = {};
  token_.offset = at_;
  token_.line = line_;
  token_.column = at_ - line_begin_ + 1;
  token_.first_on_line = fresh_line_;
  fresh_line_ = false;
  if (at_ >= text_.size()) return;
  const char c = text_[at_];
  std::size_t end = at_;
  if (is_alpha(c)) {
    token_.kind = Token::Kind::kName;
    while (end < text_.size() &&
           (is_alnum(text_[end]) ||
            (text_[end] == '-' && end + 1 < text_.size() && is_alnum(text_[end + 1])))) {
      ++end;
    }
  } else if (is_digit(c)) {
    token_.kind = Token::Kind::kInteger;
    while (end < text_.size() && is_digit(text_[end])) ++end;
  } else if (c == '"') {
    token_.kind = Token::Kind::kString;
    end = text_.find_first_of("\"\n", at_ + 1);
    if (end == std::string_view::npos || text_[end] == '\n') {
      fail(place(), "a string has no end", "close it with a quotation mark on the same line");
    }
    token_.text = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return;
  } else {
    token_.kind = Token::Kind::kMark;
    for (const std::string_view mark : kMarks) {
      if (text_.substr(at_).starts_with(mark)) {
        end = at_ + mark.size();
        break;
      }
    }
    if (end == at_) {
      const bool printable = std::isprint(static_cast<unsigned char>(c));
      fail(place(),
           printable ? fmt::format("'{}' does not belong to the language", c)
                     : fmt::format("byte {:#04x} does not belong to the language",
                                   static_cast<unsigned char>(c)),
           "names are made of letters, digits, '_' and '-'");
    }
  }
  token_.text = text_.substr(at_, end - at_);
  at_ = end;
}

Token Lexer::next() {
  Token token = token_;
  if (token.kind != Token::Kind::kEnd) {
    last_line_ = line_;
    remark_.clear();
    scan();
  }
  return token;
}

std::string Lexer::raw_block() {
  const Place begin = place();
  at_ = token_.offset + 1;
  std::size_t depth = 1;
  const std::size_t first = at_;
  bool quoted = false;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
      line_begin_ = at_ + 1;
      quoted = false;
    }
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '{' && ++depth > kMaximumNesting) {
      fail(begin, fmt::format("braces are nested more than {} deep", kMaximumNesting));
    }
    if (c == '}' && --depth == 0) break;
  }
  if (depth > 0) fail(begin, "a brace has no end", "close it with '}'");
  std::string text(text_.substr(first, at_ - first));
  ++at_;
  last_line_ = line_;
  remark_.clear();
  scan();
  return text;
}

std::string Lexer::number() {
  const Place begin = place();
  std::size_t end = token_.offset;
  const auto digits = [&] {
    const std::size_t before = end;
    while (end < text_.size() && is_digit(text_[end])) ++end;
    return end > before;
  };
  if (end < text_.size() && text_[end] == '-') ++end;
  bool valid = digits();
  if (valid && end + 1 < text_.size() && text_[end] == '.' && is_digit(text_[end + 1])) {
    ++end;
    digits();
  }
  if (valid && end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
    ++end;
    if (end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
    valid = digits();
  }
  if (!valid || (end < text_.size() && is_alpha(text_[end]))) {
    fail(begin, fmt::format("'{}' where a number should be", token_.text),
         "write it like 1, -0.5 or 1e-3");
  }
  std::string text(text_.substr(token_.offset, end - token_.offset));
  at_ = end;
  last_line_ = line_;
  remark_.clear();
  scan();
  return text;
}

std::vector<std::string> Lexer::take_comments() { return std::move(comments_); }

std::string Lexer::take_remark() {
  std::string remark = std::move(remark_);
  remark_.clear();
  return remark;
}

}  // namespace sinew::blocks
