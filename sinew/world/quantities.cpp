#include "sinew/world/quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew::world {
namespace {

using math::dot;

double shortest(const std::vector<Shape>& a, const std::vector<Shape>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Shape& of_a : a) {
    for (const Shape& of_b : b) least = std::min(least, distance(of_a, of_b));
  }
  return least;
}

double between_bodies(const Seen& a, const Seen& b, const Seen*) {
  return shortest(a.shapes, b.shapes);
}
double from_origin(const Seen& a, const Seen& b, const Seen*) {
  return shortest(a.shapes, {{Sphere{0}, {{}, b.origin}}});
}
double height_gap(const Seen& a, const Seen& b, const Seen*) {
  return a.box.minimum.z - b.box.maximum.z;
}
// How much of [a_low, a_high] lies in [b_low, b_high]; a point counts whole.
double share_of(double a_low, double a_high, double b_low, double b_high) {
  if (a_high == a_low) return a_low >= b_low && a_low <= b_high ? 1 : 0;
  return std::max(0.0, std::min(a_high, b_high) - std::max(a_low, b_low)) / (a_high - a_low);
}
double covered(const Seen& a, const Seen& b, const Seen*) {
  const auto& [low, high] = a.box;
  return share_of(low.x, high.x, b.box.minimum.x, b.box.maximum.x) *
         share_of(low.y, high.y, b.box.minimum.y, b.box.maximum.y);
}
double most_outside(const Seen& a, const Seen& b, const Seen*) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Shape& of_a : a.shapes) {
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& of_b : b.shapes) least = std::min(least, protrusion(of_a, of_b));
    most = std::max(most, least);
  }
  return most;
}
double side_gap(const Seen& a, const Seen& b, const Seen*) {
  return std::max({a.box.minimum.x - b.box.maximum.x, b.box.minimum.x - a.box.maximum.x,
                   a.box.minimum.y - b.box.maximum.y, b.box.minimum.y - a.box.maximum.y});
}
double forward(const Seen& a, const Seen& b, const Seen*) { return (a.centre() - b.centre()).x; }
double left(const Seen& a, const Seen& b, const Seen*) { return (a.centre() - b.centre()).y; }
double up(const Seen& a, const Seen& b, const Seen*) { return (a.centre() - b.centre()).z; }
double bearing(const Seen& a, const Seen& b, const Seen*) {
  return std::atan2(left(a, b, nullptr), forward(a, b, nullptr));
}
double bearing_size(const Seen& a, const Seen& b, const Seen*) {
  return std::abs(bearing(a, b, nullptr));
}
double share_of_way(const Seen& a, const Seen& b, const Seen* c) {
  const Vector3 way = c->centre() - b.centre();
  const double square = dot(way, way);
  return square > 0 ? dot(a.centre() - b.centre(), way) / square : 0;
}
double off_the_way(const Seen& a, const Seen& b, const Seen* c) {
  const double share = std::clamp(share_of_way(a, b, c), 0.0, 1.0);
  const Vector3 off = a.centre() - b.centre() - share * (c->centre() - b.centre());
  return std::sqrt(dot(off, off));
}

struct Row {
  QuantityDescription description;
  double (*measure)(const Seen&, const Seen&, const Seen*);
};

// Bounds and centres are those of the boxes along the axes that hold the bodies.
constexpr Row kRows[] = {
    {{"distance", "m", "between the nearest points of the two; 0 where they touch"},
     between_bodies},
    {{"distance-from-origin", "m", "from the origin of the second's frame to the first"},
     from_origin},
    {{"protrusion", "m", "how far the first sticks out of the second; negative: well inside"},
     most_outside},
    {{"height-gap", "m", "from the second's highest point to the first's lowest"}, height_gap},
    {{"covered-share", "1", "of the first's bounds in x and y, the part over the second's"},
     covered},
    {{"side-gap", "m",
      "between their bounds in x and y, the wider; negative: one is over the other"},
     side_gap},
    {{"forward-offset", "m", "of the first's centre from the second's, along x"}, forward},
    {{"left-offset", "m", "the same along y"}, left},
    {{"up-offset", "m", "the same along z"}, up},
    {{"bearing", "rad", "of the first's centre from the second's, about z from x"}, bearing},
    {{"bearing-size", "rad", "the bearing without its sign"}, bearing_size},
    {{"share-of-way", "1", "where the first is on the way from the second to the third", true},
     share_of_way},
    {{"off-the-way", "m", "how far the first is from that way, centre to centre", true},
     off_the_way},
};

constexpr auto kDescriptions = [] {
  std::array<QuantityDescription, std::size(kRows)> result{};
  for (std::size_t i = 0; i < std::size(kRows); ++i) result[i] = kRows[i].description;
  return result;
}();

}  // namespace

std::span<const QuantityDescription> quantities() { return kDescriptions; }

double measure(std::size_t index, const Seen& first, const Seen& second, const Seen* third) {
  return kRows[index].measure(first, second, third);
}

Seen see(const Pose& X_axes_space, const Space& space, BodyId body) {
  Seen seen;
  for (const Shape& shape : space.shapes(body)) seen.shapes.push_back(placed(X_axes_space, shape));
  seen.origin = compose(X_axes_space, space.pose(body).pose).p;
  seen.box = bounds(seen.shapes);
  return seen;
}

}  // namespace sinew::world
