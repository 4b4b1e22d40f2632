#include "sinew/world/scene_numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace sinew::world {
namespace {

using graph::Id;

// The values of a list, as many as `most` + 1: who asked for fewer sees that there are more.
std::vector<Id> cells(const model::GraphReader& reader, Id head, std::size_t most) {
  std::vector<Id> values;
  for (Id cell = head; cell && cell != reader.ids.nil && values.size() <= most;
       cell = reader.view.object(cell, reader.ids.rest)) {
    values.push_back(reader.view.object(cell, reader.ids.first));
  }
  return values;
}

std::optional<double> finite(const model::GraphReader& reader, Id literal) {
  const auto number = literal ? reader.view.terms().number(literal) : std::nullopt;
  return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> SceneNumbers::list(Id node, Id property, std::size_t count) {
  const auto head = reader.one(node, property, fmt::format("the list <{}>", reader.text(property)));
  if (!head) return std::nullopt;
  std::vector<double> numbers;
  const std::vector<Id> values = cells(reader, *head, count);
  for (const Id value : values) {
    if (const auto number = finite(reader, value)) numbers.push_back(*number);
  }
  if (numbers.size() == count && values.size() == count) return numbers;
  reader.error(node, property,
               fmt::format("<{}> is no list of {} finite numbers", reader.text(property), count),
               fmt::format("write {} numbers in brackets", count));
  return std::nullopt;
}

std::optional<std::vector<double>> SceneNumbers::si_list(Id node, std::string_view term,
                                                         std::size_t count) {
  const auto system = reader.one(node, w("system"), "the system of units");
  auto found = list(node, w(term), count);
  if (!system || !found) return std::nullopt;
  if (reader.text(*system) == "SI") return found;
  reader.error(node, w("system"), "there is no system of units '" + text(*system) + "'", "SI");
  return std::nullopt;
}

std::optional<Vector3> SceneNumbers::vector(Id node, Id property) {
  const auto numbers = list(node, property, 3);
  if (!numbers) return std::nullopt;
  return Vector3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::optional<std::vector<std::array<double, 2>>> SceneNumbers::corners(Id node, Id property,
                                                                        std::size_t most) {
  const auto head = reader.one(node, property, "the outline");
  if (!head) return std::nullopt;
  std::vector<std::array<double, 2>> result;
  for (const Id corner : cells(reader, *head, most)) {
    const std::vector<Id> both = cells(reader, corner, 2);
    const auto x = both.size() == 2 ? finite(reader, both[0]) : std::nullopt;
    const auto y = both.size() == 2 ? finite(reader, both[1]) : std::nullopt;
    if (!x || !y) {
      reader.error(
          node, property,
          fmt::format("corner {} of the outline is no pair of finite numbers", result.size()),
          "write the outline as [[x, y], [x, y], …]");
      return std::nullopt;
    }
    result.push_back({*x, *y});
  }
  if (result.size() > most) {
    reader.error(node, property, fmt::format("the outline has more than {} corners", most),
                 fmt::format("3 to {} corners", most));
    return std::nullopt;
  }
  return result;
}

std::optional<Pose> SceneNumbers::pose(Id node, bool required) {
  Pose result;
  if (required || has(node, "position")) {
    const auto p = vector(node, w("position"));
    const auto scale = reader.scale(node, model::dimension::kLength, "the position");
    if (!p || !scale) return std::nullopt;
    result.p = *scale * *p;
  }
  if (required || has(node, "quaternion")) {
    const auto q = list(node, w("quaternion"), 4);
    const auto scale = reader.scale(node, model::dimension::kNone, "the quaternion");
    if (!q || !scale) return std::nullopt;
    result.q = {(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
    if (*scale != 1 || !normalise(result)) {
      reader.error(node, w("quaternion"),
                   fmt::format("the quaternion {} {} {} {} is not of unit length", (*q)[0], (*q)[1],
                               (*q)[2], (*q)[3]),
                   fmt::format("x y z w of length 1 to {:g}, in UNITLESS", kQuaternionTolerance));
      return std::nullopt;
    }
  }
  return result;
}

std::optional<Duration> SceneNumbers::duration(Id node, std::string_view term) {
  const Id property = w(term);
  if (!reader.has(node, property)) return kForever;
  const auto value = reader.one(node, property, fmt::format("the duration <{}>", term));
  if (!value) return std::nullopt;
  const auto number = reader.number(*value, w("number"));
  const auto scale = reader.scale(*value, kTimeDimension, "the duration");
  if (!number || !scale) return std::nullopt;
  const double seconds = *number * *scale;
  // Durations are 64 bits of nanoseconds.
  if (seconds < 0 || seconds > 9.2e9) {
    reader.error(*value, w("number"), fmt::format("a duration of {} s", seconds),
                 "from 0 s to 9.2e9 s; leave it out for one without end");
    return std::nullopt;
  }
  return duration_of_seconds(seconds);
}

std::optional<Stamp> SceneNumbers::stamp(Id node, std::string_view term) {
  const Id property = w(term);
  if (!reader.has(node, property)) return Stamp();
  const auto value = reader.one(node, property, "the stamp");
  if (!value) return std::nullopt;
  const auto number = reader.number(*value, w("number"));
  const auto scale = reader.scale(*value, kTimeDimension, "the stamp");
  if (!number || !scale) return std::nullopt;
  const auto integer = reader.view.terms().integer_value(reader.view.object(*value, w("number")));
  if (integer && *scale == 1e-9) return stamp_of_ns(*integer);
  const double seconds = *number * *scale;
  if (std::abs(seconds) > 9.2e9) {
    reader.error(*value, w("number"), fmt::format("a stamp of {} s", seconds),
                 "one within 9.2e9 s of the beginning of the clock");
    return std::nullopt;
  }
  return Stamp(duration_of_seconds(seconds));
}

}  // namespace sinew::world
