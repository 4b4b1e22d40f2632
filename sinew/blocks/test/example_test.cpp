// The examples that ship, from the file to the explanation.
#include <gtest/gtest.h>

#include "sinew/blocks/elaborate.h"
#include "sinew/data/emit.h"
#include "sinew/data/plan.h"

namespace sinew::blocks {
namespace {

TEST(Example, OrientationIsAnIndirectConversionOfDistanceThree) {
  const auto library = load_library(SINEW_SOURCE_DIR "/examples/conversions/orientation.blocks");
  const auto plan = data::find_plan(library, "asn_quaternion", "e_rotation");
  const auto segments = data::segments_of(library, plan);
  ASSERT_EQ(segments.size(), 3u) << data::explain(library, plan);
  EXPECT_EQ(data::type_of(segments), data::ConversionType::kIndirect);
  EXPECT_EQ(segments[0].type, data::ConversionType::kAlias);
  EXPECT_EQ(segments[0].to, "QUAT");
  EXPECT_EQ(segments[1].type, data::ConversionType::kFunction);
  EXPECT_EQ(segments[1].to, "ROT");
  EXPECT_EQ(segments[2].type, data::ConversionType::kPlain);
  EXPECT_EQ(segments[2].to, "e_rotation");
}

}  // namespace
}  // namespace sinew::blocks
