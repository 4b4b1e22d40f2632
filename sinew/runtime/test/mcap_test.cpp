// What the recorder writes as MCAP is read back by npm's @mcap/core, the format's own library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sinew/runtime/recorder.h"

namespace sinew::runtime {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path modules() { return fs::path(SINEW_BINARY_DIR) / "npm-mcap" / "node_modules"; }

bool install() {
  if (!fs::exists(modules() / "@mcap/core")) {
    fs::create_directories(modules().parent_path());
    const std::string command = "npm install --no-audit --no-fund --silent --prefix '" +
                                modules().parent_path().string() + "' @mcap/core@2 >/dev/null 2>&1";
    if (std::system("command -v node npm >/dev/null 2>&1") != 0 ||
        std::system(command.c_str()) != 0)
      return false;
  }
  return fs::exists(modules() / "@mcap/core");
}

std::vector<Json> read_back(const std::string& file) {
  const std::string command = "node '" SINEW_SOURCE_DIR "/sinew/runtime/test/read_mcap.mjs' '" +
                              modules().string() + "' '" + file + "' 2>&1";
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), count);
  pclose(pipe);
  std::vector<Json> lines;
  std::istringstream text(output);
  for (std::string line; std::getline(text, line);) {
    lines.push_back(Json::parse(line, nullptr, false));
    EXPECT_FALSE(lines.back().is_discarded()) << output;
  }
  return lines;
}

TEST(Mcap, IsReadBackByTheFormatsOwnLibrary) {
  if (!install()) GTEST_SKIP() << "npm's @mcap/core cannot be installed here";
  const std::string file = testing::TempDir() + "sinew-mcap-test.mcap";
  constexpr std::uint64_t kRows = 5000;  // several chunks
  Recorder recorder({{file}, 2 * kRows});
  const auto damping = recorder.channel("damping", {"force.z", "velocity.z"}, {"N", "M-PER-SEC"});
  recorder.gauge("phase", [] { return 3.0; });
  recorder.start();
  for (std::uint64_t tick = 0; tick < kRows; ++tick) {
    recorder.row()[damping[0]] = 0.1 + static_cast<double>(tick);
    recorder.row()[damping[1]] = tick == kRows - 1 ? 1.0 / 0.0 : 1.0 / 3.0;
    recorder.commit(tick, static_cast<Nanoseconds>(tick) * 1'000'000);
  }
  recorder.stop();
  ASSERT_EQ(recorder.report().fault, "");

  const std::vector<Json> lines = read_back(file);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0]["statistics"]["messageCount"], std::to_string(2 * kRows));
  EXPECT_EQ(lines[0]["statistics"]["channelCount"], 2);
  EXPECT_GT(lines[0]["chunks"], 1);
  EXPECT_EQ(lines[0]["library"], "sinew");
  EXPECT_EQ(lines[1]["topic"], "damping");
  EXPECT_EQ(lines[1]["schema"]["properties"]["force.z"]["description"], "N");
  EXPECT_EQ(lines[2]["topic"], "phase");
  EXPECT_EQ(lines[3]["indexed"], 2 * kRows);
  EXPECT_EQ(lines[4]["streamed"], 2 * kRows);
  EXPECT_EQ(lines[4]["done"], true);
  const Json& last = lines[3]["last"]["message"];
  EXPECT_EQ(last["tick"], kRows - 1);
  if (lines[3]["last"]["topic"] == "damping") {
    EXPECT_EQ(last["force.z"], 0.1 + static_cast<double>(kRows - 1));
    EXPECT_TRUE(last["velocity.z"].is_null()) << "JSON has no word for infinity";
  } else {
    EXPECT_EQ(last["phase"], 3.0);
  }
  fs::remove(file);
}

}  // namespace
}  // namespace sinew::runtime
