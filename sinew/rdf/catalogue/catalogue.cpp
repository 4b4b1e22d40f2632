#include "sinew/rdf/catalogue/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <span>
#include <utility>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/rdf/json/reader.h"

namespace sinew::catalogue {

// Made from metamodels/ at build time: path and text of each file.
std::span<const std::pair<std::string_view, std::string_view>> embedded_metamodels();

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(Place place, std::string iri, std::string what, std::string remedy) {
  throw Error(Problem{std::move(place), std::move(iri), std::move(what), std::move(remedy),
                      Severity::kError, "loading document failed"});
}

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (!stream || error) fail({path.string(), 0, 0}, "", "cannot read the file", "a readable file");
  if (size > kMaxFileBytes) {
    fail({path.string(), 0, 0}, "", fmt::format("larger than {} MiB", kMaxFileBytes >> 20),
         "smaller files");
  }
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  return text;
}

// The entries of a catalog.json, in its order.
struct Entry {
  std::string iri;
  std::string path;
  Place place;
};

std::vector<Entry> read_index(std::string_view text, const std::string& file) {
  const json::Document index = json::read(text, file);
  const auto place = [&](json::Position position) {
    return Place{file, position.line, position.column};
  };
  if (!index.root.is_object()) {
    fail(place(index.root.position()), "", "a catalogue is one JSON object",
         "{ \"IRI\": \"path\", ... }");
  }
  std::vector<Entry> entries;
  for (const json::Member& member : index.root.members()) {
    if (!member.value.is_string()) {
      fail(place(member.value.position()), std::string(member.name()),
           "the path of a document is not a string",
           "a path relative to the catalogue's directory");
    }
    entries.push_back({std::string(member.name()), std::string(member.value.text()),
                       place(member.value.position())});
  }
  return entries;
}

bool leads_outside(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

bool is_document(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".json" || extension == ".jsonld" || extension == ".ttl";
}

// The documents below a folder, as paths relative to it, in lexicographic order.
std::vector<fs::path> documents_below(const fs::path& folder) {
  std::vector<fs::path> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_document(entry.path())) continue;
    result.push_back(entry.path().lexically_relative(folder));
    if (result.size() > kMaxFiles) {
      fail({folder.string(), 0, 0}, "", fmt::format("more than {} documents", kMaxFiles),
           "a catalog.json that names the ones you need");
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

Catalogue::Catalogue() {
  const auto files = embedded_metamodels();
  const auto text_of = [&](std::string_view path) {
    const auto found = std::find_if(files.begin(), files.end(),
                                    [&](const auto& file) { return file.first == path; });
    return found == files.end() ? nullptr : &found->second;
  };
  const std::string_view* index = text_of("catalog.json");
  if (index == nullptr) return;
  for (Entry& entry : read_index(*index, "metamodels/catalog.json")) {
    const std::string_view* text = text_of(entry.path);
    if (text == nullptr) {
      fail(entry.place, entry.iri, fmt::format("there is no file metamodels/{}", entry.path),
           "the path of a file that exists");
    }
    Document document{entry.iri, "metamodels/" + entry.path, *text};
    documents_.insert_or_assign(std::move(entry.iri), std::move(document));
  }
}

Catalogue Catalogue::without_metamodels() { return Catalogue(Empty{}); }

void Catalogue::add(std::string iri, std::string file, std::string text) {
  texts_.push_back(std::move(text));
  Document document{iri, std::move(file), texts_.back()};
  documents_.insert_or_assign(std::move(iri), std::move(document));
}

void Catalogue::add_file(std::string iri, const fs::path& path) {
  add(std::move(iri), path.string(), read_file(path));
}

void Catalogue::add_directory(const fs::path& directory) {
  if (!fs::is_directory(directory)) {
    fail({directory.string(), 0, 0}, "", "not a directory",
         "a directory of contexts, with a catalog.json that says which IRI is which file");
  }
  const fs::path index = directory / "catalog.json";
  std::vector<Entry> entries = {{std::string(kPublishedMetamodels), ".", {}}};
  if (fs::exists(index)) entries = read_index(read_file(index), index.string());

  for (Entry& entry : entries) {
    if (leads_outside(entry.path)) {
      fail(entry.place, entry.iri, fmt::format("\"{}\" leads out of the catalogue", entry.path),
           "a path below the catalogue's directory");
    }
    const fs::path path = (directory / entry.path).lexically_normal();
    if (!entry.iri.ends_with('/')) {
      if (!fs::is_regular_file(path)) {
        fail(entry.place, entry.iri, fmt::format("there is no file {}", path.string()),
             "the path of a file that exists");
      }
      add_file(std::move(entry.iri), path);
    } else if (!fs::is_directory(path)) {
      fail(entry.place, entry.iri, fmt::format("there is no directory {}", path.string()),
           "the path of a directory, because the IRI ends with '/'");
    } else {
      for (const fs::path& name : documents_below(path)) {
        add_file(entry.iri + name.generic_string(), path / name);
      }
    }
  }
}

const Document* Catalogue::find(std::string_view iri) const {
  const auto found = documents_.find(iri);
  return found == documents_.end() ? nullptr : &found->second;
}

}  // namespace sinew::catalogue
