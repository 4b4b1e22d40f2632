// The sinew executable as a process that runs beside the test: it can be looked at, and signalled.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "command.h"

namespace sinew::test {

class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments);
  ~Process();  // kills it where it still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  std::string out() const;  // so far
  std::string err() const;
  // Looks until `it_is_so`; false: it was not within `seconds`, or the process has ended.
  bool wait_until(const std::function<bool()>& it_is_so, double seconds = 60);
  void signal(int signal) const;
  // Exit code 128 + a signal where that ended it, as the shell has it; 124 after `seconds`.
  Result wait(double seconds = 60);
  bool was_killed() const { return was_killed_; }  // by a signal that it did not handle

 private:
  bool has_ended();
  Folder folder_;
  pid_t process_ = -1;
  int status_ = 0;
  bool ended_ = false, was_killed_ = false;
};

}  // namespace sinew::test
