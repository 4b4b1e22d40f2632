// The runtime engine: machine code and interpreter, lists that grow, its refusals.
#include "sinew/data/engine.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>

#include "allocations.h"
#include "sinew/blocks/elaborate.h"

namespace sinew::blocks {
namespace {

data::Converter interpreted(const data::Library& library, const data::Plan& plan) {
  data::EngineOptions options;
  options.interpret = true;
  return data::make_converter(library, plan, options);
}

// A formula of `lines` lines over eight inputs, in which every operation appears and more numbers
// are alive at once than a processor has registers.
std::string random_formula(std::mt19937& random, int lines) {
  std::vector<std::string> names = {"a", "b", "c", "d", "e", "f", "g", "h"};
  const auto any = [&] { return names[random() % names.size()]; };
  std::string text;
  for (int i = 0; i < lines; ++i) {
    const std::string x = any(), y = any(), z = any();
    const std::string expressions[] = {x + " + " + y,
                                       x + " - " + y,
                                       x + " * " + y,
                                       x + " / (1.5 + " + y + " * " + y + ")",
                                       "-" + x,
                                       "sqrt(abs(" + x + "))",
                                       "sin(" + x + ") * " + y,
                                       "cos(" + x + ")",
                                       "atan2(" + x + ", " + y + ")",
                                       "hypot(" + x + ", 3)",
                                       "min(" + x + ", " + y + ")",
                                       "max(" + x + ", " + y + ")",
                                       "copysign(" + x + ", " + y + ")",
                                       "select(" + x + " < " + y + ", " + z + ", " + x + ")",
                                       "select(" + x + ", " + x + ", " + y + ")",
                                       "0.25 - " + x,
                                       "copysign(" + x + ", " + x + ")",
                                       "select(" + x + " <= " + x + ", 2, " + x + ")"};
    const std::string name = "t" + std::to_string(i);
    text += "let " + name + " = " + expressions[random() % std::size(expressions)] + "\n";
    names.push_back(name);
  }
  for (const char* output : {"p", "q", "r", "s", "t", "u", "v", "w"}) {
    text += std::string(output) + " = " + any() + " + " + any() + "\n";
  }
  return text;
}

TEST(Engine, MachineCodeGivesTheInterpretersBitsOnRandomFormulas) {
  std::mt19937 random(7);
  std::size_t compiled_count = 0, compared = 0;
  for (int round = 0; round < 200; ++round) {
    const auto library = load_library(R"(
domain d :: { semantic : A; coord, dr
  coordinates one of A { a = unitless b = unitless c = unitless d = unitless
                         e = unitless f = unitless g = unitless h = unitless }
  coordinates two of A { p = unitless q = unitless r = unitless s = unitless
                         t = unitless u = unitless v = unitless w = unitless }
  formula one -> two of A { )" + random_formula(random, 5 + round) +
                                          R"( } }
algebraic eight :: Scalar{a, b, c, d, e, f, g, h}
algebraic other :: Scalar{p, q, r, s, t, u, v, w}
dproto from :: d { semantic = A coord = one algebraic = eight ddr = :: c99 { struct { float f[4]; double d[4]; } }
  dr = { f.0 = a f.1 = b f.2 = c f.3 = d d.0 = e d.1 = f d.2 = g d.3 = h } }
dproto to :: d { semantic = A coord = two algebraic = other ddr = :: c99 { struct { double d[6]; float f; int i; } }
  dr = { d.0 = p d.1 = q d.2 = r d.3 = s d.4 = t d.5 = u f = v i = w } }
)",
                                      "engine_test.blocks");
    data::PlanOptions lossy;
    lossy.allow_lossy = true;
    const auto plan = data::find_plan(library, "from", "to", lossy);
    const auto compiled = data::make_converter(library, plan), plain = interpreted(library, plan);
    EXPECT_FALSE(plain.compiled());
    compiled_count += compiled.compiled();
    for (int k = 0; k < 20; ++k) {
      struct {
        float f[4];
        double d[4];
      } source;
      std::normal_distribution<double> number(0, 2);
      for (float& it : source.f) it = static_cast<float>(number(random));
      for (double& it : source.d) it = number(random);
      if (k == 0) source.f[3] = -0.0f;
      struct {
        double d[6];
        float f;
        int i;
      } a = {}, b = {};
      ASSERT_TRUE(compiled.run(&source, &a));
      ASSERT_TRUE(plain.run(&source, &b));
      // Which of two NaN comes out of a sum is the compiler's choice.
      if (!std::isfinite(std::accumulate(b.d, b.d + 6, double(b.f)))) continue;
      ++compared;
      using Bits = std::array<std::uint64_t, sizeof a / sizeof(std::uint64_t)>;
      ASSERT_EQ(std::bit_cast<Bits>(a), std::bit_cast<Bits>(b)) << "round " << round;
    }
  }
  EXPECT_GT(compared, 3000u);
#if defined(__x86_64__)
  EXPECT_EQ(compiled_count, 200u);
#endif
}

TEST(Engine, ConvertsAValueInItsOwnMemory) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/pose.blocks");
  const double h = std::sqrt(0.5);
  const double dual[8] = {0, h, 0, h, 0.1, 0.2, 0.3, 0.4};
  const auto plan = data::find_plan(library, "dual", "s_plain_pose2");
  for (const auto& converter : {data::make_converter(library, plan), interpreted(library, plan)}) {
    double apart[16], same[16];
    EXPECT_TRUE(converter.run(dual, apart));
    std::memcpy(same, dual, sizeof dual);
    EXPECT_TRUE(converter.run(same, same));
    for (int i = 0; i < 16; ++i) EXPECT_EQ(same[i], apart[i]) << i;
  }
}

TEST(Engine, AllocatesNothingWhileItRuns) {
  struct Case {
    const char *file, *from, *to;
  };
  for (const Case& it : {Case{"orientation.blocks", "asn_quaternion", "e_rotation"},
                         Case{"orientation.blocks", "asn1c_quaternion", "ROT"},
                         Case{"pose.blocks", "dual", "s_plain_pose2"},
                         Case{"position.blocks", "smart_xyz", "dds_position"},
                         Case{"twist.blocks", "ros_twist", "screw"}}) {
    const auto library =
        load_library(std::string(SINEW_SOURCE_DIR "/examples/conversions/") + it.file);
    data::PlanOptions lossy;
    lossy.allow_lossy = true;
    const auto plan = data::find_plan(library, it.from, it.to, lossy);
    for (const auto& converter :
         {data::make_converter(library, plan), interpreted(library, plan)}) {
      // Zeros: lists that grow are too short, everything else is converted.
      double source[64] = {}, target[64] = {};
      const std::size_t before = allocations();
      for (int i = 0; i < 1000; ++i) converter.run(source, target);
      EXPECT_EQ(allocations(), before) << it.from << " -> " << it.to;
    }
  }
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
  const auto plan = data::find_plan(library, "asn1c_quaternion", "ROT");
  for (const auto& converter : {data::make_converter(library, plan), interpreted(library, plan)}) {
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
