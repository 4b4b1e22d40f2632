// Domains. Beyond annotations and composites, a domain declares what is needed to convert:
//
//   coordinates cylindrical of Position :: Vector{3} { r = m, phi = rad, Z = m }
//   formula cylindrical -> cartesian of Position { X = r * cos(phi); Y = r * sin(phi); Z = Z }
//   formula screw -> {AngularVelocity = cartesian, LinearVelocity = cartesian} of Twist { … }
//   convention expressed_in of Twist, Wrench        (with "?" after its name: may be left open)
//   relation matrix of Pose identity { … } inverse { … } product { … }
//   change expressed_in cartesian of Force with t = old in new { … }
//   change reference_point cartesian of Torque needs "the force"
//   older geometric
#include <fmt/format.h>

#include "sinew/base/spelling.h"
#include "sinew/blocks/parser_impl.h"

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
  if (at_word("relation")) return parse_rule();
  if (at_word("change")) return parse_change();
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
    if (take("?")) node.add("optional", "?");
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
           expect_name("an annotation, composite, coordinates, formula, convention, relation, "
                       "change or older"));
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
  parse_text(node, "text");
  return node;
}

void Parser::parse_text(Node& node, std::string name) {
  if (!at("{"))
    fail(fmt::format("{} where '{{' should be", found()), "put the formula into braces");
  const Place place = lexer_.place();
  add_here(node, std::move(name), lexer_.raw_block(), place);
}

// relation COORDINATES of MEANING identity { … } inverse { … } product { … }
Node Parser::parse_rule() {
  Node node = begin("rule");
  lexer_.next();
  node.add("name", expect_name("coordinates"));
  if (!take_word("of"))
    fail(fmt::format("{} where 'of' should be", found()), "say of which meaning");
  node.add("of", expect_name("a meaning"));
  for (const char* part : {"identity", "inverse", "product"}) {
    if (!take_word(part)) {
      fail(fmt::format("{} where '{}' should be", found(), part),
           "a relation has an identity, an inverse and a product");
    }
    parse_text(node, part);
  }
  return node;
}

// change CONVENTION COORDINATES of MEANING, … with NAME = FRAME in FRAME, … { … }, or needs "…"
Node Parser::parse_change() {
  Node node = begin("change");
  lexer_.next();
  node.add("convention", expect_name("a convention"));
  node.add("name", expect_name("coordinates"));
  parse_semantics(node);
  if (take_word("needs")) {
    node.add("needs", expect_string("what it takes"));
    return node;
  }
  if (take_word("with")) {
    do {
      Node input = begin("given");
      input.add("name", expect_name("the relation's name in the formula"));
      expect("=");
      input.add("of", expect_name("a frame: old, new or a convention"));
      if (!take_word("in")) {
        fail(fmt::format("{} where 'in' should be", found()), "write NAME = FRAME in FRAME");
      }
      input.add("in", expect_name("a frame: old, new or a convention"));
      node.children.push_back(std::move(input));
    } while (take(","));
  }
  parse_text(node, "text");
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
