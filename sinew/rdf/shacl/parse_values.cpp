// The values that parameters of shapes have, and how faults in them are reported.
#include <fmt/format.h>

#include <unordered_set>

#include "sinew/rdf/shacl/shape_parser.h"

namespace sinew::rdf::shacl {

Place ShapeParser::place(Id node, Id property) const {
  if (!places_) return {};
  Place found = places_->find(node, property);
  for (auto shape = open_.rbegin(); found.file.empty() && shape != open_.rend(); ++shape) {
    found = places_->find(*shape);
  }
  return found;
}

void ShapeParser::fault(Id node, Id property, std::string what, std::string remedy) {
  report_.error(place(node, property), name(node), std::move(what), std::move(remedy));
}

void ShapeParser::warn(Id node, Id property, std::string what, std::string remedy) {
  Problem problem;
  problem.place = place(node, property);
  problem.iri = name(node);
  problem.what = std::move(what);
  problem.remedy = std::move(remedy);
  problem.severity = Severity::kWarning;
  out_.warnings.push_back(std::move(problem));
}

std::string ShapeParser::name(Id id) const {
  const std::string_view text = terms().text(id);
  if (terms().is_iri(id)) {
    if (text.starts_with(kSh)) return fmt::format("sh:{}", text.substr(kSh.size()));
    return std::string(text);
  }
  return terms().to_string(id);
}

bool ShapeParser::at_most_one(Id node, Id property, const std::vector<Id>& values) {
  if (values.size() <= 1) return true;
  fault(node, property, fmt::format("{} has {} values", name(property), values.size()),
        "give one value at most");
  return false;
}

std::optional<bool> ShapeParser::boolean(Id node, Id property, Id value) {
  if (terms().is_literal(value) && terms().datatype(value) == v_.xsd_boolean) {
    const std::string_view text = terms().text(value);
    if (text == "true") return true;
    if (text == "false") return false;
    if (text == "1" || text == "0") {
      warn(node, property, fmt::format("{} is {}", name(property), name(value)),
           "only the literal true switches it on: write true or false");
      return false;
    }
  }
  fault(node, property, fmt::format("{} is {}", name(property), name(value)),
        "it must be true or false, of type xsd:boolean");
  return std::nullopt;
}

std::optional<std::uint64_t> ShapeParser::count(Id node, Id property, Id value) {
  if (terms().is_literal(value) && terms().datatype(value) == v_.xsd_integer) {
    const auto number = terms().integer_value(value);
    if (number && *number >= 0) return static_cast<std::uint64_t>(*number);
  }
  fault(node, property, fmt::format("{} is {}", name(property), name(value)),
        "it must be a non-negative integer, of type xsd:integer");
  return std::nullopt;
}

std::optional<std::vector<Id>> ShapeParser::list(Id node, Id property, Id head) {
  std::vector<Id> members;
  std::unordered_set<Id> seen;
  for (Id at = head; at != v_.rdf_nil;) {
    const auto first = in_.objects(at, v_.rdf_first), rest = in_.objects(at, v_.rdf_rest);
    if (first.size() != 1 || rest.size() != 1 || !seen.insert(at).second) {
      fault(
          node, property, fmt::format("{} is no well-formed list", name(property)),
          "every cell must have one rdf:first and one rdf:rest, and the last must end in rdf:nil");
      return std::nullopt;
    }
    if (members.size() == kMaxListLength) {
      fault(node, property,
            fmt::format("{} has more than {} members", name(property), kMaxListLength),
            "make it shorter");
      return std::nullopt;
    }
    members.push_back(first[0]);
    at = rest[0];
  }
  return members;
}

bool ShapeParser::is_iri(Id node, Id property, Id value) {
  if (terms().is_iri(value)) return true;
  fault(node, property, fmt::format("{} is {}", name(property), name(value)), "it must be an IRI");
  return false;
}

bool ShapeParser::is_string(Id node, Id property, Id value, bool or_lang_string) {
  if (terms().is_literal(value)) {
    const Id type = terms().datatype(value);
    if (type == v_.xsd_string || (or_lang_string && type == v_.rdf_lang_string)) return true;
  }
  fault(node, property, fmt::format("{} is {}", name(property), name(value)),
        or_lang_string ? "it must be a string, with or without language" : "it must be a string");
  return false;
}

std::vector<Message> ShapeParser::messages(Id node) {
  std::vector<Message> found;
  for (const Id value : in_.objects(node, v_.message)) {
    if (!is_string(node, v_.message, value, true)) continue;
    found.push_back({std::string(terms().text(value)), std::string(terms().language(value))});
  }
  return found;
}

}  // namespace sinew::rdf::shacl
