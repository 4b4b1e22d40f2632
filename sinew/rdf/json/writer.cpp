#include "sinew/rdf/json/writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "sinew/rdf/iri/characters.h"

namespace sinew::json {
namespace {

void append_text(std::string& out, const Value& value, bool spaces) {
  const std::string_view comma = spaces ? ", " : ",";
  bool first = true;
  switch (value.kind()) {
    case Kind::kNull:
      out += "null";
      return;
    case Kind::kBoolean:
      out += value.is_true() ? "true" : "false";
      return;
    case Kind::kNumber:
      out += value.text();
      return;
    case Kind::kString:
      append_quoted(out, value.text());
      return;
    case Kind::kArray:
      out += '[';
      for (const Value& item : value.items()) {
        if (!first) out += comma;
        first = false;
        append_text(out, item, spaces);
      }
      out += ']';
      return;
    case Kind::kObject:
      out += spaces && !value.members().empty() ? "{ " : "{";
      for (const Member& member : value.members()) {
        if (!first) out += comma;
        first = false;
        append_quoted(out, member.name());
        out += spaces ? ": " : ":";
        append_text(out, member.value, spaces);
      }
      out += spaces && !value.members().empty() ? " }" : "}";
      return;
  }
}

bool holds_only_scalars(const Value& value) {
  return std::none_of(value.items().begin(), value.items().end(),
                      [](const Value& item) { return item.is_array() || item.is_object(); }) &&
         std::none_of(value.members().begin(), value.members().end(), [](const Member& member) {
           return member.value.is_array() || member.value.is_object();
         });
}

bool holds_only_numbers(const Value& array) {
  return std::all_of(array.items().begin(), array.items().end(),
                     [](const Value& item) { return item.is_number(); });
}

class PrettyWriter {
 public:
  explicit PrettyWriter(std::size_t width) : width_(width) {}

  void value(const Value& value, std::size_t indent) {
    const bool container = value.is_array() || value.is_object();
    if (!container || fits(value)) {
      append_text(out, value, true);
      return;
    }
    const bool array = value.is_array();
    if (array && holds_only_numbers(value)) return numbers(value, indent);
    out += array ? '[' : '{';
    bool first = true;
    const auto next = [&] {
      out += first ? "\n" : ",\n";
      first = false;
      out.append(indent + 2, ' ');
    };
    for (const Value& item : value.items()) {
      next();
      this->value(item, indent + 2);
    }
    for (const Member& member : value.members()) {
      next();
      append_quoted(out, member.name());
      out += ": ";
      this->value(member.value, indent + 2);
    }
    out += '\n';
    out.append(indent, ' ');
    out += array ? ']' : '}';
  }

  std::string out;

 private:
  void numbers(const Value& array, std::size_t indent) {
    out += '[';
    std::size_t column = width_;  // of the next number; the first one starts a line
    for (std::size_t i = 0; i < array.items().size(); ++i) {
      const std::string_view number = array.items()[i].text();
      if (i > 0) out += ',';
      if (column + number.size() + 2 > width_) {
        out += '\n';
        out.append(indent + 2, ' ');
        column = indent + 2;
      } else {
        out += ' ';
        ++column;
      }
      out += number;
      column += number.size() + 1;
    }
    out += '\n';
    out.append(indent, ' ');
    out += ']';
  }

  // On the rest of the line, with a comma behind it.
  bool fits(const Value& value) {
    if (!holds_only_scalars(value)) return false;
    const std::size_t line = out.rfind('\n') == std::string::npos ? 0 : out.rfind('\n') + 1;
    const std::size_t column = out.size() - line;
    if (column + value.items().size() * 3 > width_) return false;
    std::string text;
    append_text(text, value, true);
    return column + text.size() + 1 <= width_;
  }

  std::size_t width_;
};

std::u16string utf16(std::string_view text) {
  std::u16string result;
  for (std::size_t i = 0; i < text.size();) {
    const rdf::Decoded decoded = rdf::decode_utf8(text, i);
    i += decoded.length;
    if (decoded.character < 0x10000) {
      result += static_cast<char16_t>(decoded.character);
    } else {
      result += static_cast<char16_t>(0xD800 + ((decoded.character - 0x10000) >> 10));
      result += static_cast<char16_t>(0xDC00 + ((decoded.character - 0x10000) & 0x3FF));
    }
  }
  return result;
}

void append_canonical(std::string& out, const Value& value) {
  if (value.is_number()) {
    // A number that no double can hold has no canonical form: it stays as it was written.
    const double number = value.number();
    out += std::isfinite(number) ? ecmascript_number(number) : std::string(value.text());
  } else if (value.is_array()) {
    out += '[';
    for (std::size_t i = 0; i < value.items().size(); ++i) {
      if (i > 0) out += ',';
      append_canonical(out, value.items()[i]);
    }
    out += ']';
  } else if (value.is_object()) {
    std::vector<std::pair<std::u16string, const Member*>> members;
    for (const Member& member : value.members())
      members.emplace_back(utf16(member.name()), &member);
    std::sort(members.begin(), members.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    out += '{';
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) out += ',';
      append_quoted(out, members[i].second->name());
      out += ':';
      append_canonical(out, members[i].second->value);
    }
    out += '}';
  } else {
    append_text(out, value, false);
  }
}

}  // namespace

void append_quoted(std::string& out, std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  std::size_t plain = 0;  // start of the characters that need no escape
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\') continue;
    out.append(text, plain, i - plain);
    plain = i + 1;
    out += '\\';
    switch (c) {
      case '"':
      case '\\':
        out += c;
        break;
      case '\b':
        out += 'b';
        break;
      case '\f':
        out += 'f';
        break;
      case '\n':
        out += 'n';
        break;
      case '\r':
        out += 'r';
        break;
      case '\t':
        out += 't';
        break;
      default:
        out += "u00";
        out += kHex[c >> 4];
        out += kHex[c & 15];
    }
  }
  out.append(text, plain);
  out += '"';
}

std::string to_text(const Value& value) {
  std::string out;
  append_text(out, value, false);
  return out;
}

std::string to_pretty_text(const Value& value, std::size_t width) {
  PrettyWriter writer(width);
  writer.value(value, 0);
  writer.out += '\n';
  return std::move(writer.out);
}

std::string to_canonical_text(const Value& value) {
  std::string out;
  append_canonical(out, value);
  return out;
}

// The shortest digits that read back to the value, laid out as ECMA-262 says: plain notation for
// exponents from -7 to 20, scientific beyond.
std::string ecmascript_number(double value) {
  if (value == 0) return "0";
  std::string out;
  if (value < 0) {
    out = '-';
    value = -value;
  }
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific);
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  const std::size_t e = text.find('e');
  std::string digits(text.substr(0, e));
  digits.erase(std::remove(digits.begin(), digits.end(), '.'), digits.end());
  int exponent = 0;
  const char* sign = text.data() + e + 1;
  std::from_chars(*sign == '+' ? sign + 1 : sign, end.ptr, exponent);
  const int count = static_cast<int>(digits.size());
  const int point = exponent + 1;  // digits before the decimal point
  if (count <= point && point <= 21) return out + digits + std::string(point - count, '0');
  if (0 < point && point <= 21)
    return out.append(digits, 0, point).append(".").append(digits, point);
  if (-6 < point && point <= 0) return out + "0." + std::string(-point, '0') + digits;
  out += digits[0];
  if (count > 1) out.append(".").append(digits, 1);
  out += exponent < 0 ? "e-" : "e+";
  return out + std::to_string(std::abs(exponent));
}

}  // namespace sinew::json
