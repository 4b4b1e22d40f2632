// The source's listings as code over the real types: ROS's and Eigen's headers, asn1c's output.
#include <gtest/gtest.h>

#include <fstream>

#include "emitted_code.h"

namespace sinew::blocks {
namespace {

// A rotation by 0.3 about the axis (1, 2, 2) / 3, and its matrix by Rodrigues' formula.
constexpr const char* kRotation = R"(
static const double kX = 0.0498127074, kAngle = 0.3;
static void rotation(double q[4], double m[9]) {
  const double n[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
  const double c = cos(kAngle), s = sin(kAngle);
  q[3] = cos(kAngle / 2);
  for (int i = 0; i < 3; ++i) q[i] = sin(kAngle / 2) * n[i];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[3 * i + j] = (i == j ? c : 0) + (1 - c) * n[i] * n[j];
    m[3 * i + (i + 1) % 3] -= s * n[(i + 2) % 3];
    m[3 * i + (i + 2) % 3] += s * n[(i + 1) % 3];
  }
  (void)kX;
}
)";

TEST(Emitted, ListingTenTurnsAnAsn1QuaternionIntoAnEigenMatrix) {
  EXPECT_EQ(compile_and_run({.file = "orientation.blocks",
                             .conversions = {{"asn_quaternion", "e_rotation"},
                                             {"e_rotation", "asn_quaternion"}},
                             .main = R"(
  double q[4], m[9];
  rotation(q, m);
  asn1SccWrappers_Quaterniond source{{{q[0], q[1], q[2]}}, q[3]}, back{};
  Eigen::Matrix3d target;
  asn_quaternion_to_e_rotation(source, target);
  for (int i = 0; i < 9; ++i) NEAR(target(i / 3, i % 3), m[i]);
  NEAR((target - Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix()).norm(), 0);
  e_rotation_to_asn_quaternion(target, back);
  for (int i = 0; i < 3; ++i) NEAR(back.im.arr[i], q[i]);
  NEAR(back.re, q[3]);)",
                             .declarations = kRotation}),
            "ok");
}

TEST(Emitted, ListingTenRunsOnTheTypesThatAsn1cMakes) {
  const TemporaryFolder folder;
  if (!run_asn1c(SINEW_SOURCE_DIR "/examples/conversions/base-types.asn", folder.path)) {
    GTEST_SKIP() << "asn1c is not installed";
  }
  EXPECT_EQ(compile_and_run({.file = "orientation.blocks",
                             .conversions = {{"asn1c_quaternion", "e_rotation"},
                                             {"e_rotation", "asn1c_quaternion"}},
                             .main = R"(
  double q[4], m[9];
  rotation(q, m);
  double* parts[3] = {&q[0], &q[1], &q[2]};
  Wrappers_Quaterniond_t source{};
  source.re = q[3];
  source.im.list.array = parts;
  source.im.list.count = source.im.list.size = 3;
  Eigen::Matrix3d target;
  CHECK(asn1c_quaternion_to_e_rotation(source, target));
  for (int i = 0; i < 9; ++i) NEAR(target(i / 3, i % 3), m[i]);
  double back[3] = {};
  double* places[3] = {back, back + 1, back + 2};
  Wrappers_Quaterniond_t result{};
  result.im.list.array = places;
  result.im.list.count = result.im.list.size = 3;
  CHECK(e_rotation_to_asn1c_quaternion(target, result));
  for (int i = 0; i < 3; ++i) NEAR(back[i], q[i]);
  NEAR(result.re, q[3]);
  source.im.list.count = 2;  // a list that is too short is refused and nothing is touched
  target.setZero();
  CHECK(!asn1c_quaternion_to_e_rotation(source, target));
  NEAR(target.norm(), 0);)",
                             .include_folders = {folder.path.string()},
                             .declarations = kRotation}),
            "ok");
}

// As the source's generator would have written it: the function of the library between two arrays.
TEST(Emitted, ListingElevenCallsTheLibrarysFunction) {
  EXPECT_EQ(compile_and_run({.file = "functions.blocks",
                             .conversions = {{"asn_quaternion", "e_rotation"}},
                             .main = R"(
  double q[4], m[9];
  rotation(q, m);
  const asn1SccWrappers_Quaterniond source{{{q[0], q[1], q[2]}}, q[3]};
  Eigen::Matrix3d target;
  asn_quaternion_to_e_rotation(source, target);
  CHECK(calls == 1);
  for (int i = 0; i < 9; ++i) NEAR(target(i / 3, i % 3), m[i]);)",
                             .declarations = std::string(kRotation) + R"(
static int calls;
extern "C" void quat2rot(const double q[4], double r[9]) {
  ++calls;
  const Eigen::Matrix3d m = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  for (int i = 0; i < 9; ++i) r[i] = m(i / 3, i % 3);
}
)"}),
            "ok");
}

TEST(Emitted, ListingNineCallsAFunctionOfRosTypes) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "rotations.h") << R"(
#pragma once
#include <Eigen/Geometry>
#include <geometry_msgs/Quaternion.h>
namespace rotations {
inline void from_ros(const geometry_msgs::Quaternion* q, double r[9]) {
  const Eigen::Matrix3d m = Eigen::Quaterniond(q->w, q->x, q->y, q->z).toRotationMatrix();
  for (int i = 0; i < 9; ++i) r[i] = m(i / 3, i % 3);
}
}
)";
  EXPECT_EQ(compile_and_run({.file = "functions.blocks",
                             .conversions = {{"prelude.semantic_ros_quaternion", "e_rotation"}},
                             .main = R"(
  double q[4], m[9];
  rotation(q, m);
  geometry_msgs::Quaternion source;
  source.x = q[0]; source.y = q[1]; source.z = q[2]; source.w = q[3];
  Eigen::Matrix3d target;
  prelude_semantic_ros_quaternion_to_e_rotation(source, target);
  for (int i = 0; i < 9; ++i) NEAR(target(i / 3, i % 3), m[i]);)",
                             .include_folders = {folder.path.string()},
                             .declarations = kRotation}),
            "ok");
}

TEST(Emitted, ListingsOneToFiveMoveAPositionBetweenRosAndPlainC) {
  EXPECT_EQ(compile_and_run({.file = "position.blocks",
                             .conversions = {{"semantic_ros_position", "s_plain_position"},
                                             {"s_plain_position", "semantic_ros_position"}},
                             .main = R"(
  geometry_msgs::Point point;
  point.x = 1; point.y = 2; point.z = 3;
  double plain[3];
  semantic_ros_position_to_s_plain_position(point, plain);
  NEAR(plain[0], 1); NEAR(plain[1], 2); NEAR(plain[2], 3);
  plain[1] = -7;
  s_plain_position_to_semantic_ros_position(plain, point);
  NEAR(point.y, -7);)"}),
            "ok");
}

TEST(Emitted, UnitsSignsAndIntegersAreFoldedIntoTheMoves) {
  EXPECT_EQ(compile_and_run({.file = "position.blocks",
                             .conversions = {{"arm_position", "semantic_ros_position"},
                                             {"semantic_ros_position", "arm_position"}},
                             .main = R"(
  const struct arm_position arm = {1500, 250, -3};
  geometry_msgs::Point point;
  arm_position_to_semantic_ros_position(arm, point);
  NEAR(point.x, 1.5); NEAR(point.y, -0.25); NEAR(point.z, -0.003);
  struct arm_position back;
  semantic_ros_position_to_arm_position(point, back);
  CHECK(back.x == 1500 && back.y == 250 && back.z == -3);)",
                             .allow_lossy = true}),
            "ok");
}

TEST(Emitted, ListingSixToEightTakePosesApartAndPutThemTogether) {
  EXPECT_EQ(compile_and_run({.file = "pose.blocks",
                             .conversions = {{"s_plain_pose", "s_plain_pose2"},
                                             {"s_plain_pose2", "s_plain_pose"},
                                             {"ros_pose", "s_plain_pose2"},
                                             {"s_plain_pose2", "ros_pose"},
                                             {"s_plain_pose2", "eigen_pose"},
                                             {"eigen_pose", "dual"},
                                             {"dual", "ros_pose"}},
                             .main = R"(
  double q[4], m[9];
  rotation(q, m);
  struct s_plain_pose pose;
  for (int i = 0; i < 3; ++i) pose.position[i] = 10 + i;
  for (int i = 0; i < 9; ++i) pose.orientation[i] = m[i];
  double matrix[16];
  s_plain_pose_to_s_plain_pose2(pose, matrix);
  for (int i = 0; i < 9; ++i) NEAR(matrix[4 * (i / 3) + i % 3], m[i]);
  for (int i = 0; i < 3; ++i) NEAR(matrix[4 * i + 3], 10 + i);
  for (int i = 0; i < 4; ++i) NEAR(matrix[12 + i], i == 3);
  geometry_msgs::Pose ros;
  s_plain_pose2_to_ros_pose(matrix, ros);
  NEAR(ros.position.y, 11); NEAR(ros.orientation.w, q[3]); NEAR(ros.orientation.z, q[2]);
  double again[16];
  ros_pose_to_s_plain_pose2(ros, again);
  for (int i = 0; i < 16; ++i) NEAR(again[i], matrix[i]);
  Eigen::Isometry3d eigen;
  s_plain_pose2_to_eigen_pose(matrix, eigen);
  NEAR((eigen.translation() - Eigen::Vector3d(10, 11, 12)).norm(), 0);
  NEAR((eigen.linear() - Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix()).norm(), 0);
  struct dual dual;
  eigen_pose_to_dual(eigen, dual);
  geometry_msgs::Pose last;
  dual_to_ros_pose(dual, last);
  NEAR(last.position.x, 10); NEAR(last.position.y, 11); NEAR(last.position.z, 12);
  NEAR(last.orientation.x, q[0]); NEAR(last.orientation.w, q[3]);
  struct s_plain_pose apart;
  s_plain_pose2_to_s_plain_pose(again, apart);
  for (int i = 0; i < 9; ++i) NEAR(apart.orientation[i], m[i]);)",
                             .declarations = kRotation}),
            "ok");
}

TEST(Emitted, ListingThreeNineReachesSmartSoftObjectsJsonAndDdsStructs) {
  EXPECT_EQ(compile_and_run({.file = "position.blocks",
                             .conversions = {{"smart_xyz", "smart_3"},
                                             {"smart_3", "json_position"},
                                             {"json_position", "dds_position"},
                                             {"dds_position", "smart_xyz"}},
                             .main = R"(
  const MeasurementsIDL::PositionMeasurementXYZ xyz{3, 4, 12};
  MeasurementsIDL::PositionMeasurement3 three;
  smart_xyz_to_smart_3(xyz, three);
  NEAR(three.data[2], 12);
  nlohmann::json json;
  smart_3_to_json_position(three, json);
  CHECK(json.dump() == "{\"position\":{\"x\":3.0,\"y\":4.0,\"z\":12.0}}");
  radar::Echo echo;
  json_position_to_dds_position(json, echo);
  NEAR(echo.range, 13000);  // millimetres
  CHECK(fabs(echo.phi - 53.130102) < 1e-5);
  MeasurementsIDL::PositionMeasurementXYZ back;
  dds_position_to_smart_xyz(echo, back);
  CHECK(fabs(back.x - 3) < 1e-5 && fabs(back.y - 4) < 1e-5 && fabs(back.z - 12) < 1e-5);)",
                             .allow_lossy = true}),
            "ok");
}

TEST(Emitted, TwistsAreReorderedAndKeepTheirConvention) {
  EXPECT_EQ(compile_and_run({.file = "twist.blocks",
                             .conversions = {{"ros_twist", "screw"}, {"screw", "controller_twist"}},
                             .main = R"(
  geometry_msgs::Twist twist;
  twist.linear.x = 1; twist.linear.y = 2; twist.linear.z = 3;
  twist.angular.x = 4; twist.angular.y = 5; twist.angular.z = M_PI;
  double screw[6];
  ros_twist_to_screw(twist, screw);
  NEAR(screw[0], 4); NEAR(screw[2], M_PI); NEAR(screw[3], 1); NEAR(screw[5], 3);
  float controller[6];
  screw_to_controller_twist(screw, controller);
  CHECK(controller[0] == 1.0f && controller[2] == 3.0f && fabs(controller[5] - 180) < 1e-4);)",
                             .allow_lossy = true}),
            "ok");
}

TEST(Emitted, PlainCIsWrittenWhereAllTypesAreC) {
  EXPECT_EQ(compile_and_run({.file = "orientation.blocks",
                             .conversions = {{"asn_quaternion", "ROT"}, {"ROT", "QUAT"}},
                             .c = true,
                             .main = R"(
  double q[4], m[9], result[9], back[4];
  rotation(q, m);
  const asn1SccWrappers_Quaterniond source = {{{q[0], q[1], q[2]}}, q[3]};
  asn_quaternion_to_ROT(&source, result);
  for (int i = 0; i < 9; ++i) NEAR(result[i], m[i]);
  ROT_to_QUAT(result, back);
  for (int i = 0; i < 4; ++i) NEAR(back[i], q[i]);)",
                             .declarations = kRotation}),
            "ok");
}

}  // namespace
}  // namespace sinew::blocks
