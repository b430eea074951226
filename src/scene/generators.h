// Cloths, ropes and shapes that a scene file describes in a few words instead of listing their points and springs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/shape.h"
#include "scene/view_settings.h"
#include "sim/state.h"
#include "sim/system.h"

namespace hooke {

// Points and springs as lists; the id of each is its place. What a file lists and what generators make end up here.
struct Network {
  std::vector<Point> points;
  std::vector<Vec3> position, velocity;
  ClothCoordinates cloth_coordinates;  // of the points on their cloths; those beyond its end have none
  std::vector<Spring> springs;
  std::vector<Face> faces;
  std::vector<double> sheet_areas, sheet_weights;  // of points [m^2] and springs [1] in the sheets that they make up (SheetWeights)
};

// How masses and stiffnesses of single points and springs follow from those given.
enum class MassModel {
  Equal,      // as in a plain spring graph: every point the same mass, every spring exactly the k and d given
  Tributary,  // as a material: each point the mass around it, k and d so that the number of points does not matter
};

// What cloths and ropes have in common.
struct Fabric {
  MassModel mass_model = MassModel::Equal;
  // exactly one of the two: per area [kg/m^2] or length [kg/m], or of the whole [kg]
  std::optional<double> density, mass;
  double stiffness = 0.0;                      // [N/m]
  std::optional<double> stiffness_per_strain;  // Y [N] instead: k = Y / rest length of each spring
  double damping = 0.0;                        // [N s/m]
  std::optional<double> damping_per_length;    // c [N s/m^2] instead: d = c rest length of each spring
  std::optional<double> point_radius;          // [m]; none: a quarter of the spacing
  std::optional<Color> color;
  std::vector<Index> nails;  // points by their number within it
};

// columns x rows points, row by row from `corner`, along `across` first. Springs along both (structural), across both
// diagonals (shear), and over the next point but one (bend), as many to a point inside as the stencil says; two faces a cell.
struct Cloth {
  Vec3 corner{0.0}, across{1.0, 0.0, 0.0}, down{0.0, -1.0, 0.0};  // [m]: a corner, and the whole edges that leave it
  std::int64_t columns = 2, rows = 2;
  Fabric fabric{.mass_model = MassModel::Tributary};
  std::optional<std::int64_t> stencil;  // 4: structural, 8: and shear, 12: and bend; none: those of more than no stiffness
  // as a material, instead of stiffness and damping: Young's modulus times thickness [N/m], and the same of its viscosity [N s/m]
  std::optional<double> sheet_stiffness;
  double sheet_damping = 0.0;
  std::optional<double> shear_stiffness;  // [N/m]; none: half of the stiffness
  std::optional<double> bend_stiffness;   // [N/m]; none: half of the stiffness in a stencil of 12, else 0
};

struct Rope {
  Vec3 from{0.0}, to{1.0, 0.0, 0.0};  // [m]
  std::int64_t points = 2;
  Fabric fabric;
};

using Generator = std::variant<Cloth, Rope, Shape>;

// How much a generator makes, without making it.
struct ElementCount {
  std::uint64_t points = 0, springs = 0, faces = 0;
};
ElementCount element_count_of(const Generator& generator);

// Appends what the generator makes. Positions, masses, stiffnesses that come out as no numbers are left for the caller
// to find.
void generate(const Generator& generator, Network& network);

}  // namespace hooke
