// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace microswarm::rig {

/// Source of a fault that ended a run.
enum class FaultKind {
  none,      ///< no fault
  swarm,     ///< the swarm was lost, or does not follow
  camera,    ///< no pictures, or useless ones
  computer,  ///< the program stood still or was too late
  device,    ///< the coils' device failed, or does not confirm zero
  disk,      ///< a log could not be written
  person,    ///< stopped from outside, such as by the emergency key
};
constexpr auto enum_names(FaultKind) {
  return std::array<std::pair<FaultKind, std::string_view>, 7>{{{FaultKind::none, "none"},
                                                                {FaultKind::swarm, "swarm"},
                                                                {FaultKind::camera, "camera"},
                                                                {FaultKind::computer, "computer"},
                                                                {FaultKind::device, "device"},
                                                                {FaultKind::disk, "disk"},
                                                                {FaultKind::person, "person"}}};
}

/// Whether a person must look at the rig after such a fault, before it is driven again.
constexpr bool needs_person(FaultKind kind) {
  return kind == FaultKind::device || kind == FaultKind::disk || kind == FaultKind::person;
}

/// Why a run ended with a fault; an empty reason is none.
struct Fault {
  std::string why{};
  FaultKind kind = FaultKind::none;
};

/// The first with a reason; none if there is none.
inline Fault first_fault(std::initializer_list<Fault> faults) {
  for (const Fault& fault : faults)
    if (!fault.why.empty()) return fault;
  return {};
}

}  // namespace microswarm::rig
