// The robot interfaces that ship, by the IRIs with which algorithm models name them (sa:interface).
#pragma once

#include <string>
#include <string_view>

namespace sinew::robot {

inline constexpr std::string_view kNamespace = "https://w3id.org/sinew/robot#";

inline std::string interface_iri(std::string_view name) {  // "print", "mujoco", "udp"
  return std::string(kNamespace) + std::string(name);
}

}  // namespace sinew::robot
