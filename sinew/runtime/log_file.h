// Where a recorder's rows go: CSV for people and spreadsheets, MCAP for the tools of robotics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/runtime/clock.h"

namespace sinew::runtime {

// The columns that one `log` closure fills.
struct LogChannel {
  std::string label;
  std::vector<std::string> columns;   // names of numbers: "force.joint1", "twist.link7[5]"
  std::vector<std::string> units;     // of each column; empty: has none
  std::vector<std::uint32_t> places;  // of each column in the recorder's rows
};

// A file that is being written. Errors are returned, not thrown, so that who writes goes on living
// with a full disk: false means that nothing more can be written, and fault() says why.
class LogFile {
 public:
  virtual ~LogFile() = default;
  // tick: number of the cycle; time: since the first row's cycle began.
  virtual bool write(std::uint64_t tick, Nanoseconds time, std::span<const double> row) = 0;
  virtual bool flush() = 0;
  virtual bool close() = 0;
  const std::string& fault() const { return fault_; }

 protected:
  std::string fault_;
};

// By the file's name: .csv or .mcap; throws Error for another, or when it cannot be opened.
// `start` is the wall clock's time of the first row [ns since 1970], for the formats that keep it.
std::unique_ptr<LogFile> open_log(const std::string& path, std::vector<LogChannel> channels,
                                  std::int64_t start);

}  // namespace sinew::runtime
