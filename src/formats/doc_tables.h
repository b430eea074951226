// The parts of the documentation that are generated from tables: parameters, shapes, file formats and shipped scenes.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// The page with its generated blocks updated. A block is between the lines "<!-- table NAME -->" and "<!-- end -->", where NAME is
// parameters, shapes, formats or scenes. `make_manual docs FILE...` writes pages, and a test compares them.
std::string with_doc_tables(std::string_view page);

// The page with this table in its block of this name, if it has one.
std::string with_table(std::string page, std::string_view name, std::string_view table);

}  // namespace hooke
