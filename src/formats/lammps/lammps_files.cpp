// The input script and the data file of LAMMPS (https://docs.lammps.org).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "base/bounds.h"
#include "base/printable.h"
#include "formats/lammps/lammps_model.h"
#include "sim/model/bounding_box.h"

namespace hooke {
namespace {

std::string number(double value) { return " " + format_exact(value); }

std::string vector(const Vec3& v) { return number(v.x) + number(v.y) + number(v.z); }

bool acts(const System& system, const Spring& spring) { return system.stiffness_of(spring) > 0.0; }

Index spring_count(const Scene& scene) {
  return static_cast<Index>(
      std::ranges::count_if(scene.system.springs(), [&](const Spring& spring) { return acts(scene.system, spring); }));
}

// [m], the maximum length of a spring now or at rest.
double max_spring_length(const Scene& scene) {
  double max = 0.0;
  for (const Spring& spring : scene.system.springs()) {
    const Vec3 along =
        scene.state.position[scene.system.index_of(spring.second)] - scene.state.position[scene.system.index_of(spring.first)];
    if (acts(scene.system, spring)) max = std::max({max, spring.rest_length, glm::length(along)});
  }
  return max > 0.0 ? max : 1.0;
}

bool has_one_mass(const System& system) {
  return std::ranges::all_of(system.points(), [&](const Point& point) { return point.mass == system.points().front().mass; });
}

// [m/s^2], at the start, without drag.
std::vector<Vec3> start_accelerations(const Scene& scene) {
  const System& system = scene.system;
  std::vector<Vec3> a(system.points().size(), Vec3(0.0));
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Vec3 along = scene.state.position[j] - scene.state.position[i];
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const Vec3 force = system.stiffness_of(spring) * (length - spring.rest_length) / length * along;
    a[i] += force / system.points()[i].mass;
    a[j] -= force / system.points()[j].mass;
  }
  for (Vec3& each : a) each += field_acceleration(system);
  return a;
}

// "ylo -0.98": the side of the wall, and where the center of a point turns back.
std::string wall(const Plane& plane, double radius) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(plane.normal[c]) == 1.0)
      return std::string(1, "xyz"[c]) + (plane.normal[c] > 0.0 ? "lo" : "hi") + number(plane.point[c] + plane.normal[c] * radius);
  return {};
}

}  // namespace

std::string format_lammps_script(const Scene& scene, const std::string& data_file, const std::string& dump_file) {
  const System& system = scene.system;
  const LammpsDrag drag(scene);
  const bool has_masses = !has_one_mass(system), has_springs = spring_count(scene) > 0;
  const double length = max_spring_length(scene);
  const long steps_per_second = std::max(1l, std::lround(scene.settings.frame_rate * scene.settings.substeps));

  std::string text = "# " + printable(scene.name, 200) + ": written by Hooke; SI units\n";
  text += "variable steps index " + std::to_string(steps_per_second) + "\n";
  text += "variable every index " + std::to_string(scene.settings.substeps) + "\n";
  text += "variable report index " + std::to_string(scene.settings.substeps) + "\n";
  text += "variable frames index \"" + dump_file + "\"\n\n";
  text += "units lj\natom_style bond\nboundary s s s\natom_modify map array sort 0 0\n";
  text += "pair_style none\n";
  if (has_springs) text += "bond_style harmonic\nspecial_bonds lj/coul 1 1 1\n";
  text += "# springs may reach twice their maximum length between neighboring ranks\n";
  text += "comm_modify cutoff" + number(2.5 * length) + "\nneighbor" + number(0.5 * length) + " bin\n";
  if (has_masses) text += "fix masses all property/atom rmass\n";
  text += "read_data \"" + data_file + "\"" + (has_masses ? " fix masses NULL \"Point Masses\"" : "") + "\n";
  text += "neigh_modify every 1 delay 0 check yes\ntimestep" + number(scene.settings.substep()) + "\n\n";

  text += "# points of type 2 are nailed\ngroup free type 1\n";
  const Vec3 g = field_acceleration(system);
  if (const double magnitude = glm::length(g); magnitude > 0.0)
    text += "fix gravity free gravity" + number(magnitude) + " vector" + vector(g) + "\n";
  if (drag.is_on()) {
    text += "# drag: one kick by s a - d v per step, which is exact for constant a\n";
    for (const char c : {'x', 'y', 'z'}) {
      const std::string axis(1, c);
      text += "variable drag" + axis + " atom" + number(drag.scale - 1.0) + "*f" + axis + "-" + format_exact(drag.rate) + "*mass*v" + axis +
              "\n";
    }
    text += "fix drag free addforce v_dragx v_dragy v_dragz\n";
  }
  text += "fix move free nve\n";
  const double radius = system.points().empty() ? 0.0 : system.points().front().radius;
  for (std::size_t i = 0; i < system.colliders.size(); ++i)
    if (system.colliders[i].solid)
      text += "fix wall" + std::to_string(i) + " free wall/reflect " + wall(std::get<Plane>(system.colliders[i].shape), radius) + "\n";

  text += "\nthermo_style custom step pe ke\nthermo ${report}\nthermo_modify lost error flush yes norm no\n";
  text += std::string("dump frames all custom ${every} ${frames} id x y z vx vy vz") + (drag.is_on() ? " fx fy fz" : "") + "\n";
  return text + "dump_modify frames sort id format float %.17g\nrun ${steps}\n";
}

std::string format_lammps_data(const Scene& scene) {
  const System& system = scene.system;
  const auto& points = system.points();
  // springs of the same stiffness and rest length share a type
  std::map<std::pair<double, double>, std::size_t> types;
  std::string bonds, coefficients;
  Index bond = 0;
  for (const Spring& spring : system.springs()) {
    if (!acts(system, spring)) continue;
    const auto [type, is_new] = types.try_emplace({system.stiffness_of(spring), spring.rest_length}, types.size() + 1);
    // the energy is K (l - l0)^2
    if (is_new) coefficients += std::to_string(type->second) + number(0.5 * type->first.first) + number(type->first.second) + "\n";
    bonds += std::to_string(++bond) + " " + std::to_string(type->second) + " " + std::to_string(system.index_of(spring.first) + 1) + " " +
             std::to_string(system.index_of(spring.second) + 1) + "\n";
  }

  const auto [min, max] = bounding_box(scene.state.position);
  const double margin = 0.5 * max_spring_length(scene);

  std::string text = printable(scene.name, 200) + ": written by Hooke; SI units\n\n";
  text += std::to_string(points.size()) + " atoms\n" + std::to_string(bond) + " bonds\n2 atom types\n" + std::to_string(types.size()) +
          " bond types\n\n";
  for (int c = 0; c < 3; ++c) {
    const std::string axis(1, "xyz"[c]);
    text += format_exact(min[c] - margin) + number(max[c] + margin) + " " + axis + "lo " + axis + "hi\n";
  }
  const double mass = points.empty() ? 1.0 : points.front().mass;
  text += "\nMasses\n\n1" + number(mass) + "\n2" + number(mass) + "\n";
  if (bond > 0) text += "\nBond Coeffs # harmonic\n\n" + coefficients;
  text += "\nAtoms # bond\n\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += std::to_string(i + 1) + " 1 " + (points[i].nailed ? "2" : "1") + vector(scene.state.position[i]) + "\n";

  const LammpsDrag drag(scene);
  const std::vector<Vec3> accelerations = drag.is_on() ? start_accelerations(scene) : std::vector<Vec3>(points.size(), Vec3(0.0));
  text += "\nVelocities\n\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += std::to_string(i + 1) + vector(points[i].nailed ? Vec3(0.0) : drag.start_velocity(scene.state.velocity[i], accelerations[i])) +
            "\n";
  if (bond > 0) text += "\nBonds\n\n" + bonds;
  // last: LAMMPS misreads the title of the section after that of a fix
  if (!has_one_mass(system)) {
    text += "\nPoint Masses\n\n";
    for (std::size_t i = 0; i < points.size(); ++i) text += std::to_string(i + 1) + number(points[i].mass) + "\n";
  }
  return text;
}

}  // namespace hooke
