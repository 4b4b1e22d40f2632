#include "sinew/backend/tiered.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::backend {
namespace {

using program::Program;
using program::Role;

// joint position -> pose
Program turn() {
  Program p;
  p.name = "turn";
  p.variables = {{"position.joint1",
                  "urn:q",
                  "urn:joint1",
                  "joint-position",
                  "RAD",
                  "",
                  Role::kInput,
                  false,
                  1,
                  {}},
                 {"pose.frame1",
                  "urn:x",
                  "urn:frame1",
                  "pose",
                  "UNITLESS M",
                  "urn:frame0",
                  Role::kInternal,
                  true,
                  12,
                  {}}};
  p.closures = {{"position-to-pose-revolute", "urn:closure", "urn:step", "urn:joint1", {0, 1}}};
  p.schedule = {0};
  return p;
}

TEST(Tiered, GivesTheSameAnswersBeforeAndAfterItIsCompiled) {
  Tiered tiered(turn());
  const double q = 0.7;
  double first[12], later[12];
  tiered.evaluate(&q, first);  // whichever back end is ready
  EXPECT_NEAR(first[0], std::cos(q), 1e-15);
  tiered.wait();
  tiered.evaluate(&q, later);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(first[i], later[i], 1e-15);
  if (!tiered.is_compiled()) {
    EXPECT_FALSE(tiered.fault().empty());
    GTEST_SKIP() << "only interpreted here: " << tiered.fault();
  }
  EXPECT_TRUE(tiered.fault().empty());
}

TEST(Tiered, EvaluatesWhileItIsBeingCompiled) {
  Tiered tiered(turn());
  double out[12];
  for (int i = 0; i < 20000; ++i) {
    const double q = 1e-3 * i;
    tiered.evaluate(&q, out);
    ASSERT_NEAR(out[0], std::cos(q), 1e-14);
  }
}

}  // namespace
}  // namespace sinew::backend
