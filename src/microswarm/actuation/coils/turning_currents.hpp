// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/drivers/coil_drive.hpp"
#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/actuation/field/field_generator.hpp"

namespace microswarm {

/// Currents of a generator's field at every phase: minimum-norm currents are linear in the field.
/// `reached` becomes whether the coils can produce it.
TurningCurrents turning_currents(const Actuation& at, const FieldGenerator& generator,
                                 bool& reached);

/// Sends them to a driver that makes waveforms; channels without a coil get no current.
DriveStatus send(CoilDriver& driver, const TurningCurrents& currents);

}  // namespace microswarm
