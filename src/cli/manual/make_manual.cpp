// Prints the man page or the bash completion, or updates the generated tables of pages: make_manual man|bash|docs FILE...
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

#include "cli/manual/manual.h"
#include "formats/doc_tables.h"

namespace {

bool update_tables(const char* file) {
  std::ostringstream page;
  page << std::ifstream(file).rdbuf();
  const std::string text = hooke::with_manual_tables(hooke::with_doc_tables(page.str()));
  return static_cast<bool>(std::ofstream(file) << text << std::flush);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string_view what = count >= 2 ? arguments[1] : "";
  if (what == "docs" && count > 2) {
    for (int i = 2; i < count; ++i)
      if (!update_tables(arguments[i])) return 5;
    return 0;
  }
  if (count != 2 || (what != "man" && what != "bash")) {
    std::cerr << "usage: make_manual man|bash|docs FILE...\n";
    return 2;
  }
  std::cout << (what == "man" ? hooke::manual_page() : hooke::bash_completion()) << std::flush;
  return std::cout ? 0 : 5;
}
