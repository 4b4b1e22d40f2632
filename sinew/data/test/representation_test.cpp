// Types of other languages, laid out as the platform does: C by comparison with this very compiler,
// ROS by all of Debian's messages.
#include "sinew/data/representation.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>

#include "sinew/base/error.h"

namespace sinew::data {
namespace {

Representation read(const char* context, const std::string& text,
                    const std::string& directory = ".") {
  return read_representation(context, text, {"test.blocks", 1, 1}, {{directory, "/usr/share"}});
}

std::size_t offset(const Representation& representation, const char* path) {
  std::string why;
  const auto access = find_access(*representation.type, *parse_accessor(path), &why);
  EXPECT_TRUE(access) << path << ": " << why;
  return access ? access->offsets.back() : 0;
}

TEST(C99, LaysStructsOutLikeTheCompiler) {
  struct Inner {
    char a;
    double b;
    short c[3];
  };
  struct Outer {
    unsigned char first;
    Inner inner[2];
    float third;
    long long fourth;
    int fifth[2][3];
  };
  const auto type = read("c99",
                         "struct outer { unsigned char first; struct { signed char a; double b; "
                         "short c[3]; } inner[2];\n"
                         "float third; long long fourth; int fifth[2][3]; }");
  EXPECT_EQ(type.type->size, sizeof(Outer));
  EXPECT_EQ(type.type->alignment, alignof(Outer));
  EXPECT_EQ(offset(type, "inner.1.b"), offsetof(Outer, inner) + sizeof(Inner) + offsetof(Inner, b));
  EXPECT_EQ(offset(type, "inner.0.c.2"),
            offsetof(Outer, inner) + offsetof(Inner, c) + 2 * sizeof(short));
  EXPECT_EQ(offset(type, "third"), offsetof(Outer, third));
  EXPECT_EQ(offset(type, "fourth"), offsetof(Outer, fourth));
  EXPECT_EQ(offset(type, "fifth.1.2"), offsetof(Outer, fifth) + 5 * sizeof(int));
}

TEST(C99, KnowsTheSizesOfItsScalars) {
  EXPECT_EQ(read("c99", "unsigned long").type->size, sizeof(unsigned long));
  EXPECT_EQ(read("c99", "short").type->size, sizeof(short));
  EXPECT_EQ(read("c99", "double[3]").type->size, sizeof(double[3]));
  EXPECT_EQ(read("c99", "float[4][4]").type->size, sizeof(float[4][4]));
}

TEST(Eigen, StoresColumnByColumnUnlessToldOtherwise) {
  EXPECT_EQ(offset(read("Eigen", "Matrix<double,3,3>"), "{0,1}"), 24u);
  EXPECT_EQ(offset(read("Eigen", "Matrix<double,3,3,RowMajor>"), "{0,1}"), 8u);
  EXPECT_EQ(offset(read("Eigen", "Matrix3f"), "{2,1}"), 20u);
  EXPECT_EQ(offset(read("Eigen", "Vector3d"), "2"), 16u);
  EXPECT_EQ(offset(read("Eigen", "Quaterniond"), "w"), 24u);
  EXPECT_EQ(offset(read("Eigen", "Isometry3d"), "{0,3}"), 96u);
  EXPECT_EQ(offset(read("Eigen", "AngleAxisd"), "axis.1"), 8u);
}

TEST(Ros, EveryMessageOfGeometryAndSensorsIsRead) {
  int count = 0;
  for (const char* package : {"geometry_msgs", "sensor_msgs"}) {
    const std::string folder = std::string("/usr/share/") + package + "/msg";
    if (!std::filesystem::exists(folder))
      GTEST_SKIP() << folder << " is not installed (ros-geometry-msgs, ros-sensor-msgs)";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".msg") continue;
      EXPECT_NO_THROW(read("ROS", std::string(package) + "/" + entry.path().stem().string()))
          << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 50);
}

TEST(Ros, ReachesNestedFieldsAndFixedArrays) {
  if (!std::filesystem::exists("/usr/share/geometry_msgs/msg"))
    GTEST_SKIP() << "ros-geometry-msgs is not installed";
  const auto pose = read("ROS", "geometry_msgs/PoseWithCovarianceStamped");
  std::string why;
  const auto access = find_access(*pose.type, *parse_accessor("pose.covariance.35"), &why);
  ASSERT_TRUE(access) << why;
  EXPECT_EQ(access->source, "$.pose.covariance[35]");
  EXPECT_FALSE(find_access(*pose.type, *parse_accessor("pose.covariance.36"), &why));
  EXPECT_EQ(why, "index 36 is outside of the 36 elements");
  EXPECT_FALSE(find_access(*pose.type, *parse_accessor("pose.pose.positon.x"), &why));
  EXPECT_NE(why.find("did you mean position?"), std::string::npos);
}

TEST(Ros, ListsThatGrowAreGuarded) {
  if (!std::filesystem::exists("/usr/share/sensor_msgs/msg"))
    GTEST_SKIP() << "ros-sensor-msgs is not installed";
  const auto state = read("ROS", "sensor_msgs/JointState");
  const auto access = find_access(*state.type, *parse_accessor("position.6"), nullptr);
  ASSERT_TRUE(access);
  ASSERT_EQ(access->guards.size(), 1u);
  EXPECT_EQ(access->guards[0].index, 6u);
  EXPECT_EQ(access->offsets.size(), 2u);  // behind one pointer
}

TEST(Asn1, GivesTheLayoutsOfBothCompilers) {
  const std::string folder = SINEW_SOURCE_DIR "/examples/conversions";
  const auto taste = read("ASN1", "Base-Types.Wrappers-Quaterniond", folder);
  EXPECT_EQ(taste.type->size, 32u);
  EXPECT_EQ(find_access(*taste.type, *parse_accessor("im.2"), nullptr)->source, "$.im.arr[2]");
  const auto asn1c = read("ASN1", "Base-Types.Wrappers-Quaterniond by asn1c", folder);
  EXPECT_EQ(asn1c.type->size, 48u + 8u + 24u);
  EXPECT_EQ(find_access(*asn1c.type, *parse_accessor("im.2"), nullptr)->source,
            "(*$.im.list.array[2])");
}

TEST(Idl, ReadsModulesNestedStructsArraysAndSequences) {
  const auto type = read("IDL", R"(module a { struct P { double x, y; }; typedef double three[3];
      struct Q { P p; three v; sequence<double> s; unsigned long n; string name; }; };)");
  EXPECT_EQ(type.type->spelling, "a::Q");
  EXPECT_EQ(offset(type, "p.y"), 8u);
  EXPECT_EQ(offset(type, "v.2"), 32u);
  EXPECT_EQ(find_access(*type.type, *parse_accessor("s.1"), nullptr)->guards.size(), 1u);
  EXPECT_EQ(offset(type, "n"), 64u);
}

TEST(SmartSoft, ReadsRepositoriesOfCommunicationObjects) {
  const auto type =
      read("SMDSD", "Measurements.PositionMeasurement3", SINEW_SOURCE_DIR "/examples/conversions");
  EXPECT_EQ(type.type->spelling, "MeasurementsIDL::PositionMeasurement3");
  EXPECT_EQ(offset(type, "data.2"), 16u);
}

TEST(Json, IsReachedByNameAndIndex) {
  const auto type = read("JSON", R"({"pose": {"q": [number, number]}, "t": number})");
  EXPECT_EQ(find_access(*type.type, *parse_accessor("pose.q.1"), nullptr)->source,
            "$[\"pose\"][\"q\"][1]");
  EXPECT_FALSE(find_access(*type.type, *parse_accessor("pose"), nullptr));
}

TEST(Representation, HasLimits) {
  std::string deep = "double x;";
  for (int i = 0; i < 100; ++i) deep = "struct { " + deep + " } x;";
  EXPECT_THROW(read("c99", "struct { " + deep + " }"), Error);
  EXPECT_THROW(read("c99", "double[1000000]"), Error);
  EXPECT_THROW(read("JSON", std::string(1000, '[')), Error);
  EXPECT_THROW(read("IDL", "struct S { S s; };"), Error);
}

}  // namespace
}  // namespace sinew::data
