#include "process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace sinew::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLook{5};

}  // namespace

Process::Process(const std::vector<std::string>& arguments) {
  const std::string out = (folder_ / "out").string(), err = (folder_ / "err").string();
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), SINEW_EXECUTABLE);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ > 0) return;
  // Tests that run in the background have been told to ignore Ctrl-C.
  for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(each, SIG_DFL);
  const auto becomes = [](const std::string& path, int flags, int number) {
    dup2(open(path.c_str(), flags | O_CLOEXEC, 0600), number);
  };
  becomes("/dev/null", O_RDONLY, 0);
  becomes(out, O_WRONLY | O_CREAT, 1);
  becomes(err, O_WRONLY | O_CREAT, 2);
  execv(argv[0], argv.data());
  _exit(127);
}

Process::~Process() {
  if (has_ended()) return;
  signal(SIGKILL);
  waitpid(process_, &status_, 0);
}

std::string Process::out() const { return read_file(folder_ / "out"); }
std::string Process::err() const { return read_file(folder_ / "err"); }

bool Process::has_ended() {
  if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) == process_;
  return ended_;
}

bool Process::wait_until(const std::function<bool()>& it_is_so, double seconds) {
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  while (!it_is_so()) {
    if (has_ended() || Clock::now() > until) return it_is_so();
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

void Process::signal(int signal) const { kill(process_, signal); }

Result Process::wait(double seconds) {
  Result result;
  result.exit_code = 124;
  if (wait_until([&] { return has_ended(); }, seconds)) {
    was_killed_ = WIFSIGNALED(status_);
    result.exit_code = was_killed_ ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
  }
  result.out = out();
  result.err = err();
  return result;
}

}  // namespace sinew::test
