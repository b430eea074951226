#include "study/gnuplot.h"

#include <sys/mman.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/atomic_write.h"
#include "base/formatted.h"

namespace hooke {
namespace {

std::string reason(const char* what) { return std::string("no chart: ") + what + ": " + std::strerror(errno); }

// Runs gnuplot and reads its output to the end. Returns why there is none.
std::optional<std::string> run_gnuplot(const std::string& script, std::string& chart) {
  // the script is an unnamed file that gnuplot inherits
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> input(::fdopen(::memfd_create("script", 0), "w"), &std::fclose);
  if (!input || std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() || std::fflush(input.get()) != 0)
    return reason("the script for gnuplot could not be written");

  // -d: without the user's start-up files, which may change the terminal
  const std::string command =
      "command -v gnuplot >/dev/null || exit 127; exec gnuplot -d /dev/fd/" + std::to_string(::fileno(input.get())) + " </dev/null";
  std::FILE* output = ::popen(command.c_str(), "re");
  if (output == nullptr) return reason("gnuplot could not be started");
  std::array<char, 1 << 14> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), output)) chart.append(buffer.data(), size);
  const int status = ::pclose(output);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return "no chart: gnuplot is not installed (Debian: gnuplot-nox)";
  if (status != 0 || chart.empty()) return "no chart: gnuplot failed";
  return std::nullopt;
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '\'';
}

std::optional<std::string> draw_chart(const GnuplotChart& chart, const std::filesystem::path& file) {
  const std::string start = formatted(
      "set terminal %s size %d,%d font 'DejaVu Sans,12' background '#ffffff'\n"
      "set encoding utf8\nset border 3 linecolor rgb '#888888'\nset tics nomirror out textcolor rgb '#333333'\n",
      file.extension() == ".svg" ? "svg" : "pngcairo", chart.width, chart.height);
  std::string drawn;
  if (std::optional<std::string> failure = run_gnuplot(start + chart.script, drawn)) return failure;
  write_atomically(file, drawn);
  return std::nullopt;
}

}  // namespace hooke
