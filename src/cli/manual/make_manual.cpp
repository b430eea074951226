// Prints the man page or the completion of bash, for the build: make_manual man|bash.
#include <iostream>
#include <string_view>

#include "cli/manual/manual.h"

int main(int count, char** arguments) {
  const std::string_view what = count == 2 ? arguments[1] : "";
  if (what != "man" && what != "bash") {
    std::cerr << "usage: make_manual man|bash\n";
    return 2;
  }
  std::cout << (what == "man" ? hooke::manual_page() : hooke::bash_completion()) << std::flush;
  return std::cout ? 0 : 5;
}
