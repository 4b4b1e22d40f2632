#include "sinew/robot/mujoco.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

#include "sinew/base/error.h"
#include "sinew/robot/mjcf.h"
#include "sinew/runtime/published.h"
#include "sinew/runtime/real_time.h"

namespace sinew::robot {
namespace {

using runtime::Nanoseconds;

// A simulation that fell further behind the clock than this leaves time out instead of rushing.
constexpr double kMaximumBehind_s = 0.05;
constexpr std::size_t kSignals = 9;
constexpr int kPriority = runtime::kDefaultPriority - 10;

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, "", std::move(what), std::move(remedy), {}, {}});
}

struct Freed {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
template <typename T>
using Owned = std::unique_ptr<T, Freed>;

Owned<mjModel> compile(const std::string& xml) {
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "robot.xml", static_cast<int>(xml.size()));
  std::memcpy(files.filedata[0], xml.data(), xml.size());
  char fault[1000] = "";
  Owned<mjModel> model(mj_loadXML("robot.xml", &files, fault, sizeof fault));
  mj_deleteVFS(&files);
  if (model == nullptr)
    fail(std::string("MuJoCo refuses the robot: ") + fault, "correct the model or the scene");
  return model;
}

}  // namespace

struct Mujoco::Simulation {
  Simulation(const model::Tree& tree, const graph::Terms& terms, MujocoOptions from)
      : options(std::move(from)),
        joints(tree, terms),
        model(compile(mjcf(tree, terms, options.scene, options.timestep_s))),
        data(mj_makeData(model.get())),
        measured(1 + 2 * joints.size()),
        commanded(joints.size()),
        measurement(1 + 2 * joints.size()),
        seen(1 + 2 * joints.size()),
        force(joints.size()),
        fresh(joints.size()),
        command(joints.size()) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joints[i].iri.c_str());
      position.push_back(model->jnt_qposadr[id]);
      velocity.push_back(model->jnt_dofadr[id]);
    }
    tool = mj_name2id(model.get(), mjOBJ_GEOM, "tool");
    object = mj_name2id(model.get(), mjOBJ_BODY, "object");
    hand = mj_name2id(model.get(), mjOBJ_SITE, "hand");
    place();
  }

  // Puts the robot where the scene says, at rest unless it says otherwise.
  void place() {
    mj_resetData(model.get(), data.get());
    for (const auto& [name, number] : options.scene.start) {
      const std::size_t dot = name.find('.');
      const std::string kind = name.substr(0, dot);
      if (dot == std::string::npos || (kind != "position" && kind != "velocity"))
        fail("the start '" + name + "' is no joint's", "name position.JOINT or velocity.JOINT");
      const std::size_t joint = joints.find(name.substr(dot + 1));
      (kind == "position" ? data->qpos[position[joint]] : data->qvel[velocity[joint]]) = number;
    }
    mj_forward(model.get(), data.get());
    braked = true;
    phase = 0;
  }

  void publish() {
    measurement[0] = static_cast<double>(runtime::now() - epoch) + 1;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      measurement[1 + i] = data->qpos[position[i]];
      measurement[1 + joints.size() + i] = data->qvel[velocity[i]];
    }
    measured.publish(measurement);
  }

  void set(Signal signal, double value) {
    signals[static_cast<std::size_t>(signal)].store(value, std::memory_order_relaxed);
  }

  // The commands that came last, cut at the robot's limits. False: none yet.
  bool take_commands() {
    if (commanded.read(fresh))
      force = fresh;
    else if (braked)
      return false;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double most = joints[i].maximum_force;
      const double cut = std::clamp(force[i], -most, most);
      if (cut != force[i]) set(Signal::kCut, ++cuts);
      // What is not a number must not reach the integrator.
      data->qfrc_applied[velocity[i]] = std::isnan(cut) ? 0 : cut;
    }
    return true;
  }

  void take_object() {
    const bool wanted = attach.load(std::memory_order_acquire);
    if (object < 0 || wanted == attached) return;
    attached = wanted;
    const Object& about = *options.scene.object;
    const double before = model->body_mass[object];
    model->body_mass[object] = wanted ? about.mass : kNoMass;
    for (int i = 0; i < 3; ++i)
      model->body_inertia[3 * object + i] =
          wanted ? about.inertia[static_cast<std::size_t>(i)] : kNoMass;
    // The sums over subtrees that MuJoCo keeps in its model.
    const double more = model->body_mass[object] - before;
    for (int body = object; body != 0; body = model->body_parentid[body])
      model->body_subtreemass[body] += more;
    model->body_subtreemass[0] += more;
    set(Signal::kAttached, wanted ? 1 : 0);
  }

  // Adds the hand's force to what is applied to the joints.
  void use_hand() {
    if (hand < 0) return;
    const Hand& script = *options.scene.hand;
    std::size_t now = 0;  // from 1
    for (std::size_t i = 0; i < script.phases.size() && now == 0; ++i)
      if (data->time < script.phases[i].until) now = i + 1;
    const mjtNum* at = data->site_xpos + std::ptrdiff_t{3} * hand;
    if (now != phase) {
      phase = now;
      phase_began = data->time;
      std::copy_n(at, 3, held_from.begin());
      set(Signal::kPhase, static_cast<double>(now));
    }
    std::array<mjtNum, 3> push = {0, 0, 0};
    if (now != 0) {
      const HandPhase& what = script.phases[now - 1];
      if (what.force) push = *what.force;
      if (what.velocity) push = guide(script, *what.velocity, at);
    }
    for (std::size_t i = 0; i < 3; ++i)
      set(static_cast<Signal>(static_cast<std::size_t>(Signal::kHandX) + i), push[i]);
    const mjtNum none[3] = {0, 0, 0};
    mj_applyFT(model.get(), data.get(), push.data(), none, at, model->site_bodyid[hand],
               data->qfrc_applied);
  }

  std::array<mjtNum, 3> guide(const Hand& script, const Vector& velocity, const mjtNum* at) {
    mjtNum speed[6];
    // Angular, linear; world axes.
    mj_objectVelocity(model.get(), data.get(), mjOBJ_SITE, hand, speed, 0);
    std::array<mjtNum, 3> push;
    mjtNum length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const mjtNum wanted = held_from[i] + velocity[i] * (data->time - phase_began);
      push[i] = script.stiffness * (wanted - at[i]) + script.damping * (velocity[i] - speed[3 + i]);
      length += push[i] * push[i];
    }
    length = std::sqrt(length);
    if (length > script.maximum_force)
      for (mjtNum& each : push) each *= script.maximum_force / length;
    return push;
  }

  void measure_contact() {
    if (tool < 0) return;
    mjtNum normal = 0;
    for (int i = 0; i < data->ncon; ++i) {
      if (data->contact[i].geom1 != tool && data->contact[i].geom2 != tool) continue;
      mjtNum wrench[6];
      mj_contactForce(model.get(), data.get(), i, wrench);
      normal += wrench[0];
    }
    set(Signal::kContact, normal);
  }

  void step() {
    take_object();
    if (take_commands()) {
      braked = false;
      use_hand();
      mj_step(model.get(), data.get());
      measure_contact();
      set(Signal::kTime, data->time);
    }
  }

  void run() {
    if (options.real_time) runtime::become_real_time(kPriority);
    const Nanoseconds step_time = runtime::from_seconds(options.timestep_s);
    Nanoseconds next = runtime::now();
    while (!ending.load(std::memory_order_acquire)) {
      next += step_time;
      runtime::sleep_until(next);
      if (stalled.load(std::memory_order_acquire)) continue;
      const Nanoseconds late = runtime::now() - next;
      if (late > runtime::from_seconds(kMaximumBehind_s)) {
        behind += runtime::to_seconds(late);
        set(Signal::kBehind, behind);
        next += late;
      }
      step();
      publish();
    }
  }

  MujocoOptions options;
  Joints joints;
  Owned<mjModel> model;
  Owned<mjData> data;
  std::vector<int> position, velocity;  // addresses of the joints
  int tool = -1, object = -1, hand = -1;

  // The simulation's: its thread, or the loop's in lockstep.
  bool braked = true, attached = false;
  std::size_t phase = 0;
  double phase_began = 0, cuts = 0, behind = 0;
  std::array<mjtNum, 3> held_from = {};

  runtime::Published measured;   // when [ns from epoch, plus 1], positions, velocities
  runtime::Published commanded;  // forces
  std::vector<double> measurement, seen, force, fresh, command;
  Nanoseconds epoch = runtime::now();
  std::array<std::atomic<double>, kSignals> signals = {};
  std::atomic<bool> attach = false, stalled = false, ending = false;
  std::thread thread;
};

Mujoco::Mujoco(const model::Tree& tree, const graph::Terms& terms, MujocoOptions options)
    : simulation_(std::make_unique<Simulation>(tree, terms, std::move(options))) {
  simulation_->publish();
}

Mujoco::~Mujoco() { stop(); }

runtime::Channel Mujoco::measurement(const program::Variable& block) const {
  return simulation_->joints.measurement(block);
}
runtime::Channel Mujoco::command(const program::Variable& block) const {
  return simulation_->joints.command(block);
}
const Joints& Mujoco::joints() const { return simulation_->joints; }

void Mujoco::start() {
  Simulation& s = *simulation_;
  if (s.thread.joinable() || s.options.lockstep_period_s > 0) {
    s.publish();
    return;
  }
  s.ending = false;
  s.publish();
  s.thread = std::thread([&s] { s.run(); });
}

void Mujoco::stop() {
  Simulation& s = *simulation_;
  if (!s.thread.joinable()) return;
  s.ending = true;
  s.thread.join();
}

runtime::Nanoseconds Mujoco::read(std::span<const runtime::Transfer> measurements) noexcept {
  Simulation& s = *simulation_;
  const bool lockstep = s.options.lockstep_period_s > 0;
  if (!s.measured.read(s.seen)) return 0;
  for (const runtime::Transfer& transfer : measurements)
    transfer.numbers[0] = s.seen[1 + transfer.channel];
  if (lockstep && !s.stalled.load(std::memory_order_acquire)) return runtime::now();
  return s.epoch + static_cast<Nanoseconds>(s.seen[0]) - 1;
}

void Mujoco::write(std::span<const runtime::Transfer> commands) noexcept {
  Simulation& s = *simulation_;
  for (const runtime::Transfer& transfer : commands)
    s.command[transfer.channel] = transfer.numbers[0];
  s.commanded.publish(s.command);
}

void Mujoco::end_cycle() noexcept {
  Simulation& s = *simulation_;
  if (s.options.lockstep_period_s <= 0 || s.stalled.load(std::memory_order_acquire)) return;
  const auto steps = std::lround(s.options.lockstep_period_s / s.options.timestep_s);
  for (long i = 0; i < steps; ++i) s.step();
  s.publish();
}

double Mujoco::signal(Signal signal) const noexcept {
  return simulation_->signals[static_cast<std::size_t>(signal)].load(std::memory_order_relaxed);
}

std::string Mujoco::phase_name(int phase) const {
  const auto& hand = simulation_->options.scene.hand;
  if (!hand || phase < 1 || phase > static_cast<int>(hand->phases.size())) return "";
  return hand->phases[static_cast<std::size_t>(phase) - 1].name;
}

void Mujoco::attach_object(bool attached) {
  if (simulation_->object < 0) fail("the scene has no object", "state one");
  simulation_->attach.store(attached, std::memory_order_release);
}

void Mujoco::stall(bool stalled) { simulation_->stalled.store(stalled, std::memory_order_release); }

}  // namespace sinew::robot
