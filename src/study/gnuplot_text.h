// Text in a script for gnuplot.
#pragma once

#include <string>
#include <string_view>

namespace hooke {

// In single quotes, in which gnuplot interprets nothing except a doubled quote.
inline std::string gnuplot_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '\'';
}

}  // namespace hooke
