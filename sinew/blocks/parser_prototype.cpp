// Data prototypes.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/blocks/parser_impl.h"

namespace sinew::blocks {

Node Parser::parse_dproto() {
  Node node = begin("dproto");
  lexer_.next();
  node.add("name", expect_name("the prototype's name"));
  expect("::");
  const Place place = lexer_.place();
  add_here(node, "domain", expect_name("the prototype's domain"), place);
  parse_braces(node, [&] {
    Node field = parse_field();
    if (node.child(field.kind)) {
      throw Error(Problem{field.place,
                          node.text("name"),
                          fmt::format("field '{}' is there twice", field.kind),
                          "leave one out",
                          Severity::kError,
                          {}});
    }
    return field;
  });
  return node;
}

Node Parser::parse_field() {
  static const std::vector<std::string> kFields = {
      "semantic", "coord", "algebraic", "ddr", "dr", "units", "composes", "convention", "usingddr"};
  Node node = begin("");
  const Place place = lexer_.place();
  const std::string name = expect_name("a field of the prototype");
  node.kind = name;
  if (name == "composes" || name == "usingddr") {
    take("=");
  } else if (std::find(kFields.begin(), kFields.end(), name) != kFields.end()) {
    expect("=");
  } else {
    throw Error(
        Problem{place,
                {},
                fmt::format("prototypes have no field '{}'", name),
                did_you_mean(name, kFields, fmt::format("use one of {}", fmt::join(kFields, ", "))),
                Severity::kError,
                {}});
  }
  const Place value_place = lexer_.place();
  if (name == "semantic" || name == "coord") {
    add_here(node, "value", expect_name(name == "semantic" ? "a meaning" : "coordinates"),
             value_place);
  } else if (name == "algebraic") {
    if (take("::")) {
      add_here(node, "form", parse_form(), value_place);
    } else {
      add_here(node, "value", parse_qualified("an algebraic form"), value_place);
    }
  } else if (name == "ddr" || name == "usingddr") {
    parse_representation(node);
  } else if (name == "units") {
    if (take("::")) {
      parse_units_body(node);
    } else {
      add_here(node, "value", parse_qualified("units"), value_place);
    }
  } else if (name == "dr") {
    parse_braces(node, [&] { return parse_entry(); });
  } else {
    parse_braces(node, [&] { return parse_member(); });
  }
  return node;
}

// NAME, :: CTX { text }, or the older { mid = "text" mmid = "CTX" }
void Parser::parse_representation(Node& node) {
  if (take("::")) return parse_representation_text(node);
  const Place place = lexer_.place();
  if (!take("{")) {
    add_here(node, "value", parse_qualified("a data representation"), place);
    return;
  }
  std::string context, text;
  for (int i = 0; i < 2; ++i) {
    const Place at_name = lexer_.place();
    const std::string name = expect_name("mid or mmid");
    expect("=");
    const std::string value = expect_string("its text");
    if (name == "mmid") {
      context = value;
    } else if (name == "mid") {
      text = value;
    } else {
      throw Error(Problem{at_name,
                          {},
                          fmt::format("'{}' says nothing about a representation", name),
                          "write mid and mmid",
                          Severity::kError,
                          {}});
    }
    if (!take(",")) take(";");
  }
  expect("}");
  add_here(node, "context", context, place);
  add_here(node, "text", " " + text + " ", place);
}

Node Parser::parse_member() {
  Node node = begin("member");
  node.add("name", expect_name("a member's name"));
  expect("=");
  add_qualified(node, "value", "a name");
  return node;
}

}  // namespace sinew::blocks
