// What asks a long run to end before it is through: Ctrl-C (SIGINT), SIGTERM, a terminal that is
// closed (SIGHUP), and nobody reading standard output any more (SIGPIPE).
#pragma once

#include <string_view>

namespace sinew::cli {

// While one of these lives, a signal only asks, so that what has begun is brought to its end; the
// second of the same kind ends the process at once. A signal that the process was started to
// ignore (nohup, a job in the background) stays ignored.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  static constexpr int kKinds = 3;
  bool is_ours_[kKinds] = {};
};

// Writing to a pipe that nobody reads fails from now on; it no longer ends the process.
void outlive_broken_pipes();
// Standard output is a pipe whose reader has gone. Commands that never change print nothing that
// would show it.
bool nobody_reads_output();

// The first signal that has asked; 0: none has.
int interruption();
// As if it had come.
void interrupt(int signal);

std::string_view signal_name(int signal);
// As of a process that the signal has ended, by the shell's convention.
inline int interrupted_exit_code(int signal) { return 128 + signal; }

}  // namespace sinew::cli
