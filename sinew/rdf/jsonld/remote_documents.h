// The context documents that a document refers to, found in the catalogue, each read once. May be
// shared between the documents that are processed one after the other.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/jsonld/errors.h"

namespace sinew::jsonld {

struct RemoteDocument {
  std::string url;
  json::Document document;
  json::Value context;  // the value of its @context
  Source source() const { return {document.file, url}; }
};

class RemoteDocuments {
 public:
  // The catalogue must outlive this. With `local_files`, an IRI of the form file:///… that is not
  // in the catalogue is read from the disk: a context that lies beside the model that uses it.
  explicit RemoteDocuments(const catalogue::Catalogue& catalogue, bool local_files = false)
      : catalogue_(catalogue), local_files_(local_files) {}

  // The document behind an absolute IRI, which must be an object with an @context. Throws Error,
  // blaming `named_at`, the place that names the IRI.
  const RemoteDocument& context_document(std::string_view url, const Place& named_at);

 private:
  std::unique_ptr<RemoteDocument> load(std::string_view url, const Place& named_at);

  const catalogue::Catalogue& catalogue_;
  bool local_files_;
  std::map<std::string, std::unique_ptr<RemoteDocument>, std::less<>> loaded_;
};

}  // namespace sinew::jsonld
