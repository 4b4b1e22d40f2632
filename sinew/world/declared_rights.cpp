#include "sinew/world/declared_rights.h"

#include <optional>

#include "sinew/model/graph_reader.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

using graph::Id;

struct RightsReader {
  graph::Store& store;
  const graph::Places& places;
  model::GraphReader reader;
  DeclaredRights declared = {};

  Id w(std::string_view term) {
    return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
  }

  std::optional<Act> act(Id rule) {
    const auto word = reader.one(rule, w("act"), "what the rule is about");
    if (!word) return std::nullopt;
    for (const Act act :
         {Act::kMeasure, Act::kRelate, Act::kModel, Act::kRead, Act::kPerform, Act::kReadGraph}) {
      if (reader.text(*word) == to_string(act)) return act;
    }
    reader.error(rule, w("act"), "there is no act '" + std::string(reader.text(*word)) + "'",
                 "write-measurement, change-relation, change-model, read-measurement, read-graph "
                 "or perform-action");
    return std::nullopt;
  }

  // At least one value.
  std::vector<Id> some(Id rule, Id property, std::string_view what) {
    std::vector<Id> found = reader.objects(rule, property);
    if (found.empty())
      reader.error(rule, property, "the rule does not say " + std::string(what), "its IRI");
    return found;
  }

  void rules(std::string_view type, bool allowed) {
    for (const Id rule : reader.all(w(type))) {
      const std::optional<Act> about = act(rule);
      const std::vector<Id> subjects = some(rule, w("who"), "who");
      const std::vector<Id> objects = some(rule, w("what"), "to what");
      if (!about) continue;
      for (const Id who : subjects) {
        declared.named.push_back({std::string(reader.text(who)), std::string(reader.text(rule)),
                                  places.find(rule, w("who"))});
        for (const Id what : objects) {
          if (allowed) {
            declared.rights.allow(reader.text(who), *about, reader.text(what));
          } else {
            declared.rights.forbid(reader.text(who), *about, reader.text(what));
          }
        }
      }
    }
  }

  void single_writers() {
    for (const Id rule : reader.all(w("SingleWriter"))) {
      for (const Id what : some(rule, w("what"), "of what")) {
        declared.rights.require_single_writer(reader.text(what));
      }
    }
  }

  void components() {
    for (const Id component : reader.all(w("Component"))) {
      declared.components.emplace(reader.text(component));
      for (const Id measurement : reader.objects(component, w("reads"))) {
        declared.readers.push_back({std::string(reader.text(component)),
                                    std::string(reader.text(measurement)),
                                    places.find(component, w("reads"))});
      }
      for (const Id measurement : reader.objects(component, w("writes"))) {
        declared.writers.push_back({std::string(reader.text(component)),
                                    std::string(reader.text(measurement)),
                                    places.find(component, w("writes"))});
      }
    }
  }
};

}  // namespace

DeclaredRights read_rights(graph::Store& store, const graph::Places& places, Report& report) {
  RightsReader reader{store, places, model::GraphReader(store, places, report)};
  reader.rules("Allowance", true);
  reader.rules("Prohibition", false);
  reader.single_writers();
  reader.components();
  return std::move(reader.declared);
}

void check_configuration(const World& world, const DeclaredRights& declared, Report& report) {
  check_configuration(world, declared.rights, declared.writers, report);
  const State state = world.state();
  for (const DeclaredReader& reader : declared.readers) {
    const MeasurementId measurement = world.find_measurement(reader.what);
    if (!measurement) {
      report.error(reader.place, reader.what,
                   reader.who + " is to read it, and it is no measurement of this world",
                   "the IRI of a measurement");
      continue;
    }
    const MeasurementModel& model = *state.measurements[measurement.index].model;
    if (const auto reason = declared.rights.reason_against_reading(
            reader.who, reader.what, model.used_by, model.provenance)) {
      report.error(reader.place, reader.what, reader.who + " is to read it, but " + *reason,
                   "one of its users as the reader, or a rule that allows it");
    }
  }
  for (Index at = 0; at < state.measurements.size(); ++at) {
    const MeasurementRecord& record = state.measurements[at];
    if (!record.alive) continue;
    for (const std::string& user : record.model->used_by) {
      if (declared.components.contains(user)) continue;
      report.error({}, world.name(MeasurementId{at}),
                   "its user " + user + " is no declared component", "the IRI of a w:Component");
    }
  }
  for (const DeclaredRights::Named& named : declared.named) {
    if (declared.components.contains(named.who)) continue;
    report.error(named.place, named.rule,
                 "it is about " + named.who + ", which is no declared component",
                 "the IRI of a w:Component");
  }
}

}  // namespace sinew::world
