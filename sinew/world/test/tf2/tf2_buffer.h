// tf2's buffer behind plain numbers. tf2's headers are C++17, so they stay in one file of their
// own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

// Quaternion x y z w, position x y z.
using Tf2Numbers = std::array<double, 7>;

class Tf2Buffer {
 public:
  explicit Tf2Buffer(double cache_seconds = 10);
  ~Tf2Buffer();
  void set(const std::string& child, const std::string& parent, std::int64_t stamp_ns,
           const Tf2Numbers& pose, bool is_static = false);
  // Pose of `source` in `target`; stamp 0 asks for the latest common time. False: tf2 refuses.
  bool lookup(const std::string& target, const std::string& source, std::int64_t stamp_ns,
              Tf2Numbers* pose) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};
