#include "sinew/base/error.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(Problem, NamesPlaceIriFaultAndRemedyInThatOrder) {
  const Problem problem{.place = {"robot.json", 12, 3},
                        .iri = "http://x/joint1",
                        .what = "has no unit",
                        .remedy = "add \"unit\"",
                        .severity = Severity::kError,
                        .code = {}};
  EXPECT_EQ(to_string(problem), "robot.json:12: http://x/joint1: has no unit; add \"unit\"");
}

TEST(Problem, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string({{}, "", "no query", "", Severity::kError, {}}), "no query");
  EXPECT_EQ(to_string({{"a", 0, 0}, "", "odd", "", Severity::kWarning, {}}), "a: warning: odd");
}

TEST(Report, ThrowsEveryErrorButNoWarning) {
  Report report;
  report.warning({}, "", "only a warning", "");
  EXPECT_NO_THROW(report.throw_if_errors());
  report.error({}, "", "first", "");
  report.error({}, "", "second", "");
  try {
    report.throw_if_errors();
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "first\nsecond");
  }
}

TEST(Report, SaysHowManyProblemsItLeftOut) {
  Report report(2);
  for (int i = 0; i < 5; ++i) report.error({}, "", "fault", "");
  try {
    report.throw_if_errors();
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems().back().what, "and 3 more problems");
  }
}

TEST(Report, StillThrowsWhenOnlyLeftOutProblemsAreErrors) {
  Report report(1);
  report.warning({}, "", "kept", "");
  report.error({}, "", "left out", "");
  EXPECT_THROW(report.throw_if_errors(), Error);
}

}  // namespace
}  // namespace sinew
