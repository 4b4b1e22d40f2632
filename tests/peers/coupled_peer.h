// Joints that follow others (URDF's mimic) for libraries that move every joint by itself: their
// answers for all joints, brought to those that follow none.
#pragma once

#include <functional>
#include <memory>

#include "peer.h"

namespace sinew::peers {

// What `make` makes; where some joints of the URDF mimic others and are not among the setup's
// joints, with them.
std::unique_ptr<Peer> with_followers(
    const Setup& setup, const std::function<std::unique_ptr<Peer>(const Setup&)>& make);

}  // namespace sinew::peers
