// Two links of 1 kg and 1 m on joints about y, a tool at the end, and a lamp beside the arm.
#pragma once

namespace sinew::test {

inline constexpr const char* kArm = R"(<robot name="arm">
  <link name="ground"/>
  <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0.001" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.5 0 0"/><mass value="1"/>
    <inertia ixx="0.001" iyy="0.08" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tool"/>
  <link name="lamp"/>
  <joint name="shoulder" type="continuous"><parent link="ground"/><child link="upper"/>
    <axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="tool"/>
    <origin xyz="1 0 0"/></joint>
  <joint name="post" type="fixed"><parent link="ground"/><child link="lamp"/></joint>
</robot>
)";

}  // namespace sinew::test
