// The documents that stand behind IRIs: contexts, shapes, models. This is all that an IRI can ever
// lead to: nothing is fetched from a network.
//
// The metamodels that ship with Sinew are part of the binary. A directory adds to them, and wins
// over them and over directories added before it. Its file catalog.json says which IRI is which
// file; a key that ends with '/' stands for every IRI below it and names a folder:
//
//   { "https://example.org/arm.json": "contexts/arm.json",
//     "https://example.org/robots/": "robots" }
//
// A directory without catalog.json stands in for the published metamodels: its file x/y.json
// answers https://comp-rob2b.github.io/metamodels/x/y.json.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace sinew::catalogue {

inline constexpr std::string_view kPublishedMetamodels = "https://comp-rob2b.github.io/metamodels/";

// Beyond these a directory is refused.
inline constexpr std::size_t kMaxFiles = 10'000;
inline constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;

struct Document {
  std::string iri;
  std::string file;  // for messages: a path, or "metamodels/…" for one that ships with Sinew
  std::string_view text;
};

class Catalogue {
 public:
  Catalogue();                            // the metamodels that ship with Sinew
  static Catalogue without_metamodels();  // empty, for tests and for processing other vocabularies
  Catalogue(Catalogue&&) = default;
  Catalogue& operator=(Catalogue&&) = default;

  // Throws Error where the directory or its catalog.json is at fault.
  void add_directory(const std::filesystem::path& directory);
  // One document; replaces what stood behind the IRI.
  void add(std::string iri, std::string file, std::string text);

  // nullptr when the catalogue has no such document. The document lives as long as the catalogue.
  const Document* find(std::string_view iri) const;
  const std::map<std::string, Document, std::less<>>& documents() const { return documents_; }

 private:
  struct Empty {};
  explicit Catalogue(Empty) {}
  void add_file(std::string iri, const std::filesystem::path& path);

  std::map<std::string, Document, std::less<>> documents_;
  std::deque<std::string> texts_;  // of the documents that are not part of the binary
};

}  // namespace sinew::catalogue
