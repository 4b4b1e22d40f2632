// Numbers whose products would overflow are refused where they stand; those at the limits pass.
#include "sinew/model/sizes.h"

#include <gtest/gtest.h>

#include "sinew/model/check.h"
#include "small_models.h"

namespace sinew::model::test {
namespace {

// A joint about z through frame a-1 of one link to b, that has mass; one number is odd.
struct Numbers {
  std::string mass = "1", first_moment = "0.1", moment = "0.05", product = "0.001", length = "1";
  std::string more = {}, unit = "KiloGM", length_unit = "M";
};

std::string model_of(const Numbers& n) {
  return "@prefix kc-stat: <https://comp-rob2b.github.io/metamodels/kinematic-chain/state#> .\n" +
         link("a", {"a-1"}) + link("b", {"b-1"}) + link("c") +
         pose("a-1", "a-root", "0 0 " + n.length, false, n.length_unit) +
         pose("b-1", "b-root", "0 0 1") + joint("j", "a-1", "b-root") +
         joint("k", "b-1", "c-root") +
         ":i a dyn:RigidBodyInertia ; dyn:of-body :b ; dyn:about :b-root-origin .\n"
         ":i-coord a dync:RigidBodyInertiaCoordinate ; dync:of-inertia :i ; dync:as-seen-by "
         ":b-root ; qudt:unit unit:" +
         n.unit + ", unit:M-KiloGM, unit:KiloGM-M2 ; dync:mass " + n.mass +
         " ; dync:first-moment-of-mass (" + n.first_moment + " 0 0) ; dync:ixx " + n.moment +
         " ; dync:iyy " + n.moment + " ; dync:izz " + n.moment + " ; dync:ixy " + n.product +
         " ; dync:ixz 0 ; dync:iyz 0 .\n" + n.more;
}

std::string limits(const std::string& number, const std::string& unit) {
  return ":l a skc:JointPositionLimits ; kc-stat:of-joint :j ; skc:lower 0 ; skc:upper " + number +
         " ; qudt:unit unit:" + unit + " .\n";
}

std::string mimicry(const std::string& multiplier, const std::string& offset) {
  return ":m a skc:JointMimicry ; kc-stat:of-joint :k ; skc:mimics :j ; skc:multiplier " +
         multiplier + " ; skc:offset " + offset + " ; qudt:unit unit:RAD .\n";
}

std::string gear(const std::string& ratio, const std::string& inertia) {
  return ":t a skc:JointTransmission ; kc-stat:of-joint :j ; skc:ratio " + ratio +
         " ; skc:rotor-inertia " + inertia + " ; qudt:unit unit:KiloGM-M2 .\n";
}

struct Size {
  const char* name;
  Numbers numbers;
  const char* iri;
  const char* phrase;
};

const std::vector<Size>& too_much() {
  static const std::vector<Size> kSizes = {
      {"Mass", {.mass = "1e308"}, "r#i-coord", "the mass is 1e+308 kg, more than 1e+12 kg"},
      {"MassByItsUnit", {.mass = "1e308", .unit = "TONNE"}, "r#i-coord", "the mass is inf kg"},
      {"TinyMass", {.mass = "1e-310"}, "r#i-coord", "not zero, but less than 1e-30 kg"},
      {"FirstMoment", {.first_moment = "1e200"}, "r#i-coord", "first moment of mass is beyond"},
      {"Moment", {.moment = "1e155"}, "r#i-coord", "moment of inertia is beyond 1e+36 kg m^2"},
      {"Product", {.product = "-1e308"}, "r#i-coord", "moment of inertia is beyond"},
      {"TinyMoments",
       {.first_moment = "0", .moment = "1e-300", .product = "0"},
       "r#i-coord",
       "the moments of inertia are not zero, but less than 1e-48 kg m^2"},
      {"Length", {.length = "1e200"}, "r#pose-a-1-a-root-coord", "is longer than 1e+12 m"},
      {"LengthByItsUnit",
       {.length = "1e306", .length_unit = "KiloM"},
       "r#pose-a-1-a-root-coord",
       "is longer than 1e+12 m"},
      {"Limit", {.more = limits("1e308", "REV")}, "r#j", "a limit of the joint overflows"},
      {"Multiplier", {.more = mimicry("1e200", "0")}, "r#m", "more than 1e+12 times as far"},
      {"Offset", {.more = mimicry("1", "-1e200")}, "r#m", "is beyond 1e+12"},
      {"Gear", {.more = gear("1e200", "1")}, "r#t", "the rotor is inf kg m^2, not between"},
      {"VanishingRotor", {.more = gear("1e-200", "1")}, "r#t", "the rotor is 0 kg m^2, not"},
  };
  return kSizes;
}

class TooMuch : public testing::TestWithParam<std::size_t> {};

TEST_P(TooMuch, IsRefusedBeforeASolverIsMadeAndByCheck) {
  const Size& size = too_much()[GetParam()];
  for (const bool checks : {false, true}) {
    Model model;
    load_texts(model, {turtle(model_of(size.numbers))});
    ASSERT_EQ(first_error(model), "");
    if (checks)
      check_numbers(model.store, model.places, model.report);
    else
      normalise(model.store, model.places, {}, model.report);
    const std::string error = first_error(model);
    EXPECT_NE(error.find(size.phrase), std::string::npos) << error;
    EXPECT_NE(error.find(size.iri), std::string::npos) << error;
    EXPECT_EQ(error.find("model.ttl:"), 0u) << error;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, TooMuch, testing::Range<std::size_t>(0, too_much().size()),
                         [](const auto& info) { return too_much()[info.param].name; });

TEST(Sizes, AtTheLimitsPass) {
  const Numbers fine[] = {
      {.mass = "1e12", .first_moment = "1e12", .moment = "1e24", .product = "1e20"},
      {.mass = "1e-30", .first_moment = "0", .moment = "1e-48", .product = "1e-60"},
      {.length = "-1e12"},
      {.length = "1e9", .length_unit = "KiloM"},
      {.more = limits("1.7976931348623157e308", "RAD")},
      {.more = mimicry("-1e12", "1e12")},
      {.more = gear("1e6", "1e-3")},
      {.more = gear("0", "1")}};
  for (const Numbers& numbers : fine) {
    Model model;
    normalise_texts(model, {turtle(model_of(numbers))});
    EXPECT_EQ(first_error(model), "");
  }
}

// Far from its joint even a sane body has a moment of inertia that is none.
TEST(Sizes, CountAboutTheJoint) {
  Model model;
  Numbers numbers;
  numbers.mass = "1e12";
  numbers.moment = "1e11";
  std::string text = model_of(numbers);
  const std::string about = "dyn:about :b-root-origin", seen = "dync:as-seen-by :b-root";
  text.replace(text.find(about), about.size(), "dyn:about :b-1-origin");
  text.replace(text.find(seen), seen.size(), "dync:as-seen-by :b-1");
  text += pose("b-1", "b-root", "0 0 9e11");
  text.replace(text.find("coord:x 0 ; coord:y 0 ; coord:z 1 .", text.find("pose-b-1-b-root-coord")),
               35, "coord:x 0 ; coord:y 9e11 ; coord:z 9e11 .");
  text.erase(text.rfind(":pose-b-1-b-root a"));
  normalise_texts(model, {turtle(text)});
  EXPECT_NE(first_error(model).find("i-coord: about the joint, a moment of inertia is beyond"),
            std::string::npos)
      << first_error(model);
}

// Each follows the one before it a million times as far.
TEST(Sizes, OfALineOfFollowersMultiply) {
  const auto joint_of = [](int k) {
    const std::string name = std::to_string(k), before = std::to_string(k - 1);
    return "<link name='l" + name + "'/><joint name='j" + name +
           "' type='continuous'><parent link='l" + before + "'/><child link='l" + name + "'/>" +
           (k > 1 ? "<mimic joint='j" + before + "' multiplier='1e6'/>" : "") + "</joint>\n";
  };
  for (const int joints : {3, 4}) {
    std::string robot = "<link name='l0'/>\n";
    for (int k = 1; k <= joints; ++k) robot += joint_of(k);
    Model model;
    normalise_texts(model, {urdf(robot)});
    const std::string error = first_error(model);
    if (joints == 3) {
      EXPECT_EQ(error, "");
    } else {
      EXPECT_EQ(error.find("robot.urdf:6: "), 0u) << error;
      EXPECT_NE(error.find("by way of others"), std::string::npos) << error;
    }
  }
}

TEST(Sizes, OfTheGravityThatIsAskedFor) {
  Model model;
  NormaliseOptions options;
  options.gravity = Vector3{0, 0, -1e300};
  normalise_texts(model, {turtle(model_of({}))}, options);
  EXPECT_NE(first_error(model).find("the gravity is beyond 1e+12 m/s^2; give the gravity vector"),
            std::string::npos)
      << first_error(model);
}

}  // namespace
}  // namespace sinew::model::test
