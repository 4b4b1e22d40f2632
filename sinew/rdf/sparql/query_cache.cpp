#include <mutex>
#include <unordered_map>

#include "sinew/rdf/sparql/engine.h"

namespace sinew::rdf::sparql {

struct QueryCache::Data {
  explicit Data(graph::Store& of) : store(of) {}
  graph::Store& store;
  mutable std::mutex mutex;
  std::unordered_map<std::string, std::shared_ptr<const Prepared>> queries;
};

QueryCache::QueryCache(graph::Store& store) : data_(std::make_unique<Data>(store)) {}
QueryCache::~QueryCache() = default;

std::shared_ptr<const Prepared> QueryCache::prepare(std::string_view text,
                                                    std::span<const std::string_view> parameters,
                                                    graph::Dataset dataset) {
  // No name and no query holds a null byte.
  std::string key = dataset == graph::Dataset::kUnion ? "u" : "d";
  for (const std::string_view parameter : parameters) key.append(1, '\0').append(parameter);
  key.append(1, '\0').append(text);
  const std::lock_guard lock(data_->mutex);
  if (const auto found = data_->queries.find(key); found != data_->queries.end()) {
    return found->second;
  }
  auto made = sparql::prepare(data_->store, text, parameters, dataset);
  if (data_->queries.size() >= kMostQueries) data_->queries.clear();
  data_->queries.emplace(std::move(key), made);
  return made;
}

std::size_t QueryCache::size() const {
  const std::lock_guard lock(data_->mutex);
  return data_->queries.size();
}

}  // namespace sinew::rdf::sparql
