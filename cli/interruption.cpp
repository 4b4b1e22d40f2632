#include "interruption.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <iterator>

namespace sinew::cli {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> first = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal's handler may set it");

void note(int signal) {
  int none = 0;
  first.compare_exchange_strong(none, signal);
}

}  // namespace

Interruptible::Interruptible() {
  static_assert(std::size(kSignals) == kKinds);
  struct sigaction ours {};
  ours.sa_handler = note;
  ours.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&ours.sa_mask);
  for (int i = 0; i < kKinds; ++i) {
    struct sigaction before {};
    sigaction(kSignals[i], nullptr, &before);
    is_ours_[i] = before.sa_handler != SIG_IGN;
    if (is_ours_[i]) sigaction(kSignals[i], &ours, nullptr);
  }
}

Interruptible::~Interruptible() {
  for (int i = 0; i < kKinds; ++i)
    if (is_ours_[i]) ::signal(kSignals[i], SIG_DFL);
}

void outlive_broken_pipes() { ::signal(SIGPIPE, SIG_IGN); }

bool nobody_reads_output() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

int interruption() { return first.load(std::memory_order_relaxed); }
void interrupt(int signal) { note(signal); }

std::string_view signal_name(int signal) {
  switch (signal) {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    case SIGHUP:
      return "SIGHUP";
    case SIGPIPE:
      return "SIGPIPE";
    default:
      return "a signal";
  }
}

}  // namespace sinew::cli
