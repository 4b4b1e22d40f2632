#include "sinew/world/symbols.h"

#include <algorithm>
#include <string>

#include "sinew/graph/standard_iris.h"

namespace sinew::world {
namespace {

constexpr std::string_view kGeometry = "https://comp-rob2b.github.io/metamodels/geometry/";

// The same term in another dictionary.
graph::Id copied(const graph::Terms& from, graph::Id id, graph::Terms& to) {
  switch (from.kind(id)) {
    case graph::TermKind::kBlank:
      return to.blank(from.text(id));
    case graph::TermKind::kLiteral:
      return to.literal(from.text(id), from.text(from.datatype(id)), from.language(id));
    default:
      return to.iri(from.text(id));
  }
}

}  // namespace

void copy_facts(const graph::View& from, graph::Store& to,
                const std::function<bool(const graph::Quad&)>& keep) {
  graph::Transaction transaction = to.begin();
  const auto copy = [&](const graph::Quad& quad) {
    if (!keep(quad)) return true;
    const auto term = [&](graph::Id id) { return copied(from.terms(), id, to.terms()); };
    transaction.add({term(quad.subject), term(quad.predicate), term(quad.object),
                     quad.graph ? term(quad.graph) : graph::Id{}});
    return true;
  };
  from.match_in({}, {}, {}, {}, copy);
  from.match_named({}, {}, {}, copy);
  transaction.commit();
}

Symbols::Symbols(std::string_view world_iri, const Names& names, const State& state,
                 const graph::Snapshot* inherited)
    : names_(names), graph_(store.terms().iri(world_iri)) {
  if (inherited) {
    const graph::Id described = inherited->terms().find_iri(world_iri);
    copy_facts(*inherited, store, [described](const graph::Quad& quad) {
      return !quad.graph || quad.graph != described;
    });
  }
  describe_all(state);
}

graph::Id Symbols::iri(Name name) {
  if (name.value >= terms_.size()) terms_.resize(name.value + 1);
  graph::Id& term = terms_[name.value];
  if (!term) term = store.terms().iri(names_.text(name));
  return term;
}

graph::Id Symbols::world(std::string_view term) {
  return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
}

void Symbols::describe(const State& state, ElementKind kind, Index index,
                       std::vector<graph::Quad>& quads) {
  graph::Terms& terms = store.terms();
  const graph::Id type = terms.iri(graph::kRdfType);
  const auto add = [&](graph::Id subject, graph::Id predicate, graph::Id object) {
    quads.push_back({subject, predicate, object, graph_});
  };
  const auto geometry = [&](std::string_view term) {
    return terms.iri(std::string(kGeometry) + std::string(term));
  };
  switch (kind) {
    case ElementKind::kNothing:
      return;
    case ElementKind::kFrame: {
      const FrameRecord* const frame = state.frames.find(index);
      if (!frame || !frame->alive) return;
      add(iri(frame->name), type, geometry("structural-entities#Frame"));
      return;
    }
    case ElementKind::kObject: {
      const ObjectRecord* const object = state.objects.find(index);
      if (!object || !object->alive) return;
      add(iri(object->name), type, world("Object"));
      add(iri(object->name), world("attached-to"), iri(state.frames[object->frame].name));
      if (object->model) add(iri(object->name), world("instance-of"), iri(object->model));
      return;
    }
    case ElementKind::kRelation: {
      const RelationRecord* const relation = state.relations.find(index);
      if (!relation || !relation->alive) return;
      const graph::Id node = iri(relation->name);
      switch (relation->kind) {
        case RelationKind::kFree:
          add(node, type, geometry("spatial-relations#Pose"));
          break;
        case RelationKind::kRevolute:
        case RelationKind::kPrismatic:
          add(node, type, geometry("spatial-relations#Pose"));
          add(node, type,
              world(relation->kind == RelationKind::kRevolute ? "Revolute" : "Prismatic"));
          break;
        case RelationKind::kProperty:
          add(node, type, world("Property"));
          break;
      }
      add(node, geometry("spatial-relations#of"), iri(state.frames[relation->of].name));
      if (relation->with_respect_to != kNone) {
        add(node, geometry("spatial-relations#with-respect-to"),
            iri(state.frames[relation->with_respect_to].name));
      }
      if (relation->suspended) add(node, world("suspended"), terms.boolean(true));
      if (relation->attachment) add(node, type, world("Attachment"));
      return;
    }
    case ElementKind::kMeasurement: {
      const MeasurementRecord* const measurement = state.measurements.find(index);
      if (!measurement || !measurement->alive) return;
      const graph::Id node = iri(measurement->name);
      const MeasurementModel& model = *measurement->model;
      add(node, type, world("Measurement"));
      add(iri(state.relations[measurement->relation].name), world("measured-by"), node);
      add(node, world("quantity"), terms.literal(to_string(measurement->quantity)));
      add(node, world("life-cycle"), terms.literal(to_string(model.life_cycle)));
      if (!model.provenance.empty()) add(node, world("provenance"), terms.iri(model.provenance));
      if (!model.coord_frame.empty()) add(node, world("coord-frame"), terms.iri(model.coord_frame));
      for (const std::string& user : model.used_by) add(node, world("used-by"), terms.iri(user));
      // The measurement's own numbers, and each block; all of them are consistent with that one.
      const graph::Id own = terms.iri(names_.text(measurement->name) + "/data");
      add(node, world("value"), own);
      add(own, type, world("DataBlock"));
      for (std::size_t i = 0; measurement->blocks && i < measurement->blocks->blocks.size(); ++i) {
        const DataBlock& data = measurement->blocks->blocks[i];
        const graph::Id block = terms.iri(data.name);
        add(node, world("value"), block);
        add(block, type, world("DataBlock"));
        add(block, world("prototype"), terms.literal(data.prototype));
        add(block, world("consistency"), own);
        if (data.realtime) add(block, world("realtime"), terms.boolean(true));
        if (!data.to_canonical) add(block, world("derived"), terms.boolean(true));
      }
      return;
    }
  }
}

void Symbols::describe_all(const State& state) {
  std::vector<graph::Quad> quads;
  for (Index i = 0; i < state.frames.size(); ++i) describe(state, ElementKind::kFrame, i, quads);
  for (Index i = 0; i < state.objects.size(); ++i) describe(state, ElementKind::kObject, i, quads);
  for (Index i = 0; i < state.relations.size(); ++i) {
    describe(state, ElementKind::kRelation, i, quads);
  }
  for (Index i = 0; i < state.measurements.size(); ++i) {
    describe(state, ElementKind::kMeasurement, i, quads);
  }
  graph::Transaction transaction = store.begin();
  transaction.create_graph(graph_);
  transaction.add(quads);
  transaction.commit();
}

void Symbols::update(graph::Transaction& transaction, const State& before, const State& after,
                     std::vector<Element> touched) {
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  std::vector<graph::Quad> old;
  std::vector<graph::Quad> now;
  for (const auto& [kind, index] : touched) {
    describe(before, kind, index, old);
    describe(after, kind, index, now);
  }
  std::sort(old.begin(), old.end());
  std::sort(now.begin(), now.end());
  for (const graph::Quad& quad : old) {
    if (!std::binary_search(now.begin(), now.end(), quad)) transaction.remove(quad);
  }
  for (const graph::Quad& quad : now) {
    if (!std::binary_search(old.begin(), old.end(), quad)) transaction.add(quad);
  }
}

}  // namespace sinew::world
