// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm::vision {

/// Keeps OpenCV and its FFmpeg from writing to stderr in the whole process, unless the environment
/// sets FFmpeg's level. To be called by programs at their start, not by libraries: what cannot be
/// read or written is an error of the function that tries it.
void silence_picture_messages();

}  // namespace microswarm::vision
