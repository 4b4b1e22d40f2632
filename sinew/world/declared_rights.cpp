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
    for (const Act act : {Act::kMeasure, Act::kRelate, Act::kModel}) {
      if (reader.text(*word) == to_string(act)) return act;
    }
    reader.error(rule, w("act"), "there is no act '" + std::string(reader.text(*word)) + "'",
                 "write-measurement, change-relation or change-model");
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

  void writers() {
    for (const Id component : reader.all(w("Component"))) {
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
  reader.writers();
  return std::move(reader.declared);
}

}  // namespace sinew::world
