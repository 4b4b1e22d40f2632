#include "sinew/graph/store.h"

#include <algorithm>
#include <mutex>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/writer.h"

namespace sinew::graph {

// The records and who still reads which version of them.
struct Core {
  Core(std::shared_ptr<Terms> all_terms, std::uint32_t limit)
      : writer(limit), terms(std::move(all_terms)) {}

  Writer writer;
  std::shared_ptr<Terms> terms;

  void retain(Version version) {
    const std::lock_guard lock(mutex_);
    const auto at = find(version);
    if (at != readers_.end() && at->first == version) {
      ++at->second;
    } else {
      readers_.insert(at, {version, 1});
    }
  }
  void release(Version version) {
    const std::lock_guard lock(mutex_);
    const auto at = find(version);
    if (--at->second == 0) readers_.erase(at);
  }
  // The oldest version that a snapshot reads, or `present` when there is none older.
  Version oldest(Version present) {
    const std::lock_guard lock(mutex_);
    return readers_.empty() ? present : std::min(present, readers_.front().first);
  }

 private:
  using Reader = std::pair<Version, std::size_t>;
  std::vector<Reader>::iterator find(Version version) {
    return std::lower_bound(readers_.begin(), readers_.end(), Reader{version, 0});
  }
  std::mutex mutex_;
  std::vector<Reader> readers_;  // by version
};

// What was packed, of one version.
struct PackedEdges {
  struct Entry {
    Id predicate;
    Direction direction;
    std::shared_ptr<const Adjacency> edges;
  };
  std::mutex mutex;
  Version version = 0;
  std::vector<Entry> entries;
};

struct StoreData {
  std::shared_ptr<Terms> terms;
  std::uint32_t quad_limit = kMaxQuads;
  std::shared_ptr<Core> core;
  Present present;

  mutable std::mutex publishing;  // guards core and present against snapshot()
  std::binary_semaphore writing{1};
  std::atomic<std::thread::id> writer_thread{};
  mutable PackedEdges packed;
};

namespace {

void install(StoreData& data, std::shared_ptr<Core> core, Version committed) {
  const std::lock_guard lock(data.publishing);
  data.present = {&core->writer.records, data.terms.get(), committed,
                  core->writer.records.live_count};
  data.core = std::move(core);
}

// A core with what is visible at `version` and nothing else.
std::shared_ptr<Core> copy_of(const StoreData& data, std::shared_ptr<Terms> terms,
                              Version version) {
  const Records& from = *data.present.records;
  auto core = std::make_shared<Core>(std::move(terms), data.quad_limit);
  Writer& to = core->writer;
  for (std::uint32_t at = 1; at <= from.triple_count; ++at) {
    const Triple& triple = from.triples[at];
    if (triple.added > version) continue;
    const auto copy_to = [&](std::uint32_t graph) {
      to.add({{triple.subject}, {triple.predicate}, {triple.object}, {graph}}, version);
    };
    if (triple.removed > version) copy_to(triple.graph);
    from.for_further(triple, version, [&](const Membership& further) {
      copy_to(further.graph);
      return true;
    });
  }
  for (std::uint32_t at = 1; at <= from.graph_count; ++at) {
    const Graph& graph = from.graphs[at];
    for (std::uint32_t mark = graph.marks; mark != 0; mark = from.marks[mark].next) {
      if (from.marks[mark].added <= version && from.marks[mark].removed > version) {
        to.create_graph(graph.name, version);
      }
    }
  }
  to.finish(version);
  return core;
}

Error misuse(const char* what, const char* remedy) {
  Problem problem;
  problem.what = what;
  problem.remedy = remedy;
  return Error(std::move(problem));
}

}  // namespace

// ---- Snapshot ----

Snapshot::Snapshot(std::shared_ptr<Core> core, Version version, std::size_t size)
    : View(&core->writer.records, core->terms.get(), version, size),
      core_(std::move(core)),
      version_(version) {}

Snapshot::Snapshot(const Snapshot& other)
    : View(other), core_(other.core_), version_(other.version_) {
  if (core_) core_->retain(version_);
}

Snapshot::Snapshot(Snapshot&& other) noexcept
    : View(other), core_(std::move(other.core_)), version_(other.version_) {}

Snapshot& Snapshot::operator=(Snapshot other) noexcept {
  View::operator=(other);
  std::swap(core_, other.core_);
  std::swap(version_, other.version_);
  return *this;
}

Snapshot::~Snapshot() {
  if (core_) core_->release(version_);
}

// ---- Transaction ----

Transaction::Transaction(StoreData& data) : data_(&data) {
  const auto self = std::this_thread::get_id();
  if (data.writer_thread.load() == self) {
    throw misuse(
        "this thread already has a transaction of this store, and would wait for it for ever",
        "write through that one, or end it first");
  }
  data.writing.acquire();
  data.writer_thread.store(self);
  version_ = data.present.committed + 1;
  data.core->writer.start();
}

Transaction::Transaction(Transaction&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      version_(other.version_),
      known_terms_(other.known_terms_) {}

Transaction::~Transaction() {
  if (!data_) return;
  undo_to(0);
  data_->writer_thread.store({});
  data_->writing.release();
}

StoreData& Transaction::data() const {
  if (!data_) throw misuse("the transaction is over", "begin a new one");
  return *data_;
}

namespace {

bool has_terms_of(std::uint32_t known, const Quad& quad) {
  const auto is_term = [known](Id id) { return id.value - 1 < known; };
  return is_term(quad.subject) && is_term(quad.predicate) && is_term(quad.object) &&
         quad.graph.value <= known;
}

[[noreturn]] void refuse_terms() {
  throw misuse("an id of the quad is no term of this store",
               "use ids of this store's own dictionary; only the graph may be 0");
}

}  // namespace

bool Transaction::add(const Quad& quad) {
  StoreData& in = data();
  if (!has_terms_of(known_terms_, quad)) [[unlikely]] {
    known_terms_ = static_cast<std::uint32_t>(in.terms->size());
    if (!has_terms_of(known_terms_, quad)) refuse_terms();
  }
  return in.core->writer.add(quad, version_);
}

std::size_t Transaction::add(std::span<const Quad> quads) {
  StoreData& in = data();
  const auto known = static_cast<std::uint32_t>(in.terms->size());
  const auto culprit = std::find_if_not(
      quads.begin(), quads.end(), [known](const Quad& quad) { return has_terms_of(known, quad); });
  const std::size_t good = static_cast<std::size_t>(culprit - quads.begin());
  const std::size_t count = in.core->writer.add(quads.first(good), version_);
  if (good < quads.size()) refuse_terms();
  return count;
}

bool Transaction::remove(const Quad& quad) { return data().core->writer.remove(quad, version_); }
void Transaction::clear(Id graph) { data().core->writer.clear(graph.value, version_); }
void Transaction::create_graph(Id graph) {
  data().core->writer.create_graph(graph.value, version_);
}
void Transaction::drop_graph(Id graph) { data().core->writer.drop_graph(graph.value, version_); }

View Transaction::view() const {
  const StoreData& in = data();
  in.core->writer.show();
  return View(in.present.records, in.terms.get(), version_, View::kUnfinished);
}

Transaction::Mark Transaction::mark() const { return data().core->writer.mark(); }
void Transaction::undo_to(Mark mark) { data().core->writer.undo_to(mark); }

void Transaction::commit() {
  StoreData& in = data();
  Writer& writer = in.core->writer;
  if (writer.changes() > 0) {
    writer.show();
    {
      const std::lock_guard lock(in.publishing);
      in.present.committed = version_;
      in.present.size = writer.records.live_count;
    }
    // Whoever takes a snapshot from here on gets this version; older ones are counted.
    writer.finish(in.core->oldest(version_));
  }
  data_ = nullptr;
  in.writer_thread.store({});
  in.writing.release();
}

// ---- Store ----

Store::Store(StoreLimits limits) : data_(std::make_unique<StoreData>()) {
  data_->terms = std::make_shared<Terms>(limits.terms);
  data_->quad_limit = std::min(limits.quads, kMaxQuads);
  install(*data_, std::make_shared<Core>(data_->terms, data_->quad_limit), 1);
}

Store::Store(std::unique_ptr<StoreData> data) : data_(std::move(data)) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

Terms& Store::terms() { return *data_->terms; }
const Terms& Store::terms() const { return *data_->terms; }
View Store::view() const { return View(&data_->present); }

Snapshot Store::snapshot() const {
  const std::lock_guard lock(data_->publishing);
  data_->core->retain(data_->present.committed);
  return Snapshot(data_->core, data_->present.committed, data_->present.size);
}

Transaction Store::begin() {
  Transaction transaction(*data_);
  const Writer& writer = data_->core->writer;
  const Records& records = writer.records;
  const std::uint32_t all = records.triple_count + records.membership_count;
  const std::uint32_t alive = all - std::min(all, writer.dead_records());
  const std::uint32_t bearable = std::min(std::max(kWorthCompacting, alive), data_->quad_limit / 4);
  const bool full = std::max(records.triple_count, records.membership_count) == data_->quad_limit;
  if ((writer.dead_records() > bearable || (full && writer.dead_records() > 0)) &&
      !MatchScope::matching()) {
    const Version committed = data_->present.committed;
    install(*data_, copy_of(*data_, data_->terms, committed), committed);
  }
  return transaction;
}

bool Store::add(const Quad& quad) {
  Transaction transaction = begin();
  const bool added = transaction.add(quad);
  if (added) transaction.commit();
  return added;
}

bool Store::remove(const Quad& quad) {
  Transaction transaction = begin();
  const bool removed = transaction.remove(quad);
  if (removed) transaction.commit();
  return removed;
}

std::shared_ptr<const Adjacency> Store::edges(Id predicate, Direction direction) const {
  PackedEdges& packed = data_->packed;
  const std::lock_guard lock(packed.mutex);
  const Snapshot now = snapshot();
  if (now.stamp().version != packed.version) {
    packed.entries.clear();
    packed.version = now.stamp().version;
  }
  for (const PackedEdges::Entry& entry : packed.entries) {
    if (entry.predicate == predicate && entry.direction == direction) return entry.edges;
  }
  auto made = std::make_shared<const Adjacency>(now, predicate, direction);
  packed.entries.push_back({predicate, direction, made});
  return made;
}

Store Store::clone() const {
  auto data = std::make_unique<StoreData>();
  data->terms = std::shared_ptr<Terms>(data_->terms->clone());
  data->quad_limit = data_->quad_limit;
  const Version committed = data_->present.committed;
  install(*data, copy_of(*data_, data->terms, committed), committed);
  return Store(std::move(data));
}

}  // namespace sinew::graph
