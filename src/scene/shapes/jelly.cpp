// A jelly: points in a cubic lattice of spacing a, springs along its edges and the diagonals of its squares, all of the same stiffness k.
// For small strains this is an isotropic solid: C11 = 3 k / a, C12 = C44 = k / a (Born and Huang 1954, section 11, central forces between
// nearest and second nearest neighbors), so that Poisson's ratio is 1/4 and E = 5/2 k / a. A spring on the surface belongs to fewer cubes
// than an inner one and has that fraction of k; the masses of points likewise.
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr std::string_view supports[] = {"nothing", "base"};
constexpr ShapeNumber numbers[] = {
    {"columns", "Points along x", "", 2, 40, 6, true},  {"rows", "Points along y", "", 2, 40, 6, true},
    {"layers", "Points along z", "", 2, 40, 6, true},   {"spacing", "Spacing", "m", 0.005, 1.0, 0.08},
    {"density", "Density", "kg/m^3", 1.0, 1e4, 100.0},  {"young", "Young's modulus", "Pa", 10.0, 1e7, 6000.0},
    {"damping", "Damping d / k", "s", 0.0, 0.1, 0.004},
};

// Offsets from a point to its neighbors, each pair once.
struct Direction {
  int x, y, z;
};
constexpr Direction directions[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 1, 0}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}};

class Lattice {
 public:
  explicit Lattice(const Shape& shape) : n_{shape.count("columns"), shape.count("rows"), shape.count("layers")} {}

  std::size_t number(std::int64_t x, std::int64_t y, std::int64_t z) const { return static_cast<std::size_t>((z * n_[1] + y) * n_[0] + x); }
  std::int64_t side(int axis) const { return n_[axis]; }
  bool contains(int axis, std::int64_t at) const { return at >= 0 && at < n_[axis]; }
  // The weight of a position along an axis: one half on the surface.
  double fraction(int axis, std::int64_t at) const { return at == 0 || at == n_[axis] - 1 ? 0.5 : 1.0; }
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::int64_t z = 0; z < n_[2]; ++z)
      for (std::int64_t y = 0; y < n_[1]; ++y)
        for (std::int64_t x = 0; x < n_[0]; ++x) visit(x, y, z);
  }

 private:
  std::int64_t n_[3];
};

ElementCount element_count(const Shape& shape) {
  const auto x = static_cast<std::uint64_t>(shape.count("columns")), y = static_cast<std::uint64_t>(shape.count("rows")),
             z = static_cast<std::uint64_t>(shape.count("layers"));
  ElementCount count{.points = x * y * z};
  count.springs = (x - 1) * y * z + x * (y - 1) * z + x * y * (z - 1);
  count.springs += 2 * ((x - 1) * (y - 1) * z + (x - 1) * y * (z - 1) + x * (y - 1) * (z - 1));
  count.faces = 4 * ((x - 1) * (y - 1) + (x - 1) * (z - 1) + (y - 1) * (z - 1));
  return count;
}

void make_points(const Shape& shape, const Lattice& lattice, ShapeBuilder& builder) {
  const double a = shape["spacing"];
  const auto middle = [&](int axis, std::int64_t at) {
    return a * (static_cast<double>(at) - 0.5 * static_cast<double>(lattice.side(axis) - 1));
  };
  lattice.for_each([&](std::int64_t x, std::int64_t y, std::int64_t z) {
    const double fraction = lattice.fraction(0, x) * lattice.fraction(1, y) * lattice.fraction(2, z);
    builder.add_point({middle(0, x), middle(1, y), middle(2, z)}, fraction * shape["density"] * a * a * a, 0.2 * a,
                      shape.support_name() == "base" && y == 0);
  });
}

// An edge is shared by the cubes on both sides of it in two directions, a diagonal in one direction.
void make_springs(const Shape& shape, const Lattice& lattice, ShapeBuilder& builder) {
  const double k = 0.4 * shape["young"] * shape["spacing"], d = shape["damping"] * k;
  lattice.for_each([&](std::int64_t x, std::int64_t y, std::int64_t z) {
    for (const auto& [dx, dy, dz] : directions) {
      if (!lattice.contains(0, x + dx) || !lattice.contains(1, y + dy) || !lattice.contains(2, z + dz)) continue;
      double fraction = 1.0;
      if (dx == 0) fraction *= lattice.fraction(0, x);
      if (dy == 0) fraction *= lattice.fraction(1, y);
      if (dz == 0) fraction *= lattice.fraction(2, z);
      const bool is_edge = dx * dx + dy * dy + dz * dz == 1;
      builder.add_spring(builder.first() + lattice.number(x, y, z), builder.first() + lattice.number(x + dx, y + dy, z + dz), fraction * k,
                         fraction * d, is_edge ? SpringFamily::Structural : SpringFamily::Shear);
    }
  });
}

// Two triangles for each square of the surface, counter-clockwise seen from outside.
void make_faces(const Lattice& lattice, ShapeBuilder& builder) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const std::int64_t at : {std::int64_t{0}, lattice.side(axis) - 1})
      for (std::int64_t j = 0; j + 1 < lattice.side(v); ++j)
        for (std::int64_t i = 0; i + 1 < lattice.side(u); ++i) {
          const auto corner = [&](std::int64_t along_u, std::int64_t along_v) {
            std::int64_t place[3];
            place[axis] = at;
            place[u] = i + along_u;
            place[v] = j + along_v;
            return builder.first() + lattice.number(place[0], place[1], place[2]);
          };
          const std::size_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          at == 0 ? builder.add_face(d, c, a) : builder.add_face(b, c, a);
          at == 0 ? builder.add_face(a, c, b) : builder.add_face(a, c, d);
        }
  }
}

void make(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  const Lattice lattice(shape);
  make_points(shape, lattice, builder);
  make_springs(shape, lattice, builder);
  make_faces(lattice, builder);
}

}  // namespace

constinit const ShapeKind jelly_shape{.id = "jelly",
                                      .label = "Jelly cube",
                                      .description = "A soft solid: points in a lattice; its properties do not depend on the spacing.",
                                      .details =
                                          "An isotropic solid of Poisson's ratio 1/4: k = 2/5 E a along the edges and diagonals of its "
                                          "cubes with E = `young` and a = `spacing`, and d = `damping` k",
                                      .numbers = numbers,
                                      .supports = supports,
                                      .is_3d_only = true,
                                      .contact = ShapeContact::Faces,
                                      .element_count = element_count,
                                      .make = make};

}  // namespace hooke
