// Components whose every value node must pass a test of its own (sections 4.1, 4.3, 4.4, 4.8.3).
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "sinew/rdf/shacl/literals.h"
#include "sinew/rdf/shacl/validator.h"
#include "sinew/rdf/sparql/values/strings.h"

namespace sinew::rdf::shacl {
namespace {

namespace values = sparql::values;

bool has_node_kind(const graph::Terms& terms, Id value, Id kind) {
  const std::string_view name = terms.text(kind).substr(kSh.size());
  if (terms.is_iri(value))
    return name == "IRI" || name == "BlankNodeOrIRI" || name == "IRIOrLiteral";
  if (terms.is_blank(value)) {
    return name == "BlankNode" || name == "BlankNodeOrIRI" || name == "BlankNodeOrLiteral";
  }
  return name == "Literal" || name == "BlankNodeOrLiteral" || name == "IRIOrLiteral";
}

bool passes(Check& check, Id value) {
  const graph::Terms& terms = check.validator.terms();
  const values::TermSpace& space = check.validator.values();
  const Constraint& constraint = check.constraint;
  const Id parameter = constraint.values.empty() ? Id{} : constraint.values[0];
  switch (constraint.component) {
    case Component::kClass:
      return !terms.is_literal(value) && check.validator.is_instance(value, parameter);
    case Component::kDatatype:
      return terms.is_literal(value) && terms.datatype(value) == parameter &&
             is_well_formed(terms.text(value), terms.text(parameter));
    case Component::kNodeKind:
      return has_node_kind(terms, value, parameter);
    case Component::kMinExclusive:
      return compare_values(parameter, value, space) < 0;
    case Component::kMinInclusive:
      return compare_values(parameter, value, space) <= 0;
    case Component::kMaxExclusive:
      return compare_values(parameter, value, space) > 0;
    case Component::kMaxInclusive:
      return compare_values(parameter, value, space) >= 0;
    case Component::kMinLength:
      return !terms.is_blank(value) &&
             values::character_count(terms.text(value)) >= constraint.count;
    case Component::kMaxLength:
      return !terms.is_blank(value) &&
             values::character_count(terms.text(value)) <= constraint.count;
    case Component::kPattern:
      return !terms.is_blank(value) && constraint.pattern->search(terms.text(value));
    case Component::kLanguageIn: {
      const std::string_view language = terms.language(value);
      return !language.empty() &&
             std::any_of(constraint.languages.begin(), constraint.languages.end(),
                         [&](const std::string& range) {
                           return values::language_matches(language, range);
                         });
    }
    case Component::kIn:
      return std::find(constraint.values.begin(), constraint.values.end(), value) !=
             constraint.values.end();
    default:
      return true;
  }
}

std::string names(const Validator& validator, std::span<const Id> ids) {
  constexpr std::size_t kShown = 12;
  std::string text;
  for (std::size_t i = 0; i < ids.size() && i < kShown; ++i) {
    if (i > 0) text += ", ";
    text += validator.name(ids[i]);
  }
  if (ids.size() > kShown) text += fmt::format(" or {} others", ids.size() - kShown);
  return text;
}

std::string remedy(const Check& check) {
  const Constraint& constraint = check.constraint;
  const Validator& validator = check.validator;
  const std::string first = constraint.values.empty() ? "" : validator.name(constraint.values[0]);
  switch (constraint.component) {
    case Component::kClass:
      return fmt::format("it must be an instance of {}", first);
    case Component::kDatatype:
      return fmt::format("it must be a well-formed literal of {}", first);
    case Component::kNodeKind:
      return fmt::format("its node kind must be {}", first);
    case Component::kMinExclusive:
      return fmt::format("it must be greater than {}", first);
    case Component::kMinInclusive:
      return fmt::format("it must be at least {}", first);
    case Component::kMaxExclusive:
      return fmt::format("it must be less than {}", first);
    case Component::kMaxInclusive:
      return fmt::format("it must be at most {}", first);
    case Component::kMinLength:
      return fmt::format("it must have at least {} characters", constraint.count);
    case Component::kMaxLength:
      return fmt::format("it must have at most {} characters", constraint.count);
    case Component::kPattern:
      return fmt::format("it must match {}", first);
    case Component::kLanguageIn:
      return fmt::format("its language must be one of {}", names(validator, constraint.values));
    case Component::kIn:
      return fmt::format("it must be one of {}", names(validator, constraint.values));
    default:
      return {};
  }
}

}  // namespace

void check_value(Check& check) {
  for (const Id value : check.values) {
    if (passes(check, value)) continue;
    if (!check.results) {
      check.violation(value);
      return;
    }
    check.violation(value, fmt::format("the value is {}", check.validator.name(value)),
                    remedy(check));
  }
}

}  // namespace sinew::rdf::shacl
