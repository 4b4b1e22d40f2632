#include "sinew/runtime/csv_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace sinew::runtime {

CsvLog::CsvLog(const std::string& path, const std::vector<LogChannel>& channels) : file_(path) {
  line_ = "tick,time";
  for (const LogChannel& channel : channels) {
    for (std::size_t i = 0; i < channel.columns.size(); ++i) {
      // A number that two channels log has one place in the rows, and one column here.
      if (std::find(places_.begin(), places_.end(), channel.places[i]) != places_.end()) continue;
      places_.push_back(channel.places[i]);
      line_ += "," + channel.columns[i];
    }
  }
  checked(file_.write(line_ + "\n"));
}

bool CsvLog::checked(bool good) {
  if (!good) fault_ = file_.fault();
  return good;
}

bool CsvLog::write(std::uint64_t tick, Nanoseconds time, std::span<const double> row) {
  line_.clear();
  fmt::format_to(std::back_inserter(line_), "{},{:.9f}", tick, to_seconds(time));
  for (const std::uint32_t place : places_)
    fmt::format_to(std::back_inserter(line_), ",{}", row[place]);  // the shortest that reads back
  line_ += '\n';
  return checked(file_.write(line_));
}

bool CsvLog::flush() { return checked(file_.flush()); }
bool CsvLog::close() { return checked(file_.close()); }

}  // namespace sinew::runtime
