// Domains. Beyond annotations and composites, a domain declares what is needed to convert:
//
//   coordinates cylindrical of Position :: Vector{3} { r = m, phi = rad, Z = m }
//   formula cylindrical -> cartesian of Position { X = r * cos(phi); Y = r * sin(phi); Z = Z }
//   formula screw -> {AngularVelocity = cartesian, LinearVelocity = cartesian} of Twist { … }
//   convention expressed_in of Twist, Wrench
//   older geometric
#include <fmt/format.h>

#include "sinew/blocks/parser_impl.h"
#include "sinew/data/spelling.h"

namespace sinew::blocks {

Node Parser::parse_domain() {
  Node node = begin("domain");
  lexer_.next();
  node.add("name", expect_name("the domain's name"));
  expect("::");
  parse_braces(node, [&] { return parse_domain_entry(); });
  return node;
}

Node Parser::parse_domain_entry() {
  if (at_word("coordinates")) return parse_coordinates();
  if (at_word("formula")) return parse_formula();
  if (at_word("convention")) {
    Node node = begin("convention");
    lexer_.next();
    if (lexer_.peek().kind != Token::Kind::kName) {  // the annotation of that name
      node.kind = "annotation";
      node.add("name", "convention");
      if (take("?")) node.add("optional", "?");
      return node;
    }
    node.add("name", expect_name("the convention's name"));
    parse_semantics(node);
    return node;
  }
  if (at_word("older")) {
    Node node = begin("older");
    lexer_.next();
    node.add("name", expect_name("the older name"));
    return node;
  }
  if (at_word("composite")) {
    Node node = begin("composite");
    lexer_.next();
    node.add("name", expect_name("the composite's name"));
    expect("=");
    expect("{");
    while (!take("}")) {
      if (at_end()) fail(fmt_end("}"));
      node.add("member", expect_name("a member's name"));
      if (!take(",")) take(";");
    }
    return node;
  }
  Node node = begin("annotation");
  node.add("name",
           expect_name("an annotation, composite, coordinates, formula, convention or older"));
  if (take("?")) node.add("optional", "?");
  if (take(":")) {
    do {
      node.add("value", expect_name("an allowed value"));
    } while (take("|"));
  }
  return node;
}

// of Position, Twist
void Parser::parse_semantics(Node& node) {
  if (!take_word("of")) fail(fmt::format("{} where 'of' should be", found()), "say what it is of");
  do {
    const Place place = lexer_.place();
    add_here(node, "of", expect_name("a meaning"), place);
  } while (take(","));
}

Node Parser::parse_coordinates() {
  Node node = begin("coordinates");
  lexer_.next();
  node.add("name", expect_name("the coordinates' name"));
  parse_semantics(node);
  if (take("::")) node.add("form", parse_form());
  parse_braces(node, [&] {
    Node parameter = begin("parameter");
    parameter.add("name", expect_name("a parameter's name"));
    expect("=");
    const Place place = lexer_.place();
    if (take_word("const")) {
      add_here(parameter, "constant", lexer_.number(), place);
    } else if (lexer_.peek().kind == Token::Kind::kString) {
      add_here(parameter, "unit", lexer_.next().text, place);
    } else {
      add_here(parameter, "unit", expect_name("an SI unit"), place);
    }
    return parameter;
  });
  return node;
}

Node Parser::parse_formula() {
  Node node = begin("formula");
  lexer_.next();
  node.add("from", parse_formula_side());
  expect("->");
  node.add("to", parse_formula_side());
  if (!take_word("of"))
    fail(fmt::format("{} where 'of' should be", found()), "say of which meaning");
  node.add("of", expect_name("a meaning"));
  if (take_word("loses")) node.add("loses", expect_string("what the formula loses"));
  if (!at("{"))
    fail(fmt::format("{} where '{{' should be", found()), "put the formula into braces");
  const Place place = lexer_.place();
  add_here(node, "text", lexer_.raw_block(), place);
  return node;
}

// NAME, or {MEMBER = NAME, …} in normal form.
std::string Parser::parse_formula_side() {
  if (!take("{")) return expect_name("coordinates");
  std::string text = "{";
  while (!take("}")) {
    if (at_end()) fail(fmt_end("}"));
    if (text.size() > 1) text += ", ";
    text += expect_name("a member's name");
    expect("=");
    text += " = " + expect_name("the member's coordinates");
    if (!take(",")) take(";");
  }
  return text + "}";
}

}  // namespace sinew::blocks
