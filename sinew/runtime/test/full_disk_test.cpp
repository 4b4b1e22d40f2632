// A disk that is full ends the recording, not the loop: every cycle runs, every row is counted, and
// the report says why. Each kind of log file, on each kind of full disk that this machine lets a
// test make.
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fixture.h"

namespace sinew::runtime::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::uint64_t kCycles = 1000;

class FullDisk : public RuntimeTest, public testing::WithParamInterface<const char*> {
 protected:
  FullDisk() {
    std::string name = (fs::temp_directory_path() / "sinew-full-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~FullDisk() override {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
    fs::remove_all(folder_);
  }

  std::string log() const { return (folder_ / ("log" + std::string(GetParam()))).string(); }

  // A loop at 2 kHz that logs what it has; `around` is handed the run.
  template <typename Around>
  RecorderReport record(Around&& around) {
    bindings_.recorder = std::make_shared<Recorder>(RecorderOptions{{log()}, 4096});
    const auto m = model();
    weave(*m, "log", "a so:log ; so:quantity ( ?force ?pose ) ; sa:label \"all\"");
    const auto h = host(*m, {.period_s = 5e-4, .cycles = kCycles, .late = LateCycles::kCatchUp});
    around([&] {
      h->start();
      h->wait();
    });
    EXPECT_EQ(h->state(), State::kConfigured) << "no fault";
    EXPECT_EQ(h->statistics().cycles, kCycles);
    EXPECT_EQ(h->statistics().missed, 0u);
    const RecorderReport report = bindings_.recorder->report();
    EXPECT_EQ(report.written + report.dropped + report.lost, kCycles);
    EXPECT_THAT(to_string(report), HasSubstr(fs::path(log()).filename().string()));
    return report;
  }

  fs::path folder_;
  bool mounted_ = false;
};

// A limit on the size of files fails writes in the same way.
TEST_P(FullDisk, AfterFourKibibytes) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  const RecorderReport report = record([&](auto&& run) {
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    run();
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  });
  EXPECT_THAT(report.fault, HasSubstr("File too large"));
}

// /dev/full takes no byte: the first one that is written finds no space.
TEST_P(FullDisk, FromTheFirstByteOn) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  fs::create_symlink("/dev/full", log());
  const RecorderReport report = record([](auto&& run) { run(); });
  EXPECT_THAT(report.fault, HasSubstr("No space left on device"));
}

// A file system of 64 KiB, which the log fills.
TEST_P(FullDisk, OfAFileSystemThatTheLogFills) {
  if (::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "a tmpfs cannot be mounted here: " << std::strerror(errno);
  mounted_ = true;
  const RecorderReport report = record([](auto&& run) { run(); });
  EXPECT_THAT(report.fault, HasSubstr("No space left on device"));
  EXPECT_GT(report.lost, 0u);
  EXPECT_EQ(fs::file_size(log()), 65536u) << "what fits has been written";
  // With space again, the next recording is whole.
  fs::remove(log());
  Recorder next({{log()}, 64});
  next.channel("a", {"x"}, {""});
  next.start();
  next.commit(0, 0);
  next.stop();
  EXPECT_EQ(next.report().written, 1u);
  EXPECT_EQ(next.report().fault, "");
}

INSTANTIATE_TEST_SUITE_P(Of, FullDisk, testing::Values(".csv", ".mcap"),
                         [](const auto& info) { return std::string(info.param + 1); });

}  // namespace
}  // namespace sinew::runtime::test
