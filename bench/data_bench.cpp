// Data conversions: emitted code against the same written by hand, the runtime engine, the search
// for a chain.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "asn_quaternion_to_e_rotation.h"  // made by sinew convert from examples/conversions/orientation.blocks
#include "sinew/blocks/elaborate.h"
#include "sinew/data/engine.h"

namespace {

using namespace sinew;
using Matrix = Eigen::Matrix<double, 3, 3>;

// What a person would write for the source's three-step example.
inline void by_hand(const asn1SccWrappers_Quaterniond& q, Matrix& r) {
  const double x = q.im.arr[0], y = q.im.arr[1], z = q.im.arr[2], w = q.re;
  const double x2 = x + x, y2 = y + y, z2 = z + z;
  const double xx = x * x2, xy = x * y2, xz = x * z2;
  const double yy = y * y2, yz = y * z2, zz = z * z2;
  const double wx = w * x2, wy = w * y2, wz = w * z2;
  r(0, 0) = 1 - (yy + zz);
  r(0, 1) = xy - wz;
  r(0, 2) = xz + wy;
  r(1, 0) = xy + wz;
  r(1, 1) = 1 - (xx + zz);
  r(1, 2) = yz - wx;
  r(2, 0) = xz - wy;
  r(2, 1) = yz + wx;
  r(2, 2) = 1 - (xx + yy);
}

// The source's way: a function in a library between two plain arrays.
[[gnu::noinline]] void quat2rot(const double* q, double* r) {
  const asn1SccWrappers_Quaterniond quaternion{{{q[0], q[1], q[2]}}, q[3]};
  Matrix matrix;
  by_hand(quaternion, matrix);
  for (int i = 0; i < 9; ++i) r[i] = matrix(i / 3, i % 3);
}
void in_three_steps(const asn1SccWrappers_Quaterniond& source, Matrix& target) {
  const double quaternion[4] = {source.im.arr[0], source.im.arr[1], source.im.arr[2], source.re};
  double rotation[9];
  quat2rot(quaternion, rotation);
  for (int i = 0; i < 9; ++i) target(i / 3, i % 3) = rotation[i];
}

std::vector<asn1SccWrappers_Quaterniond> quaternions() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<asn1SccWrappers_Quaterniond> result(256);
  for (auto& q : result) {
    const Eigen::Quaterniond unit =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized();
    q = {{{unit.x(), unit.y(), unit.z()}}, unit.w()};
  }
  return result;
}

template <typename Convert>
void convert_all(benchmark::State& state, Convert&& convert) {
  const auto sources = quaternions();
  std::vector<Matrix> targets(sources.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      convert(sources[i], targets[i]);
      benchmark::DoNotOptimize(targets[i].data());
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sources.size()));
}

void BM_ByHand(benchmark::State& state) {
  convert_all(state, [](const auto& q, Matrix& r) { by_hand(q, r); });
}
void BM_Emitted(benchmark::State& state) {
  convert_all(state, [](const auto& q, Matrix& r) { asn_quaternion_to_e_rotation(q, r); });
}
void BM_ByHandInThreeSteps(benchmark::State& state) {
  convert_all(state, [](const auto& q, Matrix& r) { in_three_steps(q, r); });
}
BENCHMARK(BM_ByHand);
BENCHMARK(BM_Emitted);
BENCHMARK(BM_ByHandInThreeSteps);

const data::Library& orientation() {
  static const data::Library library = blocks::load_library(
      std::string(SINEW_SOURCE_DIR "/examples/conversions/orientation.blocks"));
  return library;
}

void BM_Engine(benchmark::State& state) {
  data::EngineOptions options;
  options.interpret = state.range(0) != 0;
  const auto converter = data::make_converter(
      orientation(), data::find_plan(orientation(), "asn_quaternion", "e_rotation"), options);
  convert_all(state, [&](const auto& q, Matrix& r) { converter.run(&q, r.data()); });
}
BENCHMARK(BM_Engine)->ArgName("interpreted")->Arg(0)->Arg(1);

// A file of n prototypes of one meaning in three coordinates, with functions between some of them.
data::Library many_prototypes(int n) {
  std::string text =
      "algebraic r :: Matrix{3,3} algebraic q :: Scalar{x,y,z,w} algebraic e :: Vector{3}\n"
      "units u :: qudt, e { rad = 0, rad = 1, rad = 2 }\n";
  std::string matrix;
  for (int k = 0; k < 9; ++k) {
    matrix += std::to_string(k) + "={" + std::to_string(k / 3) + "," + std::to_string(k % 3) + "} ";
  }
  for (int i = 0; i < n; ++i) {
    const std::string name = "p" + std::to_string(i);
    text += "dproto " + name + " :: geometry { semantic = Orientation ";
    if (i % 3 == 0)
      text +=
          "coord = rot_matrix algebraic = r ddr = :: c99 { double[9] } dr = { " + matrix + "} }\n";
    if (i % 3 == 1)
      text +=
          "coord = quaternion algebraic = q ddr = :: c99 { double[4] } dr = { 0=x 1=y 2=z 3=w } "
          "}\n";
    if (i % 3 == 2)
      text +=
          "coord = rpy algebraic = e ddr = :: c99 { double[3] } dr = { 0=0 1=1 2=2 } units = u }\n";
    if (i >= 10 && i % 10 == 1) {
      const std::string function = "f" + std::to_string(i), to = "p" + std::to_string(i - 7);
      text += "fproto " + function + " :: c99 { args = { 1 <= " + name + ", 2 => " + to + " } }\n";
      text += "conversion " + name + " -> " + to + " = " + function +
              " { cost = " + std::to_string(20 + i % 50) + " }\n";
    }
  }
  return blocks::load_library(text, "many.blocks");
}

void BM_FindPlan(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const data::Library library = many_prototypes(n);
  int i = 0;
  for (auto _ : state) {
    const auto from = "p" + std::to_string(i % n), to = "p" + std::to_string((7 * i + 5) % n);
    benchmark::DoNotOptimize(data::find_plan(library, from, to).cost);
    ++i;
  }
}
BENCHMARK(BM_FindPlan)->ArgName("prototypes")->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

void BM_LoadLibrary(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(many_prototypes(1000).prototypes.size());
}
BENCHMARK(BM_LoadLibrary)->Unit(benchmark::kMillisecond);

}  // namespace
