// Operators of tasks: views of single numbers, constraints, monitors, controllers, guarded motions,
// rates. Their functions are in math/control.h.
#include "sinew/algorithm/operator_rows.h"

namespace sinew::algorithm {
namespace {

constexpr OperatorRow kRows[] = {
    // Views: one number of a pose, twist or wrench, along or about an axis; and back.
    {"position-along", SINEW_OWN "position-along", "axis:direction pose:pose -> signal:signal",
     "axis.seen = pose.wrt", "s = axis . p", "signal = M"},
    {"angular-velocity-about", SINEW_OWN "angular-velocity-about",
     "axis:direction twist:velocity-twist -> signal:signal", "axis.seen = twist.seen",
     "s = axis . w", "signal = RAD-PER-SEC"},
    {"linear-velocity-along", SINEW_OWN "linear-velocity-along",
     "axis:direction twist:velocity-twist -> signal:signal", "axis.seen = twist.seen",
     "s = axis . v", "signal = M-PER-SEC"},
    {"angular-acceleration-about", SINEW_OWN "angular-acceleration-about",
     "axis:direction twist:acceleration-twist -> signal:signal", "axis.seen = twist.seen",
     "s = axis . al", "signal = RAD-PER-SEC2"},
    {"linear-acceleration-along", SINEW_OWN "linear-acceleration-along",
     "axis:direction twist:acceleration-twist -> signal:signal", "axis.seen = twist.seen",
     "s = axis . a", "signal = M-PER-SEC2"},
    {"torque-about", SINEW_OWN "torque-about", "axis:direction wrench:wrench -> signal:signal",
     "axis.seen = wrench.seen", "s = axis . n", "signal = N-M"},
    {"force-along", SINEW_OWN "force-along", "axis:direction wrench:wrench -> signal:signal",
     "axis.seen = wrench.seen", "s = axis . f", "signal = N"},
    {"wrench-of-torque", SINEW_OWN "wrench-of-torque", "line:line signal:signal -> wrench:wrench",
     "wrench.at = line.at; wrench.of = line.of", "n = s line, f = 0", "signal = N-M"},
    {"wrench-of-force", SINEW_OWN "wrench-of-force", "line:line signal:signal -> wrench:wrench",
     "wrench.at = line.at; wrench.of = line.of", "n = 0, f = s line", "signal = N"},

    // A joint's quantities as single numbers; and back.
    {"signal-of-joint-position", SINEW_OWN "signal-of-joint-position",
     "position:joint-position -> signal:signal", "", "s = q", "signal = position"},
    {"signal-of-joint-velocity", SINEW_OWN "signal-of-joint-velocity",
     "velocity:joint-velocity -> signal:signal", "", "s = qd", "signal = velocity"},
    {"signal-of-joint-acceleration", SINEW_OWN "signal-of-joint-acceleration",
     "acceleration:joint-acceleration -> signal:signal", "", "s = qdd", "signal = acceleration"},
    {"joint-force-of-signal", SINEW_OWN "joint-force-of-signal",
     "signal:signal -> force:joint-force", "", "tau = s", "force = signal"},
    {"joint-acceleration-of-signal", SINEW_OWN "joint-acceleration-of-signal",
     "signal:signal -> acceleration:joint-acceleration", "", "qdd = s", "acceleration = signal"},
    // What a unit constraint force, 1 N or 1 N m, does at an acceleration.
    {"acceleration-energy-of-signal", SINEW_OWN "acceleration-energy-of-signal",
     "signal:signal -> energy:acceleration-energy", "", "E = s", "energy = signal"},
    {"acceleration-energy-of-linear-acceleration",
     SINEW_OWN "acceleration-energy-of-linear-acceleration",
     "signal:signal -> energy:acceleration-energy", "", "E = 1 N a",
     "energy = N signal; signal = M-PER-SEC2"},
    {"acceleration-energy-of-angular-acceleration",
     SINEW_OWN "acceleration-energy-of-angular-acceleration",
     "signal:signal -> energy:acceleration-energy", "", "E = 1 N m al",
     "energy RAD = N-M signal; signal = RAD-PER-SEC2"},
    // The transpose of a Jacobian, column by column.
    {"joint-force-from-column", SINEW_OWN "joint-force-from-column",
     "column:jacobian-column wrench:wrench -> force:joint-force", "wrench.at = column.at",
     "tau = column . W"},

    // Controllers.
    {"damping", SINEW_OWN "damping",
     "velocity:signal maximum-velocity:signal maximum-force:signal -> force:signal", "",
     "f = f_max - f_max / v_max v", "maximum-velocity = velocity; force = maximum-force"},
    {"spring-damper", SINEW_OWN "spring-damper",
     "error:signal velocity:signal stiffness:signal damping:signal -> force:signal", "",
     "f = k e - d v", "force = stiffness error; force = damping velocity"},
    {"inertia-force", SINEW_OWN "inertia-force",
     "force:signal inertia:signal acceleration:signal -> total:signal", "", "f' = f + m a",
     "total = force; force = inertia acceleration"},
    {"proportional-integral-derivative", SINEW_OWN "proportional-integral-derivative",
     "error:signal integral:signal rate:signal proportional-gain:signal integral-gain:signal "
     "derivative-gain:signal -> control:signal",
     "", "u = kp e + ki i + kd r",
     "control = proportional-gain error; control = integral-gain integral; "
     "control = derivative-gain rate"},
    {"decaying-integral", SINEW_OWN "decaying-integral",
     "integral:signal error:signal decay-rate:signal time-step:signal -> next:signal", "",
     "i' = (i + e dt) / (1 + lambda dt)",
     "next = integral; integral = error time-step; 1 = decay-rate time-step; time-step = SEC"},
    {"rate", SINEW_OWN "rate",
     "value:signal before:signal has-before:flag time-step:signal -> rate:signal", "",
     "r = (e - e_before) / dt, 0 in the first cycle",
     "before = value; rate time-step = value; time-step = SEC"},
    {"limit", SINEW_OWN "limit", "signal:signal limit:signal -> limited:signal", "",
     "u within -limit .. limit", "limit = signal; limited = signal"},
    {"anti-windup", SINEW_OWN "anti-windup",
     "integral:signal next:signal error:signal integral-gain:signal control:signal limit:signal "
     "-> kept:signal",
     "", "i while |u| > limit and ki e drives u further, otherwise i'",
     "next = integral; kept = integral; integral = error SEC; control = integral-gain integral; "
     "limit = control"},
    {"pose-error", SINEW_OWN "pose-error", "measured:pose desired:pose -> error:pose-error",
     "desired.wrt = measured.wrt; error.of = desired.of; error.wrt = measured.of; "
     "error.at = measured.of",
     "e = log(X_RM^-1 X_RD)"},
    {"impedance", SINEW_OWN "impedance",
     "error:pose-error velocity:velocity-twist stiffness:spatial-stiffness "
     "damping:spatial-damping -> wrench:wrench",
     "velocity.at = error.at; stiffness.seen = error.seen; damping.seen = error.seen; "
     "wrench.at = error.at; wrench.of = velocity.of",
     "W = K e - D V"},

    // Constraints: what is missing until they hold.
    {"error-of-equality", SINEW_OWN "error-of-equality",
     "quantity:signal reference:signal -> error:signal", "", "e = r - q",
     "reference = quantity; error = quantity"},
    {"error-of-lower-bound", SINEW_OWN "error-of-lower-bound",
     "quantity:signal threshold:signal -> error:signal", "", "e = max(0, t - q)",
     "threshold = quantity; error = quantity"},
    {"error-of-upper-bound", SINEW_OWN "error-of-upper-bound",
     "quantity:signal threshold:signal -> error:signal", "", "e = min(0, t - q)",
     "threshold = quantity; error = quantity"},
    {"error-of-interval", SINEW_OWN "error-of-interval",
     "quantity:signal lower-threshold:signal upper-threshold:signal -> error:signal", "",
     "e = max(0, l - q) + min(0, u - q)",
     "lower-threshold = quantity; upper-threshold = quantity; error = quantity"},

    // Monitors.
    {"level", SINEW_OWN "level", "error:signal tolerance:signal -> flag:flag", "",
     "1 where |e| <= tolerance", "tolerance = error"},
    {"level-with-hysteresis", SINEW_OWN "level-with-hysteresis",
     "error:signal tolerance:signal release-tolerance:signal before:flag -> flag:flag", "",
     "1 where |e| <= tolerance, 0 where |e| > release, otherwise as before",
     "tolerance = error; release-tolerance = error"},
    {"rising-edge", SINEW_OWN "rising-edge", "flag:flag before:flag -> event:flag", "",
     "1 where the flag is set and was not"},
    {"falling-edge", SINEW_OWN "falling-edge", "flag:flag before:flag -> event:flag", "",
     "1 where the flag was set and is not"},
    {"any-edge", SINEW_OWN "any-edge", "flag:flag before:flag -> event:flag", "",
     "1 where the flag has changed"},
    {"both", SINEW_OWN "both", "in1:flag in2:flag -> out:flag", "", "a and b"},
    {"either", SINEW_OWN "either", "in1:flag in2:flag -> out:flag", "", "a or b"},

    // Guarded motions.
    {"motion-phase", SINEW_OWN "motion-phase",
     "before:signal when:flag while:flag until:flag -> phase:signal", "",
     "0 waiting, 1 active, 2 done", "before = 1; phase = 1"},
    {"motion-is-active", SINEW_OWN "motion-is-active", "phase:signal -> active:flag", "",
     "1 where the phase is 1", "phase = 1"},

    // Choices, rates, and what is kept from one cycle to the next: `keep` is a state's only writer.
    {"choose-signal", SINEW_OWN "choose-signal",
     "chosen:signal other:signal flag:flag -> out:signal", "", "the chosen where the flag is set",
     "other = chosen; out = chosen"},
    {"choose-flag", SINEW_OWN "choose-flag", "chosen:flag other:flag flag:flag -> out:flag", "",
     "the chosen where the flag is set"},
    {"choose-wrench", SINEW_OWN "choose-wrench",
     "chosen:wrench other:wrench flag:flag -> out:wrench",
     "other.at = chosen.at; other.of = chosen.of; out.at = chosen.at; out.of = chosen.of",
     "the chosen where the flag is set"},
    {"count-up", SINEW_OWN "count-up", "count:signal cycles:signal -> next:signal", "",
     "n' = n + 1, or 0 at the number of cycles", "count = 1; cycles = 1; next = 1"},
    {"count-is-zero", SINEW_OWN "count-is-zero", "count:signal -> flag:flag", "",
     "1 where the count is 0", "count = 1"},
    {"keep-signal", SINEW_OWN "keep-signal", "value:signal -> kept:signal", "", "a copy",
     "kept = value"},
    {"keep-flag", SINEW_OWN "keep-flag", "value:flag -> kept:flag", "", "a copy"},
    {"keep-wrench", SINEW_OWN "keep-wrench", "value:wrench -> kept:wrench",
     "kept.at = value.at; kept.of = value.of", "a copy"},
};

}  // namespace

std::span<const OperatorRow> control_operator_rows() { return kRows; }

}  // namespace sinew::algorithm
