// Records what `log` closures see, without disturbing the loop: the loop's thread copies a row of
// numbers into a ring, a writer thread takes them out and writes the file.
//
// A full ring drops the row and counts it. A disk that is full ends the recording, not the loop:
// later rows are counted as lost. The report says how many.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "sinew/runtime/log_file.h"
#include "sinew/runtime/ring.h"

namespace sinew::runtime {

struct RecorderOptions {
  std::vector<std::string> paths;     // each .csv or .mcap
  std::size_t capacity_rows = 16384;  // of the ring: 16 s at 1 kHz
};

struct RecorderReport {
  std::uint64_t written = 0;  // rows
  std::uint64_t dropped = 0;  // the ring was full
  std::uint64_t lost = 0;     // a file could not be written
  std::string fault;          // why; empty when all is well
};
std::string to_string(const RecorderReport& report);

class Recorder {
 public:
  explicit Recorder(RecorderOptions options);
  ~Recorder();  // stops
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Design time. The places of a channel's columns in the row. Once the recorder has started, only
  // columns that it has already can be asked for: throws Error for another. Not by two threads at
  // once.
  std::vector<std::uint32_t> channel(const std::string& label,
                                     const std::vector<std::string>& columns,
                                     const std::vector<std::string>& units);
  // A column, in a channel of its own, that is asked for its value at every commit, by the loop's
  // thread: it must be real-time safe.
  void gauge(const std::string& label, std::function<double()> value);

  // Opens the files and starts the writer thread. Throws Error.
  void start();
  // Writes what is in the ring, closes the files. No commit may follow.
  void stop();
  // Waits until the writer has taken everything out of the ring: for loops without a clock.
  void drain() const;
  bool is_started() const { return started_; }

  // The loop's thread: the row that the next commit records; what nobody changes keeps its value.
  double* row() noexcept { return row_.data() + kStamps; }
  void commit(std::uint64_t tick, Nanoseconds time) noexcept;

  RecorderReport report() const;  // any thread; `fault` once it has stopped

 private:
  static constexpr std::size_t kStamps = 2;  // tick and time come before the columns
  void write_all();
  void write_pending(std::vector<double>& row);

  RecorderOptions options_;
  std::vector<LogChannel> channels_;
  std::vector<std::string> columns_;
  std::vector<std::pair<std::uint32_t, std::function<double()>>> gauges_;
  std::vector<double> row_;
  std::vector<std::unique_ptr<LogFile>> files_;
  std::unique_ptr<RowRing> ring_;
  std::thread writer_;
  bool started_ = false;
  Nanoseconds first_time_ = 0;
  bool any_row_ = false;
  std::atomic<bool> ending_ = false;
  std::atomic<std::uint64_t> written_ = 0, dropped_ = 0, lost_ = 0;
  std::string fault_;
};

}  // namespace sinew::runtime
