# Checks the log of the seven phases: columns phase, signal.upward-velocity, signal.upward-force, position.joint2.
function fail(text) { print "FAILED: " text; failed = 1 }
function magnitude(x) { return x < 0 ? -x : x }
BEGIN { FS = ","; f_max = 10; v_max = 0.1 }
NR == 1 {
  for (i = 1; i <= NF; ++i) at[$i] = i
  split("phase signal.upward-velocity signal.upward-force position.joint2", needed, " ")
  for (i in needed) if (!(needed[i] in at)) { fail("the log has no column " needed[i]); exit }
  next
}
{
  phase = $at["phase"]; v = $at["signal.upward-velocity"]; f = $at["signal.upward-force"]; q = $at["position.joint2"]
  ++samples
  # Within 1 % of the formula; beside its zero, of 1 % of f_max / 100.
  formula = f_max - f_max / v_max * v
  error = magnitude(f - formula); bound = 0.01 * magnitude(formula) + 0.001
  if (error > worst) worst = error
  if (error > bound) ++off
  if (magnitude(v) < 1e-3) { ++at_rest; if (magnitude(f - f_max) > 0.11) ++wrong_at_rest }
  if (magnitude(v - v_max) < 5e-4) { ++at_maximum; if (magnitude(f) > 0.06) ++wrong_at_maximum }
  if (v > v_max * 1.001) { ++beyond; if (f >= 0) ++wrong_beyond }
  if (v < v_max * 0.999 && f <= 0) ++wrong_below
  if (phase > 0) {
    ++count[phase]; sum_v[phase] += v; sum_f[phase] += f; last_v[phase] = v; last_q[phase] = q
    if (!(phase in low) || v < low[phase]) low[phase] = v
    if (!(phase in high) || v > high[phase]) high[phase] = v
  }
}
END {
  if (failed) exit 1
  printf "%d samples, largest deviation from the formula %.2g N\n", samples, worst
  printf "phase   mean velocity   mean force   joint 2 at its end\n"
  for (p = 1; p <= 7; ++p) {
    if (!count[p]) { fail("phase " p " is missing"); exit 1 }
    printf "%5d %9.4f m/s %10.3f N %12.3f rad\n", p, sum_v[p] / count[p], sum_f[p] / count[p], last_q[p]
  }
  if (off) fail(off " samples are off the formula by more than 1 %")
  if (!at_rest || wrong_at_rest) fail("at rest the force is not f_max (" at_rest + 0 " samples, " wrong_at_rest + 0 " wrong)")
  if (!at_maximum || wrong_at_maximum) fail("at v_max the force is not 0 (" at_maximum + 0 " samples, " wrong_at_maximum + 0 " wrong)")
  if (!beyond || wrong_beyond || wrong_below) fail("the sign does not flip at v_max")
  # 1 stretched out at rest; 2 pushed down, more than f_max; 3 and 5 held with f_max; 4 up by itself, slower than v_max;
  # 6 pushed up beyond v_max, braking; 7 as 1.
  if (magnitude(last_v[1]) > 5e-3) fail("phase 1 does not come to rest")
  if (low[2] > -v_max || sum_f[2] / count[2] < f_max) fail("phase 2 is not pushed down")
  if (last_q[2] < 0.6) fail("phase 2 does not displace joint 2")
  for (p = 3; p <= 5; p += 2) if (magnitude(last_v[p]) > 2e-3) fail("phase " p " is not held")
  if (sum_v[4] / count[4] < 0.02 || high[4] > v_max * 1.01) fail("phase 4 does not move up below v_max")
  if (high[6] <= v_max) fail("phase 6 is not pushed beyond v_max")
  if (magnitude(last_v[7]) > 5e-3 || magnitude(last_q[7] - last_q[1]) > 0.1) fail("phase 7 is not stretched out")
  exit failed
}
