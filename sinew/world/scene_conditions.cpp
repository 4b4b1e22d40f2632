#include "sinew/world/scene_conditions.h"

#include <string>
#include <utility>

namespace sinew::world {

const QuantityDescription* find_quantity(std::string_view name) {
  for (const QuantityDescription& row : quantities()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

data::Dimension dimension_of(std::string_view unit) {
  if (unit == "m") return model::dimension::kLength;
  if (unit == "rad") return model::dimension::kAngle;
  return model::dimension::kNone;
}

std::optional<Condition> read_condition(SceneNumbers& numbers, graph::Id node) {
  model::GraphReader& reader = numbers.reader;
  const auto measures = reader.one(node, numbers.w("measures"), "the quantity that is measured");
  if (!measures) return std::nullopt;
  const QuantityDescription* const row = find_quantity(reader.text(*measures));
  if (!row) {
    std::string known;
    for (const auto& each : quantities()) {
      known += (known.empty() ? "" : ", ") + std::string(each.name);
    }
    reader.error(node, numbers.w("measures"),
                 "there is no quantity '" + numbers.text(*measures) + "'", known);
    return std::nullopt;
  }
  const auto scale = reader.scale(node, dimension_of(row->unit), "the bounds");
  if (!scale) return std::nullopt;
  Condition condition{.quantity = std::string(row->name)};
  for (auto [term, bound] :
       {std::pair{"minimum", &condition.minimum}, std::pair{"maximum", &condition.maximum}}) {
    if (!numbers.has(node, term)) continue;
    const auto value = reader.number(node, numbers.w(term));
    if (!value) return std::nullopt;
    *bound = *scale * *value;
  }
  if (numbers.has(node, "maximum-of")) {
    condition.maximum_of = numbers.text(reader.view.object(node, numbers.w("maximum-of")));
  }
  return condition;
}

}  // namespace sinew::world
