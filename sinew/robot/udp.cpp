#include "sinew/robot/udp.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <thread>

#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, "", std::move(what), std::move(remedy), {}, {}});
}

// "127.0.0.1:9000". Names are not looked up: a control loop should not depend on a name server.
sockaddr_in parse_address(const std::string& text) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  const std::size_t colon = text.rfind(':');
  std::uint16_t port = 0;
  bool good = colon != std::string::npos &&
              inet_pton(AF_INET, text.substr(0, colon).c_str(), &address.sin_addr) == 1;
  if (good) {
    const char* const end = text.data() + text.size();
    const auto [at, fault] = std::from_chars(text.data() + colon + 1, end, port);
    good = fault == std::errc{} && at == end;
  }
  if (!good) fail("'" + text + "' is no address", "write it as 127.0.0.1:9000");
  address.sin_port = htons(port);
  return address;
}

std::vector<std::string> names(const Joints& joints, std::initializer_list<const char*> kinds) {
  std::vector<std::string> result;
  for (const char* kind : kinds)
    for (std::size_t i = 0; i < joints.size(); ++i)
      result.push_back(std::string(kind) + "." + joints[i].name);
  return result;
}

}  // namespace

Udp::Udp(const model::Tree& tree, const graph::Terms& terms, UdpOptions options)
    : joints_(tree, terms),
      options_(std::move(options)),
      measurement_layout_(layout_of(names(joints_, {"position", "velocity"}))),
      command_layout_(layout_of(names(joints_, {"force"}))),
      newest_(2 * joints_.size()),
      incoming_(2 * joints_.size()),
      command_(joints_.size()) {
  if (incoming_.size() > kMaximumNumbers)
    fail("a robot of " + std::to_string(joints_.size()) + " joints", "a frame holds 128 of them");
  const sockaddr_in local = parse_address(options_.local), remote = parse_address(options_.remote);
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const auto* bound = reinterpret_cast<const sockaddr*>(&local);
  const auto* peer = reinterpret_cast<const sockaddr*>(&remote);
  if (socket_ < 0 || ::bind(socket_, bound, sizeof local) != 0 ||
      ::connect(socket_, peer, sizeof remote) != 0) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) ::close(socket_);
    fail("no connection from " + options_.local + " to " + options_.remote + ": " + why,
         "name addresses of this machine and of the bridge");
  }
}

Udp::~Udp() {
  if (socket_ >= 0) ::close(socket_);
}

runtime::Channel Udp::measurement(const program::Variable& block) const {
  return joints_.measurement(block);
}
runtime::Channel Udp::command(const program::Variable& block) const {
  return joints_.command(block);
}

std::uint16_t Udp::local_port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

void Udp::start() {
  arrived_ = 0;
  const runtime::Nanoseconds until =
      runtime::now() + runtime::from_seconds(options_.start_timeout_s);
  while (!take_frames()) {
    if (options_.gives_up && options_.gives_up())
      fail("the wait for a first measurement at " + options_.local + " was given up", "");
    if (runtime::now() > until)
      fail("no measurement arrived at " + options_.local + " within " +
               std::to_string(options_.start_timeout_s) + " s",
           "start the bridge first");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// True once there has been a measurement.
bool Udp::take_frames() noexcept {
  std::array<std::byte, kMaximumFrame + 1> bytes;  // one more shows what is too long
  for (int i = 0; i < kFramesPerCycle; ++i) {
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size < 0) break;
    const auto frame = decode(std::span(bytes).first(static_cast<std::size_t>(size)), incoming_);
    if (!frame || frame->kind != FrameKind::kMeasurement || frame->count != incoming_.size() ||
        frame->layout != measurement_layout_) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      continue;
    }
    if (arrived_ != 0 && !is_after(frame->sequence, seen_)) continue;
    seen_ = frame->sequence;
    arrived_ = runtime::now();
    std::copy(incoming_.begin(), incoming_.end(), newest_.begin());
  }
  return arrived_ != 0;
}

runtime::Nanoseconds Udp::read(std::span<const runtime::Transfer> measurements) noexcept {
  if (!take_frames()) return 0;
  for (const runtime::Transfer& transfer : measurements)
    transfer.numbers[0] = newest_[transfer.channel];
  return arrived_;
}

void Udp::write(std::span<const runtime::Transfer> commands) noexcept {
  for (const runtime::Transfer& transfer : commands)
    command_[transfer.channel] = transfer.numbers[0];
  std::array<std::byte, kMaximumFrame> bytes;
  const Frame frame{FrameKind::kCommand, command_layout_, ++sent_,
                    static_cast<std::uint64_t>(runtime::now()), command_.size()};
  const std::size_t size = encode(frame, command_, bytes);
  // A full buffer or a bridge that is gone loses the frame, as the wire may; the measurements that
  // then stay away are what is acted upon.
  [[maybe_unused]] const ssize_t sent = ::send(socket_, bytes.data(), size, MSG_NOSIGNAL);
}

}  // namespace sinew::robot
