// The order of items: filters as soon as they can, then what makes the fewest rows, OPTIONALs last.
#include <algorithm>

#include "sinew/rdf/sparql/plan/planner_class.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql::plan {
namespace {

// Items of a lower rank go first when they are ready.
int rank(const Item& item) {
  switch (item.kind) {
    case Item::Kind::kRefuse:
      return 0;
    case Item::Kind::kFilter:
      return 1;
    case Item::Kind::kMinus:
      return 2;
    case Item::Kind::kExtend:
      return 4;
    case Item::Kind::kOptional:
      return 5;
    default:
      return 3;
  }
}

}  // namespace

bool Planner::ready(const Item& item, const std::vector<Item>& items, std::size_t first_undone,
                    const Context& context) const {
  if (item.barrier > first_undone) return false;
  return std::all_of(item.needs.begin(), item.needs.end(), [&](Variable variable) {
    if (context.bound.has(variable)) return true;
    for (std::size_t i = item.scope_begin; i < item.scope_end; ++i) {
      if (!items[i].done && items[i].possible.has(variable)) return false;
    }
    return true;
  });
}

void Planner::order_and_emit(std::vector<Item>& items, Context context) {
  if (items.size() > kMaximumChain) fail_too_long();
  // Of very many items only the next ones in the text are looked at, so that planning stays short.
  constexpr std::size_t kWindow = 200;
  std::size_t first_undone = 0;
  for (std::size_t left = items.size(); left > 0; --left) {
    while (items[first_undone].done) ++first_undone;
    Item* best = nullptr;
    int best_rank = 0;
    double best_cost = 0;
    std::size_t looked_at = 0;
    for (std::size_t i = first_undone; i < items.size(); ++i) {
      Item& item = items[i];
      if (item.done) continue;
      if (++looked_at > kWindow && best) break;
      int item_rank = rank(item);
      // A value that others wait for comes before the patterns that could use it.
      if (item.kind == Item::Kind::kExtend) {
        const bool used = std::any_of(items.begin(), items.end(), [&](const Item& other) {
          return !other.done && rank(other) == 3 && other.possible.has(item.variable);
        });
        if (used) item_rank = 2;
      }
      if (best && item_rank > best_rank) continue;
      if (!ready(item, items, first_undone, context)) continue;
      const double item_cost = item_rank == 3 ? cost(item, context) : 0;
      if (best && item_rank == best_rank && item_cost >= best_cost) continue;
      best = &item;
      best_rank = item_rank;
      best_cost = item_cost;
    }
    emit(*best, context, best_cost);
    best->done = true;
    context.bound.add(best->certain);
    VariableSet possible = best->possible;
    possible.remove(context.fixed);
    context.maybe.add(possible);
  }
}

}  // namespace sinew::rdf::sparql::plan
