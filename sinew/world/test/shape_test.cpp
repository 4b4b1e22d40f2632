// Distances and protrusions of shapes against closed formulas, separating axes and points drawn
// from the shapes.
#include "sinew/world/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "random_poses.h"
#include "random_shapes.h"
#include "refusal.h"
#include "sinew/base/error.h"

namespace sinew::world {
namespace {

using math::cross;
using math::dot;

double length(const Vector3& v) { return std::sqrt(dot(v, v)); }

Vector3 axis(const Pose& X, int i) {
  return rotate(X.q, {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0});
}

// Separating axes (Gottschalk 1996): boxes overlap when none of 15 directions separates them. Gives
// the largest gap along any of them, negative when they overlap.
double largest_gap(const Shape& a, const Shape& b) {
  std::vector<Vector3> directions;
  for (int i = 0; i < 3; ++i) {
    directions.push_back(axis(a.placement, i));
    directions.push_back(axis(b.placement, i));
    for (int j = 0; j < 3; ++j) {
      directions.push_back(cross(axis(a.placement, i), axis(b.placement, j)));
    }
  }
  const auto half_width = [](const Shape& shape, const Vector3& d) {
    const Vector3 size = std::get<Box>(shape.geometry).size;
    return 0.5 * (size.x * std::abs(dot(d, axis(shape.placement, 0))) +
                  size.y * std::abs(dot(d, axis(shape.placement, 1))) +
                  size.z * std::abs(dot(d, axis(shape.placement, 2))));
  };
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vector3& direction : directions) {
    if (length(direction) < 1e-9) continue;
    const Vector3 d = (1 / length(direction)) * direction;
    const double apart = std::abs(dot(d, a.placement.p - b.placement.p));
    largest = std::max(largest, apart - half_width(a, d) - half_width(b, d));
  }
  return largest;
}

TEST(Shape, BoxesTouchExactlyWhereNoAxisSeparatesThem) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> size(0.1, 2);
  int touching = 0, apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const Shape a = {Box{{size(random), size(random), size(random)}}, random_pose(random)};
    const Shape b = {Box{{size(random), size(random), size(random)}}, random_pose(random)};
    const double gap = largest_gap(a, b);
    if (std::abs(gap) < 1e-5) continue;
    ASSERT_EQ(touch(a, b), gap < 0) << "pair " << i << ", gap " << gap;
    ASSERT_GE(distance(a, b), gap - kTouchingDistance);
    ++(gap < 0 ? touching : apart);
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(apart, 500);
}

TEST(Shape, DistanceToASphereIsThatOfItsMiddleLessItsRadius) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> size(0.1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Shape sphere = {Sphere{size(random)}, random_pose(random)};
    const double radius = std::get<Sphere>(sphere.geometry).radius;
    const Pose X = random_pose(random);
    const Vector3 middle_seen = compose(invert(X), sphere.placement).p;

    const Vector3 half = {size(random), size(random), size(random)};
    const double to_box = length({std::max(0.0, std::abs(middle_seen.x) - half.x),
                                  std::max(0.0, std::abs(middle_seen.y) - half.y),
                                  std::max(0.0, std::abs(middle_seen.z) - half.z)});
    EXPECT_NEAR(distance({Box{2.0 * half}, X}, sphere), std::max(0.0, to_box - radius), 1e-6);

    const double r = size(random), h = size(random);
    const double to_cylinder =
        std::hypot(std::max(0.0, std::hypot(middle_seen.x, middle_seen.y) - r),
                   std::max(0.0, std::abs(middle_seen.z) - h / 2));
    EXPECT_NEAR(distance(sphere, {Cylinder{r, h}, X}), std::max(0.0, to_cylinder - radius), 1e-6);

    const Shape other = {Sphere{r}, X};
    EXPECT_NEAR(distance(sphere, other), std::max(0.0, length(middle_seen) - r - radius), 1e-9);
  }
}

// A lower bound of the distance is the gap along any direction; an upper bound that of any two
// points. With many of each, the answer is between them; shapes of all kinds.
TEST(Shape, DistanceLiesBetweenGapsAndPairsOfPoints) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    const Shape a = random_shape(random), b = random_shape(random);
    const double found = distance(a, b);
    EXPECT_NEAR(found, distance(b, a), 1e-6);
    double gap = 0, nearest = INFINITY;
    std::vector<Vector3> of_b;
    for (int k = 0; k < 60; ++k) of_b.push_back(random_point_in(b, random));
    for (int k = 0; k < 60; ++k) {
      const Vector3 d = {normal(random), normal(random), normal(random)};
      gap = std::max(gap, dot(d, support(a, -d) - support(b, d)) / length(d));
      const Vector3 point = random_point_in(a, random);
      for (const Vector3& other : of_b) nearest = std::min(nearest, length(point - other));
    }
    ASSERT_GE(found, gap - 1e-6) << i;
    ASSERT_LE(found, nearest + 1e-6) << i;
  }
}

TEST(Shape, ProtrusionIsNotAboveZeroExactlyWhenEveryPointIsInside) {
  std::mt19937_64 random(6);
  int inside = 0, outside = 0;
  for (int i = 0; i < 6000; ++i) {
    Shape a = random_shape(random), b = random_shape(random);
    a.placement.p = 0.15 * a.placement.p;
    b.placement.p = 0.15 * b.placement.p;
    const double most = protrusion(a, b);
    if (std::abs(most) < 1e-3) continue;
    // A point of the surface in each of many directions: of a shape that protrudes by a
    // millimetre, one of them is outside.
    bool all_inside = true;
    std::normal_distribution<double> normal;
    for (int k = 0; k < 500; ++k) {
      const Vector3 d = {normal(random), normal(random), normal(random)};
      all_inside = all_inside && contains(b, support(a, d));
    }
    if (most < 0) {
      ASSERT_TRUE(all_inside) << i << ": " << most;
    }
    if (most > 0.05) {
      ASSERT_FALSE(all_inside) << i << ": " << most;
    }
    ++(most < 0 ? inside : outside);
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 500);
}

TEST(Shape, BoundsHoldTheShapeAndTouchIt) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 500; ++i) {
    const Shape shape = random_shape(random);
    const Bounds3 box = bounds(shape);
    const Vector3 size = box.maximum - box.minimum;
    const Shape as_box = {MeshBounds{box.minimum, box.maximum}, {}};
    EXPECT_LT(protrusion(shape, as_box), 1e-12);
    EXPECT_GT(protrusion(shape, {MeshBounds{box.minimum + 1e-6 * size, box.maximum}, {}}), 0);
  }
}

TEST(Shape, BoundsOfAMeshAreThoseOfItsVertices) {
  const Vector3 vertices[] = {{1, 0, 0}, {0, -2, 0}, {0, 0, 3}};
  const MeshBounds mesh = mesh_bounds(vertices);
  EXPECT_EQ(mesh.minimum.y, -2);
  EXPECT_EQ(mesh.maximum.z, 3);
  EXPECT_NE(refusal([] { mesh_bounds({}); }).find("without vertices"), std::string::npos);
}

TEST(Shape, RefusesWhatIsNoConvexBody) {
  const Geometry wrong[] = {
      Box{{1, 0, 1}},
      Sphere{-1},
      Cylinder{1, INFINITY},
      Polygon{{{0, 0}, {1, 0}}, 0, 1},
      Polygon{{{0, 0}, {1, 0}, {1, 1}}, 1, 1},
      Polygon{{{0, 0}, {0, 1}, {1, 1}}, 0, 1},                  // clockwise
      Polygon{{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}}, 0, 1},        // a notch
      Polygon{std::vector<std::array<double, 2>>(1001), 0, 1},  // too many corners
      MeshBounds{{0, 0, 0}, {-1, 1, 1}},
  };
  for (const Geometry& geometry : wrong) {
    EXPECT_THROW(check_shape(geometry, "http://cell/thing"), Error) << geometry.index();
  }
  EXPECT_NO_THROW(check_shape(Polygon{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 0, 1}, "x"));
  EXPECT_NE(refusal([&] {
              check_shape(wrong[6], "http://cell/magazine");
            }).find("not convex and anticlockwise at corner 2"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::world
