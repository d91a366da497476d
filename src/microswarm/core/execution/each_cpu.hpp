// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Placed before the definition of a function of plain loops: compiles it for AVX2 as well and
/// selects the variant when the program starts. Both variants give the same bits: AVX2 alone has no
/// fused multiply-add, and nothing is reordered. Sanitizer builds and other machines have only the
/// plain variant.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MICROSWARM_EACH_CPU __attribute__((target_clones("avx2", "default")))
#else
#define MICROSWARM_EACH_CPU
#endif
