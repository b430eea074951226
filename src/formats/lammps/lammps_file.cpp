// The row of LAMMPS in the table of formats: an input script, and its data file beside it.
#include <algorithm>
#include <cctype>

#include "formats/file_kinds.h"
#include "formats/lammps/lammps_model.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

std::string format_script(const Scene& scene, const std::string& file, std::vector<std::string>& losses) {
  refuse_unsupported(scene, file);
  if (scene.system.points().empty()) throw InputError(file + ": points: must be at least 1");
  const std::string stem = std::filesystem::path(file).stem().string();
  // LAMMPS separates words by spaces, replaces $, * and %, begins comments with #, and reads no other characters than those of ASCII
  const auto is_plain = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '+'); };
  if (!std::ranges::all_of(stem, is_plain))
    throw InputError(file + ": file name: LAMMPS accepts only the letters A to Z and a to z, digits and any of . _ - + here");
  if (scene.settings.integrator != &default_integrator())
    losses.push_back(file + ": LAMMPS runs velocity_verlet with the same step, not " + std::string(scene.settings.integrator->id));
  return format_lammps_script(scene, stem + ".data", stem + ".dump");
}

}  // namespace

constinit const FileKind lammps_file{.extension = ".lmp",
                                     .title = "LAMMPS input script, with its data file",
                                     .format = format_script,
                                     .companion_extension = ".data",
                                     .format_companion = format_lammps_data};

}  // namespace hooke
