// The block language as a tree: what a file says, in its order, with comments and places, and
// nothing resolved. The parser makes it, the formatter prints it, the graph holds it, and
// elaborate.h gives it meaning.
//
// Every node has a kind, texts by name, and children (after the colon):
//
// - file, module(name): items
// - import(file, as)
// - domain(name): annotation, composite, coordinates, formula, convention, older
// - annotation(name, optional, value…), composite(name, member…), convention(name, of…),
// older(name)
// - coordinates(name, of…, form): parameter(name, unit | constant)
// - formula(from, to, of, loses, text)
// - ddr(name, context, text)
// - algebraic(name, form)
// - units(name, ontology, algebraic): unit(unit, accessor)
// - alias(left, right): entry(left, sign, right | constant)
// - dproto(name, domain): semantic(value), coord(value), algebraic(value | form),
//   ddr and usingddr(value | context, text), dr: entry, units(value | ontology, algebraic): unit,
//   composes and convention: member(name, value)
// - view(prototype, member, target, function): entry
// - conversion(from, to, function): setting(name, number | word | text)
// - fproto(name, context): setting, args: argument(position, direction, prototype)
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::blocks {

// How deep modules and raw braces may be nested, and how long a file may be.
constexpr std::size_t kMaximumNesting = 32;
constexpr std::size_t kMaximumFileSize = std::size_t{16} * 1024 * 1024;

struct Text {
  std::string name;
  std::string value;
  Place place;
};

struct Node {
  std::string kind;
  Place place;
  std::vector<std::string> comments;  // before it, as written with their marks; "" is a blank line
  std::string remark;                 // the comment behind it on its last line
  std::vector<std::string> end_comments;  // before its closing brace, or the end of the file
  std::vector<Text> texts;                // a name may repeat: a list
  std::vector<Node> children;

  // The first text of this name; empty when there is none.
  const std::string& text(std::string_view name) const;
  Place place_of(std::string_view name) const;  // the node's own place when there is no such text
  bool has(std::string_view name) const;
  std::vector<std::string> all(std::string_view name) const;
  const Node* child(std::string_view kind) const;  // the first one; null when there is none
  void add(std::string name, std::string value, Place place = {});
};

// Equal in everything but places.
bool same(const Node& a, const Node& b);

}  // namespace sinew::blocks
