#include "sinew/rdf/iri/iri.h"

#include <array>
#include <filesystem>

namespace sinew::rdf {
namespace {

bool is_alpha(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Length of the scheme that the text begins with, without the ':'; 0 when it begins with none.
std::size_t scheme_length(std::string_view text) {
  if (text.empty() || !is_alpha(text[0])) return 0;
  for (std::size_t i = 1; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ':') return i;
    if (!is_alpha(c) && !is_digit(c) && c != '+' && c != '-' && c != '.') return 0;
  }
  return 0;
}

// RFC 3986, section 5.2.4, on a path that is walked segment by segment.
std::string remove_dot_segments(std::string_view path) {
  while (path.starts_with("./") || path.starts_with("../")) path.remove_prefix(path.find('/') + 1);
  if (path == "." || path == "..") return {};
  std::string out;
  out.reserve(path.size());
  const bool rooted = path.starts_with('/');
  std::size_t start = rooted ? 1 : 0;
  while (true) {
    const std::size_t slash = path.find('/', start);
    const bool last = slash == std::string_view::npos;
    const std::string_view segment = path.substr(start, last ? slash : slash - start);
    if (segment == "." || segment == "..") {
      if (segment == "..") {
        const std::size_t cut = out.rfind('/');
        out.resize(cut == std::string::npos ? 0 : cut);
      }
      if (last) out += '/';
    } else {
      if (start > 0) out += '/';
      out += segment;
    }
    if (last) return out;
    start = slash + 1;
  }
}

// RFC 3986, section 5.2.3.
std::string merge_paths(const IriParts& base, std::string_view reference_path) {
  std::string merged;
  if (base.authority && base.path.empty()) {
    merged = "/";
  } else if (const std::size_t slash = base.path.rfind('/'); slash != std::string_view::npos) {
    merged = base.path.substr(0, slash + 1);
  }
  return merged.append(reference_path);
}

// The path of `target` as seen from the directory of `base`; both begin with '/'.
std::string relative_path(std::string_view target, std::string_view base) {
  std::size_t common = 0;  // just after the last '/' up to which both agree
  for (std::size_t i = 0; i < target.size() && i < base.size() && target[i] == base[i]; ++i) {
    if (target[i] == '/') common = i + 1;
  }
  std::string out;
  for (const char c : base.substr(common)) {
    if (c == '/') out += "../";
  }
  const std::string_view rest = target.substr(common);
  // The first segment must neither be empty nor look like a scheme.
  const bool needs_dot =
      out.empty() && (rest.empty() || rest.substr(0, rest.find('/')).empty() ||
                      rest.substr(0, rest.find('/')).find(':') != std::string_view::npos);
  if (needs_dot) out += "./";
  out += rest;
  return out;
}

}  // namespace

IriParts split_iri(std::string_view text) {
  IriParts parts;
  if (const std::size_t length = scheme_length(text); length > 0) {
    parts.scheme = text.substr(0, length);
    text.remove_prefix(length + 1);
  }
  if (const std::size_t hash = text.find('#'); hash != std::string_view::npos) {
    parts.fragment = text.substr(hash + 1);
    text = text.substr(0, hash);
  }
  if (const std::size_t mark = text.find('?'); mark != std::string_view::npos) {
    parts.query = text.substr(mark + 1);
    text = text.substr(0, mark);
  }
  if (text.starts_with("//")) {
    text.remove_prefix(2);
    const std::size_t end = text.find('/');
    parts.authority = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end);
  }
  parts.path = text;
  return parts;
}

std::string join_iri(const IriParts& parts) {
  std::string out;
  if (parts.scheme) out.append(*parts.scheme).append(":");
  if (parts.authority) out.append("//").append(*parts.authority);
  out.append(parts.path);
  if (parts.query) out.append("?").append(*parts.query);
  if (parts.fragment) out.append("#").append(*parts.fragment);
  return out;
}

bool is_absolute_iri(std::string_view text) { return scheme_length(text) > 0; }

// RFC 3986, section 5.2.2, without the tolerance for references that repeat the base's scheme.
std::optional<std::string> resolve_iri(std::string_view reference_text,
                                       std::string_view base_text) {
  const IriParts reference = split_iri(reference_text);
  const IriParts base = split_iri(base_text);
  if (!base.scheme) {
    if (!reference.scheme) return std::nullopt;
    return std::string(reference_text);
  }
  IriParts target = reference;
  std::string path;
  if (reference.scheme || reference.authority) {
    path = remove_dot_segments(reference.path);
  } else if (reference.path.empty()) {
    path = base.path;
    target.authority = base.authority;
    if (!reference.query) target.query = base.query;
  } else {
    path = remove_dot_segments(reference.path.starts_with('/') ? std::string(reference.path)
                                                               : merge_paths(base, reference.path));
    target.authority = base.authority;
  }
  if (!reference.scheme) target.scheme = base.scheme;
  // Without an authority, a path must not begin with "//": it would be read as one.
  if (!target.authority && path.starts_with("//")) path.insert(0, "/.");
  target.path = path;
  return join_iri(target);
}

std::string relative_iri(std::string_view iri, std::string_view base_text) {
  const IriParts target = split_iri(iri);
  const IriParts base = split_iri(base_text);
  if (!target.scheme || target.scheme != base.scheme || target.authority != base.authority) {
    return std::string(iri);
  }
  std::string tail;
  if (target.query) tail.append("?").append(*target.query);
  const std::size_t query_length = tail.size();
  if (target.fragment) tail.append("#").append(*target.fragment);

  std::array<std::string, 4> candidates;
  candidates[0] = tail.substr(query_length);
  candidates[1] = tail;
  if (target.path.starts_with('/') && base.path.starts_with('/')) {
    candidates[2] = relative_path(target.path, base.path) + tail;
  }
  candidates[3] = std::string(target.path) + tail;
  for (const std::string& candidate : candidates) {
    if (resolve_iri(candidate, base_text) == iri) return candidate;
  }
  return std::string(iri);
}

std::optional<std::string> fault_of_iri(std::string_view text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (!forbidden_in_iri(byte)) continue;
    if (byte == ' ') return "the IRI holds a space";
    if (byte < 0x20 || byte == 0x7F) return "the IRI holds a control character";
    return std::string("the IRI holds the character ") + c;
  }
  if (!is_absolute_iri(text)) return "the IRI has no scheme";
  return std::nullopt;
}

std::string file_iri(std::string_view path) {
  const std::string absolute =
      std::filesystem::absolute(std::filesystem::path(path)).lexically_normal().generic_string();
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out = "file://";
  for (const char c : absolute) {
    const auto byte = static_cast<unsigned char>(c);
    if (forbidden_in_iri(byte) || byte == '%' || byte == '?' || byte == '#' || byte >= 0x80) {
      out += '%';
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace sinew::rdf
