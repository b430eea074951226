// A sheet of cloth.
#include "scene/shapes/builder.h"
#include "scene/shapes/rows.h"
#include "scene/shapes/upright_cloth.h"

namespace hooke {
namespace {

constexpr ShapeNumber numbers[] = {
    {"width", "Width", "m", 0.05, 20.0, 1.0},          {"height", "Height", "m", 0.05, 20.0, 1.0},
    {"columns", "Columns", "", 2, 200, 24, true},      {"rows", "Rows", "", 2, 200, 24, true},
    {"density", "Density", "kg/m^2", 0.01, 10.0, 0.2}, {"stiffness", "Stiffness", "N/m", 0.1, 1e5, 60.0},
    {"damping", "Dashpots", "N s/m", 0.0, 10.0, 0.01},
};

ElementCount element_count(const Shape& shape) { return element_count_of(sheet_cloth(shape)); }
void make(const Shape& shape, Network& network) { add_nailed_cloth(shape, sheet_cloth(shape), network); }

}  // namespace

constinit const ShapeKind sheet_shape{
    .id = "sheet",
    .label = "Sheet",
    .description =
        "A sheet of cloth, nailed at its corners, an edge, all around or nowhere; its properties do not depend on the number of points.",
    .details = "A `cloth` as above, tributary and upright",
    .numbers = numbers,
    .supports = sheet_supports,
    .contact = ShapeContact::Faces,
    .element_count = element_count,
    .make = make};

}  // namespace hooke
