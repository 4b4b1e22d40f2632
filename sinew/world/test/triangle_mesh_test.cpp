// Meshes as shapes: what touches them, how far from them, what is inside; against the shapes that
// they are the surfaces of, looking at every triangle, and FCL.
#include "sinew/world/triangle_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "meshes.h"
#include "random_shapes.h"
#include "refusal.h"
#include "sinew/base/error.h"
#include "sinew/world/convex_distance.h"
#include "sinew/world/edit.h"
#include "sinew/world/space.h"
#include "times_and_places.h"

#ifdef SINEW_HAVE_FCL
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#endif

namespace sinew::world {
namespace {

Vector3 in(const Shape& shape, const Vector3& point) {
  return compose(invert(shape.placement), {{}, point}).p;
}
bool encloses(const Shape& mesh, const Vector3& point) {
  return encloses(*std::get<Mesh>(mesh.geometry).triangles, in(mesh, point));
}
Shape nearer(Shape shape, double by) {
  shape.placement.p = by * shape.placement.p;
  return shape;
}

TEST(TriangleMesh, IsClosedWhereEveryEdgeIsPassedThereAndBack) {
  MeshData box = box_mesh({1, 1, 1});
  EXPECT_TRUE(box.mesh().triangles->is_closed);
  box.triangles.pop_back();
  EXPECT_FALSE(box.mesh().triangles->is_closed);
  MeshData turned = box_mesh({1, 1, 1});
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_FALSE(turned.mesh().triangles->is_closed) << "one face seen from the other side";
  // A file that states each triangle's corners anew.
  MeshData loose;
  for (const Corners& corners : box_mesh({1, 1, 1}).triangles) {
    for (const std::uint32_t corner : corners) {
      loose.vertices.push_back(box_mesh({1, 1, 1}).vertices[corner]);
    }
    const auto n = static_cast<std::uint32_t>(loose.vertices.size());
    loose.triangles.push_back({n - 3, n - 2, n - 1});
  }
  EXPECT_TRUE(loose.mesh().triangles->is_closed);
  EXPECT_EQ(loose.mesh().triangles->vertices.size(), 8u);
  EXPECT_EQ(loose.mesh().triangles->parts.size(), 1u);
}

TEST(TriangleMesh, EnclosesThePointsOfItsSolid) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> coordinate(-1.3, 1.3);
  const double ring = 0.8, tube = 0.3;
  const Mesh torus = torus_mesh(ring, tube, 64, 32).mesh();
  const Mesh angle = angle_mesh(1, 0.3, 1).mesh();
  int within = 0, outside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = {coordinate(random), coordinate(random), coordinate(random)};
    const double from_ring = std::hypot(std::hypot(p.x, p.y) - ring, p.z);
    // Towards the axis, triangles stand out of the torus by as much.
    const double sagitta = tube * (1 - std::cos(M_PI / 32)) + (ring + tube) * (1 - cos(M_PI / 64));
    if (from_ring > tube + sagitta || from_ring < tube - sagitta) {
      ASSERT_EQ(encloses(*torus.triangles, p), from_ring < tube) << i;
      ++(from_ring < tube ? within : outside);
    }
    const bool in_angle = p.z > 0 && p.z < 1 && p.x > 0 && p.y > 0 &&
                          ((p.x < 1 && p.y < 0.3) || (p.x < 0.3 && p.y < 1));
    ASSERT_EQ(encloses(*angle.triangles, p), in_angle) << i;
  }
  EXPECT_GT(within, 500);
  EXPECT_GT(outside, 5000);
  // Below the middle of edges, where rays from grid points like to go.
  for (const Vector3& p : {Vector3{0.15, 0.15, 0.5}, {0.3, 0.15, 0.5}, {0.15, 0.15, 0.15}}) {
    EXPECT_TRUE(encloses(*angle.triangles, p));
  }
}

TEST(TriangleMesh, OfABoxIsToEveryShapeWhatTheBoxIs) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> size(0.1, 2);
  int touching = 0, within = 0, around = 0;
  for (int i = 0; i < 6000; ++i) {
    const double scale = i % 3 == 0 ? 0.2 : 1;
    const Vector3 sizes = {scale * size(random), scale * size(random), scale * size(random)};
    const Pose X = random_pose(random);
    Shape box = {Box{sizes}, X}, mesh = {box_mesh(sizes).mesh(), X};
    const double by = i % 2 == 0 ? 0.15 : 1;
    box = nearer(box, by), mesh = nearer(mesh, by);
    const Shape other = nearer(random_shape(random), by);
    ASSERT_NEAR(distance(mesh, other), distance(box, other), 3e-7) << i;
    ASSERT_NEAR(distance(other, mesh), distance(other, box), 3e-7) << i;
    const double apart = distance(box, other);
    if (apart == 0 || apart > 2e-6) {
      ASSERT_EQ(touch(mesh, other), apart == 0) << i;
      ASSERT_EQ(touch(other, mesh), apart == 0) << i;
      touching += apart == 0;
    }
    const double sticks_out = protrusion(other, box);
    if (std::abs(sticks_out) > 3e-6) {
      ASSERT_EQ(inside(other, mesh), sticks_out < 0) << i;
      within += sticks_out < 0;
    }
    const double mesh_sticks_out = protrusion(mesh, other);
    ASSERT_NEAR(mesh_sticks_out, protrusion(box, other), 1e-9) << i;
    around += inside(mesh, other);
    const Bounds3 found = bounds(mesh), right = bounds(box);
    ASSERT_NEAR(found.minimum.x, right.minimum.x, 1e-12);
    ASSERT_NEAR(found.maximum.z, right.maximum.z, 1e-12);
  }
  EXPECT_GT(touching, 1500);
  EXPECT_GT(within, 50);
  EXPECT_GT(around, 50);
}

// Flush faces, of the same box and of one in a corner: inside. A thousandth of a millimetre counts
// as touching, a hundredth does not.
TEST(TriangleMesh, WhatIsFlushWithItIsInside) {
  const Shape mesh = {box_mesh({1, 1, 1}).mesh(), {}};
  EXPECT_TRUE(inside({Box{{1, 1, 1}}, {}}, mesh));
  EXPECT_TRUE(inside({Box{{0.5, 0.5, 0.5}}, {{}, {0.25, 0.25, 0.25}}}, mesh));
  EXPECT_FALSE(inside({Box{{0.5, 0.5, 0.5}}, {{}, {0.25001, 0.25, 0.25}}}, mesh));
  EXPECT_TRUE(inside({Cylinder{0.5, 1}, {}}, mesh));
  EXPECT_TRUE(inside({Sphere{0.5}, {}}, mesh));
  EXPECT_FALSE(inside({Sphere{0.50001}, {}}, mesh));
  EXPECT_TRUE(inside({MeshBounds{{-0.5, -0.5, 0}, {0.5, 0.5, 0.001}}, {}}, mesh));
  EXPECT_TRUE(inside({Polygon{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}}, -0.5, 0.5}, {}}, mesh));
  EXPECT_FALSE(inside({Polygon{{{-0.5, -0.5}, {0.6, -0.5}, {0.5, 0.5}}, -0.5, 0.5}, {}}, mesh));
  EXPECT_TRUE(inside(mesh, {Box{{1, 1, 1}}, {}}));
  // A plate that is thinner than what touches.
  EXPECT_TRUE(inside({Box{{0.5, 0.5, 1e-6}}, {}}, mesh));
  EXPECT_FALSE(inside({Box{{0.5, 0.5, 1e-6}}, {{}, {0, 0, 0.6}}}, mesh));
}

TEST(TriangleMesh, OfATorusIsAsFarAsItsNearestTriangle) {
  std::mt19937_64 random(23);
  const Mesh torus = torus_mesh(0.8, 0.3, 24, 12).mesh();
  int touching = 0, apart = 0, hole = 0;
  for (int i = 0; i < 400; ++i) {
    const Shape mesh = {torus, random_pose(random)};
    const Shape other = random_shape(random);
    double least = std::numeric_limits<double>::infinity();
    const math::Pose<double> X = to_matrix(mesh.placement);
    for (std::uint32_t k = 0; k < torus.triangles->triangles.size(); ++k) {
      Triangle triangle{torus.triangles->corners(k)};
      for (Vector3& corner : triangle.corners) corner = X.p + X.R * corner;
      least = std::min(least, convex_distance(triangle, ConvexShape{other}));
    }
    const bool is_within = encloses(mesh, support(other, {0, 0, 1}));
    ASSERT_NEAR(distance(mesh, other), is_within ? 0 : least, 3e-7) << i;
    ASSERT_EQ(touch(mesh, other), is_within || least <= kTouchingDistance) << i;
    ++(touch(mesh, other) ? touching : apart);
    hole += !touch(mesh, other) &&
            touch({MeshBounds{torus.triangles->bounds().minimum, torus.triangles->bounds().maximum},
                   mesh.placement},
                  other);
  }
  EXPECT_GT(touching, 50);
  EXPECT_GT(apart, 50);
  EXPECT_GT(hole, 10) << "what its bounds touch, and it does not";
}

TEST(TriangleMesh, NothingOfWhatIsInsideATorusIsOutside) {
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> share(0, 1);
  const double ring = 0.8, tube = 0.3;
  const Mesh torus = torus_mesh(ring, tube, 48, 24).mesh();
  // Triangles are at most so far below the true torus.
  const double sagitta = tube * (1 - std::cos(M_PI / 24)) + (ring + tube) * (1 - cos(M_PI / 48));
  int within = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Shape mesh = {torus, random_pose(random)};
    Shape other = random_shape(random);
    const double u = 2 * M_PI * share(random);
    other.placement = compose(mesh.placement,
                              {random_pose(random).q, {ring * std::cos(u), ring * std::sin(u), 0}});
    const double shrink = 0.1 + 0.2 * share(random);
    if (auto* box = std::get_if<Box>(&other.geometry)) {
      box->size = shrink * box->size;
    } else if (auto* sphere = std::get_if<Sphere>(&other.geometry)) {
      sphere->radius *= 2 * shrink;
    } else if (auto* cylinder = std::get_if<Cylinder>(&other.geometry)) {
      cylinder->radius *= shrink, cylinder->height *= shrink;
    } else {
      continue;
    }
    double most = 0;  // from the ring
    for (int k = 0; k < 300; ++k) {
      const Vector3 p = in(mesh, support(other, random_pose(random).p));
      most = std::max(most, std::hypot(std::hypot(p.x, p.y) - ring, p.z));
    }
    const bool found = inside(other, mesh);
    // Distance from the ring is no convex function; that from the axis of a piece of it is nearly.
    if (most < 0.8 * (tube - sagitta)) {
      ASSERT_TRUE(found) << i << ": " << most;
    }
    if (most > tube) {
      ASSERT_FALSE(found) << i << ": " << most;
    }
    ++(found ? within : outside);
  }
  EXPECT_GT(within, 300);
  EXPECT_GT(outside, 50);
}

TEST(TriangleMesh, ToAnotherMeshGoesBySurfacesAndSolids) {
  const Mesh torus = torus_mesh(1, 0.2, 96, 48).mesh();
  const Shape first = {torus, {}};
  // A link of a chain: their rings cross at right angles, and the tubes are 1 - 0.4 apart.
  const Shape second = {torus, {{std::sqrt(0.5), 0, 0, std::sqrt(0.5)}, {1, 0, 0}}};
  EXPECT_FALSE(touch(first, second));
  EXPECT_NEAR(distance(first, second), 0.6, 0.005);
  EXPECT_TRUE(touch(first, {torus, {{}, {0.3, 0, 0}}}));
  // A box in the tube, and a torus around nothing.
  const Shape box = {box_mesh({0.1, 0.1, 0.1}).mesh(), {{}, {1, 0, 0}}};
  EXPECT_EQ(distance(first, box), 0);
  EXPECT_EQ(distance(box, first), 0);
  EXPECT_TRUE(inside(box, first));
  EXPECT_FALSE(inside(first, box));
  EXPECT_FALSE(inside({box_mesh({0.1, 0.1, 0.1}).mesh(), {}}, first));
  EXPECT_NEAR(distance(first, {box_mesh({0.1, 0.1, 0.1}).mesh(), {}}), 0.8 - 0.05 * std::sqrt(2.0),
              0.005);
  // Two parts, one of which is inside: neither surface touches the other.
  MeshData parts = box_mesh({0.1, 0.1, 0.1});
  for (const Vector3& v : box_mesh({0.1, 0.1, 0.1}).vertices) {
    parts.vertices.push_back(v + Vector3{1, 0, 0});
  }
  for (const auto& [a, b, c] : box_mesh({0.1, 0.1, 0.1}).triangles) {
    parts.triangles.push_back({a + 8, b + 8, c + 8});
  }
  const Shape apart = {parts.mesh(), {}};
  EXPECT_EQ(std::get<Mesh>(apart.geometry).triangles->parts.size(), 2u);
  EXPECT_TRUE(touch(apart, first));
  EXPECT_FALSE(inside(apart, first));
}

TEST(TriangleMesh, AnOpenOneIsASurfaceAndNothingIsInside) {
  MeshData tray = box_mesh({1, 1, 0.2});
  tray.triangles.resize(tray.triangles.size() - 2);  // without the lid on top
  const Shape mesh = {tray.mesh(), {}};
  const Shape pea = {Sphere{0.05}, {}};
  EXPECT_FALSE(touch(mesh, pea));
  EXPECT_NEAR(distance(mesh, pea), 0.05, 1e-6);
  EXPECT_FALSE(inside(pea, mesh));
  EXPECT_TRUE(touch(mesh, {Sphere{0.1}, {}}));
}

TEST(TriangleMesh, WhatIsNoneIsRefused) {
  const std::vector<Vector3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
  const std::vector<Corners> beyond = {{0, 1, 3}}, bad = {{0, 1, 2}};
  EXPECT_NE(refusal([&] { make_mesh(vertices, {}); }).find("without triangles"), std::string::npos);
  EXPECT_NE(refusal([&] { make_mesh(vertices, beyond); }).find("is no vertex"), std::string::npos);
  EXPECT_NE(refusal([&] { make_mesh(vertices, bad); }).find("not finite"), std::string::npos);
  const std::vector<Corners> many(kMaximumMeshTriangles + 1, Corners{0, 1, 1});
  EXPECT_NE(refusal([&] { make_mesh(vertices, many); }).find("at most 4194304"), std::string::npos);
  const std::vector<Vector3> dense(kMaximumMeshVertices + 1);
  EXPECT_NE(refusal([&] { make_mesh(dense, bad); }).find("16777216"), std::string::npos);
  EXPECT_NE(refusal([] { check_shape(Mesh{}, "http://cell/bolt"); }).find("http://cell/bolt"),
            std::string::npos);
}

// ---- in a space ----

// An angle whose arms enclose a notch: the region in the notch is in the bounds, and not in it.
TEST(SpaceMesh, RegionsMeetItsTrianglesAndFollowItsFrame) {
  World world;
  const FrameId cell = world.add_frame("http://cell/cell");
  const FrameId part = world.add_frame("http://cell/frame");
  const RelationId pose =
      world.add_relation({.name = "http://cell/pose", .of = part, .with_respect_to = cell});
  const MeasurementId seen = world.add_measurement(
      {.name = "http://cell/seen",
       .relation = pose,
       .model = {.life_cycle = TimeDependent{}, .provenance = "http://cell/camera"}});
  Space space(world, cell);
  const BodyId angle =
      space.add(world.add_object("http://cell/angle", part), {{angle_mesh(1, 0.3, 1).mesh(), {}}});
  const Pose notch = {{}, {0.65, 0.65, 0.5}};
  const Shape regions[] = {
      {Box{{0.5, 0.5, 0.5}}, notch},
      {Sphere{0.3}, notch},
      {Cylinder{0.3, 0.5}, notch},
      {Polygon{{{-0.2, -0.2}, {0.2, -0.2}, {0, 0.2}}, -0.2, 0.2}, notch},
      {MeshBounds{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}}, notch},
      {torus_mesh(0.2, 0.05, 12, 8).mesh(), notch},
  };
  for (const Shape& region : regions) {
    space.add_area("http://cell/area-" + std::to_string(region.geometry.index()), cell, {region});
  }
  const auto found = [&](std::size_t i, Match match) {
    const bool by_volume = !space.within(cell, {regions[i]}, match).bodies.empty();
    const bool by_name =
        !space.within("http://cell/area-" + std::to_string(i), match).bodies.empty();
    EXPECT_EQ(by_volume, by_name) << i;
    return by_volume;
  };
  const WriteContext camera{"http://cell/camera"};
  world.write(seen, at_s(1), Pose{}, camera);
  space.update(at_s(1));
  for (std::size_t i = 0; i < std::size(regions); ++i) EXPECT_FALSE(found(i, Match::kTouching));
  // 0.2 m on along x and y: the arm that leads along y comes through the notch.
  world.write(seen, at_s(2), Pose{{}, {0.4, 0.4, 0}}, camera);
  space.update(at_s(2));
  for (std::size_t i = 0; i < std::size(regions); ++i) {
    EXPECT_TRUE(found(i, Match::kTouching)) << i;
    EXPECT_FALSE(found(i, Match::kInside)) << i;
  }
  EXPECT_EQ(
      space.within(cell, {{Box{{1.001, 1.001, 1.001}}, {{}, {0.9, 0.9, 0.5}}}}, Match::kInside)
          .bodies,
      std::vector<BodyId>{angle});
  // Its corners are in, its bounds' are not: the fourth corner of an L is empty.
  const Shape without_corner = {Polygon{{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 1}, {0, 1}}, 0, 1},
                                {{}, {0.4, 0.4, 0}}};
  EXPECT_EQ(space.within(cell, {without_corner}, Match::kInside).bodies,
            std::vector<BodyId>{angle});
}

TEST(SpaceMesh, AnOpenRegionHoldsNothingAndIsRefused) {
  World world;
  const FrameId cell = world.add_frame("http://cell/cell");
  Space space(world, cell);
  MeshData open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  space.add_area("http://cell/open", cell, {{open.mesh(), {}}});
  space.update(at_s(1));
  EXPECT_NE(refusal([&] {
              space.within("http://cell/open", Match::kInside);
            }).find("http://cell/open: a mesh of the region is open"),
            std::string::npos);
  EXPECT_EQ(space.within("http://cell/open", Match::kTouching).status, Status::kOk);
}

// ---- FCL ----

TEST(TriangleMesh, AgreesWithFcl) {
#ifndef SINEW_HAVE_FCL
  GTEST_SKIP() << "no FCL (libfcl-dev)";
#else
  const auto transform = [](const Pose& X) {
    fcl::Transform3d at = fcl::Transform3d::Identity();
    at.linear() = fcl::Quaterniond(X.q.w, X.q.x, X.q.y, X.q.z).toRotationMatrix();
    at.translation() = fcl::Vector3d(X.p.x, X.p.y, X.p.z);
    return at;
  };
  const MeshData data = torus_mesh(0.8, 0.3, 32, 16);
  const Mesh torus = data.mesh();
  const auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd> >();
  model->beginModel();
  for (const auto& [a, b, c] : data.triangles) {
    const auto at = [&](std::uint32_t i) {
      return fcl::Vector3d(data.vertices[i].x, data.vertices[i].y, data.vertices[i].z);
    };
    model->addTriangle(at(a), at(b), at(c));
  }
  model->endModel();
  std::mt19937_64 random(25);
  int touching = 0, apart = 0;
  for (int i = 0; i < 600; ++i) {
    const Shape mesh = {torus, random_pose(random)};
    Shape other = random_shape(random);
    other.placement.p = 0.7 * other.placement.p;
    std::shared_ptr<fcl::CollisionGeometryd> geometry;
    if (const auto* box = std::get_if<Box>(&other.geometry)) {
      geometry = std::make_shared<fcl::Boxd>(box->size.x, box->size.y, box->size.z);
    } else if (const auto* sphere = std::get_if<Sphere>(&other.geometry)) {
      geometry = std::make_shared<fcl::Sphered>(sphere->radius);
    } else if (const auto* cylinder = std::get_if<Cylinder>(&other.geometry)) {
      geometry = std::make_shared<fcl::Cylinderd>(cylinder->radius, cylinder->height);
    } else {  // the mesh itself, elsewhere
      other.geometry = torus;
      geometry = model;
    }
    // To FCL a mesh is a surface: what is enclosed, it does not touch.
    const bool enclosed = encloses(mesh, support(other, {1, 0, 0}));
    const double ours = distance(mesh, other);
    fcl::CollisionResultd collision;
    fcl::collide(model.get(), transform(mesh.placement), geometry.get(), transform(other.placement),
                 fcl::CollisionRequestd(), collision);
    if (ours == 0 || ours > 1e-4) {
      ASSERT_EQ(touch(mesh, other), collision.isCollision() || enclosed) << i << ": " << ours;
    }
    ++(touch(mesh, other) ? touching : apart);
    if (ours > 1e-3) {
      fcl::DistanceResultd result;
      fcl::distance(model.get(), transform(mesh.placement), geometry.get(),
                    transform(other.placement), fcl::DistanceRequestd(), result);
      ASSERT_NEAR(ours, result.min_distance, 1e-5) << i;
    }
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 100);
#endif
}

}  // namespace
}  // namespace sinew::world
