// The row of LAMMPS in the table of formats: an input script, and its data file beside it.
#include "base/printable.h"
#include "formats/file_kinds.h"
#include "formats/lammps/lammps_model.h"
#include "sim/integrator.h"

namespace hooke {
namespace {

std::string format_script(const Scene& scene, const std::string& file, std::vector<std::string>& losses) {
  refuse_unsupported(scene, file);
  if (scene.system.points().empty()) throw InputError(file + ": points: must be at least 1");
  const std::string stem = std::filesystem::path(file).stem().string();
  // LAMMPS has no way to write a quote in a file name
  if (stem.find_first_of("\"$&\\\n") != std::string::npos) throw InputError(file + ": file name: must not contain any of \" $ & \\");
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
