#include "sinew/rdf/sparql/values/regex_translation.h"

#include <fmt/format.h>

#include <vector>

#include "sinew/rdf/sparql/values/strings.h"

namespace sinew::rdf::sparql::values {
namespace {

// \i and \c of XML names, as what stands inside brackets.
constexpr std::string_view kNameStart =
    ":A-Z_a-z\\x{C0}-\\x{D6}\\x{D8}-\\x{F6}\\x{F8}-\\x{2FF}"
    "\\x{370}-\\x{37D}\\x{37F}-\\x{1FFF}\\x{200C}-\\x{200D}\\x{2070}-\\x{218F}\\x{2C00}-\\x{2FEF}"
    "\\x{3001}-\\x{D7FF}\\x{F900}-\\x{FDCF}\\x{FDF0}-\\x{FFFD}\\x{10000}-\\x{EFFFF}";
constexpr std::string_view kNameMore = "\\-.0-9\\x{B7}\\x{300}-\\x{36F}\\x{203F}-\\x{2040}";

class Translation {
 public:
  Translation(std::string_view pattern, bool extended, bool dot_all, std::string& why)
      : text_(pattern), extended_(extended), dot_all_(dot_all), why_(why) {}

  bool run() {
    if (!branches(0)) return false;
    return done() || fail("a ')' closes nothing");
  }
  std::string out;

 private:
  static constexpr std::size_t kDeepest = 100;

  bool done() const { return at_ >= text_.size(); }
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool fail(std::string what) {
    if (why_.empty()) why_ = std::move(what);
    return false;
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  void skip_space() {
    if (!extended_) return;
    while (!done() && (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r')) ++at_;
  }

  // Branches up to the end or a ')'.
  bool branches(std::size_t depth) {
    if (depth > kDeepest) return fail("it is nested too deep");
    bool can_repeat = false;
    for (skip_space(); !done() && peek() != ')'; skip_space()) {
      const char c = peek();
      if (c == '|') {
        out += '|';
        ++at_;
        can_repeat = false;
      } else if (c == '*' || c == '+' || c == '?' || c == '{') {
        if (!can_repeat) return fail("a quantifier has nothing before it");
        if (!quantifier()) return false;
        can_repeat = false;
      } else if (c == '^' || c == '$') {
        out += c;
        ++at_;
        can_repeat = false;
      } else {
        if (!atom(depth)) return false;
        can_repeat = true;
      }
    }
    return true;
  }

  bool quantifier() {
    if (peek() == '{') {
      const std::size_t end = text_.find('}', at_);
      if (end == std::string_view::npos) return fail("a '{' is not closed");
      const std::string_view inner = text_.substr(at_ + 1, end - at_ - 1);
      const std::size_t comma = inner.find(',');
      const std::string_view low = inner.substr(0, comma);
      const std::string_view high =
          comma == std::string_view::npos ? std::string_view{} : inner.substr(comma + 1);
      const auto all_digits = [](std::string_view digits) {
        return digits.find_first_not_of("0123456789") == std::string_view::npos &&
               digits.size() <= 5;
      };
      if (low.empty() || !all_digits(low) || !all_digits(high)) {
        return fail("a quantifier is not {n}, {n,} or {n,m}");
      }
      out.append(1, '{').append(inner).append(1, '}');
      at_ = end + 1;
    } else {
      out += peek();
      ++at_;
    }
    skip_space();
    if (peek() == '?' && !done()) {
      out += '?';
      ++at_;
    }
    return true;
  }

  bool atom(std::size_t depth) {
    const char c = peek();
    switch (c) {
      case '(':
        return group(depth);
      case '[':
        return bracket(depth);
      case '\\':
        return escape(false);
      case '.':
        // Without flag s: everything but the two ends of lines.
        out += dot_all_ ? "(?s:.)" : "[^\\n\\r]";
        ++at_;
        return true;
      case ']':
      case '}':
        return fail(fmt::format("a '{}' closes nothing", c));
      default:
        literal();
        return true;
    }
  }

  // One character, as itself.
  void literal() {
    if ((peek() & 0x80) == 0) {
      const char c = peek();
      const bool is_word = is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      if (!is_word && c != ' ' && c != '\n' && c != '\t' && c != '\r' && c > ' ') out += '\\';
      out += c;
      ++at_;
      return;
    }
    do {
      out += text_[at_++];
    } while (!done() && (text_[at_] & 0xC0) == 0x80);
  }

  bool group(std::size_t depth) {
    ++at_;
    if (peek() == '?') {
      if (peek(1) != ':') return fail("(? is followed by something else than ':'");
      at_ += 2;
      out += "(?:";
    } else {
      out += '(';
      ++opened_;
      open_.push_back(opened_);
    }
    const bool captures = out.back() == '(';
    if (!branches(depth + 1)) return false;
    if (done()) return fail("a '(' is not closed");
    ++at_;
    out += ')';
    if (captures) open_.pop_back();
    return true;
  }

  // At the '\'. Inside brackets, what it stands for goes into a PCRE2 class.
  bool escape(bool in_bracket) {
    const char c = peek(1);
    if (at_ + 1 >= text_.size()) return fail("it ends in '\\'");
    if (is_digit(c) && !in_bracket) return back_reference();
    at_ += 2;
    const auto set = [&](std::string_view positive, bool negated) {
      if (in_bracket && !negated) {
        out += positive;
      } else if (!in_bracket) {
        out.append(negated ? "[^" : "[").append(positive).append("]");
      } else {
        return false;
      }
      return true;
    };
    switch (c) {
      case 'n':
      case 'r':
      case 't':
        out.append(1, '\\').append(1, c);
        return true;
      case '\\':
      case '|':
      case '.':
      case '-':
      case '^':
      case '?':
      case '*':
      case '+':
      case '{':
      case '}':
      case '(':
      case ')':
      case '[':
      case ']':
      case '$':
        out.append(1, '\\').append(1, c);
        return true;
      case 's':
        return set(" \\t\\n\\r", false);
      case 'S':
        if (set(" \\t\\n\\r", true)) return true;
        out += "\\x{0}-\\x{8}\\x{B}\\x{C}\\x{E}-\\x{1F}\\x{21}-\\x{10FFFF}";
        return true;
      case 'd':
        out += "\\p{Nd}";
        return true;
      case 'D':
        out += "\\P{Nd}";
        return true;
      // \w: everything but punctuation, separators and others.
      case 'w':
        out += in_bracket ? "\\p{L}\\p{M}\\p{N}\\p{S}" : "[\\p{L}\\p{M}\\p{N}\\p{S}]";
        return true;
      case 'W':
        out += in_bracket ? "\\p{P}\\p{Z}\\p{C}" : "[\\p{P}\\p{Z}\\p{C}]";
        return true;
      case 'i':
        return set(kNameStart, false);
      case 'c':
        return set(std::string(kNameStart) + std::string(kNameMore), false);
      case 'I':
        return set(kNameStart, true) || fail("\\I stands in brackets: write [^\\i]");
      case 'C':
        return set(std::string(kNameStart) + std::string(kNameMore), true) ||
               fail("\\C stands in brackets: write [^\\c]");
      case 'p':
      case 'P':
        return property(c == 'P', in_bracket);
      default:
        return fail(fmt::format("there is no escape \\{}", c));
    }
  }

  bool back_reference() {
    std::size_t number = 0;
    ++at_;
    // As many digits as there are groups for.
    while (is_digit(peek()) && !done()) {
      const std::size_t longer = number * 10 + static_cast<std::size_t>(peek() - '0');
      if (longer > opened_ && number > 0) break;
      number = longer;
      ++at_;
      if (number == 0 || number > opened_) return fail("a back-reference names no group");
    }
    for (const std::size_t open : open_) {
      if (open == number) return fail("a back-reference names the group that it is in");
    }
    out += fmt::format("\\g{{{}}}", number);
    return true;
  }

  bool property(bool negated, bool in_bracket) {
    const std::size_t end = text_.find('}', at_);
    if (peek() != '{' || end == std::string_view::npos) return fail("\\p is not \\p{...}");
    const std::string_view name = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    if (name.starts_with("Is")) {
      const auto block = unicode_block(name.substr(2));
      if (!block) return fail(fmt::format("there is no Unicode block '{}'", name.substr(2)));
      const auto range = [](std::uint32_t first, std::uint32_t last) {
        return fmt::format("\\x{{{:X}}}-\\x{{{:X}}}", first, last);
      };
      std::string inside;
      if (!negated) {
        inside = range(block->first, block->last);
      } else {
        if (block->first > 0) inside += range(0, block->first - 1);
        if (block->last < 0x10FFFF) inside += range(block->last + 1, 0x10FFFF);
      }
      out += in_bracket ? inside : "[" + inside + "]";
      return true;
    }
    static constexpr std::string_view kCategories[] = {
        "L",  "Lu", "Ll", "Lt", "Lm", "Lo", "M",  "Mn", "Mc", "Me", "N",  "Nd",
        "Nl", "No", "P",  "Pc", "Pd", "Ps", "Pe", "Pi", "Pf", "Po", "Z",  "Zs",
        "Zl", "Zp", "S",  "Sm", "Sc", "Sk", "So", "C",  "Cc", "Cf", "Co", "Cn"};
    for (const std::string_view category : kCategories) {
      if (category != name) continue;
      out += fmt::format("\\{}{{{}}}", negated ? 'P' : 'p', name);
      return true;
    }
    return fail(fmt::format("there is no category '{}'", name));
  }

  // [...], with an optional subtraction: [a-z-[aeiou]] becomes (?![aeiou])[a-z].
  bool bracket(std::size_t depth) {
    if (depth > kDeepest) return fail("it is nested too deep");
    const std::size_t begin = out.size();
    ++at_;
    out += '[';
    if (peek() == '^') {
      out += '^';
      ++at_;
    }
    bool any = false;
    while (true) {
      if (done()) return fail("a '[' is not closed");
      const char c = peek();
      if (c == ']') break;
      if (c == '-' && peek(1) == '[') {
        if (!any) return fail("a class subtracts from nothing");
        ++at_;
        std::string outer = out.substr(begin) + "]";
        out.resize(begin);
        out += "(?:(?!";
        if (!bracket(depth + 1)) return false;
        out += ")" + outer + ")";
        if (peek() != ']') return fail("a subtraction is not the end of its class");
        ++at_;
        return true;
      }
      if (c == '[') return fail("a '[' stands in a class: write \\[");
      any = true;
      if (!class_item()) return false;
    }
    if (!any) return fail("a class is empty");
    ++at_;
    out += ']';
    return true;
  }

  // A character, a range, or an escape for a set.
  bool class_item() {
    if (peek() == '\\') {
      const char kind = peek(1);
      const bool is_set = std::string_view("sSdDwWiIcCpP").find(kind) != std::string_view::npos;
      if (!escape(true)) return false;
      if (is_set) return true;
    } else if (peek() == '-') {
      // A hyphen that is no range stands at either end.
      out += "\\-";
      ++at_;
    } else {
      literal();
    }
    if (peek() != '-' || peek(1) == ']' || peek(1) == '[' || at_ + 1 >= text_.size()) return true;
    ++at_;
    out += '-';
    if (peek() == '\\') {
      if (std::string_view("sSdDwWiIcCpP").find(peek(1)) != std::string_view::npos) {
        return fail("a range ends in a set");
      }
      return escape(true);
    }
    literal();
    return true;
  }

  std::string_view text_;
  bool extended_, dot_all_;
  std::string& why_;
  std::size_t at_ = 0;
  std::size_t opened_ = 0;         // groups so far
  std::vector<std::size_t> open_;  // groups that are not closed yet
};

}  // namespace

std::optional<std::string> to_pcre(std::string_view pattern, bool extended, bool dot_all,
                                   std::string& why) {
  Translation translation(pattern, extended, dot_all, why);
  if (!translation.run()) return std::nullopt;
  return std::move(translation.out);
}

}  // namespace sinew::rdf::sparql::values
