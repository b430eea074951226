// A scene as LAMMPS runs it: velocity Verlet on point masses and harmonic bonds. `hooke convert` writes it, `hooke run --engine` runs it.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace hooke {

// What the scene has and LAMMPS, as packaged by Debian 12, cannot represent, one phrase each: "dashpots". Empty: the motion is the same.
std::vector<std::string> unsupported_by_lammps(const Scene& scene);

// Throws InputError with these phrases if there are any; `file` is the name in the message.
void refuse_unsupported(const Scene& scene, const std::string& file);

// The step of velocity_verlet with drag c, v = E v + phi a for each half kick, is in LAMMPS a kick by s a - d v, with one kick of a whole
// step at a time: E^2 = 1 - h d, phi (1 + E) = h s. Positions and half-step velocities are then equal to rounding. Without drag s = 1, d =
// 0.
struct LammpsDrag {
  double decay = 1.0, weight = 0.0;  // E = e^(-c h/2), phi [s]
  double scale = 1.0, rate = 0.0;    // s, d [1/s]
  double half = 0.0;                 // h/2 [s]
  explicit LammpsDrag(const Scene& scene);
  bool is_on() const { return rate > 0.0; }

  // The velocity to start LAMMPS with, so that the first half step is that of velocity_verlet. `a`: the acceleration without drag.
  Vec3 start_velocity(const Vec3& v, const Vec3& a) const;
  // The velocity at the end of a step from that of LAMMPS and the acceleration that it applied, s a - d v.
  Vec3 end_velocity(const Vec3& v, const Vec3& applied) const;
};

// Gravity, and drag times wind [m/s^2]; along z nothing in flat scenes.
Vec3 field_acceleration(const System& system);

// The input script. It reads `data_file` and writes a dump of positions and velocities, with drag also of forces. Its variables, which
// -var NAME VALUE of LAMMPS sets: steps (default: those of one second), every (steps from one dump to the next), report (the same for
// lines of energies) and frames (the dump).
std::string format_lammps_script(const Scene& scene, const std::string& data_file, const std::string& dump_file);

// The data file: points, springs and initial velocities.
std::string format_lammps_data(const Scene& scene);

}  // namespace hooke
