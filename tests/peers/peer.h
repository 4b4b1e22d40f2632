// Independent libraries that answer the same questions, each built from the same URDF: Orocos KDL,
// MuJoCo and DART. Tests compare with them, benchmarks race them.
//
// All use this project's conventions: joints in the order that the caller names them; a floating
// base comes first, with position x y z qx qy qz qw, velocity angular then linear in the body
// frame, acceleration the time derivative of those six numbers, and force torque then force in the
// body frame. SI units, gravity seen from the world.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::peers {

using Vector = std::vector<double>;

struct Setup {
  std::string urdf;                 // the text
  std::vector<std::string> joints;  // moving joints in the caller's order
  bool floating = false;
  std::array<double, 3> gravity = {0, 0, -9.81};  // [m/s^2]
};

// Numbers of the base first if it floats (7, 6, 6), then one for each joint.
struct State {
  Vector position, velocity, acceleration;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  // Forces for the state's acceleration; 6 numbers of the base first if it floats.
  virtual Vector inverse_dynamics(const State& state) = 0;
  // Accelerations for these forces.
  virtual Vector forward_dynamics(const State& state, const Vector& force) = 0;
  // n x n, row-major, in the order of velocities.
  virtual Vector mass_matrix(const State& state) = 0;
  // 3x4 row-major [R p] of a link in the world (the fixed base's frame).
  virtual Vector link_pose(const State& state, const std::string& link) = 0;

  // Whatever else a library may know, by the name that our queries have for it and in our layout:
  // seen from the world, a link's about its own origin. "joint-wrench" is of a joint (or of the
  // link that floats), seen from the link behind it. Nothing where the library has no such
  // quantity.
  virtual std::optional<Vector> quantity(const State& state, std::string_view name,
                                         const std::string& link = {}) {
    static_cast<void>(state), static_cast<void>(name), static_cast<void>(link);
    return std::nullopt;
  }
  // As above, while a wrench (moment, force) acts on a link, seen from the link and about its
  // origin.
  virtual Vector inverse_dynamics_under(const State& state, const std::string& link,
                                        const Vector& wrench) = 0;

  // For benchmarks. `load` puts states, with forces for forward dynamics, into the library's own
  // form; `call` sets one of them and makes the library's own calls for a solver of ours (rnea,
  // aba, crba, fpk, jacobian: of the last link), leaving the result in the library. False where it
  // has none.
  virtual void load(const std::vector<State>& states, const std::vector<Vector>& forces) {
    static_cast<void>(states), static_cast<void>(forces);
  }
  virtual bool call(std::string_view solver, std::size_t state) {
    static_cast<void>(solver), static_cast<void>(state);
    return false;
  }
};

// Throw std::runtime_error with what the library says.
std::unique_ptr<Peer> make_kdl(const Setup& setup);  // fixed base only
std::unique_ptr<Peer> make_mujoco(const Setup& setup);
std::unique_ptr<Peer> make_dart(const Setup& setup);

}  // namespace sinew::peers
