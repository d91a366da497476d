// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace microswarm::cli {

/// Columns that stdout has: the variable COLUMNS, or what the terminal says, or 80; 0 without a
/// terminal, where nothing is wrapped.
std::size_t output_columns();

/// A help text in lines of at most `columns` (0: any number; otherwise at least 40 are used). The
/// meaning of an option continues below its beginning, a command line behind a backslash. A word
/// that is longer stays whole.
std::string wrapped_help(std::string_view help, std::size_t columns);

}  // namespace microswarm::cli
