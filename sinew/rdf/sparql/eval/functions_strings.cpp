// Functions on strings, regular expressions and digests (SPARQL 1.1, sections 17.4.3 and 17.4.6).
#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/casts.h"
#include "sinew/rdf/sparql/values/digest.h"
#include "sinew/rdf/sparql/values/strings.h"

namespace sinew::rdf::sparql::eval {

using values::ValueKind;

namespace {

bool is_text(const Value& value) {
  return value.kind == ValueKind::kString || value.kind == ValueKind::kLangString;
}

// Section 17.4.3.1.2: the second has no language, or that of the first.
bool compatible(const Value& first, const Value& second) {
  if (!is_text(first) || !is_text(second)) return false;
  return second.kind == ValueKind::kString || first.language == second.language;
}

std::optional<double> number_of(const Value& value) {
  switch (value.kind) {
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      return values::to_double(value.decimal);
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      return value.real;
    default:
      return std::nullopt;
  }
}

}  // namespace

Value Evaluator::string_function(const plan::Expression& call) {
  if (call.op == Operator::kConcat) return concatenated(call);
  const Value text = argument(call, 0);
  if (!is_text(text)) return Value::error();
  switch (call.op) {
    case Operator::kStrLen:
      return Value::of_integer(static_cast<std::int64_t>(values::character_count(text.text)));
    case Operator::kUCase:
      return kept_string(values::upper_case(text.text), text.language);
    case Operator::kLCase:
      return kept_string(values::lower_case(text.text), text.language);
    case Operator::kEncodeForUri:
      return kept_string(values::encode_for_uri(text.text));
    case Operator::kSubStr: {
      const auto start = number_of(argument(call, 1));
      if (!start) return Value::error();
      std::optional<double> length;
      if (call.count > 2) {
        length = number_of(argument(call, 2));
        if (!length) return Value::error();
      }
      return Value::of_string(values::substring(text.text, *start, length), text.language);
    }
    default:
      break;
  }
  const Value part = argument(call, 1);
  if (call.op == Operator::kLangMatches) {
    if (text.kind != ValueKind::kString || part.kind != ValueKind::kString) return Value::error();
    return Value::of(values::language_matches(text.text, part.text));
  }
  if (!compatible(text, part)) return Value::error();
  const std::size_t at = text.text.find(part.text);
  switch (call.op) {
    case Operator::kStrStarts:
      return Value::of(text.text.starts_with(part.text));
    case Operator::kStrEnds:
      return Value::of(text.text.ends_with(part.text));
    case Operator::kContains:
      return Value::of(at != std::string_view::npos);
    case Operator::kStrBefore:
      if (at == std::string_view::npos) return Value::of_string({});
      return Value::of_string(text.text.substr(0, at), text.language);
    case Operator::kStrAfter:
      if (at == std::string_view::npos) return Value::of_string({});
      return Value::of_string(text.text.substr(at + part.text.size()), text.language);
    default:
      return Value::error();
  }
}

// With a language where all arguments have the same one.
Value Evaluator::concatenated(const plan::Expression& call) {
  std::string result;
  std::string_view language;
  for (std::uint32_t i = 0; i < call.count; ++i) {
    const Value part = argument(call, i);
    if (!is_text(part)) return Value::error();
    if (i == 0) language = part.language;
    if (part.language != language) language = {};
    result += part.text;
    check_text_size(result.size());
  }
  return kept_string(result, language);
}

Value Evaluator::regex_function(const plan::Expression& call) {
  const bool replaces = call.op == Operator::kReplace;
  const Value text = argument(call, 0);
  const Value pattern = argument(call, 1);
  if (!is_text(text) || pattern.kind != ValueKind::kString) return Value::error();
  Value replacement;
  if (replaces) {
    replacement = argument(call, 2);
    if (replacement.kind != ValueKind::kString) return Value::error();
  }
  const std::uint32_t flags_at = replaces ? 3 : 2;
  std::string_view flag_text;
  if (call.count > flags_at) {
    const Value flags = argument(call, flags_at);
    if (flags.kind != ValueKind::kString) return Value::error();
    flag_text = flags.text;
  }
  // Nearly always the pattern is a constant: compiled once.
  CachedRegex& cached = regexes_[call.cache];
  if (!cached.is_made || cached.pattern != pattern.text || cached.flags != flag_text) {
    cached.is_made = true;
    cached.pattern = pattern.text;
    cached.flags = flag_text;
    cached.regex = values::Regex::compile(pattern.text, flag_text);
  }
  if (!cached.regex) return Value::error();
  if (!replaces) return Value::of(cached.regex->search(text.text));
  const auto replaced = cached.regex->replace(text.text, replacement.text);
  if (!replaced) return Value::error();
  check_text_size(replaced->size());
  return kept_string(*replaced, text.language);
}

Value Evaluator::digest_function(const plan::Expression& call) {
  const Value text = argument(call, 0);
  if (text.kind != ValueKind::kString) return Value::error();
  using values::DigestKind;
  static constexpr DigestKind kKinds[] = {DigestKind::kMd5, DigestKind::kSha1, DigestKind::kSha256,
                                          DigestKind::kSha384, DigestKind::kSha512};
  const int which = static_cast<int>(call.op) - static_cast<int>(Operator::kMd5);
  return kept_string(values::digest(text.text, kKinds[which]));
}

}  // namespace sinew::rdf::sparql::eval
