// A simulated robot: MuJoCo moves the same joints and masses that the program was made for, in a
// thread of its own that keeps the pace of the wall clock. MuJoCo's headers stay behind this one.
//
// The brakes are on until the first command. Commands are cut at the maximum forces that the model
// states. In lockstep there is no thread: each `end_cycle` moves the simulation on by one period,
// so a run is the same on every machine, however slow.
#pragma once

#include <memory>
#include <string>

#include "sinew/graph/terms.h"
#include "sinew/model/tree.h"
#include "sinew/robot/joints.h"
#include "sinew/robot/scene.h"
#include "sinew/runtime/robot_interface.h"

namespace sinew::robot {

struct MujocoOptions {
  Scene scene;
  double timestep_s = 0.0005;
  double lockstep_period_s = 0;  // > 0: in lockstep, this long a cycle
  bool real_time = true;         // ask for SCHED_FIFO, below the loop's priority
};

class Mujoco final : public runtime::RobotInterface {
 public:
  // Throws Error where the scene does not fit the model or MuJoCo refuses it.
  Mujoco(const model::Tree& tree, const graph::Terms& terms, MujocoOptions options);
  ~Mujoco() override;

  runtime::Channel measurement(const program::Variable& block) const override;
  runtime::Channel command(const program::Variable& block) const override;
  void start() override;
  void stop() override;
  runtime::Nanoseconds read(std::span<const runtime::Transfer> measurements) noexcept override;
  void write(std::span<const runtime::Transfer> commands) noexcept override;
  void end_cycle() noexcept override;

  const Joints& joints() const;

  // What only the simulation knows, for logs and for who plays the rest of the world. Any thread;
  // real-time safe.
  enum class Signal : std::uint8_t {
    kTime,   // of the simulation [s], from the first command on
    kPhase,  // of the hand's script, from 1; 0: before the first or after the last
    kHandX,  // force of the hand on the robot [N]
    kHandY,
    kHandZ,
    kContact,   // normal force between tool and table [N]
    kAttached,  // 1 when the object is
    kCut,       // commands that were cut at a maximum, so far
    kBehind,    // [s] that the simulation was late and left out, so far
  };
  double signal(Signal signal) const noexcept;
  std::string phase_name(int phase) const;  // from 1

  // From the next step on the object is part of the robot, or not. Any thread.
  void attach_object(bool attached = true);
  // Stops stepping and measuring, as a simulator that hangs; or goes on.
  void stall(bool stalled = true);

  struct Simulation;

 private:
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace sinew::robot
