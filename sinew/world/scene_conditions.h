// Bounds on measured quantities, as models say them: of rules and of triggers (declared_scene.h,
// declared_triggers.h).
//
//   K w:measures "height-gap" ; w:minimum n ; w:maximum n ; w:maximum-of "reach" ; qudt:unit U
#pragma once

#include <optional>

#include "sinew/world/qualitative.h"
#include "sinew/world/scene_numbers.h"

namespace sinew::world {

const QuantityDescription* find_quantity(std::string_view name);  // null where there is none
data::Dimension dimension_of(std::string_view unit);              // "m", "rad" or "1"

// Nothing, and reported, where the quantity is none or a bound is no number with its unit.
std::optional<Condition> read_condition(SceneNumbers& numbers, graph::Id node);

}  // namespace sinew::world
