#include "sinew/rdf/json/arena.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "sinew/base/error.h"

namespace sinew::json {
namespace {

constexpr std::size_t kLargestBlock = std::size_t{1} << 20;

}  // namespace

void* Arena::bytes_in_new_block(std::size_t size) {
  const std::size_t block = std::max(size, next_block_);
  if (used_ + block > kMaxBytes) throw_full();
  blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(block));
  used_ += block;
  next_block_ = std::min(next_block_ * 2, kLargestBlock);
  std::byte* result = blocks_.back().get();
  free_ = result + size;
  end_ = result + block;
  return result;
}

std::string_view Arena::copy(std::string_view text) { return concat(text, {}); }

std::string_view Arena::concat(std::string_view first, std::string_view second) {
  const std::size_t size = first.size() + second.size();
  if (size == 0) return "";
  char* result = allocate<char>(size);
  if (!first.empty()) std::memcpy(result, first.data(), first.size());
  if (!second.empty()) std::memcpy(result + first.size(), second.data(), second.size());
  return {result, size};
}

void Arena::throw_full() {
  Problem problem;
  problem.what = "the document needs more than 1 GiB of memory";
  problem.remedy = "split the document into several files";
  problem.code = "loading document failed";
  throw Error(std::move(problem));
}

}  // namespace sinew::json
