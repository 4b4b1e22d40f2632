// Meshes from files: how far they reach, by which unit and scale, and what is refused.
#include "sinew/world/mesh_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "refusal.h"
#include "sinew/model/load.h"
#include "sinew/world/scene.h"

namespace sinew::world {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("sinew_mesh_" + std::to_string(::getpid()))) {
    fs::create_directories(path / "meshes");
  }
  ~Folder() { fs::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / "meshes" / name, std::ios::binary) << text;
    return (path / "meshes" / name).string();
  }
  fs::path path;
};

// A wedge from (0, 0, 0) to (2, 3, 4), in three languages.
const float kCorners[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
const int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string text_stl() {
  std::string text = "solid wedge\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : face) {
      text += "vertex " + std::to_string(kCorners[i][0]) + " " + std::to_string(kCorners[i][1]) +
              " " + std::to_string(kCorners[i][2]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid wedge\n";
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  const std::uint32_t count = 4;
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& face : kFaces) {
    float numbers[12] = {};
    for (std::size_t k = 0; k < 3; ++k) std::memcpy(numbers + 3 + 3 * k, kCorners[face[k]], 12);
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string obj() {
  std::string text;
  for (const auto& corner : kCorners) {
    text += "v " + std::to_string(corner[0]) + " " + std::to_string(corner[1]) + " " +
            std::to_string(corner[2]) + "\n";
  }
  for (const auto& face : kFaces) {
    text += "f " + std::to_string(face[0] + 1) + " " + std::to_string(face[1] + 1) + " " +
            std::to_string(face[2] + 1) + "\n";
  }
  return text;
}

// In centimetres, z up, and moved along x by a node.
std::string dae() {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="wedge"><mesh>
  <source id="corners"><float_array id="numbers" count="12">0 0 0 200 0 0 0 300 0 0 0 400</float_array>
   <technique_common><accessor source="#numbers" count="4" stride="3"><param name="X" type="float"/>
    <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="vertices"><input semantic="POSITION" source="#corners"/></vertices>
  <triangles count="4"><input semantic="VERTEX" source="#vertices" offset="0"/>
   <p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="scene"><node id="at"><translate>100 0 0</translate>
  <instance_geometry url="#wedge"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)";
}

TEST(MeshFile, EveryFormatReachesAsFar) {
  const Folder folder;
  struct Case {
    std::string name, text;
    double x;
  };
  for (const Case& one : {Case{"text.stl", text_stl(), 0}, Case{"binary.stl", binary_stl(), 0},
                          Case{"wedge.obj", obj(), 0}, Case{"wedge.dae", dae(), 1}}) {
    const Mesh mesh = load_mesh(folder.write(one.name, one.text), {1, 1, 1});
    EXPECT_EQ(mesh.triangles->triangles.size(), 4u) << one.name;
    EXPECT_TRUE(mesh.triangles->is_closed) << one.name;
    const Bounds3& found = mesh.triangles->bounds();
    EXPECT_NEAR(found.minimum.x, one.x, 1e-6) << one.name;
    EXPECT_NEAR(found.maximum.x, one.x + 2, 1e-6) << one.name;
    EXPECT_NEAR(found.maximum.y, 3, 1e-6) << one.name;
    EXPECT_NEAR(found.maximum.z, 4, 1e-6) << one.name;
  }
  // In millimetres, and mirrored along y.
  const Mesh mirrored =
      load_mesh((folder.path / "meshes/text.stl").string(), {0.001, -0.001, 0.001});
  EXPECT_TRUE(mirrored.triangles->is_closed);
  const Bounds3& scaled = mirrored.triangles->bounds();
  EXPECT_NEAR(scaled.maximum.x, 0.002, 1e-9);
  EXPECT_NEAR(scaled.minimum.y, -0.003, 1e-9);
}

TEST(MeshFile, NamesAreResolvedByWhatIsDeclaredAlone) {
  const MeshFiles files{.packages = {{"cell", "/roots/cell"}}, .directory = "/here"};
  EXPECT_EQ(resolve_mesh("package://cell/meshes/a.stl", files), "/roots/cell/meshes/a.stl");
  EXPECT_EQ(resolve_mesh("file:///meshes/a.stl", files), "/meshes/a.stl");
  EXPECT_EQ(resolve_mesh("a.stl", files), "/here/a.stl");
  EXPECT_NE(refusal([&] {
              resolve_mesh("package://other/a.stl", files);
            }).find("the root of the package 'other' is not declared"),
            std::string::npos);
  EXPECT_NE(refusal([&] { resolve_mesh("a.stl", {}); }).find("a relative path"), std::string::npos);
  EXPECT_NE(refusal([&] { resolve_mesh("http://x/a.stl", files); }).find("is no file here"),
            std::string::npos);
  EXPECT_NE(refusal([&] { resolve_mesh("package://cell", files); }), "none");
}

TEST(MeshFile, WhatIsNoMeshIsRefused) {
  const Folder folder;
  EXPECT_NE(refusal([&] {
              load_mesh((folder.path / "none.stl").string(), {1, 1, 1});
            }).find("the mesh is not read"),
            std::string::npos);
  EXPECT_NE(refusal([&] { load_mesh(folder.write("no.obj", "f 1 2 3\n"), {1, 1, 1}); }), "none");
  EXPECT_NE(refusal([&] {
              load_mesh(folder.write("no.dae", "<x/>"), {1, 1, 1});
            }).find("is no mesh"),
            std::string::npos);
  // As large as the limit allows, and one byte more; nothing of it is read.
  const std::string large = folder.write("large.stl", "solid");
  fs::resize_file(large, kMaximumMeshBytes + 1);
  EXPECT_NE(refusal([&] { load_mesh(large, {1, 1, 1}); }).find("bytes"), std::string::npos);
}

// A file that is at a limit is read, one that is over it is refused with the limit and the file.
TEST(MeshFile, EveryLimitIsKept) {
  const Folder folder;
  const std::string file = folder.write("wedge.obj", obj());
  const std::size_t bytes = obj().size();
  struct Case {
    std::string what;
    MeshLimits at, over;
  };
  // Without welding: what the file's faces are taken apart to.
  const Case cases[] = {
      {"bytes", {.bytes = bytes}, {.bytes = bytes - 1}},
      {"triangles", {.triangles = 4}, {.triangles = 3}},
      {"vertices", {.vertices = 12}, {.vertices = 3}},
  };
  for (const Case& one : cases) {
    EXPECT_EQ(refusal([&] { load_mesh(file, {1, 1, 1}, one.at); }), "none") << one.what;
    const std::string said = refusal([&] { load_mesh(file, {1, 1, 1}, one.over); });
    EXPECT_NE(said.find(one.what), std::string::npos) << said;
    EXPECT_NE(said.find("wedge.obj"), std::string::npos) << said;
  }
}

// Of the file's own nodes; the reader puts a root above them.
TEST(MeshFile, NodesWithinNodesAreAsDeepAsTheLimit) {
  const Folder folder;
  const auto nested = [&](std::size_t nodes) {
    std::string text = dae();
    const std::string open = "<node id=\"at\"><translate>100 0 0</translate>", close = "</node>";
    std::string before, after;
    for (std::size_t i = 1; i < nodes; ++i) {
      before += "<node id=\"n" + std::to_string(i) + "\">";
      after += close;
    }
    text.insert(text.find(close) + close.size(), after);
    text.insert(text.find(open), before);
    return folder.write("deep.dae", text);
  };
  EXPECT_EQ(refusal([&] { load_mesh(nested(kMaximumMeshDepth - 1), {1, 1, 1}); }), "none");
  const std::string said = refusal([&] { load_mesh(nested(kMaximumMeshDepth + 2), {1, 1, 1}); });
  EXPECT_NE(said.find("more than 64 deep"), std::string::npos) << said;
  EXPECT_EQ(refusal([&] { load_mesh(nested(5), {1, 1, 1}, {.depth = 5}); }), "none");
  EXPECT_NE(refusal([&] { load_mesh(nested(5), {1, 1, 1}, {.depth = 3}); }), "none");
}

// Each mention of a mesh counts: a small file may not grow without bound.
TEST(MeshFile, MentionsOfAMeshCountEach) {
  const Folder folder;
  std::string text = dae();
  const std::string one = "<instance_geometry url=\"#wedge\"/>";
  for (int i = 0; i < 9; ++i) text.insert(text.find(one), one);
  const std::string file = folder.write("many.dae", text);
  EXPECT_EQ(refusal([&] { load_mesh(file, {1, 1, 1}, {.triangles = 40}); }), "none");
  EXPECT_NE(refusal([&] {
              load_mesh(file, {1, 1, 1}, {.triangles = 39});
            }).find("39 triangles"),
            std::string::npos);
}

// A face of four corners is two triangles, and a line is one without a face.
TEST(MeshFile, FacesAreCutIntoTriangles) {
  const Folder folder;
  const std::string quad =
      folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(load_mesh(quad, {1, 1, 1}).triangles->triangles.size(), 2u);
  const std::string line = folder.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  EXPECT_EQ(load_mesh(line, {1, 1, 1}).triangles->triangles.size(), 1u);
}

TEST(MeshFile, AnObjectIsShapedByItsMesh) {
  const Folder folder;
  folder.write("wedge.stl", binary_stl());
  const std::string scene =
      "@prefix w: <https://w3id.org/sinew/world#> . @prefix x: <http://x/> .\n"
      "@prefix shape: <https://w3id.org/sinew/shape#> .\n"
      "@prefix unit: <http://qudt.org/vocab/unit/> . @prefix qudt: <http://qudt.org/schema/qudt/> "
      ".\n"
      "@prefix geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#> .\n"
      "@prefix c: <https://comp-rob2b.github.io/metamodels/geometry/coordinates#> .\n"
      "x:a a geom:Frame . x:o a w:Object ; w:attached-to x:a ; w:shaped-as x:s .\n"
      "x:s a shape:Mesh ; shape:file \"package://cell/meshes/wedge.stl\" ;\n"
      "  shape:scale (1 2 1) ; c:as-seen-by x:a ; qudt:unit unit:MilliM .\n";
  const auto load = [&](const std::string& text, const MeshFiles& meshes, Report& report,
                        World& world) {
    const model::Source source{"scene.ttl", text};
    graph::Store store;
    graph::Places places;
    model::load({&source, 1}, {}, store, places, report);
    load_scene(world, store, places, report);
    return read_scene(world, store, places, report, meshes);
  };
  const MeshFiles meshes{.packages = {{"cell", folder.path.string()}}, .directory = {}};
  Report report, without;
  World world, other;
  const DeclaredScene read = load(scene, meshes, report, world);
  ASSERT_FALSE(report.has_errors()) << to_string(report.problems().front());
  ASSERT_EQ(read.bodies.size(), 1u);
  const auto& bounds = std::get<Mesh>(read.bodies[0].shapes[0].shape.geometry).triangles->bounds();
  EXPECT_NEAR(bounds.maximum.y, 0.006, 1e-9);
  // It is written as the mesh that it is.
  graph::Store out;
  Report quiet;
  write_scene(world, read, out, quiet);
  EXPECT_TRUE(out.view().subject(out.terms().iri("https://w3id.org/sinew/shape#file"),
                                 out.terms().literal("package://cell/meshes/wedge.stl")));
  // Without the package's root: an error with its place.
  load(scene, {}, without, other);
  ASSERT_TRUE(without.has_errors());
  EXPECT_NE(to_string(without.problems().front()).find("scene.ttl:7: http://x/s"),
            std::string::npos)
      << to_string(without.problems().front());
}

}  // namespace
}  // namespace sinew::world
