#include "sinew/rdf/json/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "sinew/base/error.h"
#include "sinew/rdf/iri/characters.h"

namespace sinew::json {
namespace {

class Reader {
 public:
  Reader(std::string_view text, std::string_view file, Arena& arena)
      : next_(text.data()),
        end_(text.data() + text.size()),
        line_start_(text.data()),
        file_(file),
        arena_(arena) {}

  Value document() {
    if (static_cast<std::size_t>(end_ - next_) > kMaxBytes) {
      fail(fmt::format("the file is larger than {} MiB", kMaxBytes >> 20),
           "split it into several files");
    }
    check_encoding();
    if (std::string_view(next_, end_).starts_with("\xEF\xBB\xBF")) next_ += 3;  // byte-order mark
    skip_space();
    const Value result = value(0);
    skip_space();
    if (next_ != end_) fail("text follows the end of the document", "one JSON value and no more");
    return result;
  }

 private:
  Position here() const { return {line_, static_cast<std::uint32_t>(next_ - line_start_ + 1)}; }

  [[noreturn]] void fail(std::string what, std::string remedy) const {
    fail_at(here(), std::move(what), std::move(remedy));
  }

  [[noreturn]] void fail_at(Position position, std::string what, std::string remedy) const {
    throw Error(Problem{{std::string(file_), position.line, position.column},
                        "",
                        "not valid JSON: " + std::move(what),
                        std::move(remedy),
                        Severity::kError,
                        "loading document failed"});
  }

  void check_encoding() {
    const std::string_view text(next_, end_);
    const std::size_t bad = rdf::first_invalid_utf8(text);
    if (bad == std::string_view::npos) return;
    for (; next_ != text.data() + bad; ++next_) {
      if (*next_ == '\n') {
        ++line_;
        line_start_ = next_ + 1;
      }
    }
    fail(found() + " is not valid UTF-8", "save the file as UTF-8");
  }

  // What stands at the cursor, for messages.
  std::string found() const {
    if (next_ == end_) return "the file ends here";
    const auto byte = static_cast<unsigned char>(*next_);
    if (byte < 0x20 || byte >= 0x7F) return fmt::format("byte 0x{:02X}", byte);
    return fmt::format("'{}'", *next_);
  }

  void skip_space() {
    for (; next_ != end_; ++next_) {
      if (*next_ == '\n') {
        ++line_;
        line_start_ = next_ + 1;
      } else if (*next_ != ' ' && *next_ != '\t' && *next_ != '\r') {
        return;
      }
    }
  }

  bool take(char wanted) {
    if (next_ == end_ || *next_ != wanted) return false;
    ++next_;
    return true;
  }

  Value value(std::size_t depth) {
    if (++values_ > kMaxValues) {
      fail(fmt::format("the document has more than {} values", kMaxValues),
           "split it into several files");
    }
    if (next_ == end_) fail("the file ends where a value is expected", "complete the document");
    switch (*next_) {
      case '{':
        return object(depth);
      case '[':
        return array(depth);
      case '"': {
        const Position position = here();
        return Value::string(string(), position);
      }
      case 't':
        return literal("true", Value::boolean(true, here()));
      case 'f':
        return literal("false", Value::boolean(false, here()));
      case 'n':
        return literal("null", Value().at(here()));
      default:
        return number();
    }
  }

  Value literal(std::string_view word, Value value) {
    if (!std::string_view(next_, end_).starts_with(word)) {
      fail(found() + " starts no value", fmt::format("\"{}\" in full", word));
    }
    next_ += word.size();
    return value;
  }

  void check_depth(std::size_t depth) const {
    if (depth >= kMaxDepth) {
      fail(fmt::format("arrays and objects are nested more than {} deep", kMaxDepth),
           "a flatter document");
    }
  }

  Value array(std::size_t depth) {
    check_depth(depth);
    Value result = Value::array(arena_, here());
    ++next_;
    skip_space();
    if (take(']')) return result;
    while (true) {
      result.append(arena_, value(depth + 1));
      skip_space();
      if (take(']')) return result;
      if (!take(',')) fail(found() + " follows an item of an array", "',' or ']'");
      skip_space();
    }
  }

  Value object(std::size_t depth) {
    check_depth(depth);
    Value result = Value::object(arena_, here());
    ++next_;
    skip_space();
    if (take('}')) return result;
    while (true) {
      if (next_ == end_ || *next_ != '"') {
        fail(found() + " where a key is expected", "a key in double quotes");
      }
      const Position position = here();
      const Value key = Value::string(string(), position);
      if (result.find(key.text()) != nullptr) {
        fail_at(position, fmt::format("the key \"{}\" stands twice in one object", key.text()),
                "each key once; several values go into an array");
      }
      skip_space();
      if (!take(':')) fail(found() + " follows a key", "':'");
      skip_space();
      result.add(arena_, key, value(depth + 1));
      skip_space();
      if (take('}')) return result;
      if (!take(',')) fail(found() + " follows a member of an object", "',' or '}'");
      skip_space();
    }
  }

  void digits() {
    if (next_ == end_ || *next_ < '0' || *next_ > '9') fail(found() + " in a number", "a digit");
    while (next_ != end_ && *next_ >= '0' && *next_ <= '9') ++next_;
  }

  Value number() {
    const Position position = here();
    const char* start = next_;
    if (*next_ != '-' && (*next_ < '0' || *next_ > '9')) {
      fail(found() + " starts no value", "a string, number, object, array, true, false or null");
    }
    take('-');
    if (take('0')) {
      if (next_ != end_ && *next_ >= '0' && *next_ <= '9') {
        fail("a number starts with a needless 0", "the number without it");
      }
    } else {
      digits();
    }
    if (take('.')) digits();
    if (take('e') || take('E')) {
      if (!take('+')) take('-');
      digits();
    }
    return Value::number({start, next_}, position);
  }

  // The cursor is on the opening quote. A string without escapes refers to the text itself.
  std::string_view string() {
    const char* start = ++next_;
    while (next_ != end_) {
      const auto byte = static_cast<unsigned char>(*next_);
      if (byte == '"') return {start, next_++};
      if (byte == '\\') return escaped_string(start);
      if (byte < 0x20) fail("a control character inside a string", "an escape such as \\n");
      ++next_;
    }
    fail("the file ends inside a string", "a closing '\"'");
  }

  std::string_view escaped_string(const char* start) {
    buffer_.assign(start, next_);
    while (next_ != end_) {
      const auto byte = static_cast<unsigned char>(*next_);
      if (byte == '"') {
        ++next_;
        return arena_.copy(buffer_);
      }
      if (byte == '\\') {
        ++next_;
        escape();
      } else {
        if (byte < 0x20) fail("a control character inside a string", "an escape such as \\n");
        buffer_ += *next_++;
      }
    }
    fail("the file ends inside a string", "a closing '\"'");
  }

  void escape() {
    if (next_ == end_) fail("the file ends inside a string", "a closing '\"'");
    const char code = *next_;
    if (const char control = rdf::control_of_escape(code)) {
      buffer_ += control;
      ++next_;
      return;
    }
    switch (code) {
      case '"':
      case '\\':
      case '/':
        buffer_ += code;
        break;
      case 'u':
        ++next_;
        unicode_escape();
        return;
      default:
        fail(found() + " after a backslash", "one of \" \\ / b f n r t u");
    }
    ++next_;
  }

  void unicode_escape() {
    char32_t code = hex4();
    if (code >= 0xD800 && code < 0xDC00 && std::string_view(next_, end_).starts_with("\\u")) {
      next_ += 2;
      const char32_t low = hex4();
      if (low < 0xDC00 || low > 0xDFFF) fail("half of a surrogate pair", "both halves");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    } else if (code >= 0xD800 && code <= 0xDFFF) {
      fail("half of a surrogate pair", "both halves");
    }
    rdf::append_utf8(buffer_, code);
  }

  char32_t hex4() {
    char32_t code = 0;
    for (int i = 0; i < 4; ++i, ++next_) {
      if (next_ == end_) fail("the file ends inside a string", "a closing '\"'");
      const int digit = rdf::hex_digit_value(static_cast<unsigned char>(*next_));
      if (digit < 0) fail(found() + " after \\u", "four hexadecimal digits");
      code = code << 4 | static_cast<char32_t>(digit);
    }
    return code;
  }

  const char* next_;
  const char* end_;
  const char* line_start_;
  std::uint32_t line_ = 1;
  std::size_t values_ = 0;
  std::string_view file_;
  Arena& arena_;
  std::string buffer_;
};

}  // namespace

Value read_into(std::string_view text, std::string_view file, Arena& arena) {
  return Reader(text, file, arena).document();
}

bool is_number(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t start = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - start;
  };
  if (text.starts_with('-')) ++at;
  const bool zero = at < text.size() && text[at] == '0';
  const std::size_t whole = digits();
  if (whole == 0 || (zero && whole > 1)) return false;
  if (at < text.size() && text[at] == '.') {
    ++at;
    if (digits() == 0) return false;
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits() == 0) return false;
  }
  return at == text.size();
}

Document read(std::string_view text, std::string_view file) {
  Document result;
  result.file = file;
  // Values take about three times the bytes of their text; one block holds most documents.
  result.arena = std::make_unique<Arena>(std::min<std::size_t>(text.size() * 4 + 256, 1 << 18));
  // A text beyond the limit is refused before it is copied.
  if (text.size() <= kMaxBytes) text = result.arena->copy(text);
  result.root = read_into(text, result.file, *result.arena);
  return result;
}

}  // namespace sinew::json
