// Prints the man page or the completion for a shell, or updates the generated tables of pages: make_manual man|bash|zsh|fish|docs FILE...
#include <fstream>
#include <iostream>
#include <sstream>
#include <string_view>

#include "cli/manual/completion.h"
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
  for (const auto& [name, text] : {std::pair{"man", &hooke::manual_page}, std::pair{"bash", &hooke::bash_completion},
                                   std::pair{"zsh", &hooke::zsh_completion}, std::pair{"fish", &hooke::fish_completion}})
    if (count == 2 && what == name) return std::cout << text() << std::flush ? 0 : 5;
  std::cerr << "usage: make_manual man|bash|zsh|fish|docs FILE...\n";
  return 2;
}
