// The syntax tree as nodes of the graph, and back, without loss: prototypes, forms, units,
// functions and domains have IRIs (the file's own, then the qualified name), everything else hangs
// below them. Comments are kept.
//
// One thing is normalised on the way: references are to the item that they mean, so on the way back
// each is written with the shortest name that means it.
#pragma once

#include <string>

#include "sinew/blocks/syntax.h"
#include "sinew/graph/store.h"

namespace sinew::blocks {

// Adds the file's nodes to the unnamed graph; returns the file's node. `base` is its IRI, and the
// beginning of every item's: "https://example.org/arm/". Throws Error when two items have one name.
graph::Id to_graph(const Node& file, const std::string& base, graph::Store& store);

// The tree of a file's node; with the null Id of the only data:File there is. `name` is the file's
// name for errors. Throws Error for what the graph says and the language does not.
Node from_graph(const graph::View& view, graph::Id file, const std::string& name);

// JSON-LD text and back, with the context https://w3id.org/sinew/data.json.
std::string to_jsonld(const Node& file, const std::string& base);
Node from_jsonld(std::string_view text, const std::string& name);

// The IRI that a file has when nobody gives one: https://w3id.org/sinew/files/STEM/.
std::string default_base(const std::string& file);

}  // namespace sinew::blocks
