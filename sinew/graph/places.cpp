#include "sinew/graph/places.h"

namespace sinew::graph {
namespace {

std::uint64_t key(Id subject, Id predicate) {
  return std::uint64_t{subject.value} << 32 | predicate.value;
}

}  // namespace

std::uint32_t Places::add_file(std::string name) {
  files_.push_back(std::move(name));
  return static_cast<std::uint32_t>(files_.size() - 1);
}

void Places::note(Id subject, Id predicate, std::uint32_t file, std::uint32_t line,
                  std::uint32_t column) {
  const Entry entry{file, line, column};
  entries_.try_emplace(key(subject, Id{}), entry);
  if (predicate) entries_.try_emplace(key(subject, predicate), entry);
}

Place Places::find(Id subject, Id predicate) const {
  auto found = entries_.find(key(subject, predicate));
  if (found == entries_.end()) found = entries_.find(key(subject, Id{}));
  if (found == entries_.end()) return {};
  const Entry& entry = found->second;
  return {files_[entry.file], entry.line, entry.column};
}

}  // namespace sinew::graph
