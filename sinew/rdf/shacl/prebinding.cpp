#include "sinew/rdf/shacl/prebinding.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::rdf::shacl {
namespace {

namespace syntax = sparql::syntax;
constexpr std::string_view kPath = "PATH";

class Inspection {
 public:
  Inspection(const syntax::Query& query, std::span<const std::string_view> prebound,
             std::span<const std::string_view> returned)
      : names_(query.names.texts), prebound_(prebound), returned_(returned) {
    select(query.select);
  }
  std::optional<std::string> fault;

 private:
  void refuse(std::string why) {
    if (!fault) fault = std::move(why);
  }
  std::string_view name(syntax::Variable variable) const { return names_[variable]; }

  // AS ?variable
  void assigned(syntax::Variable variable) {
    const bool is_prebound =
        std::find(prebound_.begin(), prebound_.end(), name(variable)) != prebound_.end();
    if (is_prebound) refuse(fmt::format("it gives ${} a new value", name(variable)));
    used(variable);
  }
  // Anywhere but as a predicate.
  void used(syntax::Variable variable) {
    if (name(variable) == kPath) refuse("$PATH stands elsewhere than as a predicate");
  }
  void node(const syntax::Node& node) {
    if (node.is_variable()) used(node.value);
  }

  void expression(const syntax::Expression& expression) {
    using sparql::Operator;
    if (expression.op == Operator::kVariable || expression.op == Operator::kBound) {
      used(expression.variable);
    }
    for (const syntax::Expression& argument : expression.arguments) this->expression(argument);
    if (expression.pattern) group(*expression.pattern);
  }

  void select(const syntax::Select& select) {
    for (const syntax::Projection& projection : select.projections) {
      if (projection.expression) {
        expression(*projection.expression);
        assigned(projection.variable);
      } else {
        used(projection.variable);
      }
    }
    if (select.where) group(*select.where);
    for (const syntax::GroupKey& key : select.group_by) {
      expression(key.expression);
      if (key.variable && key.expression.op != sparql::Operator::kVariable) assigned(*key.variable);
    }
    for (const syntax::Expression& having : select.having) expression(having);
    for (const syntax::Order& order : select.order_by) expression(order.expression);
    if (select.values) refuse("it has VALUES");
  }

  void sub_select(const syntax::Select& inner) {
    for (const std::string_view required : returned_) {
      const bool found = std::any_of(inner.projections.begin(), inner.projections.end(),
                                     [&](const syntax::Projection& projection) {
                                       return name(projection.variable) == required;
                                     });
      if (!found) refuse(fmt::format("a sub-select does not return ${}", required));
    }
    select(inner);
  }

  void group(const syntax::Group& group) {
    for (const syntax::Element& element : group.elements) this->element(element);
  }

  void element(const syntax::Element& element) {
    using Kind = syntax::Element::Kind;
    switch (element.kind) {
      case Kind::kTriples:
        for (const syntax::Triple& triple : element.triples) {
          node(triple.subject);
          node(triple.object);
        }
        break;
      case Kind::kFilter:
        expression(element.expression);
        break;
      case Kind::kBind:
        expression(element.expression);
        assigned(element.variable);
        break;
      case Kind::kValues:
        refuse("it has VALUES");
        break;
      case Kind::kMinus:
        refuse("it has MINUS");
        break;
      case Kind::kService:
        refuse("it has SERVICE");
        break;
      case Kind::kSelect:
        sub_select(*element.select);
        break;
      case Kind::kGraph:
        node(element.name);
        break;
      case Kind::kGroup:
      case Kind::kUnion:
      case Kind::kOptional:
        break;
    }
    for (const auto& inner : element.groups) group(*inner);
  }

  const std::vector<std::string>& names_;
  std::span<const std::string_view> prebound_, returned_;
};

// The end of the string, IRI or comment that begins at `at`; `at` itself if there is none.
std::size_t end_of_quoted(std::string_view text, std::size_t at) {
  const char first = text[at];
  if (first == '#') return std::min(text.find('\n', at), text.size());
  if (first == '<') {
    // An IRI has no spaces; otherwise it is the operator.
    const std::size_t end = text.find_first_of("> \t\r\n<\"{}|^`\\", at + 1);
    return end != std::string_view::npos && text[end] == '>' ? end + 1 : at;
  }
  if (first != '"' && first != '\'') return at;
  const std::string three(3, first);
  const bool is_long = text.substr(at).starts_with(three);
  const std::string_view quote = is_long ? std::string_view(three) : text.substr(at, 1);
  for (std::size_t i = at + quote.size(); i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text.substr(i).starts_with(quote)) {
      return i + quote.size();
    }
  }
  return text.size();
}

bool continues_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         (c & 0x80) != 0;
}

}  // namespace

std::optional<std::string> prebinding_fault(const syntax::Query& query,
                                            std::span<const std::string_view> prebound,
                                            std::span<const std::string_view> returned) {
  return Inspection(query, prebound, returned).fault;
}

std::string with_path(std::string_view query, std::string_view path) {
  std::string text;
  for (std::size_t at = 0; at < query.size();) {
    const std::size_t end = end_of_quoted(query, at);
    if (end > at) {
      text += query.substr(at, end - at);
      at = end;
      continue;
    }
    const std::size_t behind = at + 1 + kPath.size();
    const bool is_path = (query[at] == '$' || query[at] == '?') &&
                         query.substr(at + 1).starts_with(kPath) &&
                         (behind >= query.size() || !continues_name(query[behind]));
    if (is_path) {
      text += path;
      at = behind;
    } else {
      text += query[at++];
    }
  }
  return text;
}

}  // namespace sinew::rdf::shacl
