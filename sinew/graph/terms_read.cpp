// Reading terms: kinds, texts (made on demand for fresh and derived nodes), values, N-Triples form.
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/graph/terms_data.h"
#include "sinew/graph/uuid.h"

namespace sinew::graph {
namespace {

// The namespace of our names: UUID version 5 of kDerivedPrefix in the namespace of URLs of
// RFC 4122, appendix C.
const Uuid& derived_namespace() {
  constexpr Uuid kUrls = {0x6b, 0xa7, 0xb8, 0x11, 0x9d, 0xad, 0x11, 0xd1,
                          0x80, 0xb4, 0x00, 0xc0, 0x4f, 0xd4, 0x30, 0xc8};
  static const Uuid uuid = name_based_uuid(kUrls, kDerivedPrefix);
  return uuid;
}

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\b':
        out += "\\b";
        break;
      case '\f':
        out += "\\f";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
          out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        } else {
          out += c;
        }
    }
  }
  return out;
}

// Characters that an IRI reference of N-Triples may only hold as \u escapes.
std::string escaped_iri(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (static_cast<unsigned char>(c) <= 0x20 ||
        std::string_view("<>\"{}|^`\\").find(c) != std::string_view::npos) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

TermKind Terms::kind(Id id) const { return id ? data_->entries[id.value].kind : TermKind::kNone; }

std::string_view Terms::text(Id id) const {
  if (!id) return {};
  const TermEntry& entry = data_->entries[id.value];
  if (const char* text = load(entry.text)) return {text, entry.size};
  const std::lock_guard lock(data_->demand);
  return data_->make_text(id.value);
}

Id Terms::datatype(Id literal) const {
  return is_literal(literal) ? Id{data_->entries[literal.value].link} : Id{};
}

std::string_view Terms::language(Id literal) const {
  if (!is_literal(literal)) return {};
  const TermEntry& entry = data_->entries[literal.value];
  return {entry.text + entry.size, entry.language_size};
}

std::optional<double> Terms::number(Id literal) const {
  if (!literal) return std::nullopt;
  const TermEntry& entry = data_->entries[literal.value];
  return entry.has_number ? std::optional(entry.number) : std::nullopt;
}

std::optional<std::int64_t> Terms::integer_value(Id literal) const {
  if (!is_literal(literal)) return std::nullopt;
  const TermEntry& entry = data_->entries[literal.value];
  return parse_integer({entry.text, entry.size}, numeric_type_of(entry.link));
}

std::string Terms::to_string(Id id) const {
  switch (kind(id)) {
    case TermKind::kNone:
      return "(none)";
    case TermKind::kIri:
    case TermKind::kDerived:
      return fmt::format("<{}>", escaped_iri(text(id)));
    case TermKind::kBlank:
      return fmt::format("_:{}", text(id));
    case TermKind::kLiteral:
      break;
  }
  std::string out = fmt::format("\"{}\"", escaped(text(id)));
  if (const std::string_view tag = language(id); !tag.empty()) {
    out += fmt::format("@{}", tag);
  } else if (datatype(id).value != kBuiltinString) {
    out += fmt::format("^^<{}>", escaped_iri(text(datatype(id))));
  }
  return out;
}

// ---- texts on demand ----

// The role and the parts, each as its kind, the sizes of its texts, and its texts: unambiguous.
void Terms::Data::append_to_name(std::uint32_t id, std::string& name) const {
  const TermEntry& entry = entries[id];
  const std::string_view text(entry.text, entry.size);
  const auto number = [&](std::size_t value) {
    const fmt::format_int digits(value);
    name.append(digits.data(), digits.size());
  };
  if (id == 0) {
    name += '-';
  } else if (entry.kind == TermKind::kLiteral) {
    const TermEntry& datatype = entries[entry.link];
    name += 'L';
    number(text.size());
    name += ',';
    number(datatype.size);
    name += ',';
    number(entry.language_size);
    name += ':';
    name += text;
    name.append(datatype.text, datatype.size);
    name.append(entry.text + entry.size, entry.language_size);
  } else {
    name += entry.kind == TermKind::kBlank ? 'B' : 'I';
    number(text.size());
    name += ':';
    name += text;
  }
}

// The namespace, the role and the first part are the same in many names, one after the other.
Uuid Terms::Data::uuid_of(const DerivedEntry& made_of) {
  const std::uint32_t first = made_of.count > 0 ? made_of.parts[0] : 0;
  NameBegin& begin = name_begins[(made_of.role ^ first * 31U) % name_begins.size()];
  std::string& name = name_rest;
  if (!begin.known || begin.role != made_of.role || begin.first != first ||
      begin.alone != (made_of.count == 0)) {
    begin = {true, made_of.role, first, made_of.count == 0, {}};
    const Uuid& space = derived_namespace();
    name.assign(space.begin(), space.end());
    append_to_name(made_of.role, name);
    if (made_of.count > 0) append_to_name(first, name);
    begin.hash.add(name);
  }
  name.clear();
  for (std::uint32_t i = 1; i < made_of.count; ++i) append_to_name(made_of.parts[i], name);
  Sha1 hash = begin.hash;
  hash.add(name);
  return name_based_uuid(hash.digest());
}

std::string_view Terms::Data::make_text(std::uint32_t id) {
  // A derived node's parts may be derived; they are made first, without recursion, because such
  // chains may be as long as the dictionary.
  std::vector<std::uint32_t>& waiting = names_waiting;
  waiting.assign(1, id);
  while (!waiting.empty()) {
    const std::uint32_t current = waiting.back();
    TermEntry& entry = entries[current];
    if (load(entry.text)) {
      waiting.pop_back();
      continue;
    }
    char* memory = nullptr;
    if (entry.kind == TermKind::kDerived) {
      const DerivedEntry& made_of = derived[entry.link];
      const std::size_t before = waiting.size();
      for (std::uint32_t i = 0; i < made_of.count; ++i) {
        const std::uint32_t part = made_of.parts[i];
        if (part != 0 && !load(entries[part].text)) waiting.push_back(part);
      }
      if (!load(entries[made_of.role].text)) waiting.push_back(made_of.role);
      if (waiting.size() > before) continue;
      entry.size = kDerivedPrefix.size() + kUuidText;
      memory = demand_arena.allocate(entry.size);
      kDerivedPrefix.copy(memory, kDerivedPrefix.size());
      write_text(uuid_of(made_of), memory + kDerivedPrefix.size());
    } else {
      const std::string text = fmt::format("fresh{}", current);
      entry.size = static_cast<std::uint32_t>(text.size());
      memory = demand_arena.allocate(text.size());
      text.copy(memory, text.size());
    }
    store(entry.text, memory);
    waiting.pop_back();
  }
  return {entries[id].text, entries[id].size};
}

std::uint32_t Terms::Data::find_derived_text(std::string_view text) {
  const std::uint32_t count = derived_published.load(std::memory_order_acquire);
  for (; derived_named < count; ++derived_named) {
    const std::uint32_t id = derived_ids[derived_named];
    derived_by_text.emplace(make_text(id), id);
  }
  const auto found = derived_by_text.find(text);
  return found == derived_by_text.end() ? 0 : found->second;
}

}  // namespace sinew::graph
