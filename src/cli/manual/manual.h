// The man page, and tables of the documentation, generated from the tables that the programs use.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// hooke(1) in roff: commands and options as they are declared, keys, parameters, methods, exit codes.
std::string manual_page();

// The page of the documentation with its tables of keys, options and parameters up to date, between the lines "<!-- table NAME -->" and
// "<!-- end -->", where NAME is keys, set, or the name of a command.
std::string with_manual_tables(std::string_view page);

}  // namespace hooke
