#include "sinew/world/world_domain.h"

#include <string>

#include "sinew/world/symbols.h"

namespace sinew::world {

graph::Domain world_domain(graph::Terms& terms) {
  const auto w = [&](std::string_view term) {
    return terms.iri(std::string(kWorldNamespace) + std::string(term));
  };
  const auto geometry = [&](std::string_view term) {
    return terms.iri("https://comp-rob2b.github.io/metamodels/geometry/" + std::string(term));
  };
  constexpr std::size_t kAnyNumber = SIZE_MAX;
  const graph::Id frame = geometry("structural-entities#Frame");
  const graph::Role of{geometry("spatial-relations#of"), frame};
  const graph::Role with_respect_to{geometry("spatial-relations#with-respect-to"), frame};
  const graph::Role measured{w("measured-by"), w("Measurement"), 0, kAnyNumber};
  graph::Role none = with_respect_to;
  none.least = none.most = 0;
  return {"world",
          {{frame},
           {geometry("spatial-relations#Pose"), {of, with_respect_to, measured}},
           {w("Property"), {of, none, measured}},
           {w("Measurement"),
            {{w("quantity"), {}},
             {w("life-cycle"), {}},
             {w("provenance"), {}, 0, 1},
             {w("coord-frame"), {}, 0, 1},
             {w("used-by"), {}, 0, kAnyNumber},
             {w("value"), w("DataBlock"), 1, kAnyNumber}}},
           {w("DataBlock"), {{w("consistency"), w("DataBlock"), 0, 1}}},
           {w("Object"), {{w("attached-to"), frame}, {w("instance-of"), {}, 0, 1}}}}};
}

}  // namespace sinew::world
