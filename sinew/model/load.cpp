#include "sinew/model/load.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "sinew/model/urdf.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::model {
namespace {

Problem problem(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, "", std::move(what), std::move(remedy), Severity::kError, {}};
}

void load_turtle(const Source& source, graph::Terms& terms, graph::Transaction& transaction,
                 graph::Places& places) {
  const std::uint32_t file = places.add_file(source.name);
  rdf::ReadOptions options;
  options.file = source.name;
  const auto sink = [&](const graph::Quad& quad, std::size_t line, std::size_t column) {
    transaction.add(quad);
    places.note(quad.subject, quad.predicate, file, static_cast<std::uint32_t>(line),
                static_cast<std::uint32_t>(column));
  };
  rdf::read_rdf(source.text, *rdf::syntax_of_file(source.name), options, terms, sink);
}

}  // namespace

FileKind kind_of_file(std::string_view name) {
  const auto ends = [&](std::initializer_list<std::string_view> suffixes) {
    for (const std::string_view suffix : suffixes) {
      if (name.ends_with(suffix)) return true;
    }
    return false;
  };
  if (ends({".json", ".jsonld"})) return FileKind::kJsonLd;
  if (ends({".urdf", ".xml"})) return FileKind::kUrdf;
  return rdf::syntax_of_file(name) ? FileKind::kTurtle : FileKind::kUnknown;
}

Source read_source(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code fault;
  if (!in || std::filesystem::is_directory(file, fault)) {
    throw Error(problem(file.string(), "the file cannot be read",
                        "name a file that exists and that you may read"));
  }
  return {file.string(), std::string(std::istreambuf_iterator<char>(in), {})};
}

void load(std::span<const Source> sources, const LoadOptions& options, graph::Store& store,
          graph::Places& places, Report& report) {
  catalogue::Catalogue catalogue;
  for (const std::filesystem::path& folder : options.catalogues) catalogue.add_directory(folder);
  jsonld::LoadOptions jsonld_options;
  jsonld_options.lenient = options.lenient;
  jsonld::Loader jsonld(catalogue, jsonld_options);
  graph::Transaction transaction = store.begin();
  const jsonld::QuadSink sink = [&](const graph::Quad& quad) { transaction.add(quad); };
  Report found;
  for (const Source& source : sources) {
    try {
      switch (kind_of_file(source.name)) {
        case FileKind::kJsonLd:
          jsonld.load(source.text, source.name, store.terms(), sink, &places, found);
          break;
        case FileKind::kTurtle:
          load_turtle(source, store.terms(), transaction, places);
          break;
        case FileKind::kUrdf:
          import_urdf(source.text, source.name, {options.urdf_base_iri, options.lenient},
                      store.terms(), transaction, places, found);
          break;
        case FileKind::kUnknown:
          found.add(problem(source.name, "the file's name does not say what it holds",
                            "end it with .jsonld, .json, .ttl, .trig, .nt, .nq, .urdf or .xml"));
          break;
      }
    } catch (const Error& error) {
      for (const Problem& fault : error.problems()) found.add(fault);
    }
  }
  for (const Problem& fault : found.problems()) report.add(fault);
  if (!found.has_errors()) transaction.commit();
}

void load_files(std::span<const std::filesystem::path> files, const LoadOptions& options,
                graph::Store& store, graph::Places& places, Report& report) {
  std::vector<Source> sources;
  for (const std::filesystem::path& file : files) {
    try {
      sources.push_back(read_source(file));
    } catch (const Error& error) {
      for (const Problem& fault : error.problems()) report.add(fault);
    }
  }
  if (sources.size() == files.size()) load(sources, options, store, places, report);
}

}  // namespace sinew::model
