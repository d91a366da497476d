// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// Separator of a table by its header: ',', or ';' or a tab if the header has one of these and no
/// comma, as tables that spreadsheets write in other languages.
char csv_separator(std::string_view header);

/// Cells of a row between separators, without blanks and double quotes around them. A separator
/// within quotes is text; a quote within quotes, which is doubled in the row, stays doubled.
std::vector<std::string_view> csv_cells(std::string_view row, char separator);

/// Text of a number in a table: where cells are separated by ';' or tabs, "0,5" is 0.5.
std::string csv_number(std::string_view cell, char separator);

/// Refuses a table in which "1,010" may be 1010 as well as 1.01: a number with three digits behind
/// its only comma, in a table that has decimal points too; or, unless another number of the table
/// has a comma that can only be decimal, in quotes between commas, or between tabs beside whole
/// numbers. Lines that begin with '#' are left out. Throws InputError "NAME:LINE: WHY".
void require_clear_commas(std::string_view text, std::string_view name, char separator);

}  // namespace microswarm
