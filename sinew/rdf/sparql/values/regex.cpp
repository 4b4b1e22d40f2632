// The one file that uses PCRE2.
#include "sinew/rdf/sparql/values/regex.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#define PCRE2_CODE_UNIT_WIDTH 8
#include <pcre2.h>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/values/regex_translation.h"

namespace sinew::rdf::sparql::values {
namespace {

struct Free {
  void operator()(pcre2_code* code) const { pcre2_code_free(code); }
  void operator()(pcre2_match_data* data) const { pcre2_match_data_free(data); }
  void operator()(pcre2_match_context* context) const { pcre2_match_context_free(context); }
};

PCRE2_SPTR bytes(std::string_view text) {
  // PCRE2 wants a pointer even for the empty text.
  return reinterpret_cast<PCRE2_SPTR>(text.data() == nullptr ? "" : text.data());
}

}  // namespace

struct Regex::Data {
  std::unique_ptr<pcre2_code, Free> code;
  std::unique_ptr<pcre2_match_context, Free> context;
  std::uint32_t groups = 0;
  bool quoted = false;  // flag q

  // Below 0: no match.
  int match(std::string_view text, std::size_t from, std::uint32_t options,
            pcre2_match_data* found) const {
    const int result =
        pcre2_match(code.get(), bytes(text), text.size(), from, options, found, context.get());
    if (result == PCRE2_ERROR_MATCHLIMIT || result == PCRE2_ERROR_DEPTHLIMIT ||
        result == PCRE2_ERROR_HEAPLIMIT) {
      throw Error(Problem{
          {},
          {},
          fmt::format("a regular expression takes more than {} steps on one text", kMostSteps),
          "write it without nested repetitions",
          Severity::kError,
          {}});
    }
    return result;
  }
};

Regex::Regex(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Regex::~Regex() = default;

std::shared_ptr<const Regex> Regex::compile(std::string_view pattern, std::string_view flags,
                                            std::string* why) {
  std::string reason;
  const auto refuse = [&](std::string what) -> std::shared_ptr<const Regex> {
    if (why) *why = std::move(what);
    return nullptr;
  };
  if (pattern.size() > kMostPatternBytes) {
    return refuse(fmt::format("the pattern has more than {} bytes", kMostPatternBytes));
  }
  std::uint32_t options = PCRE2_UTF | PCRE2_DOLLAR_ENDONLY | PCRE2_NEVER_BACKSLASH_C;
  bool dot_all = false;
  bool extended = false;
  bool quoted = false;
  for (const char flag : flags) {
    switch (flag) {
      case 'i':
        options |= PCRE2_CASELESS;
        break;
      case 'm':
        options |= PCRE2_MULTILINE;
        break;
      case 's':
        dot_all = true;
        break;
      case 'x':
        extended = true;
        break;
      case 'q':
        quoted = true;
        break;
      default:
        return refuse(fmt::format("there is no flag '{}'", flag));
    }
  }
  std::string translated;
  if (quoted) {
    translated = pattern;
    options = (options & ~static_cast<std::uint32_t>(PCRE2_NEVER_BACKSLASH_C)) | PCRE2_LITERAL;
    options &= ~static_cast<std::uint32_t>(PCRE2_MULTILINE | PCRE2_DOLLAR_ENDONLY);
  } else {
    auto result = to_pcre(pattern, extended, dot_all, reason);
    if (!result) return refuse(std::move(reason));
    translated = *std::move(result);
  }
  const std::unique_ptr<pcre2_compile_context, decltype(&pcre2_compile_context_free)> compiling(
      pcre2_compile_context_create(nullptr), pcre2_compile_context_free);
  pcre2_set_newline(compiling.get(), PCRE2_NEWLINE_LF);
  int error = 0;
  PCRE2_SIZE where = 0;
  auto data = std::make_unique<Data>();
  data->code.reset(pcre2_compile(bytes(translated), translated.size(), options, &error, &where,
                                 compiling.get()));
  if (!data->code) {
    PCRE2_UCHAR message[200];
    pcre2_get_error_message(error, message, sizeof message);
    return refuse(reinterpret_cast<const char*>(message));
  }
  data->context.reset(pcre2_match_context_create(nullptr));
  pcre2_set_match_limit(data->context.get(), kMostSteps);
  pcre2_set_heap_limit(data->context.get(), 64 * 1024);  // KiB
  pcre2_pattern_info(data->code.get(), PCRE2_INFO_CAPTURECOUNT, &data->groups);
  data->quoted = quoted;
  return std::shared_ptr<const Regex>(new Regex(std::move(data)));
}

bool Regex::search(std::string_view text) const {
  const std::unique_ptr<pcre2_match_data, Free> found(
      pcre2_match_data_create_from_pattern(data_->code.get(), nullptr));
  return data_->match(text, 0, 0, found.get()) >= 0;
}

namespace {

// Appends what the replacement stands for; false when it is not allowed.
bool append_replacement(std::string_view replacement, bool quoted, std::string_view text,
                        const PCRE2_SIZE* groups, std::uint32_t count, std::string& out) {
  if (quoted) {
    out += replacement;
    return true;
  }
  for (std::size_t i = 0; i < replacement.size(); ++i) {
    const char c = replacement[i];
    const char next = i + 1 < replacement.size() ? replacement[i + 1] : '\0';
    if (c == '\\') {
      if (next != '\\' && next != '$') return false;
      out += next;
      ++i;
    } else if (c == '$') {
      if (next < '0' || next > '9') return false;
      // As many digits as there are groups for.
      auto number = static_cast<std::size_t>(next - '0');
      ++i;
      while (i + 1 < replacement.size() && replacement[i + 1] >= '0' && replacement[i + 1] <= '9' &&
             number * 10 + static_cast<std::size_t>(replacement[i + 1] - '0') <= count) {
        number = number * 10 + static_cast<std::size_t>(replacement[++i] - '0');
      }
      if (number <= count && groups[2 * number] != PCRE2_UNSET) {
        out += text.substr(groups[2 * number], groups[2 * number + 1] - groups[2 * number]);
      }
    } else {
      out += c;
    }
  }
  return true;
}

}  // namespace

std::optional<std::string> Regex::replace(std::string_view text,
                                          std::string_view replacement) const {
  const std::unique_ptr<pcre2_match_data, Free> found(
      pcre2_match_data_create_from_pattern(data_->code.get(), nullptr));
  if (data_->match("", 0, 0, found.get()) >= 0) return std::nullopt;
  std::string result;
  std::size_t from = 0;
  bool allowed = true;
  const PCRE2_SIZE* const groups = pcre2_get_ovector_pointer(found.get());
  // The pattern could also be wrong where nothing matches.
  std::string unused;
  const std::vector<PCRE2_SIZE> none(2 * (std::size_t{data_->groups} + 1), PCRE2_UNSET);
  if (!append_replacement(replacement, data_->quoted, {}, none.data(), data_->groups, unused)) {
    return std::nullopt;
  }
  while (allowed && from <= text.size() && data_->match(text, from, 0, found.get()) >= 0) {
    // A match of nothing, by looking around, would never end; no such pattern passes the check
    // above but for ones that look at ends of lines.
    if (groups[1] == groups[0]) return std::nullopt;
    result += text.substr(from, groups[0] - from);
    allowed = append_replacement(replacement, data_->quoted, text, groups, data_->groups, result);
    from = groups[1];
  }
  result += text.substr(std::min(from, text.size()));
  return result;
}

}  // namespace sinew::rdf::sparql::values
