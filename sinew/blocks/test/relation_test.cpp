// Values that are told another frame or another point, against KDL; and what is refused.
#include <gtest/gtest.h>

#include <kdl/frames.hpp>
#include <kdl/rigidbodyinertia.hpp>
#include <random>

#include "allocations.h"
#include "emitted_code.h"
#include "refusal.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/data/compose.h"
#include "sinew/data/engine.h"

namespace sinew::blocks {
namespace {

const data::Library& frames() {
  static const data::Library library =
      load_library(SINEW_SOURCE_DIR "/examples/conversions/frames.blocks");
  return library;
}

// As quaternion_pose of the example: x y z, then x y z w.
struct Pose {
  double numbers[7];
};
Pose numbers_of(const KDL::Frame& frame) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.numbers[i] = frame.p[i];
  frame.M.GetQuaternion(pose.numbers[3], pose.numbers[4], pose.numbers[5], pose.numbers[6]);
  return pose;
}

class Random {
 public:
  double number() { return normal_(random_); }
  KDL::Vector vector() { return {number(), number(), number()}; }
  KDL::Frame frame() { return {KDL::Rotation::RPY(number(), number(), number()), vector()}; }

 private:
  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
};

// What the example's file says of the gripper.
KDL::Frame gripper_in_tool() {
  return {KDL::Rotation::Quaternion(0, 0, 1, 0), KDL::Vector(0, 0, 0.125)};
}

template <typename Numbers>
std::vector<double> converted(const char* from, const char* to, const Numbers& source,
                              std::size_t size, const KDL::Frame& tool_in_base,
                              bool interpret = false) {
  const auto plan = data::find_plan(frames(), from, to);
  data::EngineOptions options;
  options.interpret = interpret;
  const auto converter = data::make_converter(frames(), plan, options);
  const Pose pose = numbers_of(tool_in_base);
  std::vector<const void*> inputs;
  for (const data::Index relation : data::inputs_of(frames(), plan)) {
    EXPECT_EQ(frames().relations[relation].name(), "tool in base");
    inputs.push_back(&pose);
  }
  std::vector<double> target(size);
  EXPECT_TRUE(converter.run(&source, target.data(), inputs));
  return target;
}

TEST(Frames, TwistsAreSeenFromAnotherFrameAndReferToAnotherPointAsInKdl) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const KDL::Frame tool = random.frame();
    const KDL::Twist seen_from_tool(random.vector(), random.vector());
    const double source[6] = {seen_from_tool.rot[0], seen_from_tool.rot[1], seen_from_tool.rot[2],
                              seen_from_tool.vel[0], seen_from_tool.vel[1], seen_from_tool.vel[2]};
    // Seen from the base, still about the tool's origin.
    const KDL::Twist turned = tool.M * seen_from_tool;
    const auto rotated = converted("tool_twist", "hybrid_twist", source, 6, tool);
    // Seen from the base and about its origin.
    const KDL::Twist moved = tool * seen_from_tool;
    const auto whole = converted("tool_twist", "base_twist", source, 6, tool, i % 2 == 0);
    // To the gripper, which is fixed to the tool.
    const KDL::Twist gripped = gripper_in_tool().Inverse() * seen_from_tool;
    const auto gripper = converted("tool_twist", "gripper_twist", source, 6, tool);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(rotated[k], turned.rot[k], 1e-13);
      EXPECT_NEAR(rotated[k + 3], turned.vel[k], 1e-13);
      EXPECT_NEAR(whole[k], moved.rot[k], 1e-12);
      EXPECT_NEAR(whole[k + 3], moved.vel[k], 1e-12);
      // Linear first, as the gripper's prototype has it.
      EXPECT_NEAR(gripper[k], gripped.vel[k], 1e-12);
      EXPECT_NEAR(gripper[k + 3], gripped.rot[k], 1e-12);
    }
  }
}

TEST(Frames, WrenchesPosesAndInertiasFollow) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const KDL::Frame tool = random.frame();
    const KDL::Wrench wrench(random.vector(), random.vector());
    const double source[6] = {wrench.torque[0], wrench.torque[1], wrench.torque[2],
                              wrench.force[0],  wrench.force[1],  wrench.force[2]};
    const KDL::Wrench expected = tool * wrench;
    const auto moved = converted("tool_wrench", "base_wrench", source, 6, tool);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(moved[k], expected.torque[k], 1e-12);
      EXPECT_NEAR(moved[k + 3], expected.force[k], 1e-12);
    }

    const KDL::Frame object = random.frame();
    const auto pose = converted("object_in_tool", "object_in_base", numbers_of(object), 16, tool);
    const KDL::Frame in_base = tool * object;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(pose[4 * r + c], in_base(r, c), 1e-12);
    }

    const KDL::RigidBodyInertia body(
        2 + std::fabs(random.number()), random.vector(),
        KDL::RotationalInertia(2 + i % 3, 3, 4, 0.1 * random.number(), 0.1 * random.number(),
                               0.1 * random.number()));
    const auto list = [](const KDL::RigidBodyInertia& it) {
      const KDL::RotationalInertia about = it.getRotationalInertia();
      const KDL::Vector h = it.getMass() * it.getCOG();
      return std::vector<double>{it.getMass(),  h[0],          h[1],          h[2],
                                 about.data[0], about.data[1], about.data[2], about.data[4],
                                 about.data[5], about.data[8]};
    };
    double numbers[10];
    const auto given = list(body), there = list(tool * body);
    std::copy(given.begin(), given.end(), numbers);
    const auto inertia = converted("tool_inertia", "base_inertia", numbers, 10, tool);
    for (int k = 0; k < 10; ++k) EXPECT_NEAR(inertia[k], there[k], 1e-10) << k;
  }
}

TEST(Frames, AConstantRelationIsFoldedAndNothingIsGiven) {
  const auto plan = data::find_plan(frames(), "tool_twist", "gripper_twist");
  EXPECT_TRUE(data::inputs_of(frames(), plan).empty());
  const std::string why = data::explain(frames(), plan);
  EXPECT_NE(why.find("change of expressed_in from tool to gripper and of reference_point from "
                     "tool to gripper, by gripper in tool (constant)"),
            std::string::npos)
      << why;
  // Half a turn about z: what is left are signs and two products with 0.125.
  EXPECT_LE(data::lower(frames(), plan).operations(), 22);
}

TEST(Frames, AGivenRelationThatIsLeftOutIsRefused) {
  const auto plan = data::find_plan(frames(), "tool_twist", "base_twist");
  const auto converter = data::make_converter(frames(), plan);
  const double source[6] = {};
  double target[6] = {7};
  EXPECT_FALSE(converter.run(source, target));
  EXPECT_EQ(target[0], 7);
  const Pose pose = numbers_of(KDL::Frame::Identity());
  const void* inputs[] = {&pose};
  const std::size_t before = allocations();
  EXPECT_TRUE(converter.run(source, target, inputs));
  EXPECT_EQ(allocations(), before);
}

TEST(Frames, ChainsOfRelationsArePutTogether) {
  // From the gripper by the tool to the base.
  Random random;
  const KDL::Frame tool = random.frame();
  const KDL::Twist twist(random.vector(), random.vector());
  const double source[6] = {twist.vel[0], twist.vel[1], twist.vel[2],
                            twist.rot[0], twist.rot[1], twist.rot[2]};
  const KDL::Twist expected = tool * gripper_in_tool() * twist;
  const auto result = converted("gripper_twist", "base_twist", source, 6, tool);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(result[k], expected.rot[k], 1e-13);
    EXPECT_NEAR(result[k + 3], expected.vel[k], 1e-13);
  }
}

TEST(Frames, EmittedCodeTakesTheRelationAsAParameter) {
  EXPECT_EQ(compile_and_run({.file = "frames.blocks",
                             .conversions = {{"tool_twist", "base_twist"},
                                             {"object_in_tool", "object_in_base"}},
                             .main = R"(
  // A quarter of a turn about z, one metre along x.
  const struct quaternion_pose tool = {{1, 0, 0}, {0, 0, sqrt(0.5), sqrt(0.5)}};
  const double twist[6] = {0, 0, 2, 3, 0, 0};
  double moved[6];
  tool_twist_to_base_twist(twist, moved, tool);
  NEAR(moved[2], 2); NEAR(moved[3], 0); NEAR(moved[4], 3 - 2);
  const struct quaternion_pose object = {{0, 1, 0}, {0, 0, 0, 1}};
  double matrix[16];
  object_in_tool_to_object_in_base(object, matrix, tool);
  NEAR(matrix[3], 0); NEAR(matrix[0], 0); NEAR(matrix[4], 1); NEAR(matrix[15], 1);)"}),
            "ok");
}

TEST(Frames, ComposerSaysWhichRelationsAConversionReads) {
  const auto inserted =
      data::insert_conversions(frames(), {{{"sensor", "out", "tool_twist", {"app.blocks", 1, 1}},
                                           {"control", "in", "base_twist", {"app.blocks", 2, 1}}}});
  ASSERT_EQ(inserted.size(), 1u);
  EXPECT_EQ(inserted[0].inputs, std::vector<std::string>{"tool in base"});
}

TEST(Frames, RefusalsNameWhatIsMissing) {
  const auto of_plan = [](const char* from, const char* to) {
    return refusal([&] { data::find_plan(frames(), from, to); });
  };
  EXPECT_NE(of_plan("tool_twist", "camera_twist")
                .find("it is not known how 'tool' is related to 'camera' (related frames are base, "
                      "gripper, tool); declare relation tool in camera = PROTOTYPE"),
            std::string::npos)
      << of_plan("tool_twist", "camera_twist");
  EXPECT_NE(of_plan("tool_velocity", "base_velocity")
                .find("to change the reference_point of LinearVelocity takes the angular velocity, "
                      "as in a Twist"),
            std::string::npos)
      << of_plan("tool_velocity", "base_velocity");
  EXPECT_NE(of_plan("unrelated_pose", "object_in_base")
                .find("of no stated convention, that of 'object_in_base' with_respect_to=base"),
            std::string::npos)
      << of_plan("unrelated_pose", "object_in_base");
}

}  // namespace
}  // namespace sinew::blocks
