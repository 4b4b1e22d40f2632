#include "sinew/synthesis/factors.h"

#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;

std::uint32_t width(const Context& context) {
  std::uint32_t count = context.query.floating ? 5 : 0;
  for (const Coordinate& coordinate : coordinates(context.robot))
    count += static_cast<std::uint32_t>(coordinate.parts.size());
  return count;
}

BlockIndex make_width(Context& context) {
  const double count[] = {static_cast<double>(width(context))};
  BlockSpec spec = whole(context, "number-of-coordinates", "coordinate-map");
  spec.size = 1;
  spec.role = algorithm::Role::kConstant;
  spec.value = count;
  return context.make(spec);
}

BlockSpec of_all(const Context& context, std::string_view slot, std::string_view quantity) {
  return {.slot = slot,
          .represents = context.robot.root_body,
          .quantity = quantity,
          .size = width(context),
          .label = algorithm::kWholeRobot};
}

void join_forces(Context& context, const std::function<BlockIndex(std::size_t part)>& force,
                 BlockIndex all) {
  std::vector<BlockIndex> blocks;
  for (const Coordinate& coordinate : coordinates(context.robot))
    for (const std::size_t part : coordinate.parts) blocks.push_back(force(part));
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(all);
  const Id body = context.robot.root_body;
  if (context.query.floating)
    context.closure_with_counts("join-floating-forces", std::move(blocks), {1, count - 1, 1}, body);
  else
    context.closure_with_counts("join-joint-forces", std::move(blocks), {count, 1}, body);
}

}  // namespace sinew::synthesis
