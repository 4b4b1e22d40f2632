// Parts that no map of elements can tell, so that functions read and write them: emitted code and
// the runtime engine, both with the functions compiled.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "emitted_code.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/data/engine.h"

namespace sinew::blocks {
namespace {

// A pose in the plane, as a tablet gives it: a point in millimetres and a heading as a unit vector.
// Emitted headers declare the type themselves.
constexpr const char* kType = "struct tablet { int x, y; float cosine, sine; };\n";
// The same text for the emitted code and for the library.
constexpr const char* kFunctions = R"(
#include <math.h>
#ifdef __cplusplus
extern "C" {
#endif
void tablet_heading(const struct tablet* whole, double* quaternion) {
  const double half = 0.5 * atan2((double)whole->sine, (double)whole->cosine);
  quaternion[0] = 0; quaternion[1] = 0; quaternion[2] = sin(half); quaternion[3] = cos(half);
}
void tablet_turn(struct tablet* whole, const double* quaternion) {
  const double heading = 2 * atan2(quaternion[2], quaternion[3]);
  whole->cosine = (float)cos(heading); whole->sine = (float)sin(heading);
}
void tablet_point(const struct tablet* whole, double* position) {
  position[0] = whole->x * 1e-3; position[1] = whole->y * 1e-3; position[2] = 0;
}
void tablet_move(const double* position, struct tablet* whole) {
  whole->x = (int)lround(position[0] * 1e3); whole->y = (int)lround(position[1] * 1e3);
}
#ifdef __cplusplus
}
namespace pad { double half(double number) { return number / 2; } }
#endif
)";

TEST(FunctionViews, EmittedCodeReadsAndWritesParts) {
  EXPECT_EQ(compile_and_run({.file = "tablet.blocks",
                             .conversions = {{"tablet.Orientation", "prelude.s_plain_rotation"},
                                             {"prelude.s_plain_rotation", "tablet.Orientation"},
                                             {"tablet", "s_plain_pose2"},
                                             {"s_plain_pose2", "tablet"}},
                             .main = R"(
  const struct tablet given = {1500, -250, 0, 1};  // a quarter of a turn
  double matrix[9], pose[16];
  tablet_Orientation_to_prelude_s_plain_rotation(given, matrix);
  NEAR(matrix[0], 0); NEAR(matrix[1], -1); NEAR(matrix[3], 1); NEAR(matrix[8], 1);
  tablet_to_s_plain_pose2(given, pose);
  NEAR(pose[3], 1.5); NEAR(pose[7], -0.25); NEAR(pose[1], -1); NEAR(pose[4], 1); NEAR(pose[15], 1);
  struct tablet back = {7, 7, 7, 7};
  prelude_s_plain_rotation_to_tablet_Orientation(matrix, back);
  CHECK(back.x == 7 && back.y == 7);  // the rest of the whole stays
  CHECK(fabs(back.cosine) < 1e-6 && fabs(back.sine - 1) < 1e-6);
  s_plain_pose2_to_tablet(pose, back);
  CHECK(back.x == 1500 && back.y == -250 && fabs(back.sine - 1) < 1e-6);)",
                             .declarations = kFunctions}),
            "ok");
}

TEST(FunctionViews, TheEngineCallsTheSameFunctions) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "tablet.cpp") << kType << kFunctions;
  ASSERT_EQ(compile_library(folder.path, "tablet.cpp", "libtablet.so"), "");
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/tablet.blocks");
  data::EngineOptions options;
  options.library_directories = {folder.path.string()};
  struct Tablet {
    int x, y;
    float cosine, sine;
  };
  for (const bool interpret : {false, true}) {
    options.interpret = interpret;
    const auto to_pose = data::make_converter(
                   library, data::find_plan(library, "tablet", "s_plain_pose2"), options),
               from_pose = data::make_converter(
                   library, data::find_plan(library, "s_plain_pose2", "tablet"), options);
    const Tablet given{300, 40, std::cos(0.5f), std::sin(0.5f)};
    Tablet back{};
    double pose[16];
    ASSERT_TRUE(to_pose.run(&given, pose));
    EXPECT_NEAR(pose[0], std::cos(0.5), 1e-7);
    EXPECT_NEAR(pose[4], std::sin(0.5), 1e-7);
    EXPECT_DOUBLE_EQ(pose[3], 0.3);
    ASSERT_TRUE(from_pose.run(pose, &back));
    EXPECT_EQ(back.x, 300);
    EXPECT_EQ(back.y, 40);
    EXPECT_FLOAT_EQ(back.sine, given.sine);
  }
}

TEST(FunctionViews, AreExplainedAndTheirCostIsNotBounded) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/tablet.blocks");
  const std::string why =
      data::explain(library, data::find_plan(library, "tablet", "s_plain_pose2"));
  EXPECT_NE(why.find("part by part, read by functions"), std::string::npos) << why;
  EXPECT_NE(why.find("the function tablet_heading"), std::string::npos) << why;
  EXPECT_NE(why.find("cost not bounded"), std::string::npos) << why;
}

TEST(FunctionViews, OneDirectionAloneDoesNotGiveTheOther) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/tablet.blocks");
  try {
    data::find_plan(library, "prelude.s_plain_position", "reading.Position");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no function writes 'reading.Position'"),
              std::string::npos)
        << error.what();
  }
}

TEST(Engine, CallsFunctionsOfCppByTheirMangledName) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "tablet.cpp") << kType << kFunctions;
  ASSERT_EQ(compile_library(folder.path, "tablet.cpp", "libtablet.so"), "");
  const auto library = load_library(R"(
domain d :: { semantic : A; coord, units, dr }
algebraic q :: Scalar{v}
dproto whole :: d { semantic = A coord = whole algebraic = q ddr = :: c99 { double } dr = { value = v }
  units = :: qudt, q { unitless = v } }
dproto halved :: d { semantic = A coord = halved algebraic = q ddr = :: c99 { double } dr = { value = v }
  units = :: qudt, q { unitless = v } }
fproto half :: cpp { library = "tablet", fname = "_ZN3pad4halfEd", args = { 0 => halved, 1 <= whole } }
fproto plain :: cpp { library = "tablet", fname = "pad::half", args = { 0 => whole, 1 <= halved } }
conversion whole -> halved = half { cost = 4 }
conversion halved -> whole = plain { cost = 4 }
)",
                                    "engine_test.blocks");
  data::EngineOptions options;
  options.library_directories = {folder.path.string()};
  const double number = 9;
  double result = 0;
  EXPECT_TRUE(data::make_converter(library, data::find_plan(library, "whole", "halved"), options)
                  .run(&number, &result));
  EXPECT_EQ(result, 4.5);
  EXPECT_THROW(data::make_converter(library, data::find_plan(library, "halved", "whole"), options),
               Error);
}

}  // namespace
}  // namespace sinew::blocks
