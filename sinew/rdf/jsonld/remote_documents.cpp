#include "sinew/rdf/jsonld/remote_documents.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "sinew/base/spelling.h"
#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/jsonld/keywords.h"

namespace sinew::jsonld {
namespace {

constexpr std::string_view kFileScheme = "file://";

std::string undo_percent_encoding(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = i + 2 < text.size() ? rdf::hex_digit_value(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? rdf::hex_digit_value(text[i + 2]) : -1;
    if (text[i] == '%' && high >= 0 && low >= 0) {
      result += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string remedy_for_unknown(std::string_view url, const catalogue::Catalogue& catalogue) {
  std::vector<std::string> known;
  for (const auto& [iri, document] : catalogue.documents()) known.emplace_back(iri);
  std::string directory = "give the directory that holds it with --catalog DIR";
  const auto close = close_spellings(url, known, 1);
  if (close.empty()) return directory;
  return fmt::format("did you mean {}? Otherwise {}", close.front(), directory);
}

}  // namespace

const RemoteDocument& RemoteDocuments::context_document(std::string_view url,
                                                        const Place& named_at) {
  const auto found = loaded_.find(url);
  if (found != loaded_.end()) return *found->second;
  auto document = load(url, named_at);
  return *loaded_.emplace(std::string(url), std::move(document)).first->second;
}

std::unique_ptr<RemoteDocument> RemoteDocuments::load(std::string_view url, const Place& named_at) {
  std::string file, from_disk;
  std::string_view text;
  if (const catalogue::Document* document = catalogue_.find(url)) {
    file = document->file;
    text = document->text;
  } else if (local_files_ && url.starts_with(kFileScheme)) {
    file = undo_percent_encoding(url.substr(kFileScheme.size()));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      fail(code::kLoadingRemoteContextFailed, named_at, std::string(url),
           fmt::format("there is no context file {}", file), "the path of a file that exists");
    }
    from_disk.assign(std::istreambuf_iterator<char>(stream), {});
    text = from_disk;
  } else {
    fail(code::kLoadingRemoteContextFailed, named_at, std::string(url),
         "no such document in the catalogue (nothing is fetched from a network)",
         remedy_for_unknown(url, catalogue_));
  }

  auto result = std::make_unique<RemoteDocument>();
  result->url = url;
  try {
    result->document = json::read(text, file);
  } catch (const Error& error) {
    Problem problem = error.problems().front();
    problem.code = code::kLoadingRemoteContextFailed;
    throw Error(std::move(problem));
  }
  const json::Value* context = result->document.root.find(keyword::kContext);
  if (context == nullptr) {
    fail(code::kInvalidRemoteContext, place_in(result->source(), result->document.root.position()),
         std::string(url), "the document is used as a context but has no \"@context\"",
         "{ \"@context\": { ... } }");
  }
  result->context = *context;
  return result;
}

}  // namespace sinew::jsonld
