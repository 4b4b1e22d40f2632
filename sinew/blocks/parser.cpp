#include "sinew/blocks/parser.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/blocks/parser_impl.h"

namespace sinew::blocks {
namespace {

const std::vector<std::string> kOtherHalf = {"load",     "fblx",  "dblx",   "external",
                                             "priority", "fresh", "trigger"};

}  // namespace

const std::vector<std::string>& item_keywords() {
  static const std::vector<std::string> keywords = {
      "import", "module", "domain", "ddr",        "algebraic", "units",
      "alias",  "dproto", "view",   "conversion", "fproto",    "relation"};
  return keywords;
}

Node parse(std::string_view text, const std::string& file) {
  return Parser(text, file).parse_file();
}

Node Parser::parse_file() {
  Node file = begin("file");
  parse_items(file, 0);
  report_.throw_if_errors();
  return file;
}

void Parser::parse_items(Node& parent, std::size_t depth) {
  while (!at_end() && !(depth > 0 && at("}"))) {
    try {
      std::vector<std::string> comments = lexer_.take_comments();
      Node item = parse_item(depth);
      item.comments.insert(item.comments.begin(), comments.begin(), comments.end());
      if (!take(",")) take(";");
      if (item.remark.empty()) item.remark = lexer_.take_remark();
      parent.children.push_back(std::move(item));
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) report_.add(problem);
      recover();
    }
  }
  parent.end_comments = lexer_.take_comments();
}

// To the next line that begins with an item's keyword.
void Parser::recover() {
  while (!at_end()) {
    try {
      lexer_.next();
      const Token& token = lexer_.peek();
      const auto& keywords = item_keywords();
      // In a prototype's body lines begin with some of these words too, followed by "=".
      if (token.first_on_line && token.column == 1 && token.kind == Token::Kind::kName &&
          std::find(keywords.begin(), keywords.end(), token.text) != keywords.end()) {
        return;
      }
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) report_.add(problem);
      throw Error(std::vector<Problem>(report_.problems()));
    }
  }
}

Node Parser::parse_item(std::size_t depth) {
  if (take_word("import")) return parse_import();
  if (at_word("module")) return parse_module(depth);
  if (at_word("domain")) return parse_domain();
  if (at_word("ddr")) return parse_ddr();
  if (at_word("algebraic")) return parse_algebraic();
  if (at_word("units")) return parse_units();
  if (at_word("alias")) return parse_alias();
  if (at_word("dproto")) return parse_dproto();
  if (at_word("view")) return parse_view();
  if (at_word("conversion")) return parse_conversion();
  if (at_word("fproto")) return parse_fproto();
  if (at_word("relation")) return parse_relation();
  const std::string word = lexer_.peek().text;
  if (std::find(kOtherHalf.begin(), kOtherHalf.end(), word) != kOtherHalf.end()) {
    fail(fmt::format("'{}' belongs to the composition of functions, which is not read here", word),
         "describe data: import, module, domain, ddr, algebraic, units, alias, dproto, view, "
         "conversion, fproto, relation");
  }
  fail(
      fmt::format("{} where an item should begin", found()),
      did_you_mean(word, item_keywords(),
                   fmt::format("an item begins with one of {}", fmt::join(item_keywords(), ", "))));
}

Node Parser::parse_import() {
  Node node = begin("import");
  const Place place = lexer_.place();
  add_here(node, "file", expect_string("the file to import"), place);
  if (take_word("as")) node.add("as", expect_name("the name of the module"));
  return node;
}

Node Parser::parse_module(std::size_t depth) {
  Node node = begin("module");
  lexer_.next();
  if (depth >= kMaximumNesting)
    fail(fmt::format("modules are nested more than {} deep", kMaximumNesting));
  node.add("name", expect_name("the module's name"));
  expect("{");
  parse_items(node, depth + 1);
  expect("}");
  return node;
}

Node Parser::parse_ddr() {
  Node node = begin("ddr");
  lexer_.next();
  node.add("name", expect_name("the representation's name"));
  expect("::");
  parse_representation_text(node);
  return node;
}

void Parser::parse_representation_text(Node& node) {
  const Place place = lexer_.place();
  add_here(node, "context", expect_name("the kind of representation, as in c99"), place);
  if (!at("{")) fail(fmt::format("{} where '{{' should be", found()), "put the type into braces");
  const Place text_place = lexer_.place();
  add_here(node, "text", lexer_.raw_block(), text_place);
}

Node Parser::parse_algebraic() {
  Node node = begin("algebraic");
  lexer_.next();
  node.add("name", expect_name("the form's name"));
  expect("::");
  const Place place = lexer_.place();
  add_here(node, "form", parse_form(), place);
  return node;
}

// Scalar{x,y}, Vector{3}, Matrix{3,3}, in normal form.
std::string Parser::parse_form() {
  const Place place = lexer_.place();
  const std::string kind = expect_name("Scalar, Vector or Matrix");
  static const std::vector<std::string> kinds = {"Scalar", "Vector", "Matrix"};
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    throw Error(Problem{place,
                        {},
                        fmt::format("'{}' is no algebraic form", kind),
                        did_you_mean(kind, kinds, "write Scalar{x,y}, Vector{3} or Matrix{3,3}"),
                        Severity::kError,
                        {}});
  }
  expect("{");
  std::string form = kind + "{";
  for (bool first = true; !at("}"); first = false) {
    if (!first) {
      expect(",");
      form += ",";
    }
    if (kind == "Scalar") {
      form += expect_name("an element's name");
    } else if (lexer_.peek().kind == Token::Kind::kInteger) {
      form += lexer_.next().text;
    } else {
      fail(fmt::format("{} where a whole number should be", found()),
           "write Vector{3} or Matrix{3,3}");
    }
  }
  expect("}");
  const auto commas = std::count(form.begin(), form.end(), ',');
  if ((kind == "Vector" && commas != 0) || (kind == "Matrix" && commas != 1)) {
    throw Error(Problem{place,
                        {},
                        fmt::format("'{}}}' has the wrong number of sizes", form),
                        "a Vector has one, a Matrix two",
                        Severity::kError,
                        {}});
  }
  return form + "}";
}

Node Parser::parse_units() {
  Node node = begin("units");
  lexer_.next();
  node.add("name", expect_name("the units' name"));
  expect("::");
  parse_units_body(node);
  return node;
}

void Parser::parse_units_body(Node& node) {
  const Place place = lexer_.place();
  add_here(node, "ontology", expect_name("the table of units, qudt"), place);
  expect(",");
  add_qualified(node, "algebraic", "an algebraic form");
  parse_braces(node, [&] { return parse_unit(); });
}

Node Parser::parse_unit() {
  Node node = begin("unit");
  if (lexer_.peek().kind == Token::Kind::kString) {
    node.add("unit", lexer_.next().text);
  } else {
    node.add("unit", expect_name("a unit"));
  }
  expect("=");
  const Place place = lexer_.place();
  add_here(node, "accessor", parse_accessor(), place);
  return node;
}

Node Parser::parse_alias() {
  Node node = begin("alias");
  lexer_.next();
  add_qualified(node, "left", "an algebraic form");
  expect("<->");
  add_qualified(node, "right", "an algebraic form");
  parse_braces(node, [&] { return parse_entry(); });
  return node;
}

// accessor = [-] accessor | const number
Node Parser::parse_entry() {
  Node node = begin("entry");
  node.add("left", parse_accessor());
  expect("=");
  if (take_word("const")) {
    const Place place = lexer_.place();
    add_here(node, "constant", lexer_.number(), place);
    return node;
  }
  if (take("-")) node.add("sign", "-");
  const Place place = lexer_.place();
  add_here(node, "right", parse_accessor(), place);
  return node;
}

std::string Parser::parse_accessor() {
  std::string text;
  if (take("{")) {
    text = "{";
    for (int i = 0; !take("}"); ++i) {
      if (i == 2) fail("three numbers in braces", "write {index} or {row,column}");
      if (i > 0) {
        expect(",");
        text += ",";
      }
      if (lexer_.peek().kind != Token::Kind::kInteger) {
        fail(fmt::format("{} where a row or column should be", found()), "write {row,column}");
      }
      text += lexer_.next().text;
    }
    if (text.size() == 1) fail("empty braces", "write {index} or {row,column}");
    return text + "}";
  }
  do {
    if (!text.empty()) text += ".";
    if (lexer_.peek().kind == Token::Kind::kInteger) {
      text += lexer_.next().text;
    } else {
      text += expect_name("a part's name or index");
    }
  } while (take("."));
  return text;
}

Node Parser::parse_view() {
  Node node = begin("view");
  lexer_.next();
  const Place place = lexer_.place();
  const std::string path = parse_qualified("PROTOTYPE.MEMBER");
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) {
    throw Error(Problem{place,
                        {},
                        fmt::format("'{}' names no member", path),
                        "write PROTOTYPE.MEMBER",
                        Severity::kError,
                        {}});
  }
  add_here(node, "prototype", path.substr(0, dot), place);
  add_here(node, "member", path.substr(dot + 1), place);
  expect("->");
  add_qualified(node, "target", "the prototype of the part");
  const bool equals = take("=");
  if (equals && !at("{")) {
    add_qualified(node, "function", "a function");
    return node;
  }
  parse_braces(node, [&] { return parse_entry(); });
  return node;
}

Node Parser::parse_conversion() {
  Node node = begin("conversion");
  lexer_.next();
  add_qualified(node, "from", "a prototype");
  expect("->");
  add_qualified(node, "to", "a prototype");
  expect("=");
  add_qualified(node, "function", "a function");
  if (at("{")) {
    parse_braces(node, [&] { return parse_setting(); });
  }
  return node;
}

// relation tool in base = PROTOTYPE [ { part = const number } ]
Node Parser::parse_relation() {
  Node node = begin("relation");
  lexer_.next();
  node.add("frame", expect_name("a frame"));
  if (!take_word("in")) {
    fail(fmt::format("{} where 'in' should be", found()), "write relation FRAME in FRAME");
  }
  node.add("reference", expect_name("a frame"));
  expect("=");
  add_qualified(node, "prototype", "a prototype");
  if (at("{")) {
    node.add("constant", "const");
    parse_braces(node, [&] { return parse_entry(); });
  }
  return node;
}

// name = number | word | "text"
Node Parser::parse_setting() {
  Node node = begin("setting");
  node.add("name", expect_name("a setting's name"));
  expect("=");
  const Place place = lexer_.place();
  if (lexer_.peek().kind == Token::Kind::kString) {
    add_here(node, "text", lexer_.next().text, place);
  } else if (lexer_.peek().kind == Token::Kind::kName) {
    add_here(node, "word", lexer_.next().text, place);
  } else {
    add_here(node, "number", lexer_.number(), place);
  }
  return node;
}

Node Parser::parse_fproto() {
  Node node = begin("fproto");
  lexer_.next();
  node.add("name", expect_name("the function's name"));
  if (at("<") || at("(")) {
    fail("a composed fproto belongs to the composition of functions, which is not read here",
         "describe a function of a library: fproto NAME :: c99 { … }");
  }
  if (take("::") && !at("{"))
    node.add("context", expect_name("the function's language, as in c99"));
  parse_braces(node, [&] {
    if (!at_word("args")) return parse_setting();
    Node arguments = begin("args");
    lexer_.next();
    take("=");
    parse_braces(arguments, [&] { return parse_argument(); });
    return arguments;
  });
  return node;
}

// position <= | => | <=> prototype
Node Parser::parse_argument() {
  Node node = begin("argument");
  if (lexer_.peek().kind != Token::Kind::kInteger) {
    fail(fmt::format("{} where an argument's position should be", found()), "write 1 <= PROTOTYPE");
  }
  node.add("position", lexer_.next().text);
  for (const char* direction : {"<=>", "<=", "=>"}) {
    if (!take(direction)) continue;
    node.add("direction", direction);
    add_qualified(node, "prototype", "a prototype");
    return node;
  }
  fail(fmt::format("{} where a direction should be", found()),
       "write <= for an input, => for an output");
}

std::string Parser::parse_qualified(std::string_view what) {
  std::string name = expect_name(what);
  while (take(".")) name += "." + expect_name("a name");
  return name;
}

// ---- words ----

Node Parser::begin(std::string kind) const {
  Node node;
  node.kind = std::move(kind);
  node.place = lexer_.place();
  return node;
}

bool Parser::at(std::string_view mark) const {
  return lexer_.peek().kind == Token::Kind::kMark && lexer_.peek().text == mark;
}

bool Parser::at_word(std::string_view word) const {
  return lexer_.peek().kind == Token::Kind::kName && lexer_.peek().text == word;
}

bool Parser::take(std::string_view mark) {
  if (!at(mark)) return false;
  lexer_.next();
  return true;
}

bool Parser::take_word(std::string_view word) {
  if (!at_word(word)) return false;
  lexer_.next();
  return true;
}

void Parser::expect(std::string_view mark) {
  if (take(mark)) return;
  fail(at_end() ? fmt_end(mark) : fmt::format("{} where '{}' should be", found(), mark));
}

std::string Parser::expect_name(std::string_view what) {
  if (lexer_.peek().kind == Token::Kind::kName) return lexer_.next().text;
  fail(fmt::format("{} where {} should be", found(), what));
}

std::string Parser::expect_string(std::string_view what) {
  if (lexer_.peek().kind == Token::Kind::kString) return lexer_.next().text;
  fail(fmt::format("{} where {} should be", found(), what), "put it into quotation marks");
}

std::string Parser::found() const {
  return at_end() ? "the file ends" : fmt::format("'{}'", lexer_.peek().text);
}

std::string Parser::fmt_end(std::string_view mark) {
  return fmt::format("the file ends where '{}' should be", mark);
}

void Parser::fail(std::string what, std::string remedy) const {
  lexer_.fail(lexer_.place(), std::move(what), std::move(remedy));
}

void Parser::add_qualified(Node& node, std::string name, std::string_view what) {
  const Place place = lexer_.place();
  add_here(node, std::move(name), parse_qualified(what), place);
}

void Parser::add_here(Node& node, std::string name, std::string value, const Place& place) const {
  node.add(std::move(name), std::move(value), place);
}

}  // namespace sinew::blocks
