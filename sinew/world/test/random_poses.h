// Random poses for the tests: rotations spread evenly, positions within some metres.
#pragma once

#include <cmath>
#include <random>

#include "sinew/world/pose.h"

namespace sinew::world {

inline Pose random_pose(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Pose X{{normal(random), normal(random), normal(random), normal(random)},
         {normal(random), normal(random), normal(random)}};
  auto& [x, y, z, w] = X.q;
  const double scale = 1 / std::sqrt(x * x + y * y + z * z + w * w);
  x *= scale, y *= scale, z *= scale, w *= scale;
  return X;
}

// The largest difference of two poses: of an entry of R, or of a coordinate.
inline double difference(const Pose& a, const Pose& b) {
  const auto A = to_matrix(a);
  const auto B = to_matrix(b);
  const double entries[] = {A.R.xx - B.R.xx, A.R.xy - B.R.xy, A.R.xz - B.R.xz, A.R.yx - B.R.yx,
                            A.R.yy - B.R.yy, A.R.yz - B.R.yz, A.R.zx - B.R.zx, A.R.zy - B.R.zy,
                            A.R.zz - B.R.zz, A.p.x - B.p.x,   A.p.y - B.p.y,   A.p.z - B.p.z};
  double worst = 0;
  for (const double entry : entries) worst = std::max(worst, std::abs(entry));
  return worst;
}

}  // namespace sinew::world
