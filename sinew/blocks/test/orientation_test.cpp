// Every coordinate of orientation into every other and back, on random rotations and on singular
// ones, and against Eigen and KDL where they follow the same convention.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <kdl/frames.hpp>
#include <random>

#include "sinew/blocks/elaborate.h"
#include "sinew/data/engine.h"

namespace sinew::blocks {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Coordinates {
  std::string name, form;
  int size;
};

std::vector<Coordinates> all_coordinates() {
  std::vector<Coordinates> all = {{"rot_matrix", "Matrix{3,3}", 9},
                                  {"quaternion", "Scalar{x,y,z,w}", 4},
                                  {"axis_angle", "Scalar{x,y,z,angle}", 4},
                                  {"rotation_vector", "Vector{3}", 3},
                                  {"rpy", "Vector{3}", 3}};
  for (const char* frame : {"rotating", "fixed"}) {
    for (const char a : {'x', 'y', 'z'}) {
      for (const char b : {'x', 'y', 'z'}) {
        for (const char c : {'x', 'y', 'z'}) {
          if (a == b || b == c) continue;
          all.push_back({std::string("euler_") + a + b + c + "_" + frame, "Vector{3}", 3});
        }
      }
    }
  }
  return all;
}

std::string prototype(const Coordinates& it) {
  std::string form = it.form, map, units;
  for (int i = 0; i < it.size; ++i) {
    std::string element = std::to_string(i), unit = "rad";
    if (it.size == 9) {
      element = "{" + std::to_string(i / 3) + "," + std::to_string(i % 3) + "}";
      unit = "unitless";
    }
    if (it.size == 4) {
      element = it.name == "quaternion"
                    ? std::vector<std::string>{"x", "y", "z", "w"}[std::size_t(i)]
                    : std::vector<std::string>{"x", "y", "z", "angle"}[std::size_t(i)];
      unit = element == "angle" ? "rad" : "unitless";
    }
    map += std::to_string(i) + " = " + element + " ";
    units += unit + " = " + element + " ";
  }
  return "algebraic form_" + it.name + " :: " + form + "\nunits units_" + it.name +
         " :: qudt, form_" + it.name + " { " + units + "}\ndproto " + it.name +
         " :: geometry {\n semantic = Orientation\n coord = " + it.name + "\n algebraic = form_" +
         it.name + "\n ddr = :: c99 { double[" + std::to_string(it.size) + "] }\n dr = { " + map +
         "}\n units = units_" + it.name + "\n}\n";
}

const data::Library& library() {
  static const data::Library result = [] {
    std::string text;
    for (const Coordinates& it : all_coordinates()) text += prototype(it);
    return load_library(text, "orientation_test.blocks");
  }();
  return result;
}

data::Converter converter(const std::string& from, const std::string& to) {
  return data::make_converter(library(), data::find_plan(library(), from, to));
}

Matrix3d matrix_of(const double* row_major) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_major);
}

// Random rotations, and the ones at which some coordinates are singular: identity, half turns,
// quarter turns (gimbal lock), and neighbours of all of these.
const std::vector<Matrix3d>& rotations() {
  static const std::vector<Matrix3d> all = [] {
    std::vector<Matrix3d> result;
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    const auto add = [&](const Quaterniond& q) {
      result.push_back(q.normalized().toRotationMatrix());
    };
    for (int i = 0; i < 10000; ++i)
      add(Quaterniond(normal(random), normal(random), normal(random), normal(random)));
    const Vector3d axes[] = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(),
                             Vector3d(1, 1, 0).normalized(), Vector3d(1, -1, 1).normalized()};
    for (const Vector3d& axis : axes) {
      for (const double turn : {0.0, M_PI / 2, -M_PI / 2, M_PI, -M_PI}) {
        for (const double near : {0.0, 1e-16, 1e-12, 1e-9, 1e-8, -1e-8, 1e-5, 1e-3}) {
          const Eigen::AngleAxisd turned(turn + near, axis);
          add(Quaterniond(turned));
          for (const Vector3d& other : axes)
            add(Quaterniond(turned * Eigen::AngleAxisd(0.7, other)));
          for (const Vector3d& other : axes)
            add(Quaterniond(Eigen::AngleAxisd(1.1, other) * turned));
        }
      }
    }
    return result;
  }();
  return all;
}

TEST(Orientation, HasTwentyFourEulerConventionsAndFiveOthers) {
  EXPECT_EQ(all_coordinates().size(), 29u);
}

// matrix -> A -> B -> matrix for every A and B.
TEST(Orientation, EveryCoordinateConvertsToEveryOtherWithinRoundOff) {
  const auto all = all_coordinates();
  double worst = 0;
  std::string worst_pair;
  for (const Coordinates& a : all) {
    const auto to_a = converter("rot_matrix", a.name);
    std::vector<std::array<double, 9>> values(rotations().size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> matrix = rotations()[i];
      ASSERT_TRUE(to_a.run(matrix.data(), values[i].data()));
    }
    for (const Coordinates& b : all) {
      const auto a_to_b = converter(a.name, b.name), back = converter(b.name, "rot_matrix");
      for (std::size_t i = 0; i < values.size(); ++i) {
        double value[9], matrix[9];
        a_to_b.run(values[i].data(), value);
        back.run(value, matrix);
        const double error = (matrix_of(matrix) - rotations()[i]).cwiseAbs().maxCoeff();
        if (!(error <= worst)) {
          worst = error;
          worst_pair = a.name + " -> " + b.name;
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-12) << worst_pair;
  std::printf("worst round trip %.2e (%s) over %zu rotations and %zu pairs\n", worst,
              worst_pair.c_str(), rotations().size(), all.size() * all.size());
}

TEST(Orientation, QuaternionsAgreeWithEigenAndKdl) {
  const auto to_quaternion = converter("rot_matrix", "quaternion");
  for (const Matrix3d& rotation : rotations()) {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> matrix = rotation;
    double q[4];
    to_quaternion.run(matrix.data(), q);
    Quaterniond theirs(rotation);
    const double sign = theirs.dot(Quaterniond(q[3], q[0], q[1], q[2])) < 0 ? -1 : 1;
    EXPECT_LT((sign * theirs.coeffs() - Eigen::Vector4d(q[0], q[1], q[2], q[3])).norm(), 1e-12);
    const KDL::Rotation kdl = KDL::Rotation::Quaternion(q[0], q[1], q[2], q[3]);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(kdl(r, c), rotation(r, c), 1e-12);
    }
  }
}

TEST(Orientation, AxisAngleAndRotationVectorAgreeWithEigen) {
  const auto from_vector = converter("rotation_vector", "rot_matrix");
  const auto from_axis = converter("axis_angle", "rot_matrix");
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-3, 3);
  for (int i = 0; i < 10000; ++i) {
    const Vector3d vector(uniform(random), uniform(random), uniform(random));
    const Matrix3d theirs =
        Eigen::AngleAxisd(vector.norm(), vector.normalized()).toRotationMatrix();
    double matrix[9];
    from_vector.run(vector.data(), matrix);
    EXPECT_LT((matrix_of(matrix) - theirs).norm(), 1e-12);
    const Vector3d axis = vector.normalized();
    const double axis_angle[4] = {axis.x(), axis.y(), axis.z(), vector.norm()};
    from_axis.run(axis_angle, matrix);
    EXPECT_LT((matrix_of(matrix) - theirs).norm(), 1e-12);
  }
}

Vector3d axis_of(char name) {
  return name == 'x' ? Vector3d::UnitX() : name == 'y' ? Vector3d::UnitY() : Vector3d::UnitZ();
}

// Rotating axes: R = R_a(first) R_b(second) R_c(third). Fixed axes: R = R_c(third) R_b(second)
// R_a(first).
TEST(Orientation, AllTwentyFourEulerConventionsAgreeWithEigen) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-3.1, 3.1);
  for (const Coordinates& it : all_coordinates()) {
    if (!it.name.starts_with("euler_")) continue;
    const auto to_matrix = converter(it.name, "rot_matrix");
    for (int i = 0; i < 400; ++i) {
      const double angles[3] = {uniform(random), uniform(random), uniform(random)};
      const Eigen::AngleAxisd first(angles[0], axis_of(it.name[6])),
          second(angles[1], axis_of(it.name[7])), third(angles[2], axis_of(it.name[8]));
      const Matrix3d theirs = it.name.ends_with("rotating")
                                  ? (first * second * third).toRotationMatrix()
                                  : (third * second * first).toRotationMatrix();
      double matrix[9];
      to_matrix.run(angles, matrix);
      EXPECT_LT((matrix_of(matrix) - theirs).norm(), 1e-12) << it.name;
    }
  }
}

TEST(Orientation, RpyZyxAndZyzAnglesAgreeWithKdl) {
  const auto rpy = converter("rpy", "rot_matrix");
  const auto zyx = converter("euler_zyx_rotating", "rot_matrix"),
             zyz = converter("euler_zyz_rotating", "rot_matrix");
  const auto to_rpy = converter("rot_matrix", "rpy"),
             to_zyx = converter("rot_matrix", "euler_zyx_rotating");
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);  // where the angles are unique
  for (int i = 0; i < 10000; ++i) {
    const double angles[3] = {2 * uniform(random), uniform(random), 2 * uniform(random)};
    const auto check = [&](const data::Converter& ours, const KDL::Rotation& theirs) {
      double matrix[9];
      ours.run(angles, matrix);
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(matrix[k], theirs(k / 3, k % 3), 1e-12);
    };
    check(rpy, KDL::Rotation::RPY(angles[0], angles[1], angles[2]));
    check(zyx, KDL::Rotation::EulerZYX(angles[0], angles[1], angles[2]));
    check(zyz, KDL::Rotation::EulerZYZ(angles[0], angles[1], angles[2]));
    double matrix[9], ours[3], theirs[3];
    rpy.run(angles, matrix);
    to_rpy.run(matrix, ours);
    KDL::Rotation::RPY(angles[0], angles[1], angles[2]).GetRPY(theirs[0], theirs[1], theirs[2]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(ours[k], theirs[k], 1e-12);
    zyx.run(angles, matrix);
    to_zyx.run(matrix, ours);
    KDL::Rotation::EulerZYX(angles[0], angles[1], angles[2])
        .GetEulerZYX(theirs[0], theirs[1], theirs[2]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(ours[k], theirs[k], 1e-12);
  }
}

}  // namespace
}  // namespace sinew::blocks
