// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// Least distance [µm] between a point that runs straight from s.a at time t0 to s.b at t1 [s after
/// the snapshot] and the moving bodies, each going on with the velocity it was seen with and
/// growing by its deformation speed; at most `limit`. Exact in continuous time: every body is asked
/// in its own frame, in which the point runs along a straight segment too.
double forecast_clearance(const Snapshot& seen, Segment s, double t0, double t1, double limit);

/// The snapshot with every moving body drawn out along its way of the next `horizon` seconds, so
/// that a plan made on it with the clearance `r` keeps out of the way of what is coming.
Snapshot drawn_out(const Snapshot& seen, double horizon, double r);

}  // namespace microswarm
