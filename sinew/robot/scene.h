// What a simulated robot finds around it: where it starts, a table, an object that it can grasp, an
// operator's hand that follows a script. Read from JSON; every number is stated, in SI units, seen
// from the robot's root frame unless it says otherwise.
//
//   { "start": { "position.joint2": 0.3 },            joints that are not named start at 0
//     "joint-damping": 0.1,                            [N m s/rad], of every joint
//     "tool":   { "frame": "link7-root", "radius": 0.04 },
//     "table":  { "center": [0.5, 0, 0.2], "size": [0.4, 0.6, 0.05] },      full lengths
//     "object": { "frame": "link7-root", "mass": 1.0, "center-of-mass": [0, 0, -0.1],
//                 "inertia": [0.002, 0.002, 0.002] },  about its centre of mass, axes of the frame
//     "hand":   { "frame": "link7-root", "stiffness": 2000, "damping": 100, "maximum-force": 80,
//                 "phases": [ { "name": "free", "until": 2 },
//                             { "name": "pushed down", "until": 5, "velocity": [0, 0, -0.15] },
//                             { "name": "held", "until": 6, "velocity": [0, 0, 0] },
//                             { "name": "pulled", "until": 7, "force": [0, 0, 20] } ] } }
//
// A hand with a velocity holds the frame by a spring and a damper, to a point that starts where the
// frame is when the phase begins and moves with that velocity. Times are of the simulation.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::robot {

using Vector = std::array<double, 3>;

struct Tool {
  std::string frame;  // by IRI or last segment; a sphere about its origin
  double radius = 0;
};

struct Table {
  Vector center = {}, size = {};
};

struct Object {
  std::string frame;
  double mass = 0;
  Vector center_of_mass = {}, inertia = {};
};

struct HandPhase {
  std::string name;
  double until = 0;                // [s]
  std::optional<Vector> velocity;  // guided
  std::optional<Vector> force;     // pushed; neither: free
};

struct Hand {
  std::string frame;
  double stiffness = 0, damping = 0, maximum_force = 0;
  std::vector<HandPhase> phases;
};

struct Scene {
  std::map<std::string, double> start;  // "position.joint2", "velocity.joint1"
  double joint_damping = 0;
  std::optional<Tool> tool;
  std::optional<Table> table;
  std::optional<Object> object;
  std::optional<Hand> hand;
};

inline constexpr std::size_t kMaximumPhases = 1000;

// Throws Error, naming what is missing, unknown or out of range.
Scene parse_scene(std::string_view json, const std::string& file);

}  // namespace sinew::robot
