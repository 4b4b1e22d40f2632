#include "sinew/synthesis/query.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sinew::synthesis {

std::string canonical_text(const Query& query) {
  std::string text = query.name + " asks";
  for (const Asked& asked : query.asked)
    text += fmt::format(" {}({};{};{})", asked.quantity, asked.of, asked.seen_by,
                        asked.with_respect_to);
  text += " given";
  for (const Given& given : query.given) {
    text += fmt::format(" {}({};{}{})", given.quantity, given.of, given.seen_by,
                        given.varies ? " varies" : "");
    if (given.quantity != "acceleration-constraint") continue;
    text += fmt::format(" {} {} {}", given.iri, fmt::join(given.directions, " "),
                        given.direction_inputs);
    for (const auto& force : given.unit_forces) text += fmt::format(" [{}]", fmt::join(force, " "));
  }
  text += " base " + query.base + " tips";
  for (const std::string& tip : query.tips) text += " " + tip;
  if (query.gravity)
    text += fmt::format(" gravity {} {} {}", (*query.gravity)[0], (*query.gravity)[1],
                        (*query.gravity)[2]);
  if (query.floating) text += " floating";
  if (!query.regroup) text += " stated inertias";
  if (query.forces == Forces::kApart) text += " forces apart";
  if (query.frames == Frames::kStationary) text += " stationary frames";
  const DriverPolicy& drivers = query.drivers;
  if (drivers.singular != Singular::kUnstated)
    text +=
        fmt::format(" singular {} {}", static_cast<int>(drivers.singular), drivers.singular_number);
  if (drivers.list != DriverList::kTogether)
    text += fmt::format(" drivers {}", static_cast<int>(drivers.list));
  if (!drivers.limited.empty()) text += " limited " + drivers.limited;
  for (const Held& held : query.held) text += fmt::format(" holds {}({})", held.quantity, held.of);
  if (!query.sweeps.empty()) text += " sweeps " + query.sweeps;
  return text;
}

}  // namespace sinew::synthesis
