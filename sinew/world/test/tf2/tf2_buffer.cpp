#include "tf2_buffer.h"

#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

struct Tf2Buffer::Data {
  explicit Data(double seconds) : buffer(ros::Duration(seconds)) {}
  tf2::BufferCore buffer;
};

Tf2Buffer::Tf2Buffer(double cache_seconds) : data_(std::make_unique<Data>(cache_seconds)) {}
Tf2Buffer::~Tf2Buffer() = default;

void Tf2Buffer::set(const std::string& child, const std::string& parent, std::int64_t stamp_ns,
                    const Tf2Numbers& pose, bool is_static) {
  geometry_msgs::TransformStamped message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(stamp_ns));
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.rotation.x = pose[0];
  message.transform.rotation.y = pose[1];
  message.transform.rotation.z = pose[2];
  message.transform.rotation.w = pose[3];
  message.transform.translation.x = pose[4];
  message.transform.translation.y = pose[5];
  message.transform.translation.z = pose[6];
  data_->buffer.setTransform(message, "sinew", is_static);
}

bool Tf2Buffer::lookup(const std::string& target, const std::string& source, std::int64_t stamp_ns,
                       Tf2Numbers* pose) const {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(stamp_ns));
  try {
    const auto result = data_->buffer.lookupTransform(target, source, time).transform;
    *pose = {result.rotation.x,    result.rotation.y,    result.rotation.z,   result.rotation.w,
             result.translation.x, result.translation.y, result.translation.z};
    return true;
  } catch (const tf2::TransformException&) {
    return false;
  }
}
