#include "sinew/world/declared_actions.h"

#include <algorithm>
#include <optional>
#include <string>

#include "sinew/model/graph_reader.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

using graph::Id;

struct ActionReader {
  graph::Store& store;
  model::GraphReader reader;

  Id w(std::string_view term) {
    return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
  }

  // A text, where there has to be one; false where it is missing or there are several.
  bool read(Id node, std::string_view term, std::string_view what, std::string& text) {
    const auto found = reader.one(node, w(term), what);
    if (found) text = reader.text(*found);
    return found.has_value();
  }

  std::optional<ActionModel> action(Id node) {
    ActionModel model{.name = std::string(reader.text(node)), .effect = {}};
    bool whole = read(node, "effect", "what the action leads to", model.effect);
    for (const Id parameter : reader.objects(node, w("parameter"))) {
      model.parameters.emplace_back(reader.text(parameter));
    }
    for (const Id precondition : reader.objects(node, w("precondition"))) {
      Precondition made;
      whole = read(precondition, "query", "what the precondition asks", made.query) && whole;
      whole = read(precondition, "message", "why not, when it fails", made.message) && whole;
      model.preconditions.push_back(std::move(made));
    }
    std::sort(model.preconditions.begin(), model.preconditions.end(),
              [](const Precondition& a, const Precondition& b) { return a.message < b.message; });
    for (const auto& [term, text] :
         {std::pair("attaches", &model.attach), std::pair("detaches", &model.detach),
          std::pair("adds", &model.add), std::pair("removes", &model.remove)}) {
      if (reader.has(node, w(term))) whole = read(node, term, "what it changes", *text) && whole;
    }
    return whole ? std::optional(std::move(model)) : std::nullopt;
  }
};

}  // namespace

void read_actions(graph::Store& store, const graph::Places& places, Actions& actions,
                  Report& report) {
  ActionReader reader{store, model::GraphReader(store, places, report)};
  for (const Id node : reader.reader.all(reader.w("Action"))) {
    const auto model = reader.action(node);
    if (!model) continue;
    try {
      actions.add(*model);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        // The text's own line and column are within the literal.
        const std::string within =
            problem.place.line ? " (line " + std::to_string(problem.place.line) + " of the text)"
                               : "";
        report.error(places.find(node), model->name, problem.what + within, problem.remedy);
      }
    }
  }
}

}  // namespace sinew::world
