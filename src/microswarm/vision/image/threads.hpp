// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm {

/// Threads that the whole process lets work on a picture. For programs, not for libraries: a
/// program that drives a rig sets 1, since more would take the cores that its coils and its camera
/// need.
void set_picture_threads(int threads);

}  // namespace microswarm
