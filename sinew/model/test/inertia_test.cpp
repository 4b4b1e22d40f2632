// Inertias moved to other frames, and what counts as no turn.
#include "sinew/model/inertia.h"

#include <gtest/gtest.h>

#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

// About y, by an angle whose cosine is 1.
constexpr double kTilt = 1e-8;
const Matrix3 kTilted = {1, 0, kTilt, 0, 1, 0, -kTilt, 0, 1};

TEST(Inertia, IsTurnedByATiltWhoseCosineIsOne) {
  const RigidBodyInertia body = {2, {0, 0, 0.5}, {1, 0, 0, 2, 0, 3}};
  const RigidBodyInertia seen = transformed(body, kTilted, {0, 0, 0});
  EXPECT_DOUBLE_EQ(seen.first_moment.x, 0.5 * kTilt);
  EXPECT_DOUBLE_EQ(seen.rotational.xz, 2 * kTilt);  // (I_zz - I_xx) times the angle
  EXPECT_EQ(seen.rotational.xy, 0);
}

TEST(Inertia, StaysWhatItIsWithoutATurn) {
  const RigidBodyInertia body = {2, {0.1, 0.2, 0.3}, {0.7, 0.01, 0.02, 0.8, 0.03, 0.9}};
  const RigidBodyInertia seen = transformed(body, identity_rotation(), {0, 0, 0});
  EXPECT_EQ(seen.first_moment.y, 0.2);
  EXPECT_EQ(seen.rotational.yz, 0.03);
  EXPECT_EQ(seen.rotational.zz, 0.9);
}

TEST(Rotation, OfATiltIsNotTheIdentity) {
  EXPECT_FALSE(is_identity(kTilted));
  EXPECT_FALSE(is_identity(Pose{kTilted, {0, 0, 0}}));
  EXPECT_TRUE(is_identity(identity_rotation()));
  EXPECT_FALSE(is_identity(Pose{identity_rotation(), {0, 1e-300, 0}}));
}

}  // namespace
}  // namespace sinew::model
