// Result sets from CSV: the fields and records of RFC 4180; ends of lines may be "\n", too.
#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/blank_scope.h"

namespace sinew::rdf {
namespace {

using graph::Id;

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view file, graph::Terms& terms)
      : text_(text), file_(file), terms_(terms), blanks_(terms) {}

  ResultSet read() {
    if (const std::size_t bad = first_invalid_utf8(text_); bad != std::string_view::npos) {
      while (offset_ < bad) skip();
      fail_at(place(), "a byte is not UTF-8", "save the text as UTF-8");
    }
    if (at_end()) fail_at(place(), "there are no results", "begin with a line of variables");
    if (!at_record_end()) {
      do {
        const Place start = place();
        builder_.add_column(field(), start);
      } while (accept(','));
    }
    end_record();
    while (!at_end()) record();
    return builder_.finish(place(), true);
  }

 private:
  void record() {
    const std::size_t columns = builder_.column_count();
    builder_.add_row(place());
    for (std::size_t i = 0; i < columns; ++i) {
      if (i > 0 && !accept(',')) {
        fail_at(place(), fmt::format("a row has {} values for {} variables", i, columns),
                "give a value for each variable, an empty one where there is none");
      }
      const Place start = place();
      const std::string_view value = field();
      if (!value.empty()) builder_.bind(i, term(value), start);
    }
    end_record();
  }

  Id term(std::string_view value) {
    const bool blank = value.starts_with("_:") && is_blank_label(value.substr(2));
    return blank ? blanks_.node(value.substr(2)) : terms_.literal(value);
  }

  // Valid until the next call.
  std::string_view field() {
    field_.clear();
    const Place start = place();
    if (!accept('"')) {
      while (!at_end() && text_[offset_] != ',' && !at_record_end()) {
        if (text_[offset_] == '"') {
          fail_at(place(), "a quote stands within a value that is not quoted",
                  "quote the whole value and double the quotes in it");
        }
        take();
      }
      return field_;
    }
    while (true) {
      if (at_end()) fail_at(start, "a quoted value does not end", "close it with a quote");
      if (accept('"')) {
        if (at_end() || text_[offset_] != '"') return field_;
      }
      take();
    }
  }

  void end_record() {
    if (at_end()) return;
    if (!at_record_end()) {
      fail_at(place(), "a row has more values than there are variables, or text behind a quote",
              "give one value for each variable");
    }
    const bool both = text_[offset_] == '\r';
    skip();
    if (both) skip();
  }

  bool at_end() const { return offset_ >= text_.size(); }
  bool at_record_end() const {
    return !at_end() && (text_[offset_] == '\n' || text_.substr(offset_, 2) == "\r\n");
  }
  bool accept(char c) {
    if (at_end() || text_[offset_] != c) return false;
    ++offset_;
    return true;
  }
  void take() {
    field_ += text_[offset_];
    skip();
  }
  void skip() { count(text_[offset_++]); }
  void count(char c) {
    if (c == '\n') {
      ++line_;
      line_start_ = offset_;
    } else if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) {
      ++line_start_;
    }
  }
  Place place() const { return {file_, line_, offset_ - line_start_ + 1}; }

  std::string_view text_;
  std::string file_;
  std::size_t offset_ = 0, line_ = 1, line_start_ = 0;
  graph::Terms& terms_;
  BlankScope blanks_;
  ResultBuilder builder_;
  std::string field_;
};

}  // namespace

ResultSet read_csv(std::string_view text, std::string_view file, graph::Terms& terms) {
  return CsvReader(text, file, terms).read();
}

}  // namespace sinew::rdf
