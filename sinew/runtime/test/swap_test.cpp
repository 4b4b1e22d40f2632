#include <gmock/gmock.h>

#include "fixture.h"

namespace sinew::runtime::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SwapTest : public RuntimeTest {};

TEST_F(SwapTest, CarriesAStateWithTheSameIriAndPrototypeOver) {
  const auto before = model(2.0), after = model(100.0);
  const auto h = host(*before);
  h->step();  // kept: -2
  const SwapReport report = h->swap("main", executable(*after));
  EXPECT_THAT(report.carried, ElementsAre("kept.joint1"));
  EXPECT_THAT(report.initialised, IsEmpty());
  EXPECT_THAT(report.kept, ElementsAre("given.joint1"));
  h->step();
  EXPECT_EQ(robot_->command_, 5.0);  // 3 + 2, not 3 - 100
  ASSERT_TRUE(h->last_swap().has_value());
  EXPECT_EQ(h->last_swap()->tick, 1u);
}

TEST_F(SwapTest, RefusesAStateWithAnotherPrototypeWhenNothingIsDeclared) {
  const auto before = model(2.0), after = model(100.0, true);
  const auto h = host(*before);
  h->step();
  SwapRules rules;
  rules.set_points = {{"given.joint1", {1.0}}};
  try {
    h->swap("main", executable(*after), rules);
    FAIL() << "a state vanished in silence";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("kept.joint1"));
    EXPECT_THAT(error.what(), HasSubstr("in N-M"));
    EXPECT_THAT(error.what(), HasSubstr("sa:at-swap"));
  }
  h->step();
  EXPECT_EQ(robot_->command_, 5.0) << "the old program goes on";
}

// The same, with `says` about the state in the new program's model.
class DeclaredSwap : public SwapTest {
 protected:
  SwapReport swap(const std::string& says, double first = 2.0) {
    before_ = model(first);
    after_ = model(100.0, true);
    algorithm::weave(after_->store, after_->algorithm,
                     "PREFIX sa: <https://w3id.org/sinew/algorithm#>\n"
                     "PREFIX so: <https://w3id.org/sinew/operators#>\n"
                     "PREFIX qudt: <http://qudt.org/schema/qudt/>\n"
                     "PREFIX unit: <http://qudt.org/vocab/unit/>\n"
                     "INSERT { ?kept sa:at-swap " +
                         says + " } WHERE { ?kept sa:name \"kept.joint1\" }",
                     "declare");
    host_ = host(*before_);
    host_->step();  // kept: -first
    SwapRules rules;
    rules.set_points = {{"given.joint1", {1.0}}};
    const SwapReport report = host_->swap("main", executable(*after_), rules);
    host_->step();
    return report;
  }
  std::string refused(const std::string& says) {
    try {
      swap(says);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::unique_ptr<Model> before_, after_;
  std::unique_ptr<Host> host_;
};

TEST_F(DeclaredSwap, InitialisesAState) {
  const SwapReport report = swap("sa:initialise");
  EXPECT_THAT(report.initialised, ElementsAre("kept.joint1"));
  EXPECT_EQ(robot_->command_, -99.0);  // 1 - 100
}

TEST_F(DeclaredSwap, ConvertsAStateByAFactor) {
  // N m to N at an arm of 50 cm: 2 per metre.
  const SwapReport report = swap("[ sa:factor [ qudt:value 2.0 ; qudt:unit unit:PER-M ] ]");
  EXPECT_THAT(report.converted, ElementsAre("kept.joint1"));
  EXPECT_EQ(robot_->command_, 5.0);  // 1 + 2 * 2
}

TEST_F(DeclaredSwap, RefusesAFactorWhoseUnitDoesNotFit) {
  EXPECT_THAT(refused("[ sa:factor [ qudt:value 2.0 ; qudt:unit unit:M ] ]"),
              HasSubstr("times a factor in M"));
  EXPECT_THAT(refused("[ sa:factor [ qudt:value 2.0 ; qudt:unit unit:Elbow ] ]"),
              HasSubstr("no known unit"));
}

TEST_F(DeclaredSwap, RefusesAnOperatorThatDoesNotFitTheOldState) {
  // It makes a joint force, but of a signal.
  EXPECT_THAT(refused("[ sa:operator so:joint-force-of-signal ]"),
              HasSubstr("is a joint-force; it takes a signal"));
  EXPECT_THAT(refused("[ sa:operator so:keep-flag ]"), HasSubstr("makes no joint-force"));
  EXPECT_THAT(refused("[ sa:converted-from <https://example.org/nowhere> ; "
                      "sa:factor [ qudt:value 2.0 ; qudt:unit unit:PER-M ] ]"),
              HasSubstr("has no data block 'https://example.org/nowhere'"));
}

TEST_F(DeclaredSwap, RefusesADeclarationThatSaysNothingOrTooMuch) {
  EXPECT_THAT(refused("[ sa:converted-from sa:initialise ]"), HasSubstr("neither or both"));
  EXPECT_THAT(refused("[ sa:operator so:keep-flag ; sa:factor [ qudt:value 1 ] ]"),
              HasSubstr("neither or both"));
  EXPECT_THAT(refused("[ sa:factor 2.0 ]"), HasSubstr("no value or no unit"));
  EXPECT_THAT(refused("sa:initialise ; sa:at-swap [ sa:operator so:keep-flag ]"),
              HasSubstr("two values"));
}

TEST_F(SwapTest, InitialisesAStateWhenTheCallerSaysSo) {
  const auto before = model(2.0), after = model(100.0, true);  // newtons, not newton metres
  const auto h = host(*before);
  h->step();
  // The set point has another prototype as well, so nothing gives it a value.
  EXPECT_THROW(h->swap("main", executable(*after)), Error);
  h->step();
  EXPECT_EQ(robot_->command_, 5.0) << "the old program goes on";
  SwapRules rules;
  rules.set_points = {{"given.joint1", {1.0}}};
  rules.initialise = {"kept.joint1"};
  const SwapReport report = h->swap("main", executable(*after), rules);
  EXPECT_THAT(report.initialised, ElementsAre("kept.joint1"));
  EXPECT_THAT(report.set, ElementsAre("given.joint1"));
  h->step();
  EXPECT_EQ(robot_->command_, -99.0);  // 1 - 100
}

TEST_F(SwapTest, ConvertsAStateAsDeclared) {
  const auto before = model(2.0), after = model(100.0, true);
  const auto h = host(*before);
  h->step();  // kept: -2
  SwapRules rules;
  rules.set_points = {{"given.joint1", {1.0}}};
  rules.conversions = {
      {"kept.joint1", "kept.joint1", [](std::span<const double> from, std::span<double> to) {
         to[0] = from[0] / 0.5;  // at an arm of half a metre
       }}};
  const SwapReport report = h->swap("main", executable(*after), rules);
  EXPECT_THAT(report.converted, ElementsAre("kept.joint1"));
  h->step();
  EXPECT_EQ(robot_->command_, 5.0);  // 1 + 4
}

TEST_F(SwapTest, LeavesTheOldProgramRunningWhenTheNewOneCannotBeMade) {
  const auto before = model(), after = model();
  weave(*after, "check", "a so:check-range ; so:quantity ( ?force ) ; sa:lower 0");
  const auto h = host(*before);
  h->start();
  EXPECT_THROW(h->swap("main", executable(*after)), Error);
  const std::uint64_t cycles = h->statistics().cycles;
  for (int i = 0; i < 400 && h->statistics().cycles < cycles + 5; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(h->statistics().cycles, cycles + 5);
  EXPECT_EQ(h->state(), State::kRunning);
  EXPECT_FALSE(h->last_swap().has_value());
  h->stop();
}

// While the loop runs at 1 kHz, program after program takes over; the state goes from each to the
// next, and the count of cycles has no gap.
TEST_F(SwapTest, MissesNoCycleInALoopThatRuns) {
  const auto m = model(2.0);
  const auto h = host(*m, {.period_s = 1e-3, .late = LateCycles::kCatchUp});
  h->start();
  constexpr int kSwaps = 20;
  for (int i = 0; i < kSwaps; ++i) {
    h->swap("main", executable(*m));
    const std::uint64_t cycles = h->statistics().cycles;
    for (int k = 0; k < 400 && h->statistics().cycles < cycles + 2; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  h->stop();
  const auto record = h->last_swap();
  ASSERT_TRUE(record.has_value());
  EXPECT_LT(record->in_loop_cpu, 1'000'000) << "the exchange computes for less than a cycle";
  int swapped = 0;
  for (const Event& event : h->take_events()) swapped += event.kind == Event::Kind::kSwapped;
  EXPECT_EQ(swapped, kSwaps);
  EXPECT_EQ(h->statistics().missed, 0u);
  // After n cycles the state has changed its sign n times, whoever ran them.
  const double kept = h->read("main", "kept.joint1")[0];
  EXPECT_EQ(kept, h->statistics().cycles % 2 == 0 ? 2.0 : -2.0);
}

}  // namespace
}  // namespace sinew::runtime::test
