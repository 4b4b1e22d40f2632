#include "sinew/runtime/recorder.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fixture.h"

namespace sinew::runtime::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "sinew-recorder-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(Recorder, WritesEveryRowInOrder) {
  const Folder folder;
  Recorder recorder({{folder / "log.csv"}, 1024});
  const auto places = recorder.channel("damping", {"force.z", "velocity.z"}, {"N", "M-PER-SEC"});
  recorder.start();
  for (std::uint64_t tick = 0; tick < 3; ++tick) {
    recorder.row()[places[0]] = 0.1 * static_cast<double>(tick);
    recorder.row()[places[1]] = -1;
    recorder.commit(tick, static_cast<Nanoseconds>(5'000'000 + tick * 1'000'000));
  }
  recorder.stop();
  EXPECT_EQ(text_of(folder / "log.csv"),
            "tick,time,force.z,velocity.z\n0,0.000000000,0,-1\n1,0.001000000,0.1,-1\n"
            "2,0.002000000,0.2,-1\n");
  EXPECT_EQ(recorder.report().written, 3u);
  EXPECT_EQ(recorder.report().dropped, 0u);
}

TEST(Recorder, GivesANumberThatTwoLogsShareOneColumn) {
  const Folder folder;
  Recorder recorder({{folder / "log.csv"}, 16});
  const auto first = recorder.channel("a", {"x", "y"}, {"", ""});
  const auto second = recorder.channel("b", {"y", "z"}, {"", ""});
  EXPECT_EQ(first[1], second[0]);
  recorder.start();
  recorder.commit(0, 0);
  recorder.stop();
  EXPECT_THAT(text_of(folder / "log.csv"), HasSubstr("tick,time,x,y,z\n"));
}

TEST(Recorder, CountsWhatDoesNotFitInItsRing) {
  const Folder folder;
  Recorder recorder({{folder / "log.csv"}, 8});
  recorder.channel("a", {"x"}, {""});
  recorder.start();
  constexpr std::uint64_t kRows = 100000;
  for (std::uint64_t tick = 0; tick < kRows; ++tick) recorder.commit(tick, 0);
  recorder.stop();
  const RecorderReport report = recorder.report();
  EXPECT_GT(report.dropped, 0u);
  EXPECT_EQ(report.written + report.dropped, kRows);
}

TEST(Recorder, RefusesColumnsThatTheRecordingDoesNotHave) {
  const Folder folder;
  Recorder recorder({{folder / "log.csv"}, 8});
  recorder.channel("a", {"x"}, {""});
  EXPECT_THROW(recorder.channel("a", {"y"}, {""}), Error);
  recorder.start();
  EXPECT_NO_THROW(recorder.channel("a", {"x"}, {""}));
  EXPECT_THROW(recorder.channel("b", {"x"}, {""}), Error);
}

TEST(Recorder, RefusesAFileThatItCannotWrite) {
  Recorder unknown({{"log.txt"}, 8});
  EXPECT_THROW(unknown.start(), Error);
  Recorder nowhere({{"/no/such/folder/log.csv"}, 8});
  EXPECT_THROW(nowhere.start(), Error);
}

class RecorderWithHost : public RuntimeTest {};

TEST_F(RecorderWithHost, RecordsWhatALogSees) {
  const Folder folder;
  bindings_.recorder = std::make_shared<Recorder>(RecorderOptions{{folder / "log.csv"}, 4096});
  const auto m = model();
  weave(*m, "log", "a so:log ; so:quantity ( ?force ?kept ) ; sa:label \"damping\"");
  weave(*m, "probe", "a so:probe-time ; sa:label \"time.before-write\"");
  const auto h = host(*m);
  bindings_.recorder->start();
  h->step(2);
  bindings_.recorder->stop();
  std::istringstream lines(text_of(folder / "log.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "tick,time,force.joint1,kept.joint1,time.before-write");
  std::getline(lines, line);
  EXPECT_THAT(line, testing::MatchesRegex("0,0.000000000,1,-2,.*"));
  std::getline(lines, line);
  EXPECT_THAT(line, testing::MatchesRegex("1,0\\.[0-9]+,5,2,.*"));
}

}  // namespace
}  // namespace sinew::runtime::test
