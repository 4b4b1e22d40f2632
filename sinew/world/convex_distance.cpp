// The nearest point of a simplex is taken as the best over its faces; each face's comes from the
// Gram matrix of its edges, and a degenerate face is covered by its own.
#include "sinew/world/convex_distance.h"

namespace sinew::world {
namespace {

using math::dot;

// The point nearest to the origin in the affine hull of `face`, where it is a mix of the face's
// points with positive shares.
bool nearest_inside(const Simplex& face, Vector3& nearest) {
  const Vector3 origin = face.points[0];
  const std::size_t edges = face.size - 1;
  std::array<Vector3, 3> edge;
  std::array<std::array<double, 4>, 3> system{};  // Gram matrix of the edges | -edge . origin
  double scale = 0;
  for (std::size_t i = 0; i < edges; ++i) edge[i] = face.points[i + 1] - origin;
  for (std::size_t i = 0; i < edges; ++i) {
    for (std::size_t j = 0; j < edges; ++j) system[i][j] = dot(edge[i], edge[j]);
    system[i][3] = -dot(edge[i], origin);
    scale = std::max(scale, system[i][i]);
  }
  std::array<double, 3> share{};
  for (std::size_t i = 0; i < edges; ++i) {  // elimination; the matrix is positive definite
    if (system[i][i] <= 1e-14 * scale) return false;
    for (std::size_t k = i + 1; k < edges; ++k) {
      const double factor = system[k][i] / system[i][i];
      for (std::size_t j = i; j < 4; ++j) system[k][j] -= factor * system[i][j];
    }
  }
  double first = 1;
  for (std::size_t i = edges; i-- > 0;) {
    double right = system[i][3];
    for (std::size_t j = i + 1; j < edges; ++j) right -= system[i][j] * share[j];
    share[i] = right / system[i][i];
    if (!(share[i] > 0)) return false;
    first -= share[i];
  }
  if (!(first > 0)) return false;
  nearest = origin;
  for (std::size_t i = 0; i < edges; ++i) nearest = nearest + share[i] * edge[i];
  return true;
}

}  // namespace

Vector3 reduce(Simplex& simplex) {
  Simplex best;
  Vector3 best_point;
  double best_square = INFINITY;
  for (unsigned subset = 1; subset < (1u << simplex.size); ++subset) {
    Simplex face;
    for (std::size_t i = 0; i < simplex.size; ++i) {
      if (subset >> i & 1) face.points[face.size++] = simplex.points[i];
    }
    Vector3 point;
    if (!nearest_inside(face, point)) continue;
    const double square = dot(point, point);
    if (square < best_square) best = face, best_point = point, best_square = square;
  }
  simplex = best;
  return best_point;
}

}  // namespace sinew::world
