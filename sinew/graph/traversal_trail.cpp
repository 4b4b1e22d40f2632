#include "sinew/graph/traversal_trail.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"

namespace sinew::graph {
namespace {

[[noreturn]] void fail(std::string iri, std::string what, std::string remedy) {
  throw Error(
      Problem{{}, std::move(iri), std::move(what), std::move(remedy), Severity::kError, {}});
}

}  // namespace

std::uint32_t TraversalTrail::extend(std::uint32_t path, Id node) {
  visited_.push_back({node, path});
  return static_cast<std::uint32_t>(visited_.size() - 1);
}

std::vector<Id> TraversalTrail::path(std::uint32_t path) const {
  std::vector<Id> nodes;
  for (; path != 0; path = visited_[path].before) nodes.push_back(visited_[path].node);
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

bool TraversalTrail::is_simple(std::uint32_t path) const {
  std::vector<Id> nodes = this->path(path);
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

std::uint32_t TraversalTrail::label(std::uint32_t labels, std::string_view label, Id node) {
  labelled_.push_back({label, node, labels});
  return static_cast<std::uint32_t>(labelled_.size() - 1);
}

Id TraversalTrail::labelled(std::uint32_t labels, std::string_view label) const {
  for (; labels != 0; labels = labelled_[labels].before) {
    if (labelled_[labels].label == label) return labelled_[labels].node;
  }
  fail({}, fmt::format("no node was labelled \"{}\" on the way here", label),
       fmt::format("put as(\"{}\") before the step that refers to it", label));
}

std::uint32_t TraversalTrail::begin_loop(std::uint32_t outer) {
  loops_.push_back({0, outer});
  return static_cast<std::uint32_t>(loops_.size() - 1);
}

std::uint32_t TraversalTrail::next_round(std::uint32_t loop) {
  loops_.push_back({loops_[loop].rounds + 1, loops_[loop].outer});
  return static_cast<std::uint32_t>(loops_.size() - 1);
}

std::uint32_t TraversalTrail::end_loop(std::uint32_t loop) const { return loops_[loop].outer; }
std::uint32_t TraversalTrail::repeats(std::uint32_t loop) const { return loops_[loop].rounds; }

void throw_no_repeat() {
  fail({}, "until, times or emit without a repeat", "put it right after repeat(…)");
}

void throw_too_many_moves(std::uint64_t limit) {
  fail({}, fmt::format("the traversal took more than {} steps", limit),
       "make it more selective (simple_path, dedup), or raise the limit");
}

void throw_too_many_repeats(std::uint32_t limit, const View& view, Id node) {
  fail(std::string(view.terms().text(node)),
       fmt::format("repeat has not ended here after {} rounds", limit),
       "add simple_path or dedup against cycles, or raise the limit");
}

}  // namespace sinew::graph
