// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before the definition of a function of plain loops: it is compiled for AVX2 too, and which of
/// the two runs is decided when the program starts. Both give the same bits: AVX2 alone has no
/// fused multiply-add, and nothing is reordered. Sanitizers and other machines have the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MICROSWARM_EACH_CPU __attribute__((target_clones("avx2", "default")))
#else
#define MICROSWARM_EACH_CPU
#endif
