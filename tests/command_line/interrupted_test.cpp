// sinew run that is ended from outside: by Ctrl-C, by SIGTERM, by a reader that goes away. What it
// has written is whole, its exit code says what happened, and the robot's last command is the safe
// one.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <regex>
#include <sstream>
#include <thread>

#include "process.h"
#include "sinew/robot/frame.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

std::vector<std::string> run_gravity(const std::vector<std::string>& after) {
  std::vector<std::string> all = {"run"};
  for (const auto& file : gen3_models()) all.push_back(file.string());
  all.insert(all.end(), {"--solver", "gravity"});
  all.insert(all.end(), after.begin(), after.end());
  return all;
}

std::size_t rows_told(const std::string& err) {
  std::smatch rows;
  EXPECT_TRUE(std::regex_search(err, rows, std::regex("log +(\\d+) rows recorded, 0 dropped\n")))
      << err;
  return rows.empty() ? 0 : std::stoul(rows[1]);
}

// Whole lines, each of all columns, as many as told.
void expect_whole_csv(const std::filesystem::path& log, const std::string& err) {
  const std::string text = read_file(log);
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  std::istringstream lines(text);
  std::string header, line;
  std::getline(lines, header);
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) ASSERT_EQ(commas(line), commas(header)) << line;
  EXPECT_EQ(rows, rows_told(err));
  EXPECT_GT(rows, 0u);
}

// From magic to magic nothing but records, the last of them the footer; the statistics count the
// rows (https://mcap.dev/spec).
void expect_whole_mcap(const std::filesystem::path& log, const std::string& err) {
  const std::string text = read_file(log);
  const std::string magic("\x89MCAP0\r\n", 8);
  ASSERT_GT(text.size(), 16u);
  ASSERT_EQ(text.substr(0, 8), magic);
  ASSERT_EQ(text.substr(text.size() - 8), magic) << "cut short";
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, text.data() + at, sizeof value);
    return value;
  };
  std::size_t at = 8, messages = 0;
  std::uint32_t channels = 0;
  int last = 0;
  while (at + 9 <= text.size() - 8) {
    last = static_cast<unsigned char>(text[at]);
    if (last == 0x0B) {
      messages = number(at + 9);
      std::memcpy(&channels, text.data() + at + 9 + 8 + 2, sizeof channels);
    }
    at += 9 + number(at + 1);
  }
  EXPECT_EQ(at, text.size() - 8);
  EXPECT_EQ(last, 0x02) << "the footer";
  EXPECT_EQ(messages, channels * rows_told(err));
  EXPECT_GT(messages, 0u);
}

struct Ending {
  const char* what;
  int signal;
  std::vector<std::string> more;
  int exit_code;
};

TEST(InterruptedRun, ClosesItsLogsAndSaysWhatEndedIt) {
  const Ending endings[] = {
      {"Ctrl-C, which is how it ends", SIGINT, {"--robot", "mujoco", "--start", "position=0.2"}, 0},
      {"SIGTERM, likewise", SIGTERM, {"--robot", "print", "--start", "position=0.2"}, 0},
      {"before it is through", SIGINT, {"--robot", "mujoco", "--for", "600"}, 128 + SIGINT},
      {"by a closed terminal", SIGHUP, {"--robot", "mujoco", "--for", "600"}, 128 + SIGHUP},
      {"in lockstep",
       SIGTERM,
       {"--robot", "mujoco", "--lockstep", "--for", "100000"},
       128 + SIGTERM},
  };
  for (const Ending& ending : endings) {
    SCOPED_TRACE(ending.what);
    const Folder folder;
    const auto csv = folder / "log.csv", mcap = folder / "log.mcap";
    std::vector<std::string> more = ending.more;
    more.insert(more.end(), {"--record", csv.string()});
    // Lockstep writes some hundred thousand rows a second: one file of them.
    const bool both = more[2] != "--lockstep";
    if (both) more.insert(more.end(), {"--record", mcap.string()});
    Process process(run_gravity(more));
    EXPECT_TRUE(process.wait_until([&] {
      return std::filesystem::exists(csv) && std::filesystem::file_size(csv) > 0;
    })) << process.err();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    process.signal(ending.signal);
    const Result result = process.wait();
    EXPECT_EQ(result.exit_code, ending.exit_code) << result.err;
    EXPECT_FALSE(process.was_killed()) << "it ended itself";
    const std::string name = ending.signal == SIGINT    ? "SIGINT"
                             : ending.signal == SIGTERM ? "SIGTERM"
                                                        : "SIGHUP";
    EXPECT_THAT(result.err, HasSubstr("ended by " + name + "\n"));
    expect_whole_csv(csv, result.err);
    if (both) expect_whole_mcap(mcap, result.err);
  }
}

TEST(InterruptedRun, EndsWhenNobodyReadsWhatItPrints) {
  const Folder folder;
  const auto log = folder / "log.csv";
  const auto in_shell = [&](const std::string& output) {
    std::string line = "timeout 60 '" SINEW_EXECUTABLE "'";
    for (const std::string& word :
         run_gravity({"--robot", "print", "--start", "position=0.2", "--record", log.string()}))
      line += " '" + word + "'";
    line = "bash -c \"(" + line + "; echo code \\$? >&2)" + output + "\" 2>'" +
           (folder / "err").string() + "'";
    EXPECT_EQ(std::system(line.c_str()), 0);
    return read_file(folder / "err");
  };
  const std::string pipe = in_shell(" | head -1 | grep -q gravity-force");
  EXPECT_THAT(pipe, HasSubstr("code " + std::to_string(128 + SIGPIPE)));
  EXPECT_THAT(pipe, HasSubstr("ended by standard output, which cannot be written: Broken pipe"));
  expect_whole_csv(log, pipe);
  if (!std::filesystem::exists("/dev/full")) return;
  const std::string full = in_shell(" > /dev/full");
  EXPECT_THAT(full, HasSubstr("code 1\n"));
  EXPECT_THAT(full, HasSubstr("No space left on device"));
  expect_whole_csv(log, full);
}

// The bridge: sends measurements of seven joints, keeps what it is commanded.
class Bridge {
 public:
  Bridge() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in any = address(0);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
    socklen_t size = sizeof any;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&any), &size);
    port_ = ntohs(any.sin_port);
  }
  ~Bridge() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
  }
  std::string remote() const { return "127.0.0.1:" + std::to_string(port_); }
  void speak_to(std::uint16_t port) {
    thread_ = std::thread([this, port] { speak(address(port)); });
  }
  std::size_t commanded() const { return commanded_; }
  // Once nobody sends any more.
  std::vector<std::vector<double>> commands() {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ending_ = true;
    thread_.join();
    return commands_;
  }

 private:
  static sockaddr_in address(std::uint16_t port) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    result.sin_port = htons(port);
    return result;
  }
  void speak(const sockaddr_in& robot) {
    std::vector<std::string> channels;
    for (const char* kind : {"position.joint", "velocity.joint"})
      for (int i = 1; i <= 7; ++i) channels.push_back(kind + std::to_string(i));
    const std::vector<double> numbers(channels.size(), 0.2);
    std::array<std::byte, robot::kMaximumFrame> bytes;
    for (std::uint32_t sequence = 1; !ending_; ++sequence) {
      const std::size_t size = robot::encode(
          {robot::FrameKind::kMeasurement, robot::layout_of(channels), sequence, 0, numbers.size()},
          numbers, bytes);
      ::sendto(socket_, bytes.data(), size, 0, reinterpret_cast<const sockaddr*>(&robot),
               sizeof robot);
      std::vector<double> command(7);
      for (ssize_t got; (got = ::recv(socket_, bytes.data(), bytes.size(), 0)) > 0;) {
        if (!robot::decode(std::span(bytes).first(static_cast<std::size_t>(got)), command))
          continue;
        commands_.push_back(command);
        ++commanded_;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  int socket_;
  std::uint16_t port_ = 0;
  std::thread thread_;
  std::atomic<bool> ending_ = false;
  std::atomic<std::size_t> commanded_ = 0;
  std::vector<std::vector<double>> commands_;
};

std::optional<std::uint16_t> port_told(const std::string& err) {
  std::smatch port;
  if (!std::regex_search(err, port, std::regex("awaited at port (\\d+)\n"))) return std::nullopt;
  return static_cast<std::uint16_t>(std::stoul(port[1]));
}

TEST(InterruptedRun, CommandsWhatIsSafeAndNothingAfterIt) {
  const Folder folder;
  const auto log = folder / "log.mcap";
  Bridge bridge;
  Process process(run_gravity({"--robot", "udp", "--remote", bridge.remote(), "--safe", "-7",
                               "--age-limit", "5", "--record", log.string()}));
  ASSERT_TRUE(process.wait_until([&] { return port_told(process.err()).has_value(); }));
  bridge.speak_to(*port_told(process.err()));
  ASSERT_TRUE(process.wait_until([&] { return bridge.commanded() > 20; })) << process.err();
  process.signal(SIGINT);
  const Result result = process.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  expect_whole_mcap(log, result.err);
  const auto commands = bridge.commands();
  const std::vector<double> safe(7, -7);
  ASSERT_GT(commands.size(), 20u);
  EXPECT_NEAR(commands.front()[1], -6.1049793161502901, 1e-9);
  const auto first_safe = std::find(commands.begin(), commands.end(), safe);
  EXPECT_NE(first_safe, commands.end());
  for (auto each = first_safe; each != commands.end(); ++each) EXPECT_EQ(*each, safe);
}

TEST(InterruptedRun, GivesUpWaitingForARobotThatIsSilent) {
  const Folder folder;
  const Bridge bridge;
  Process process(run_gravity({"--robot", "udp", "--remote", bridge.remote(), "--safe", "0"}));
  ASSERT_TRUE(process.wait_until([&] { return port_told(process.err()).has_value(); }));
  // It begins to wait, and to listen to signals, a little later: until then they just end it.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(4).exit_code, 128 + SIGTERM);
}

TEST(InterruptedRun, LeavesWholeRowsAndNoHalfFile) {
  const Folder folder;
  std::string rows = "position.joint1";
  for (int i = 2; i <= 7; ++i) rows += ",position.joint" + std::to_string(i);
  rows += "\n";
  const std::size_t header = rows.size();
  for (int i = 0; i < 200'000; ++i) rows += "0,0,0,0,0,0,0\n";
  write_file(folder / "rows.csv", rows);
  write_file(folder / "few.csv", rows.substr(0, header + 14));
  const std::vector<std::string> all = {"--interpret", "--input", (folder / "rows.csv").string()};

  Process process(run_gravity(all));
  ASSERT_TRUE(process.wait_until([&] { return process.out().size() > 1000; })) << process.err();
  process.signal(SIGINT);
  const Result result = process.wait();
  EXPECT_EQ(result.exit_code, 128 + SIGINT);
  EXPECT_FALSE(process.was_killed());
  EXPECT_THAT(result.err, testing::ContainsRegex("ended by SIGINT after [0-9]+ of 200000 rows\n"));
  EXPECT_EQ(result.out.back(), '\n');
  EXPECT_EQ(columns_of(result.out).at("gravity-force.joint7").size(),
            std::stoul(result.err.substr(result.err.find("after ") + 6)));

  // The file that is there stays.
  const auto file = folder / "results.csv", part = folder / "results.csv.part";
  write_file(file, "as it was");
  std::vector<std::string> to_file = all;
  to_file.insert(to_file.end(), {"-o", file.string()});
  Process other(run_gravity(to_file));
  ASSERT_TRUE(other.wait_until([&] { return std::filesystem::exists(part); })) << other.err();
  other.signal(SIGTERM);
  const Result ended = other.wait();
  EXPECT_EQ(ended.exit_code, 128 + SIGTERM);
  EXPECT_THAT(ended.err, HasSubstr("; nothing is written to " + file.string()));
  EXPECT_EQ(read_file(file), "as it was");
  EXPECT_FALSE(std::filesystem::exists(part));

  // Who takes the first rows only need not wait for the others.
  const auto begun = std::chrono::steady_clock::now();
  std::string line = "'" SINEW_EXECUTABLE "'";
  for (const std::string& word : run_gravity(all)) line += " '" + word + "'";
  line = "bash -c \"(" + line + "; echo code \\$? >&2) | head -2 >/dev/null\" 2>'" +
         (folder / "err").string() + "'";
  EXPECT_EQ(std::system(line.c_str()), 0);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
  EXPECT_THAT(read_file(folder / "err"), HasSubstr("code " + std::to_string(128 + SIGPIPE)));
  EXPECT_LT(taken.count(), 30);
}

}  // namespace
}  // namespace sinew::test
