// MCAP, the container of robotics logs (specification: mcap.dev/spec, version 0): uncompressed
// chunks with an index, one channel for each `log` closure, JSON messages with a JSON schema.
#pragma once

#include <map>

#include "sinew/runtime/log_file.h"
#include "sinew/runtime/output_file.h"

namespace sinew::runtime {

class McapLog final : public LogFile {
 public:
  McapLog(const std::string& path, std::vector<LogChannel> channels, std::int64_t start);
  bool write(std::uint64_t tick, Nanoseconds time, std::span<const double> row) override;
  bool flush() override;
  bool close() override;

 private:
  struct Entry {
    std::uint64_t time, offset;  // of a message, in its chunk
  };
  struct ChunkIndex {
    std::uint64_t first_time, last_time, start, length, messages_length, size;
    std::map<std::uint16_t, std::uint64_t> indexes;  // where each channel's message index starts
  };

  bool checked(bool good);
  bool end_chunk();
  std::string schemas_and_channels() const;
  std::string summary();

  static constexpr std::size_t kChunkBytes = std::size_t{1} << 18;  // about

  OutputFile file_;
  std::vector<LogChannel> channels_;
  std::int64_t start_;
  std::string chunk_;
  std::map<std::uint16_t, std::vector<Entry>> chunk_messages_;
  std::uint64_t chunk_first_ = 0, chunk_last_ = 0;
  std::vector<ChunkIndex> chunks_;
  std::uint64_t messages_ = 0, first_ = 0, last_ = 0;
  std::uint32_t sequence_ = 0;
  bool closed_ = false;
};

}  // namespace sinew::runtime
