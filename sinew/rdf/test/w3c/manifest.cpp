#include "manifest.h"

#include "report.h"
#include "sinew/base/error.h"
#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::rdf::w3c {
namespace {

using graph::Id;

const Prefixes& manifest_prefixes() {
  static const Prefixes prefixes{
      {"rdf", "http://www.w3.org/1999/02/22-rdf-syntax-ns#"},
      {"rdfs", "http://www.w3.org/2000/01/rdf-schema#"},
      {"mf", "http://www.w3.org/2001/sw/DataAccess/tests/test-manifest#"},
      {"qt", "http://www.w3.org/2001/sw/DataAccess/tests/test-query#"},
      {"ut", "http://www.w3.org/2009/sparql/tests/test-update#"},
      {"rdft", "http://www.w3.org/ns/rdftest#"},
      {"sht", "http://www.w3.org/ns/shacl-test#"},
  };
  return prefixes;
}

std::string last_part(std::string_view iri) {
  return std::string(iri.substr(iri.find_last_of("#/") + 1));
}

}  // namespace

Manifest::Manifest(const std::filesystem::path& file) {
  const std::string iri = file_iri(file.string());
  read_rdf(read_file(file), Syntax::kTurtle, {file.string(), iri, {}}, store_.terms(),
           [&](const graph::Quad& quad, std::size_t, std::size_t) { store_.add(quad); });
  self_ = store_.terms().iri(iri);
  for (const Id node : list(one(self_, "mf:entries"))) {
    ManifestTest test;
    test.node = node;
    test.name = last_part(store_.terms().text(node));
    if (const Id kind = one(node, "rdf:type")) test.kind = last_part(store_.terms().text(kind));
    test.action = one(node, "mf:action");
    test.result = one(node, "mf:result");
    tests_.push_back(std::move(test));
  }
}

std::vector<std::filesystem::path> Manifest::included() const {
  std::vector<std::filesystem::path> files;
  for (const Id object : all(self_, "mf:include")) {
    if (one(object, "rdf:rest")) {
      for (const Id element : list(object)) files.push_back(file(element));
    } else {
      files.push_back(file(object));
    }
  }
  return files;
}

Id Manifest::find(std::string_view name) const {
  const auto iri = manifest_prefixes().expand(name);
  return store_.terms().find_iri(iri ? *iri : name);
}

std::vector<Id> Manifest::all(Id subject, std::string_view property) const {
  std::vector<Id> objects;
  const Id predicate = find(property);
  if (!predicate || !subject) return objects;
  store_.view().match(subject, predicate, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
    objects.push_back(quad.object);
    return true;
  });
  return objects;
}

Id Manifest::one(Id subject, std::string_view property) const {
  const std::vector<Id> objects = all(subject, property);
  return objects.empty() ? Id{} : objects.front();
}

std::vector<Id> Manifest::list(Id head) const {
  std::vector<Id> elements;
  for (Id cell = head; one(cell, "rdf:rest"); cell = one(cell, "rdf:rest")) {
    elements.push_back(one(cell, "rdf:first"));
  }
  return elements;
}

std::optional<std::string> Manifest::text(Id subject, std::string_view property) const {
  const Id object = one(subject, property);
  if (!object) return std::nullopt;
  return std::string(store_.terms().text(object));
}

std::filesystem::path Manifest::file(Id iri) const {
  return path_of_file_iri(store_.terms().text(iri));
}

std::filesystem::path path_of_file_iri(std::string_view iri) {
  constexpr std::string_view kScheme = "file://";
  if (!iri.starts_with(kScheme)) {
    throw Error(Problem{{}, std::string(iri), "is no file", "", Severity::kError, {}});
  }
  iri.remove_prefix(kScheme.size());
  std::string path;
  for (std::size_t i = 0; i < iri.size(); ++i) {
    if (iri[i] == '%' && i + 2 < iri.size()) {
      path += static_cast<char>(hex_digit_value(iri[i + 1]) * 16 + hex_digit_value(iri[i + 2]));
      i += 2;
    } else {
      path += iri[i];
    }
  }
  return path;
}

}  // namespace sinew::rdf::w3c
