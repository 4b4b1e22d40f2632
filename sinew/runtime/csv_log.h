// One row a cycle: tick, time [s], then every column of every channel.
#pragma once

#include "sinew/runtime/log_file.h"
#include "sinew/runtime/output_file.h"

namespace sinew::runtime {

class CsvLog final : public LogFile {
 public:
  CsvLog(const std::string& path, const std::vector<LogChannel>& channels);
  bool write(std::uint64_t tick, Nanoseconds time, std::span<const double> row) override;
  bool flush() override;
  bool close() override;

 private:
  bool checked(bool good);
  OutputFile file_;
  std::vector<std::uint32_t> places_;
  std::string line_;
};

}  // namespace sinew::runtime
