// A property graph on the store: nodes and edges that both have properties, ports and connectors.
// `pg:` = https://w3id.org/sinew/property-graph#
//
//   node        any term; its properties are its triples
//   edge        S label T, and E a pg:Edge ; pg:source S ; pg:label label ; pg:target T, where E
//   has
//               the edge's properties, so that several edges may link the same two nodes
//   port        P a pg:Port ; pg:of block ; pg:shows key…, a view on those of a block's properties
//   connector   C a pg:Connector ; pg:links P, Q, …, with properties that say what it means
//
// A relation that is to take part in relations itself becomes a node (`promote`): E a type ;
// source-role S ; target-role T. Its properties stay on E, so nothing is lost there and back.
//
// Writing goes through a Transaction and asks for no order: a port may be made before its block, a
// relation before what it relates. Whether all is well-formed is asked at the end (`check`), and
// whether relations have the arguments that their domain wants (domain.h).
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"

namespace sinew::graph {

inline constexpr std::string_view kPropertyGraph = "https://w3id.org/sinew/property-graph#";

// How edges of a label and nodes of a type say the same.
struct Promotion {
  Id label;                     // of the edge
  Id type;                      // of the node
  Id source_role, target_role;  // from the node to its arguments
};

struct Property {
  Id key, value;
  friend constexpr auto operator<=>(const Property&, const Property&) = default;
};

class PropertyGraph {
 public:
  // Reads and writes the unnamed graph, or the one given. Both must outlive it.
  PropertyGraph(Transaction& transaction, Terms& terms, Id graph = {});

  // ---- properties, of nodes, edges and connectors ----
  void set(Id element, Id key, Id value);  // in place of other values
  void add(Id element, Id key, Id value);  // beside them
  bool remove(Id element, Id key, Id value);
  // Without what the structure itself needs (types, arguments, pg:…), sorted. Of a promoted node
  // its arguments are not among them if `promotion` is given.
  std::vector<Property> properties(Id element, const Promotion* promotion = nullptr) const;

  // ---- edges ----
  void add_edge(Id edge, Id source, Id label, Id target);
  // With its properties. Error when it is none.
  void remove_edge(Id edge);
  bool is_edge(Id edge) const;
  std::vector<Id> edges(Id source, Id label, Id target) const;  // wildcard where 0

  // Errors: it is no edge, or none of that label.
  void promote(Id edge, const Promotion& promotion);
  // Errors: it is no such node, has not one argument of each role, or others link to it (edges
  // cannot be linked to).
  void demote(Id node, const Promotion& promotion);

  // ---- ports and connectors ----
  void add_port(Id port, Id block, std::span<const Id> keys);
  // What the port shows of its block, as it is now, sorted. Error when it is no port.
  std::vector<Property> read(Id port) const;
  // Error when the port does not show that key.
  void write(Id port, Id key, Id value);
  void connect(Id connector, std::span<const Id> ports);
  std::vector<Id> connected(Id port) const;  // other ports, by any connector; sorted

  // Edges without source, label, target, or the triple that they stand for; ports without one block
  // or a key; connectors of fewer than two ports, or of what is none.
  void check(Report& report) const;

 private:
  Id pg(std::string_view term) const;
  void put(Id subject, Id predicate, Id object);
  std::vector<Id> objects(Id subject, Id predicate) const;
  std::vector<Id> subjects(Id predicate, Id object) const;
  void drop_structure(Id edge);
  [[noreturn]] void refuse(Id element, std::string what, std::string remedy) const;

  Transaction& transaction_;
  Terms& terms_;
  Id graph_;
  Id type_, edge_, source_, label_, target_, port_, of_, shows_, connector_, links_;
};

}  // namespace sinew::graph
