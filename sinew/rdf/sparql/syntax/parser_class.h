// The recursive-descent parser; its parts lie in parse_*.cpp, one for each region of the grammar.
// Private to this folder.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/sparql/syntax/ast.h"
#include "sinew/rdf/sparql/syntax/lexer.h"
#include "sinew/rdf/sparql/syntax/parser.h"
#include "sinew/rdf/sparql/syntax/scope.h"

namespace sinew::rdf::sparql::syntax {

class Parser {
 public:
  Parser(graph::Terms& terms, std::string_view text, const ParseOptions& options);
  Query query();    // parse_query.cpp
  Update update();  // parse_update.cpp

 private:
  // --- Tokens (parser_tokens.cpp) ---
  void advance();
  bool at(std::string_view punctuation) const {
    return token_.kind == TokenKind::kPunctuation && token_.text == punctuation;
  }
  bool at_word(std::string_view word) const {
    return token_.kind == TokenKind::kWord && token_.text == word;
  }
  bool accept(std::string_view punctuation);
  bool accept_word(std::string_view word);
  void expect(std::string_view punctuation, std::string_view where);
  void expect_word(std::string_view word, std::string_view where);
  std::string describe_token() const;
  [[noreturn]] void fail(std::string what, std::string remedy) const;
  [[noreturn]] void fail_at(std::size_t offset, std::string what, std::string remedy) const;
  // Counts one level of nesting for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser);
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  // --- Terms (parse_terms.cpp) ---
  void prologue();
  bool at_iri() const { return token_.kind == TokenKind::kIri || token_.kind == TokenKind::kName; }
  graph::Id iri();
  std::string iri_text();
  bool at_literal() const;
  graph::Id literal();
  graph::Id numeric_literal(std::string_view sign);
  graph::Id boolean_or_number_or_string();
  bool at_variable() const { return token_.kind == TokenKind::kVariable; }
  Variable variable();
  Variable variable_named(std::string_view name, bool hidden);
  Variable fresh_variable();
  Node variable_or_iri();
  Node blank_node(std::string_view label, std::size_t offset);
  Node fresh_blank_node();

  // --- Triples (parse_triples.cpp) ---
  enum class TripleMode : std::uint8_t { kPattern, kTemplate, kData };
  void triples_same_subject(std::vector<Triple>& out);
  void property_list(Node subject, std::vector<Triple>& out);
  void object_list(Node subject, const Triple& verb, std::vector<Triple>& out);
  bool at_verb() const;
  void verb(Triple& into);
  bool at_graph_node() const;
  Node graph_node(std::vector<Triple>& out);
  Node collection(std::vector<Triple>& out);
  Node blank_node_property_list(std::vector<Triple>& out);
  void add_triple(Node subject, const Triple& verb, Node object, std::size_t offset,
                  std::vector<Triple>& out);

  // --- Paths (parse_paths.cpp) ---
  Path path();
  Path path_sequence();
  Path path_element();
  Path path_primary();
  Path path_negated_set();
  void path_one_in_set(Path& into);

  // --- Groups (parse_groups.cpp) ---
  std::shared_ptr<const Group> group();  // opens and closes the scope
  void group_elements(Group& into);
  void group_element(Group& into);
  void triples_block(Group& into);
  void bind(Group& into);
  void filter(Group& into);
  void group_or_union(Group& into);
  void graph_or_service(Group& into, bool is_service);
  Values values_block();
  Values inline_data();  // scope and checks
  void end_of_basic_pattern() { ++basic_pattern_; }

  // --- Expressions (parse_expressions.cpp, parse_calls.cpp) ---
  Expression expression();
  Expression or_expression();
  Expression and_expression();
  Expression relational_expression();
  struct Row {
    std::string_view marks[2];
    Operator operators[2];
    const char* called;  // in errors: "sums"
    Expression (Parser::*operand)();
  };
  Expression row_of(const Row& row);
  Expression additive_expression();
  Expression multiplicative_expression();
  Expression unary_expression();
  Expression primary_expression();
  Expression bracketted_expression();
  Expression constraint();
  bool at_constraint() const;
  Expression builtin_call();
  Expression aggregate(const Builtin& builtin);
  Expression exists(bool negated);
  Expression iri_or_function();
  std::vector<Expression> expression_list();
  void argument_list(Expression& call);
  Expression make(Operator op, std::size_t offset) const;
  Expression chain(Operator op, std::size_t offset, Expression left, Expression right);

  // --- Queries (parse_query.cpp, parse_modifiers.cpp) ---
  void select_clause(Select& select);
  void where_clause(Select& select);
  void solution_modifiers(Select& select);
  void group_clause(Select& select);
  void order_clause(Select& select);
  void limit_and_offset(Select& select);
  void finish_select(Select& select);
  void check_projection(const Select& select);
  std::shared_ptr<const Select> sub_select();
  void dataset_clauses(DatasetClause& into, std::string_view keyword);
  void construct_form(Query& query);
  void describe_form(Query& query);
  Template template_of(const std::vector<Triple>& triples, Node graph);
  bool is_parameter(Variable variable) const;

  // --- Updates (parse_update.cpp) ---
  Operation operation();
  void graph_management(Operation& operation);
  void delete_template(Template& into);
  void modify(Operation& operation, bool may_insert);
  void delete_where(Operation& operation);
  Template quads(TripleMode mode);
  void quads_block(Node graph, std::vector<Triple>& triples, Template& into);
  graph::Id graph_reference();
  graph::Id graph_or_default();
  std::shared_ptr<const Group> group_of(const Template& pattern);
  void begin_operation();

  graph::Terms& terms_;
  const ParseOptions& options_;
  std::shared_ptr<const Source> source_;
  Lexer lexer_;
  Token token_;
  std::size_t previous_end_ = 0;  // of the token before
  std::size_t depth_ = 0;

  std::string base_;
  Prefixes prefixes_;
  std::string text_;  // scratch for IRIs

  Names names_;
  std::unordered_map<std::string, Variable> variables_;
  ScopeStack scope_;

  TripleMode triple_mode_ = TripleMode::kPattern;
  struct Label {
    Node node;
    std::size_t basic_pattern;
  };
  std::unordered_map<std::string, Label> labels_;  // in patterns, or in the present template
  std::unordered_map<std::string, Label> template_labels_;  // aside
  std::unordered_map<std::string, Label> data_labels_;      // in the INSERT DATA of one request
  std::size_t basic_pattern_ = 0;
  std::uint32_t template_blanks_ = 0;

  bool aggregates_allowed_ = false;
  bool inside_aggregate_ = false;
  bool aggregate_seen_ = false;
};

}  // namespace sinew::rdf::sparql::syntax
