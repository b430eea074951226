// A bridge: a Warren truss, or two with a deck between them.
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

constexpr std::string_view supports[] = {"both_ends", "one_end", "nothing"};
constexpr ShapeNumber numbers[] = {
    {"span", "Span", "m", 0.1, 50.0, 2.4},
    {"height", "Height", "m", 0.02, 10.0, 0.25},
    {"width", "Width", "m", 0.0, 10.0, 0.4, false, true},
    {"panels", "Panels", "", 2, 100, 10, true},
    {"mass", "Mass", "kg", 0.01, 1e4, 4.0},
    {"stiffness", "Beam stiffness", "N/m", 1.0, 1e6, 1e4},
    {"damping", "Dashpots", "N s/m", 0.0, 1e3, 5.0},
};

bool is_flat(const Shape& shape) { return !(shape["width"] > 0.0); }

// One truss of n panels; points are numbered from the first:
//        n+1 --- n+2 --- ...        the top, n points
//       /   \   /   \   /
//      0 --- 1 --- 2 --- ... n      the deck, n + 1 points
void make_truss(const Shape& shape, ShapeBuilder& builder, double z, double mass) {
  const std::int64_t n = shape.count("panels");
  const double k = shape["stiffness"], d = shape["damping"], half = 0.5 * shape["height"],
               radius = 0.06 * shape["span"] / static_cast<double>(n);
  const std::size_t deck = builder.network().points.size(), top = deck + static_cast<std::size_t>(n) + 1;
  const auto place = [&](double panel) { return shape["span"] * (panel / static_cast<double>(n) - 0.5); };
  for (std::int64_t i = 0; i <= n; ++i) {
    const bool nailed = (i == 0 && shape.support_name() != "nothing") || (i == n && shape.support_name() == "both_ends");
    builder.add_point({place(static_cast<double>(i)), -half, z}, mass, radius, nailed);
  }
  for (std::int64_t i = 0; i < n; ++i) builder.add_point({place(static_cast<double>(i) + 0.5), half, z}, mass, radius);

  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    builder.add_spring(deck + i, deck + i + 1, k, d);
    builder.add_spring(deck + i, top + i, k, d);
    builder.add_spring(top + i, deck + i + 1, k, d);
    if (i > 0) builder.add_spring(top + i - 1, top + i, k, d);
  }
}

ElementCount element_count(const Shape& shape) {
  const auto n = static_cast<std::uint64_t>(shape.count("panels"));
  if (is_flat(shape)) return {.points = 2 * n + 1, .springs = 4 * n - 1};
  return {.points = 4 * n + 2, .springs = 14 * n - 1, .faces = 2 * n};
}

void make(const Shape& shape, Network& network) {
  ShapeBuilder builder(network);
  const auto n = static_cast<std::size_t>(shape.count("panels"));
  const double mass = shape["mass"] / static_cast<double>(element_count(shape).points), half = 0.5 * shape["width"];
  if (is_flat(shape)) return make_truss(shape, builder, 0.0, mass);
  make_truss(shape, builder, half, mass);
  make_truss(shape, builder, -half, mass);

  // cross beams, and diagonals in the deck, at the top and between them, without which the bridge would collapse sideways
  const double k = shape["stiffness"], d = shape["damping"];
  const std::size_t near = builder.first(), far = near + 2 * n + 1;
  for (std::size_t i = 0; i < 2 * n + 1; ++i) builder.add_spring(near + i, far + i, k, d);
  for (std::size_t i = 0; i < n; ++i) {
    builder.add_spring(near + i, far + i + 1, k, d);
    builder.add_spring(far + i, near + i + 1, k, d);
    builder.add_spring(near + n + 1 + i, far + i, k, d);
    if (i + 1 < n) builder.add_spring(near + n + 1 + i, far + n + 2 + i, k, d);
    builder.add_face(near + i, near + i + 1, far + i);
    builder.add_face(far + i, near + i + 1, far + i + 1);
  }
  builder.add_spring(far + n + 1, near, k, d);
}

}  // namespace

constinit const ShapeKind bridge_shape{.id = "bridge",
                                       .label = "Bridge",
                                       .description = "A truss of beams on two supports; flat if its width is 0.",
                                       .details = "`stiffness` and `damping` are those of each beam",
                                       .numbers = numbers,
                                       .supports = supports,
                                       .element_count = element_count,
                                       .make = make};

}  // namespace hooke
