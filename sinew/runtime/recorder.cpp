#include "sinew/runtime/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "sinew/base/error.h"
#include "sinew/runtime/csv_log.h"
#include "sinew/runtime/mcap_log.h"

namespace sinew::runtime {
namespace {

constexpr std::chrono::milliseconds kWriterPause{5};
constexpr int kPausesPerFlush = 100;

}  // namespace

std::string to_string(const RecorderReport& report) {
  std::string text = fmt::format("{} rows recorded, {} dropped", report.written, report.dropped);
  if (report.lost > 0) text += fmt::format(", {} lost", report.lost);
  if (!report.fault.empty()) text += ": " + report.fault;
  return text;
}

std::unique_ptr<LogFile> open_log(const std::string& path, std::vector<LogChannel> channels,
                                  std::int64_t start) {
  if (path.ends_with(".csv")) return std::make_unique<CsvLog>(path, channels);
  if (path.ends_with(".mcap")) return std::make_unique<McapLog>(path, std::move(channels), start);
  throw Error(
      Problem{{path, 0, 0}, "", "is no log that can be written", "name it .csv or .mcap", {}, {}});
}

Recorder::Recorder(RecorderOptions options) : options_(std::move(options)) {}

Recorder::~Recorder() { stop(); }

std::vector<std::uint32_t> Recorder::channel(const std::string& label,
                                             const std::vector<std::string>& columns,
                                             const std::vector<std::string>& units) {
  auto known = std::find_if(channels_.begin(), channels_.end(),
                            [&](const LogChannel& channel) { return channel.label == label; });
  if (started_ && (known == channels_.end() || known->columns != columns)) {
    throw Error(Problem{{},
                        "",
                        "the log '" + label + "' is not one that is being recorded",
                        "a recording keeps the columns with which it began; stop it first",
                        {},
                        {}});
  }
  if (known != channels_.end()) {
    if (known->columns == columns) return known->places;
    throw Error(Problem{{},
                        "",
                        "two logs have the label '" + label + "' and different columns",
                        "give each log a label of its own",
                        {},
                        {}});
  }
  LogChannel channel{label, columns, units, {}};
  for (const std::string& column : columns) {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    channel.places.push_back(static_cast<std::uint32_t>(found - columns_.begin()));
    if (found == columns_.end()) columns_.push_back(column);
  }
  row_.resize(kStamps + columns_.size(), std::numeric_limits<double>::quiet_NaN());
  channels_.push_back(std::move(channel));
  return channels_.back().places;
}

void Recorder::gauge(const std::string& label, std::function<double()> value) {
  const auto places = channel(label, {label}, {""});
  gauges_.emplace_back(places[0], std::move(value));
}

void Recorder::start() {
  if (started_) return;
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  for (const std::string& path : options_.paths)
    files_.push_back(open_log(path, channels_,
                              std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count()));
  row_.resize(kStamps + columns_.size());
  ring_ = std::make_unique<RowRing>(row_.size(), options_.capacity_rows);
  ending_ = false;
  any_row_ = false;
  started_ = true;
  writer_ = std::thread([this] { write_all(); });
}

void Recorder::commit(std::uint64_t tick, Nanoseconds time) noexcept {
  if (!started_) return;
  if (!any_row_) first_time_ = time;
  any_row_ = true;
  // Both are exact: a tick or nanosecond count stays below 2^53 for a hundred days.
  row_[0] = static_cast<double>(tick);
  row_[1] = static_cast<double>(time - first_time_);
  for (const auto& [place, value] : gauges_) row_[kStamps + place] = value();
  if (!ring_->push(row_.data())) dropped_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::write_pending(std::vector<double>& row) {
  while (ring_->pop(row.data())) {
    bool good = fault_.empty();
    for (const auto& file : files_) {
      if (!good) break;
      good = file->write(static_cast<std::uint64_t>(row[0]), static_cast<Nanoseconds>(row[1]),
                         std::span(row).subspan(kStamps));
      if (!good) fault_ = file->fault();
    }
    (good ? written_ : lost_).fetch_add(1, std::memory_order_relaxed);
  }
}

void Recorder::write_all() {
  std::vector<double> row(ring_->width());
  for (int pauses = 1; !ending_.load(std::memory_order_acquire); ++pauses) {
    write_pending(row);
    if (pauses % kPausesPerFlush == 0)
      for (const auto& file : files_)
        if (fault_.empty() && !file->flush()) fault_ = file->fault();
    std::this_thread::sleep_for(kWriterPause);
  }
  write_pending(row);
  for (const auto& file : files_)
    if (!file->close() && fault_.empty()) fault_ = file->fault();
}

void Recorder::drain() const {
  while (started_ && !ring_->is_empty()) std::this_thread::sleep_for(kWriterPause / 5);
}

void Recorder::stop() {
  if (!started_) return;
  ending_.store(true, std::memory_order_release);
  writer_.join();
  started_ = false;
  files_.clear();
}

RecorderReport Recorder::report() const {
  RecorderReport report{written_.load(std::memory_order_relaxed),
                        dropped_.load(std::memory_order_relaxed),
                        lost_.load(std::memory_order_relaxed),
                        {}};
  if (!started_) report.fault = fault_;
  return report;
}

}  // namespace sinew::runtime
