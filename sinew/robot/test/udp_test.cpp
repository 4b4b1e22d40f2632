#include "sinew/robot/udp.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <thread>

#include "gen3.h"

namespace sinew::robot::test {
namespace {

// The other end of the wire: a socket on the loopback device.
class Bridge {
 public:
  Bridge() {
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = loopback(0);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("bind");
    const timeval patience{2, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~Bridge() { ::close(socket_); }

  std::string address() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  }

  void send(std::uint16_t port, std::span<const std::byte> bytes) {
    const sockaddr_in address = loopback(port);
    ::sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address),
             sizeof address);
  }
  void send(const Udp& robot, std::uint32_t sequence, std::span<const double> numbers) {
    std::array<std::byte, kMaximumFrame> bytes;
    const Frame frame{FrameKind::kMeasurement, robot.measurement_layout(), sequence, 0,
                      numbers.size()};
    const std::size_t size = encode(frame, numbers, bytes);
    send(robot.local_port(), std::span(bytes).first(size));
  }
  std::optional<Frame> receive(std::span<double> numbers) {
    std::array<std::byte, kMaximumFrame> bytes;
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size < 0) return std::nullopt;
    return decode(std::span(bytes).first(static_cast<std::size_t>(size)), numbers);
  }

 private:
  static sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  int socket_;
};

class UdpTest : public testing::Test {
 protected:
  std::shared_ptr<Udp> robot(double start_timeout_s = 2) {
    return std::make_shared<Udp>(gen3_.tree, gen3_.store.terms(),
                                 UdpOptions{"127.0.0.1:0", bridge_.address(), start_timeout_s});
  }
  Gen3 gen3_;
  Bridge bridge_;
  std::vector<double> measured_ = std::vector<double>(14, 0.0);
};

TEST_F(UdpTest, BringsMeasurementsInAndCommandsOut) {
  const auto udp = robot();
  const auto host = gen3_.host("gravity", "udp", udp);
  host->configure();
  for (int i = 0; i < 7; ++i) measured_[i] = 0.2;
  bridge_.send(*udp, 1, measured_);
  udp->start();
  host->step();
  std::vector<double> command(7);
  const auto frame = bridge_.receive(command);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->kind, FrameKind::kCommand);
  EXPECT_EQ(frame->layout, udp->command_layout());
  ASSERT_EQ(frame->count, 7u);
  EXPECT_NEAR(command[1], -6.1049793161502901, 1e-12);
  EXPECT_EQ(frame->sequence, 1u);
}

TEST_F(UdpTest, TakesTheNewestAndIgnoresWhatIsOldBrokenOrNotForIt) {
  const auto udp = robot();
  measured_[0] = 1;
  bridge_.send(*udp, 0xffffffffU, measured_);
  udp->start();
  measured_[0] = 2;
  bridge_.send(*udp, 0, measured_);  // the counter wrapped around
  measured_[0] = 3;
  bridge_.send(*udp, 0xfffffff0U, measured_);  // late
  bridge_.send(udp->local_port(), std::as_bytes(std::span("no frame at all")));
  std::array<std::byte, kMaximumFrame> bytes;
  const std::size_t size = encode({FrameKind::kMeasurement, 77, 5, 0, 14}, measured_, bytes);
  bridge_.send(udp->local_port(), std::span(bytes).first(size));  // another robot's
  double first = 0;
  const runtime::Transfer transfer{0, &first, 1};
  udp->read({&transfer, 1});
  EXPECT_EQ(first, 2);
  EXPECT_EQ(udp->refused(), 2u);
}

TEST_F(UdpTest, ABridgeThatFallsSilentTripsTheWatchdog) {
  const auto udp = robot();
  const auto host = gen3_.host("gravity", "udp", udp, {.age_limit_s = 0.05});
  host->configure();
  bridge_.send(*udp, 1, measured_);
  udp->start();
  host->step();
  EXPECT_EQ(host->state(), runtime::State::kConfigured);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  bridge_.send(*udp, 1, measured_);  // the same frame again is no new measurement
  host->step();
  EXPECT_EQ(host->state(), runtime::State::kFaulted);
  std::vector<double> command(7, 1.0);
  bridge_.receive(command);
  bridge_.receive(command);
  EXPECT_EQ(command, std::vector<double>(7, 0.0)) << "the safe command";
}

TEST_F(UdpTest, DoesNotStartWithoutAMeasurement) {
  const auto udp = robot(0.02);
  EXPECT_THROW(udp->start(), Error);
}

TEST_F(UdpTest, RefusesWhatIsNoAddress) {
  for (const char* remote : {"", "127.0.0.1", "localhost:90", "127.0.0.1:99999", "127.0.0.1:9x"})
    EXPECT_THROW(Udp(gen3_.tree, gen3_.store.terms(), {"127.0.0.1:0", remote, 1}), Error) << remote;
}

TEST(Frame, SurvivesTheWay) {
  const double numbers[] = {1.5, -2.25, 1e-300, NAN};
  std::array<std::byte, kMaximumFrame> bytes;
  const std::size_t size = encode({FrameKind::kCommand, 7, 9, 11, 4}, numbers, bytes);
  ASSERT_EQ(size, kFrameOverhead + 32);
  std::array<double, 4> back;
  const auto frame = decode(std::span(bytes).first(size), back);
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->sequence, 9u);
  EXPECT_EQ(back[2], 1e-300);
  EXPECT_TRUE(std::isnan(back[3]));
}

TEST(Frame, IsRefusedWithAnyBitTurned) {
  const double numbers[] = {1.5, -2.25};
  std::array<std::byte, kMaximumFrame> bytes;
  const std::size_t size = encode({FrameKind::kCommand, 7, 9, 11, 2}, numbers, bytes);
  std::array<double, 2> back;
  for (std::size_t bit = 0; bit < 8 * size; ++bit) {
    auto broken = bytes;
    broken[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_FALSE(decode(std::span(broken).first(size), back).has_value()) << "bit " << bit;
  }
  for (std::size_t shorter = 0; shorter < size; ++shorter)
    EXPECT_FALSE(decode(std::span(bytes).first(shorter), back).has_value());
  EXPECT_FALSE(decode(std::span(bytes).first(size), std::span(back).first(1)).has_value())
      << "more numbers than there is room for";
}

}  // namespace
}  // namespace sinew::robot::test
