#include "sinew/world/clone.h"

#include <algorithm>

#include "sinew/world/edit.h"
#include "sinew/world/impl.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

using Kind = Difference::Kind;

// What of a record matters; links of lists do not.
bool same(const FrameRecord&, const FrameRecord&) { return true; }
bool same(const RelationRecord& a, const RelationRecord& b) {
  return a.suspended == b.suspended && a.attachment == b.attachment;
}
bool same(const MeasurementRecord& a, const MeasurementRecord& b) { return a.model == b.model; }
bool same(const ObjectRecord& a, const ObjectRecord& b) {
  return a.frame == b.frame && a.model == b.model;
}

template <typename Record>
void compare(const Names& names, ElementKind element, const PersistentVector<Record>& before,
             const PersistentVector<Record>& after, std::vector<Difference>& found) {
  PersistentVector<Record>::differences(
      before, after, [&](std::size_t, const Record* a, const Record* b) {
        const bool was = a && a->alive, is = b && b->alive;
        if (was && is && a->name == b->name) {
          if (!same(*a, *b)) found.push_back({Kind::kChanged, element, names.text(b->name)});
          return;
        }
        if (was) found.push_back({Kind::kRemoved, element, names.text(a->name)});
        if (is) found.push_back({Kind::kAdded, element, names.text(b->name)});
      });
}

Cell::View settled(const Cell& cell, Epoch as_of) {
  Cell::View view = cell.view(as_of);
  while (!view.settled) view = cell.view(as_of);
  return view;
}

struct Entry {
  Stamp stamp;
  std::vector<double> values;
  friend bool operator==(const Entry&, const Entry&) = default;
};

// The entries that a world sees in a cell.
std::vector<Entry> entries(const Cell& cell, Epoch as_of) {
  while (true) {
    const Cell::View view = settled(cell, as_of);
    std::vector<Entry> result;
    for (std::uint64_t i = cell.oldest(view); i < view.count; ++i) {
      Entry entry{cell.stamp(view, i), std::vector<double>(cell.values())};
      cell.read(view, i, entry.values.data(), cell.values());
      result.push_back(std::move(entry));
    }
    if (cell.intact(view, cell.oldest(view), as_of)) return result;
  }
}

std::vector<Entry> entries(const WorldImpl& world, const MeasurementRecord& record) {
  return entries(*record.cell, world.as_of(record.cell->owner()));
}

}  // namespace

std::string_view to_string(Difference::Kind kind) {
  static constexpr std::string_view kNames[] = {"added", "removed", "changed", "written"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<Difference> differences(const World& before, const World& after) {
  const WorldImpl& a = before.impl();
  const WorldImpl& b = after.impl();
  if (a.family != b.family) refuse(b.iri, "worlds that are not of one family", "a clone");
  const State x = a.published(), y = b.published();
  std::vector<Difference> found;
  const Names& names = a.family->names;
  compare(names, ElementKind::kFrame, x.frames, y.frames, found);
  compare(names, ElementKind::kObject, x.objects, y.objects, found);
  compare(names, ElementKind::kRelation, x.relations, y.relations, found);
  compare(names, ElementKind::kMeasurement, x.measurements, y.measurements, found);
  const std::size_t common = std::min(x.measurements.size(), y.measurements.size());
  for (std::size_t i = 0; i < common; ++i) {
    const MeasurementRecord& m = x.measurements[i];
    const MeasurementRecord& n = y.measurements[i];
    if (!m.alive || !n.alive || m.name != n.name) continue;
    const Cell::View u = settled(*m.cell, a.as_of(m.cell->owner()));
    const Cell::View v = settled(*n.cell, b.as_of(n.cell->owner()));
    if (m.cell == n.cell && u.ring == v.ring && u.count == v.count) continue;
    const auto mine = entries(a, m), theirs = entries(b, n);
    const bool differ =
        mine.empty() != theirs.empty() || (!mine.empty() && !(mine.back() == theirs.back()));
    if (differ) found.push_back({Kind::kWritten, ElementKind::kMeasurement, names.text(n.name)});
  }
  return found;
}

// Brings one clone's changes into an edit of its original.
struct Merger {
  WorldImpl& original;
  const WorldImpl& clone;
  Edit edit;
  const State& origin = clone.origin;
  State theirs = clone.published();
  Epoch as_of = clone.as_of(original.token);
  std::vector<Difference> applied = {};
  std::vector<Problem> conflicts = {};
  std::vector<std::pair<MeasurementId, std::vector<Entry>>> writes = {};

  const std::string& text(Name name) const { return original.family->names.text(name); }
  void conflict(Name name, std::string what) {
    conflicts.push_back({{},
                         text(name),
                         std::move(what),
                         "decide in the original which one holds",
                         Severity::kError,
                         {}});
  }
  void note(Kind kind, ElementKind element, Name name) {
    applied.push_back({kind, element, text(name)});
  }

  // Calls visit(index, origin's, theirs, ours) for each record that the clone changed. Null or
  // dead: not there.
  template <typename Record, typename Visit>
  void changed(PersistentVector<Record> State::*list, Visit&& visit) {
    PersistentVector<Record>::differences(
        origin.*list, theirs.*list,
        [&](std::size_t index, const Record* before, const Record* after) {
          const bool was = before && before->alive, is = after && after->alive;
          if (was || is) {
            visit(static_cast<Index>(index), was ? before : nullptr, is ? after : nullptr);
          }
        });
  }

  FrameId frame(Index theirs_index) const {
    return edit.find_frame(text(theirs.frames[theirs_index].name));
  }

  void removals() {
    changed(&State::objects, [&](Index i, const ObjectRecord* before, const ObjectRecord* after) {
      if (!before || after || !edit.next_.objects[i].alive) return;
      edit.remove(ObjectId{i});
      note(Kind::kRemoved, ElementKind::kObject, before->name);
    });
    changed(&State::measurements,
            [&](Index i, const MeasurementRecord* before, const MeasurementRecord* after) {
              if (!before || after || !edit.next_.measurements[i].alive) return;
              edit.remove(MeasurementId{i});
              note(Kind::kRemoved, ElementKind::kMeasurement, before->name);
            });
    changed(&State::relations,
            [&](Index i, const RelationRecord* before, const RelationRecord* after) {
              if (!before || after || !edit.next_.relations[i].alive) return;
              if (edit.next_.relations[i].first_measurement != kNone) {
                conflict(before->name, "removed in the clone, measured anew in the original");
                return;
              }
              edit.remove(RelationId{i});
              note(Kind::kRemoved, ElementKind::kRelation, before->name);
            });
    changed(&State::frames, [&](Index i, const FrameRecord* before, const FrameRecord* after) {
      if (!before || after || !edit.next_.frames[i].alive) return;
      if (edit.next_.frames[i].first_relation != kNone) {
        conflict(before->name, "removed in the clone, used by new relations in the original");
        return;
      }
      edit.remove(FrameId{i});
      note(Kind::kRemoved, ElementKind::kFrame, before->name);
    });
  }

  bool name_is_free(Name name) {
    if (edit.next_.find(name).kind == ElementKind::kNothing) return true;
    conflict(name, "added in the clone and in the original");
    return false;
  }

  void additions() {
    changed(&State::frames, [&](Index, const FrameRecord* before, const FrameRecord* after) {
      if (before || !after || !name_is_free(after->name)) return;
      edit.add_frame(text(after->name));
      note(Kind::kAdded, ElementKind::kFrame, after->name);
    });
    changed(&State::relations,
            [&](Index, const RelationRecord* before, const RelationRecord* after) {
              if (before || !after || !name_is_free(after->name)) return;
              const bool property = after->with_respect_to == kNone;
              const FrameId of = frame(after->of);
              const FrameId to = property ? FrameId{} : frame(after->with_respect_to);
              if (!of || (!property && !to)) {
                conflict(after->name, "links a frame that the original has removed");
                return;
              }
              const RelationId made = edit.add_relation({.name = text(after->name),
                                                         .of = of,
                                                         .with_respect_to = to,
                                                         .kind = after->kind,
                                                         .placement = after->placement});
              RelationRecord& record = edit.next_.relations.edit(made.index, edit.token_);
              record.suspended = after->suspended;
              record.attachment = after->attachment;
              note(Kind::kAdded, ElementKind::kRelation, after->name);
            });
    changed(&State::objects, [&](Index, const ObjectRecord* before, const ObjectRecord* after) {
      if (before || !after || !name_is_free(after->name)) return;
      const FrameId to = frame(after->frame);
      if (!to) {
        conflict(after->name, "attached to a frame that the original has removed");
        return;
      }
      edit.add_object(text(after->name), to, after->model ? text(after->model) : "");
      note(Kind::kAdded, ElementKind::kObject, after->name);
    });
    changed(&State::measurements,
            [&](Index, const MeasurementRecord* before, const MeasurementRecord* after) {
              if (!before && after && name_is_free(after->name)) add(*after);
            });
  }

  void add(const MeasurementRecord& theirs_record) {
    const Element to = edit.next_.find(theirs.relations[theirs_record.relation].name);
    if (to.kind != ElementKind::kRelation) {
      conflict(theirs_record.name, "measures a relation that the original has removed");
      return;
    }
    const MeasurementId made = edit.add_measurement({.name = text(theirs_record.name),
                                                     .relation = {to.index},
                                                     .quantity = theirs_record.quantity,
                                                     .model = *theirs_record.model,
                                                     .capacity = 1,
                                                     .values = theirs_record.cell->values()});
    const Epoch epoch = original.epoch.load();
    const auto copy = [&](const Cell& cell) {
      return std::make_shared<Cell>(cell, clone.as_of(cell.owner()), original.token, epoch);
    };
    MeasurementRecord& record = edit.next_.measurements.edit(made.index, edit.token_);
    record.cell = copy(*theirs_record.cell);
    record.blocks = theirs_record.blocks;
    if (theirs_record.block_cells) {
      auto cells = std::make_shared<std::vector<std::shared_ptr<Cell>>>();
      for (const auto& cell : *theirs_record.block_cells) cells->push_back(copy(*cell));
      record.block_cells = cells;
    }
    note(Kind::kAdded, ElementKind::kMeasurement, theirs_record.name);
  }

  void changes() {
    changed(&State::relations, [&](Index i, const RelationRecord* before,
                                   const RelationRecord* after) {
      if (!before || !after || same(*before, *after)) return;
      if (!edit.next_.relations[i].alive || !same(edit.next_.relations[i], *before)) {
        conflict(before->name, "attached, detached or removed in the clone and in the original");
        return;
      }
      edit.next_.relations.edit(i, edit.token_).suspended = after->suspended;
      edit.touch(ElementKind::kRelation, i);
      note(Kind::kChanged, ElementKind::kRelation, before->name);
    });
    changed(&State::objects, [&](Index i, const ObjectRecord* before, const ObjectRecord* after) {
      if (!before || !after || same(*before, *after)) return;
      if (!edit.next_.objects[i].alive || !same(edit.next_.objects[i], *before)) {
        conflict(before->name, "moved in the clone and moved or removed in the original");
        return;
      }
      edit.set_frame({i}, frame(after->frame));
      note(Kind::kChanged, ElementKind::kObject, before->name);
    });
    changed(&State::measurements,
            [&](Index i, const MeasurementRecord* before, const MeasurementRecord* after) {
              if (!before || !after || after->cell->owner() != clone.token) return;
              const MeasurementRecord& ours = edit.next_.measurements[i];
              if (!ours.alive) {
                conflict(before->name, "written in the clone, removed in the original");
                return;
              }
              const auto begun = entries(*before->cell, clone.as_of(before->cell->owner()));
              if (entries(original, ours) != begun) {
                conflict(before->name, "written in the clone and in the original");
                return;
              }
              if (!ours.cell->claimed_by.empty()) {
                conflict(before->name, "written in the clone, and a real-time writer is at work: " +
                                           ours.cell->claimed_by);
                return;
              }
              std::vector<Entry> news;
              for (const Entry& entry : entries(clone, *after)) {
                if (std::find(begun.begin(), begun.end(), entry) == begun.end())
                  news.push_back(entry);
              }
              writes.emplace_back(MeasurementId{i}, std::move(news));
              note(Kind::kWritten, ElementKind::kMeasurement, before->name);
            });
  }

  std::vector<Difference> run() {
    removals();
    changes();
    additions();
    if (!conflicts.empty()) throw Error(conflicts);
    edit.commit_keeping_lock();
    for (const auto& [measurement, news] : writes) {
      for (const Entry& entry : news)
        write_checked(original, measurement, entry.stamp, entry.values,
                      original.state.measurements[measurement.index].model->provenance);
    }
    return applied;
  }
};

std::vector<Difference> merge(World& original, const World& clone) {
  WorldImpl& to = original.impl();
  const WorldImpl& from = clone.impl();
  if (from.origin_owner != to.token) {
    refuse(from.iri, "merged into a world that it was not cloned from", "its original");
  }
  return Merger{to, from, original.edit()}.run();
}

}  // namespace sinew::world
