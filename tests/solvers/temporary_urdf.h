// A URDF of a test's own making, as a file for as long as it is needed.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "question.h"

namespace sinew::test {

class TemporaryUrdf {
 public:
  explicit TemporaryUrdf(const std::string& urdf, const std::string& name = "robot") {
    static std::atomic<unsigned> count = 0;
    const auto file =
        std::filesystem::temp_directory_path() / ("sinew-" + std::to_string(::getpid()) + "-" +
                                                  std::to_string(++count) + "-" + name + ".urdf");
    std::ofstream(file) << urdf;
    robot_ = {name, file.string(), urdf};
  }
  ~TemporaryUrdf() {
    std::error_code ignored;
    std::filesystem::remove(robot_.file, ignored);
  }
  TemporaryUrdf(const TemporaryUrdf&) = delete;
  TemporaryUrdf& operator=(const TemporaryUrdf&) = delete;

  const Robot& robot() const { return robot_; }

 private:
  Robot robot_;
};

}  // namespace sinew::test
