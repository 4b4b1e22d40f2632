// A file written from the recorder's thread: buffered, and with its errors kept as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::runtime {

class OutputFile {
 public:
  explicit OutputFile(const std::string& path);  // throws Error
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  bool write(std::string_view bytes);  // false once something could not be written
  bool flush();
  bool close();
  std::uint64_t position() const { return position_; }  // bytes so far
  const std::string& fault() const { return fault_; }

 private:
  static constexpr std::size_t kBuffer = std::size_t{1} << 16;
  std::string path_, buffer_, fault_;
  int file_ = -1;
  std::uint64_t position_ = 0;
};

}  // namespace sinew::runtime
