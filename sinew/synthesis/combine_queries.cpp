#include "sinew/synthesis/combine_queries.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"

namespace sinew::synthesis {
namespace {

template <typename T>
void add_each_once(std::vector<T>& all, const std::vector<T>& more) {
  for (const T& one : more)
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
}

// Takes the value of a query that states one; Error when another one was stated before.
template <typename T>
void agree(T& value, const T& other, const T& unstated, std::string_view what, const Query& query) {
  if (other == unstated || other == value) return;
  if (value != unstated)
    throw Error(Problem{{},
                        query.iri.empty() ? query.name : query.iri,
                        fmt::format("it is asked together with a query of another {}", what),
                        fmt::format("let both have the same {}, or ask them apart", what),
                        {},
                        {}});
  value = other;
}

}  // namespace

Query combined(std::span<const Query> queries) {
  Query all;
  for (const Query& query : queries) {
    all.name += (all.name.empty() ? "" : "_") + query.name;
    if (all.iri.empty()) {  // faults are named after the first that has a model
      all.iri = query.iri;
      all.place = query.place;
    }
    add_each_once(all.asked, query.asked);
    add_each_once(all.given, query.given);
    add_each_once(all.held, query.held);
    agree(all.base, query.base, {}, "base", query);
    agree(all.gravity, query.gravity, {}, "gravity", query);
    agree(all.sweeps, query.sweeps, {}, "sweep configuration", query);
    agree(all.tips, query.tips, {}, "list of tips", query);
    agree(all.floating, query.floating, false, "kind of base", query);
    agree(all.forces, query.forces, Forces::kTogether, "policy for forces", query);
    agree(all.frames, query.frames, Frames::kMoving, "policy for frames", query);
    agree(all.drivers, query.drivers, {}, "policy for drivers", query);
    agree(all.task, query.task, {}, "task", query);
    if (!query.base.empty()) all.base_origin = query.base_origin;
    if (!query.tips.empty()) all.tips_origin = query.tips_origin;
    all.regroup = all.regroup && query.regroup;
  }
  return all;
}

}  // namespace sinew::synthesis
