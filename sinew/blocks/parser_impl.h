// The parser's methods, by recursive descent. Internal to the module.
#pragma once

#include <string>
#include <vector>

#include "sinew/blocks/lexer.h"
#include "sinew/blocks/parser.h"

namespace sinew::blocks {

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : lexer_(text, file) {}
  Node parse_file();

 private:
  // parser.cpp
  void parse_items(Node& parent, std::size_t depth);
  Node parse_item(std::size_t depth);
  void recover();
  Node parse_import();
  Node parse_module(std::size_t depth);
  Node parse_ddr();
  Node parse_algebraic();
  Node parse_units();
  Node parse_alias();
  Node parse_view();
  Node parse_conversion();
  Node parse_relation();
  Node parse_fproto();
  Node parse_argument();
  Node parse_setting();

  // parser_domain.cpp
  Node parse_domain();
  Node parse_domain_entry();
  Node parse_coordinates();
  Node parse_formula();
  std::string parse_formula_side();
  Node parse_rule();
  Node parse_change();
  void parse_text(Node& node, std::string name);
  void parse_semantics(Node& node);

  // parser_prototype.cpp
  Node parse_dproto();
  Node parse_field();
  void parse_representation(Node& node);
  void parse_representation_text(Node& node);
  Node parse_member();

  // What several items use.
  std::string parse_form();
  void parse_units_body(Node& node);
  Node parse_unit();
  Node parse_entry();
  std::string parse_accessor();  // in its normal form
  std::string parse_qualified(std::string_view what);

  // "{ entry { [sep] entry } }"
  template <typename ParseEntry>
  void parse_braces(Node& node, ParseEntry&& parse_entry) {
    expect("{");
    while (!at("}")) {
      if (at_end()) fail(fmt_end("}"));
      Node entry;
      std::vector<std::string> comments = lexer_.take_comments();
      entry = parse_entry();
      entry.comments.insert(entry.comments.begin(), comments.begin(), comments.end());
      if (!take(",")) take(";");
      if (entry.remark.empty()) entry.remark = lexer_.take_remark();
      node.children.push_back(std::move(entry));
    }
    node.end_comments = lexer_.take_comments();
    expect("}");
  }

  Node begin(std::string kind) const;
  bool at(std::string_view mark) const;
  bool at_word(std::string_view word) const;
  bool at_end() const { return lexer_.peek().kind == Token::Kind::kEnd; }
  bool take(std::string_view mark);
  bool take_word(std::string_view word);
  void expect(std::string_view mark);
  std::string expect_name(std::string_view what);
  std::string expect_string(std::string_view what);
  std::string found() const;  // the next word, for messages
  static std::string fmt_end(std::string_view mark);
  [[noreturn]] void fail(std::string what, std::string remedy = {}) const;
  void add_here(Node& node, std::string name, std::string value, const Place& place) const;
  void add_qualified(Node& node, std::string name, std::string_view what);  // the name that follows

  Lexer lexer_;
  Report report_;
};

}  // namespace sinew::blocks
