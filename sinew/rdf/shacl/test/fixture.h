// Shapes and data in Turtle in, a report out; for all tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/places.h"
#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/shacl/shapes.h"
#include "sinew/rdf/shacl/validation.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::shacl {

inline constexpr std::string_view kPrefixes = R"(
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix sh: <http://www.w3.org/ns/shacl#> .
@prefix ex: <http://example.org/> .
)";

// The data is the unnamed graph, the shapes are the named graph ex:shapes.
class Shacl : public ::testing::Test {
 protected:
  void load(std::string_view turtle, Id graph, const std::string& file) {
    const std::uint32_t number = places.add_file(file);
    graph::Transaction transaction = store.begin();
    // The prefixes stand on one line, so that line 1 is the first of the text.
    std::string text(kPrefixes);
    for (char& c : text) {
      if (c == '\n') c = ' ';
    }
    read_rdf(text + std::string(turtle), Syntax::kTurtle, {file, "http://example.org/", graph},
             store.terms(), [&](const graph::Quad& quad, std::size_t line, std::size_t column) {
               transaction.add(quad);
               places.note(quad.subject, quad.predicate, number, static_cast<std::uint32_t>(line),
                           static_cast<std::uint32_t>(column));
             });
    transaction.commit();
  }
  Id iri(std::string_view local) {
    return store.terms().iri("http://example.org/" + std::string(local));
  }
  GraphReader data() const { return GraphReader(store.view(), graph::Dataset::kDefault); }

  Shapes parse(std::string_view shapes_turtle) {
    load(shapes_turtle, iri("shapes"), "shapes.ttl");
    return parse_shapes(store, GraphReader(store.view(), iri("shapes")), &places);
  }
  ValidationReport validate_text(std::string_view shapes_turtle, std::string_view data_turtle) {
    load(data_turtle, {}, "data.ttl");
    return validate(parse(shapes_turtle), data());
  }
  // "focus value" of each result, with the prefix of ex: left out; "-" for no value.
  std::vector<std::string> results(std::string_view shapes_turtle, std::string_view data_turtle) {
    return results(validate_text(shapes_turtle, data_turtle));
  }
  std::vector<std::string> results(const ValidationReport& report) {
    std::vector<std::string> lines;
    for (const Result& result : report.results) {
      lines.push_back(name(result.focus_node) + " " + (result.value ? name(result.value) : "-"));
    }
    return lines;
  }
  std::string name(Id id) const {
    const std::string_view text = store.terms().text(id);
    constexpr std::string_view kEx = "http://example.org/";
    return std::string(text.starts_with(kEx) ? text.substr(kEx.size()) : text);
  }
  // The message of the Error that parsing these shapes throws.
  std::string fault(std::string_view shapes_turtle) {
    try {
      parse(shapes_turtle);
    } catch (const Error& error) {
      return error.what();
    }
    return "no fault";
  }

  graph::Store store;
  graph::Places places;
};

using Lines = std::vector<std::string>;

}  // namespace sinew::rdf::shacl
