// Manifests of the W3C suites that are written in Turtle, read with our own reader into a store.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::rdf::w3c {

struct ManifestTest {
  graph::Id node;
  std::string name;  // the last part of its IRI, after '#' or '/'
  std::string kind;  // the last part of its rdf:type
  graph::Id action, result;
};

class Manifest {
 public:
  // Relative IRIs in the manifest are resolved against the file's own IRI.
  explicit Manifest(const std::filesystem::path& file);

  // In the order of mf:entries.
  const std::vector<ManifestTest>& tests() const { return tests_; }
  // The files of mf:include, as a list or one by one, in this order.
  std::vector<std::filesystem::path> included() const;

  graph::Id self() const { return self_; }  // the manifest's own node
  const graph::Store& store() const { return store_; }
  // Objects of a property. Names may be shortened with the prefixes mf, qt, ut, rdf, rdfs, rdft,
  // sht.
  std::vector<graph::Id> all(graph::Id subject, std::string_view property) const;
  graph::Id one(graph::Id subject, std::string_view property) const;  // or 0
  std::vector<graph::Id> list(graph::Id head) const;
  // The first object's text, if there is one.
  std::optional<std::string> text(graph::Id subject, std::string_view property) const;
  // The file that an IRI of the manifest stands for. Throws Error when it is no file IRI.
  std::filesystem::path file(graph::Id iri) const;

 private:
  graph::Id find(std::string_view name) const;

  graph::Store store_;
  graph::Id self_;
  std::vector<ManifestTest> tests_;
};

// The path of a file IRI, percent-decoded. Throws Error for any other IRI.
std::filesystem::path path_of_file_iri(std::string_view iri);

}  // namespace sinew::rdf::w3c
