// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm::vision {

/// Sets the number of threads that OpenCV uses in the whole process. To be called by programs, not
/// by libraries. A program that controls a rig sets 1, since more threads would occupy the cores
/// that coils and camera need.
void set_picture_threads(int threads);

}  // namespace microswarm::vision
