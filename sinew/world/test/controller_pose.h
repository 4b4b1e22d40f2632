// A pose as a controller has it: one homogeneous transformation, row by row, in millimetres.
#pragma once

namespace sinew::world {

inline constexpr const char* kControllerPose = R"(
units ht_mm :: qudt, ht_matrix {
  unitless = {0,0}, unitless = {0,1}, unitless = {0,2}, mm = {0,3}, unitless = {1,0},
  unitless = {1,1}, unitless = {1,2}, mm = {1,3}, unitless = {2,0}, unitless = {2,1},
  unitless = {2,2}, mm = {2,3}, unitless = {3,0}, unitless = {3,1}, unitless = {3,2},
  unitless = {3,3}
}
dproto controller_pose :: geometry {
  semantic  = Pose
  coord     = homogeneous_transformation
  algebraic = ht_matrix
  ddr       = :: c99 { double[16] }
  dr        = {
    0 = {0,0}, 1 = {0,1}, 2 = {0,2}, 3 = {0,3}, 4 = {1,0}, 5 = {1,1}, 6 = {1,2}, 7 = {1,3},
    8 = {2,0}, 9 = {2,1}, 10 = {2,2}, 11 = {2,3}, 12 = const 0, 13 = const 0, 14 = const 0,
    15 = const 1
  }
  units     = ht_mm
}
)";

}  // namespace sinew::world
