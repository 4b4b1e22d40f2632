// What converts into what, how it is found, and how it runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "refusal.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/data/compose.h"
#include "sinew/data/emit.h"
#include "sinew/data/engine.h"

namespace sinew::blocks {
namespace {

using data::ConversionType;

data::Library load(const std::string& text) { return load_library(text, "conversion_test.blocks"); }

// Two-argument shorthand for a plain prototype of one domain with free coordinates.
constexpr const char* kJointSpace = R"(
// A domain that nobody built in: joint space.
domain joint_space :: {
  semantic : JointPosition | JointVelocity
  composite JointState = { JointPosition, JointVelocity }
  coord ? : absolute | relative
  units, algebraic, dr
}
algebraic arm :: Scalar{shoulder, elbow, wrist}
algebraic three :: Vector{3}
alias three <-> arm { 0 = shoulder, 1 = elbow, 2 = -wrist }
units degrees :: qudt, arm { DEG = shoulder, DEG = elbow, DEG = wrist }
units radians :: qudt, three { RAD = 0, RAD = 1, RAD = 2 }
dproto teach_pendant :: joint_space {
  semantic = JointPosition coord = absolute algebraic = arm
  ddr = :: c99 { struct pendant { float shoulder, elbow, wrist; } }
  dr = { shoulder = shoulder, elbow = elbow, wrist = wrist } units = degrees
}
dproto controller :: joint_space {
  semantic = JointPosition coord = absolute algebraic = three
  ddr = :: c99 { double[3] } dr = { 0 = 0, 1 = 1, 2 = 2 } units = radians
}
dproto encoder :: joint_space {
  semantic = JointPosition coord = relative algebraic = three
  ddr = :: c99 { double[3] } dr = { 0 = 0, 1 = 1, 2 = 2 } units = radians
}
dproto speed :: joint_space {
  semantic = JointVelocity coord = absolute algebraic = three
  ddr = :: c99 { double[3] } dr = { 0 = 0, 1 = 1, 2 = 2 } units = :: qudt, three { "rad/s" = 0, "rad/s" = 1, "rad/s" = 2 }
}
)";

TEST(Domain, IsDeclaredByTextAlone) {
  const auto library = load(kJointSpace);
  const auto plan = data::find_plan(library, "teach_pendant", "controller");
  EXPECT_EQ(data::type_of(data::segments_of(library, plan)), ConversionType::kAlias);
  const float pendant[3] = {90, -45, 30};
  double controller[3];
  EXPECT_TRUE(data::make_converter(library, plan).run(pendant, controller));
  EXPECT_NEAR(controller[0], M_PI / 2, 1e-15);
  EXPECT_NEAR(controller[1], -M_PI / 4, 1e-15);
  EXPECT_NEAR(controller[2], -M_PI / 6, 1e-15);  // the alias turns its sign
}

TEST(Domain, RefusesToMixMeaningsAndCoordinates) {
  const auto library = load(kJointSpace);
  EXPECT_NE(refusal([&] {
              data::find_plan(library, "controller", "speed");
            }).find("'controller' means JointPosition, 'speed' means JointVelocity"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              data::find_plan(library, "controller", "encoder");
            }).find("nothing leads from"),
            std::string::npos);
}

constexpr const char* kThermal = R"(
domain thermal :: {
  semantic : Temperature
  coord : absolute
  units, algebraic, dr
  coordinates absolute of Temperature { T = K }
}
algebraic t :: Scalar{T}
dproto kelvin :: thermal { semantic = Temperature coord = absolute algebraic = t ddr = :: c99 { double }
  dr = { value = T } units = :: qudt, t { K = T } }
dproto celsius :: thermal { semantic = Temperature coord = absolute algebraic = t ddr = :: c99 { double }
  dr = { value = T } units = :: qudt, t { DEG_C = T } }
dproto fahrenheit :: thermal { semantic = Temperature coord = absolute algebraic = t ddr = :: c99 { struct { float f; } }
  dr = { f = T } units = :: qudt, t { DEG_F = T } }
)";

TEST(Units, WithOffsetsAreFoldedIntoOneMultiplicationAndOneAddition) {
  const auto library = load(kThermal);
  const auto convert = [&](const char* from, const char* to, double value) {
    double result = 0;
    data::make_converter(library, data::find_plan(library, from, to)).run(&value, &result);
    return result;
  };
  EXPECT_NEAR(convert("celsius", "kelvin", 20), 293.15, 1e-12);
  EXPECT_NEAR(convert("kelvin", "celsius", 0), -273.15, 1e-12);
  const float f = 212;
  double c = 0;
  data::make_converter(library, data::find_plan(library, "fahrenheit", "celsius")).run(&f, &c);
  EXPECT_NEAR(c, 100, 1e-12);
  const auto program = data::lower(library, data::find_plan(library, "fahrenheit", "celsius"));
  EXPECT_EQ(program.operations(), 4);  // load, multiply, add, store
}

// ---- the kinds of conversions ----

TEST(Conversion, OfOneValueToTheSameUnitIsOnlyAMove) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/position.blocks");
  const auto program =
      data::lower(library, data::find_plan(library, "semantic_ros_position", "s_plain_position"));
  EXPECT_EQ(program.operations(), 6);  // three loads, three stores
}

TEST(Conversion, LossIsNeverTakenSilently) {
  const auto library = load(R"(
dproto exact :: geometry { semantic = Position coord = cartesian algebraic = position3 ddr = :: c99 { double[3] }
  dr = { 0=0 1=1 2=2 } units = position_units }
dproto flat :: geometry { semantic = Position coord = polar algebraic = :: Scalar{r, phi} ddr = :: c99 { double[2] }
  dr = { 0 = r 1 = phi } units = :: qudt, plane { m = r rad = phi } }
dproto single :: geometry { semantic = Position coord = cartesian algebraic = position3 ddr = :: c99 { float[3] }
  dr = { 0=0 1=1 2=2 } units = position_units }
algebraic plane :: Scalar{r, phi}
)");
  EXPECT_NE(refusal([&] {
              data::find_plan(library, "exact", "flat");
            }).find("every way loses something: the height Z"),
            std::string::npos);
  EXPECT_NE(refusal([&] { data::find_plan(library, "exact", "single"); }).find("float"),
            std::string::npos);
  EXPECT_NO_THROW(data::find_plan(library, "flat", "exact"));
  EXPECT_NO_THROW(data::find_plan(library, "single", "exact"));
  data::PlanOptions lossy;
  lossy.allow_lossy = true;
  const auto plan = data::find_plan(library, "exact", "flat", lossy);
  EXPECT_NE(data::explain(library, plan).find("LOSES the height Z"), std::string::npos);
}

TEST(Conversion, ThatIsOneWayIsMarked) {
  const auto library = load(R"(
domain d :: { semantic : A; coord, units, dr
  coordinates one of A { x = m } coordinates two of A { y = m }
  formula one -> two of A { y = 2 * x } }
algebraic fx :: Scalar{x}
algebraic fy :: Scalar{y}
dproto p :: d { semantic = A coord = one algebraic = fx ddr = :: c99 { double } dr = { value = x } units = :: qudt, fx { m = x } }
dproto q :: d { semantic = A coord = two algebraic = fy ddr = :: c99 { double } dr = { value = y } units = :: qudt, fy { m = y } }
)");
  EXPECT_NE(data::explain(library, data::find_plan(library, "p", "q")).find("one-way"),
            std::string::npos);
  EXPECT_THROW(data::find_plan(library, "q", "p"), Error);
}

TEST(Conversion, WithoutADeclaredCostSaysThatItIsNotBounded) {
  const auto library = load(R"(
fproto f :: c99 { fname = "f", args = { 1 <= a, 2 => b } }
fproto g :: c99 { fname = "g", args = { 1 <= b, 2 => a } }
conversion a -> b = f
conversion b -> a = g { wcet = "50 ns" }
algebraic q :: Scalar{v}
domain d :: { semantic : A; coord, units, dr }
dproto a :: d { semantic = A coord = one algebraic = q ddr = :: c99 { double[1] } dr = { 0 = v } units = :: qudt, q { m = v } }
dproto b :: d { semantic = A coord = two algebraic = q ddr = :: c99 { double[1] } dr = { 0 = v } units = :: qudt, q { m = v } }
)");
  EXPECT_NE(data::explain(library, data::find_plan(library, "a", "b")).find("cost not bounded"),
            std::string::npos);
  EXPECT_NE(data::explain(library, data::find_plan(library, "b", "a")).find("cost 52"),
            std::string::npos);
}

TEST(Conversion, TakesTheCheapestOfSeveralWays) {
  const std::string text = R"(
domain d :: { semantic : A; coord, units, dr }
algebraic q :: Scalar{v}
fproto direct :: c99 { args = { 1 <= a, 2 => c } }
fproto first :: c99 { args = { 1 <= a, 2 => b } }
fproto second :: c99 { args = { 1 <= b, 2 => c } }
dproto a :: d { semantic = A coord = one algebraic = q ddr = :: c99 { double[1] } dr = { 0 = v } units = :: qudt, q { m = v } }
dproto b :: d { semantic = A coord = two algebraic = q ddr = :: c99 { double[1] } dr = { 0 = v } units = :: qudt, q { m = v } }
dproto c :: d { semantic = A coord = three algebraic = q ddr = :: c99 { double[1] } dr = { 0 = v } units = :: qudt, q { m = v } }
conversion a -> b = first { cost = 10 }
conversion b -> c = second { cost = 10 }
)";
  const auto cheap = load(text + "conversion a -> c = direct { cost = 15 }");
  EXPECT_EQ(data::segments_of(cheap, data::find_plan(cheap, "a", "c")).size(), 1u);
  const auto dear = load(text + "conversion a -> c = direct { cost = 50 }");
  EXPECT_EQ(data::segments_of(dear, data::find_plan(dear, "a", "c")).size(), 2u);
}

TEST(Conversion, OfACompositeWithAnIndirectMemberIsOfTypeSix) {
  const auto library = load(R"(
dproto angles :: geometry { semantic = Orientation coord = rpy algebraic = angles3 ddr = :: c99 { double[3] }
  dr = { 0=0 1=1 2=2 } units = angle_units }
dproto vector :: geometry { semantic = Orientation coord = rotation_vector algebraic = angles3 ddr = :: c99 { double[3] }
  dr = { 0=0 1=1 2=2 } units = angle_units }
dproto a :: geometry { semantic = Pose composes { Position = s_plain_position Orientation = angles } }
dproto b :: geometry { semantic = Pose composes { Position = s_plain_position Orientation = vector } }
dproto c :: geometry { semantic = Pose composes { Position = s_plain_position Orientation = angles }
  dr = { p = Position, o = Orientation } }
)");
  EXPECT_EQ(data::type_of(data::segments_of(library, data::find_plan(library, "a", "b"))),
            ConversionType::kIndirectComposite);
  EXPECT_EQ(data::type_of(data::segments_of(library, data::find_plan(library, "a", "c"))),
            ConversionType::kComposite);
  const double a[6] = {1, 2, 3, 0.1, 0.2, 0.3};
  double b[6], back[6];
  data::make_converter(library, data::find_plan(library, "a", "b")).run(a, b);
  data::make_converter(library, data::find_plan(library, "b", "a")).run(b, back);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(back[i], a[i], 1e-15);
}

// ---- the same result whatever the order ----

std::vector<std::string> two_hundred_prototypes() {
  std::vector<std::string> items = {
      "algebraic r :: Matrix{3,3}",
      "algebraic q :: Vector{4}",
      "algebraic qn :: Scalar{x,y,z,w}",
      "alias q <-> qn { 0=x 1=y 2=z 3=w }",
      "conversion p000 -> p001 = quat2rot",
      "fproto f :: c99 { fname = \"f\" args = { 1 <= p004, 2 => p007 } }",
      "conversion p004 -> p007 = f { cost = 1 }"};
  for (int i = 0; i < 200; ++i) {
    char name[8];
    std::snprintf(name, sizeof name, "p%03d", i);
    std::string text = "dproto " + std::string(name) + " :: geometry { semantic = Orientation ";
    std::string map;
    if (i % 3 == 1) {
      for (int k = 0; k < 9; ++k)
        map +=
            std::to_string(k) + "={" + std::to_string(k / 3) + "," + std::to_string(k % 3) + "} ";
      text += "coord = rot_matrix algebraic = r ddr = :: c99 { double[9] } dr = { " + map + "} }";
    } else {
      text += "coord = quaternion algebraic = " + std::string(i % 3 == 0 ? "q" : "qn") +
              " ddr = :: c99 { " + (i % 2 ? "float" : "double") + "[4] } dr = { " +
              (i % 3 == 0 ? "0=0 1=1 2=2 3=3" : "0=x 1=y 2=z 3=w") + " } }";
    }
    items.push_back(text);
  }
  return items;
}

std::string everything_about(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += item + "\n";
  const auto library = load(text);
  std::string result;
  data::PlanOptions lossy;
  lossy.allow_lossy = true;
  for (const char* from : {"p000", "p001", "p002", "p004", "p033", "p101", "p170"}) {
    for (const char* to : {"p003", "p007", "p010", "p011", "p100", "p199", "p198"}) {
      const auto plan = data::find_plan(library, from, to, lossy);
      result += data::explain(library, plan) + data::emit(library, plan, {});
    }
  }
  return result;
}

TEST(Conversion, DoesNotDependOnTheOrderOfTheFile) {
  std::vector<std::string> items = two_hundred_prototypes();
  const std::string expected = everything_about(items);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    std::shuffle(items.begin(), items.end(), random);
    ASSERT_EQ(everything_about(items), expected) << "permutation " << i;
  }
}

// ---- composing closures ----

TEST(Composition, PutsAConversionWherePrototypesDifferAndMeanTheSame) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/position.blocks");
  const auto port = [](const char* closure, const char* name, const char* prototype) {
    return data::Port{closure, name, prototype, {"app.blocks", 7, 1}};
  };
  const std::vector<data::Connection> connections = {
      {port("camera", "out", "smart_xyz"), port("log", "in", "smart_xyz")},
      {port("camera", "out", "smart_xyz"), port("filter", "in", "s_plain_position")},
      {port("camera", "out", "smart_xyz"), port("grasp", "goal", "s_plain_position")},
      {port("arm", "tip", "arm_position"), port("grasp", "tip", "s_plain_position")}};
  const auto inserted = data::insert_conversions(library, connections);
  ASSERT_EQ(inserted.size(), 2u);
  EXPECT_EQ(inserted[0].connections, (std::vector<std::size_t>{1, 2}));  // one conversion for both
  EXPECT_EQ(inserted[0].block, "camera.out.as.s_plain_position");
  EXPECT_EQ(inserted[1].connections, (std::vector<std::size_t>{3}));
  const struct { std::int32_t x, y, z; } tip = {1500, 250, -3};
  double position[3];
  EXPECT_TRUE(data::make_converter(library, inserted[1].plan).run(&tip, position));
  EXPECT_DOUBLE_EQ(position[0], 1.5);
  EXPECT_DOUBLE_EQ(position[1], -0.25);
}

TEST(Composition, RefusesWhatDoesNotMeanTheSameAndNamesBoth) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/twist.blocks");
  const std::vector<data::Connection> connections = {
      {{"base", "twist", "screw", {"app.blocks", 3, 1}},
       {"drive", "in", "tool_screw", {"app.blocks", 9, 1}}},
      {{"base", "twist", "screw", {"app.blocks", 3, 1}},
       {"drive", "v", "ros_linear", {"app.blocks", 10, 1}}}};
  const std::string text = refusal([&] { data::insert_conversions(library, connections); });
  EXPECT_NE(text.find("app.blocks:9: drive.in: is connected to base.twist"), std::string::npos)
      << text;
  EXPECT_NE(text.find("'screw'"), std::string::npos);
  EXPECT_NE(text.find("'tool_screw'"), std::string::npos);
  EXPECT_NE(text.find("'screw' means Twist, 'ros_linear' means LinearVelocity"), std::string::npos);
}

}  // namespace
}  // namespace sinew::blocks
