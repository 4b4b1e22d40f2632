#include "sinew/world/answer.h"

namespace sinew::world {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kNoData:
      return "never written";
    case Status::kTooOld:
      return "before the oldest entry";
    case Status::kTooNew:
      return "after the newest entry, and no model declared";
    case Status::kBeyondHorizon:
      return "beyond the model's horizon";
    case Status::kNoModel:
      return "the model needs more entries";
    case Status::kExpired:
      return "expired";
    case Status::kTimeOut:
      return "nothing fresh in time";
    case Status::kBusy:
      return "writers never paused";
    case Status::kRemoved:
      return "removed";
    case Status::kNotConnected:
      return "not connected";
    case Status::kNoMotion:
      return "no motion measured on the way";
    case Status::kOutOfOrder:
      return "not later than the last entry";
    case Status::kNotANumber:
      return "not finite, or not a unit quaternion";
    case Status::kTooLate:
      return "older than all that is kept";
    case Status::kReadOnly:
      return "derived, can only be read";
    case Status::kFull:
      return "the history is full";
    case Status::kStatic:
      return "static, and has its value";
    case Status::kNoRoom:
      return "no room: the history's collector is behind";
    case Status::kForbidden:
      return "the rights do not allow it any more";
  }
  return "?";
}

}  // namespace sinew::world
