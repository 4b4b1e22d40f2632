// The runtime engine: compiled formulas, lists that grow, its refusals.
#include "sinew/data/engine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/kernels/geometry_kernels.h"

namespace sinew::blocks {
namespace {

// The numbers with and without kernels, for doubles in and out.
void expect_same(const char* file, const char* from, const char* to,
                 const std::vector<double>& source, std::size_t size) {
  const auto library = load_library(std::string(SINEW_SOURCE_DIR "/examples/conversions/") + file);
  const auto plan = data::find_plan(library, from, to);
  data::EngineOptions fast;
  fast.kernels = geometry_kernels();
  const auto plain = data::make_converter(library, plan),
             compiled = data::make_converter(library, plan, fast);
  EXPECT_LT(compiled.operations(), plain.operations()) << from << " -> " << to;
  std::vector<double> a(size), b(size);
  EXPECT_TRUE(plain.run(source.data(), a.data()));
  EXPECT_TRUE(compiled.run(source.data(), b.data()));
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_NEAR(a[i], b[i], 1e-15) << from << " -> " << to << " " << i;
}

TEST(Engine, GivesTheSameNumbersWithCompiledFormulas) {
  const double h = std::sqrt(0.5);
  expect_same("orientation.blocks", "QUAT", "ROT", {0, h, 0, h}, 9);
  expect_same("orientation.blocks", "asn_quaternion", "e_rotation", {0.1, 0.7, -0.5, 0.5}, 9);
  expect_same("orientation.blocks", "ROT", "QUAT", {0, -1, 0, 1, 0, 0, 0, 0, 1}, 4);
  expect_same("pose.blocks", "dual", "s_plain_pose2", {0, h, 0, h, 0.1, 0.2, 0.3, 0.4}, 16);
  expect_same("pose.blocks", "s_plain_pose2", "dual",
              {0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1}, 8);
}

TEST(Engine, RefusesListsThatAreTooShortAndTouchesNothing) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/orientation.blocks");
  struct {
    double** array;
    int count, size;
    void* free;
    char context[24];
    double re;
    char more[24];
  } source = {};
  double numbers[3] = {0, 0, 1}, target[9] = {7, 7, 7, 7, 7, 7, 7, 7, 7};
  double* pointers[3] = {&numbers[0], &numbers[1], &numbers[2]};
  source.array = pointers;
  source.count = 2;
  for (const bool with_kernels : {false, true}) {
    data::EngineOptions options;
    if (with_kernels) options.kernels = geometry_kernels();
    const auto converter =
        data::make_converter(library, data::find_plan(library, "asn1c_quaternion", "ROT"), options);
    source.count = 2;
    target[0] = 7;
    EXPECT_FALSE(converter.run(&source, target));
    EXPECT_EQ(target[0], 7);
    source.count = 3;
    EXPECT_TRUE(converter.run(&source, target));
    EXPECT_EQ(target[0], -1);  // half a turn about z
    EXPECT_EQ(target[8], 1);
  }
}

TEST(Engine, CallsFunctionsOfLibraries) {
  const auto library = load_library(R"(
domain d :: { semantic : A; coord, units, dr }
algebraic q :: Scalar{v}
dproto angle :: d { semantic = A coord = angle algebraic = q ddr = :: c99 { double } dr = { value = v }
  units = :: qudt, q { unitless = v } }
dproto cosine :: d { semantic = A coord = cosine algebraic = q ddr = :: c99 { double } dr = { value = v }
  units = :: qudt, q { unitless = v } }
fproto cosine_of :: c99 { library = "libm.so.6", fname = "cos", args = { 0 => cosine, 1 <= angle } }
fproto nothing :: c99 { library = "sinew_no_such_library", args = { 0 => angle, 1 <= cosine } }
conversion angle -> cosine = cosine_of { cost = 20 }
conversion cosine -> angle = nothing { cost = 20 }
)",
                                    "engine_test.blocks");
  const double angle = 1.25;
  double cosine = 0;
  EXPECT_TRUE(data::make_converter(library, data::find_plan(library, "angle", "cosine"))
                  .run(&angle, &cosine));
  EXPECT_DOUBLE_EQ(cosine, std::cos(1.25));
  EXPECT_THROW(data::make_converter(library, data::find_plan(library, "cosine", "angle")), Error);
}

TEST(Engine, RefusesValuesWithoutFixedMemory) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/position.blocks");
  EXPECT_THROW(
      data::make_converter(library, data::find_plan(library, "smart_xyz", "json_position")), Error);
}

}  // namespace
}  // namespace sinew::blocks
