#include "sinew/rdf/sparql/prepared.h"

#include <array>
#include <atomic>
#include <mutex>

#include "sinew/rdf/sparql/algebra/translate.h"
#include "sinew/rdf/sparql/eval/evaluator.h"
#include "sinew/rdf/sparql/plan/planner.h"
#include "sinew/rdf/sparql/syntax/parser.h"

namespace sinew::rdf::sparql {
namespace {

using graph::Id;

// A plan and evaluators that wait to be used again. Taking one is an exchange of a pointer; when
// all are busy (a query that runs itself from its own visitor, many threads), one is made anew.
struct PlanPool {
  explicit PlanPool(std::shared_ptr<const plan::Plan> made) : plan(std::move(made)) {}
  ~PlanPool() {
    for (auto& spare : spares) delete spare.load();
  }
  PlanPool(const PlanPool&) = delete;
  PlanPool& operator=(const PlanPool&) = delete;

  std::unique_ptr<eval::Evaluator> take() {
    for (auto& spare : spares) {
      if (spare.load(std::memory_order_relaxed) == nullptr) continue;
      if (eval::Evaluator* const found = spare.exchange(nullptr, std::memory_order_acquire)) {
        return std::unique_ptr<eval::Evaluator>(found);
      }
    }
    return std::make_unique<eval::Evaluator>(plan);
  }
  void give_back(std::unique_ptr<eval::Evaluator> evaluator) {
    for (auto& spare : spares) {
      eval::Evaluator* empty = nullptr;
      if (spare.compare_exchange_strong(empty, evaluator.get(), std::memory_order_release,
                                        std::memory_order_relaxed)) {
        static_cast<void>(evaluator.release());  // `spares` owns it now
        return;
      }
    }
  }

  std::shared_ptr<const plan::Plan> plan;
  std::array<std::atomic<eval::Evaluator*>, 8> spares = {};
};

class Borrowed {
 public:
  explicit Borrowed(PlanPool& pool) : pool_(pool), evaluator_(pool.take()) {}
  ~Borrowed() { pool_.give_back(std::move(evaluator_)); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  eval::Evaluator* operator->() { return evaluator_.get(); }

 private:
  PlanPool& pool_;
  std::unique_ptr<eval::Evaluator> evaluator_;
};

}  // namespace

struct Prepared::Data {
  graph::Terms* terms = nullptr;
  algebra::Query query;
  plan::DatasetPlan dataset;
  Limits limits;
  std::vector<std::string> columns;

  // The newest plan; older ones live on, since a query may be running on them. There are few: each
  // is made for a graph of four times, or a quarter of, the size.
  std::atomic<PlanPool*> current = nullptr;
  std::mutex replanning;
  std::vector<std::unique_ptr<PlanPool>> pools;

  PlanPool& pool_for(const graph::View& view) {
    PlanPool* const pool = current.load(std::memory_order_acquire);
    constexpr std::size_t kWorthPlanning = 100;  // triples
    const std::size_t now = view.size();
    const std::size_t then = pool->plan->planned_for;
    if (now / 4 <= then + kWorthPlanning && then / 4 <= now + kWorthPlanning) return *pool;
    return replan(view);
  }

  PlanPool& replan(const graph::View& view) {
    const std::lock_guard lock(replanning);
    pools.push_back(std::make_unique<PlanPool>(plan::make_plan(query, view, dataset)));
    current.store(pools.back().get(), std::memory_order_release);
    return *pools.back();
  }
};

Prepared::Prepared() : data_(std::make_unique<Data>()) {}
Prepared::~Prepared() = default;

const std::vector<std::string>& Prepared::columns() const { return data_->columns; }

bool Prepared::is_ask() const { return data_->query.form == syntax::QueryForm::kAsk; }

std::size_t Prepared::select(const graph::View& view, std::span<const Id> parameters,
                             RowVisitor visit) const {
  Borrowed evaluator(data_->pool_for(view));
  values::TermSpace& space = evaluator->space();
  std::vector<Id> kept;  // stays empty, and free of cost, unless a row has computed terms
  return evaluator->select(view, parameters, data_->limits, [&](std::span<const Id> row) {
    std::uint32_t any = 0;
    for (const Id id : row) any |= id.value;
    if ((any & values::kLocalBit) == 0) return visit(row);
    kept.assign(row.begin(), row.end());
    for (Id& id : kept) id = space.keep(id, *data_->terms);
    return visit(kept);
  });
}

bool Prepared::ask(const graph::View& view, std::span<const Id> parameters) const {
  Borrowed evaluator(data_->pool_for(view));
  return evaluator->ask(view, parameters, data_->limits);
}

std::string Prepared::explain(const graph::Terms& terms) const {
  return plan::explain(*data_->current.load()->plan, terms);
}

std::shared_ptr<const Prepared> prepare(graph::Store& store, std::string_view text,
                                        std::span<const std::string_view> parameters,
                                        graph::Dataset dataset, const Limits& limits) {
  syntax::ParseOptions options;
  options.limits = limits;
  options.parameters = parameters;
  const syntax::Query parsed = syntax::parse_query(store.terms(), text, options);
  if (parsed.form != syntax::QueryForm::kSelect && parsed.form != syntax::QueryForm::kAsk) {
    parsed.source->fail(0, "only SELECT and ASK can be prepared",
                        "run CONSTRUCT and DESCRIBE through the engine");
  }
  std::shared_ptr<Prepared> result(new Prepared);
  Prepared::Data& data = *result->data_;
  data.terms = &store.terms();
  data.query = algebra::translate(parsed, parameters);
  data.dataset = plan::dataset_of(parsed.dataset, dataset);
  data.limits = limits;
  for (const algebra::Variable column : data.query.select.columns) {
    data.columns.push_back(data.query.names[column]);
  }
  data.replan(store.view());
  return result;
}

}  // namespace sinew::rdf::sparql
