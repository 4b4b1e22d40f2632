#include "sinew/synthesis/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sinew::synthesis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Slots = std::vector<std::string>;

// "outward: a b; inward: c"
std::string text(const Plan& plan) {
  std::string words;
  for (const Sweep& sweep : plan.sweeps) {
    words += (words.empty() ? "" : "; ") + std::string(to_string(sweep.direction)) + ":";
    for (const Step* step : sweep.steps) words += " " + step->name;
  }
  return words;
}

std::string plan(std::vector<Wish> wishes, const Slots& given) {
  Report report;
  const Plan made = make_plan(steps(), wishes, given, report);
  std::string words = text(made);
  for (const Problem& problem : report.problems()) words = to_string(problem);
  return words;
}

Wish force() { return {"force", "joint-force"}; }
Wish pose() { return {"frame-pose", "pose"}; }
const Slots kMotion = {"position", "velocity", "acceleration"};

TEST(Plan, OfPosesIsOneSweepOutward) {
  EXPECT_EQ(plan({pose()}, {"position"}), "outward: joint-pose pose frame-pose");
}

TEST(Plan, OfJointForcesIsASweepOutwardAndOneInward) {
  EXPECT_EQ(plan({force()}, kMotion),
            "outward: joint-pose joint-velocity velocity joint-acceleration body-acceleration "
            "inertia own-wrench; inward: body-wrench joint-force");
}

TEST(Plan, OfForwardDynamicsIsThreeSweeps) {
  const std::string words =
      plan({{"acceleration", "joint-acceleration"}}, {"position", "velocity", "force"});
  EXPECT_THAT(words, HasSubstr("bias-own-wrench own-articulated-inertia; inward: "
                               "articulated-inertia joint-drive-with-bias; "
                               "outward: forward-dynamics"));
}

TEST(Plan, TakesWhatSeveralThingsNeedOnce) {
  const std::string words = plan({pose(), force()}, kMotion);
  EXPECT_EQ(words.find("joint-pose"), words.rfind("joint-pose"));
  EXPECT_THAT(words, HasSubstr("outward: joint-pose pose frame-pose joint-velocity"));
}

// Acceleration that follows from forces, and moves the tip: its step comes after that of the tip in
// the list.
TEST(Plan, PutsGiversFirstWhateverTheOrderOfTheList) {
  EXPECT_THAT(
      plan({{"acceleration-twist", "acceleration-twist"}}, {"position", "velocity", "force"}),
      HasSubstr("outward: forward-dynamics joint-acceleration body-acceleration "
                "frame-acceleration"));
}

TEST(Plan, NamesWhatNoStepGives) {
  const std::vector<Step> list = {{.name = "luck",
                                   .purpose = "",
                                   .expansion = "",
                                   .needs = {"charm"},
                                   .may_use = {},
                                   .gives = {"fortune"},
                                   .visitors = {}}};
  Report report;
  make_plan(list, std::vector<Wish>{{"fortune", "fortune"}}, Slots{}, report);
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_THAT(to_string(report.problems().front()),
              HasSubstr("fortune cannot be computed without charm, which no step gives"));
}

TEST(Plan, DoesNothingForWhatIsGiven) { EXPECT_EQ(plan({force()}, {"force"}), ""); }

TEST(Plan, NamesTheDriverThatIsMissing) {
  EXPECT_THAT(plan({force()}, {"position", "velocity"}),
              HasSubstr("joint-force cannot be computed without joint-acceleration"));
  EXPECT_THAT(plan({force()}, {"velocity", "acceleration"}),
              HasSubstr("joint-force cannot be computed without joint-position"));
  EXPECT_THAT(plan({{"acceleration", "joint-acceleration"}}, {"position", "velocity"}),
              HasSubstr("joint-acceleration cannot be computed without joint-force"));
}

TEST(Plan, SaysWhyEachStepIsThere) {
  Report report;
  const std::vector<Wish> wishes = {pose()};
  const Slots given = {"position"};
  const Plan made = make_plan(steps(), wishes, given, report);
  EXPECT_THAT(made.why,
              ElementsAre(HasSubstr("joint-pose gives pose-across-joint (needed by pose)"),
                          HasSubstr("pose gives pose (needed by frame-pose)"),
                          HasSubstr("frame-pose gives frame-pose (asked: pose)")));
}

TEST(Steps, HaveNamesOfTheirOwnAndAreListedAfterTheirGivers) {
  std::set<std::string> names, given = {"position", "velocity",          "acceleration", "force",
                                        "gravity",  "base-acceleration", "wrench"};
  for (const Step& step : steps()) {
    EXPECT_TRUE(names.insert(step.name).second) << step.name;
    for (const std::string& need : step.needs)
      EXPECT_TRUE(given.contains(need)) << step.name << " needs " << need;
    given.insert(step.gives.begin(), step.gives.end());
  }
}

TEST(SweepConfiguration, RefusesAStepBeforeItsGiver) {
  Report report;
  const std::vector<Sweep> sweeps = {
      {Direction::kOutward, {find_step("pose"), find_step("joint-pose")}}};
  const Slots given = {"position"};
  check_sweeps(sweeps, given, "mine", report);
  ASSERT_FALSE(report.problems().empty());
  EXPECT_THAT(to_string(report.problems()[0]),
              HasSubstr("step pose needs pose-across-joint, which nothing before it gives"));
}

TEST(SweepConfiguration, RefusesAStepInASweepOfTheOtherDirection) {
  Report report;
  const std::vector<Sweep> sweeps = {{Direction::kInward, {find_step("joint-pose")}}};
  const Slots given = {"position"};
  check_sweeps(sweeps, given, "mine", report);
  ASSERT_FALSE(report.problems().empty());
  EXPECT_THAT(to_string(report.problems()[0]),
              HasSubstr("step joint-pose goes outward in a sweep that goes inward"));
}

}  // namespace
}  // namespace sinew::synthesis
