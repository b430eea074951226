// Words of the formats that follow from the tables of the program, in quotes as in the files. The dictionaries hold the others.
#pragma once

#include <string>
#include <vector>

namespace hooke {

std::vector<std::string> scene_table_words();
std::vector<std::string> recording_table_words();

}  // namespace hooke
