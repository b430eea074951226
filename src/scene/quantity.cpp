#include "scene/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/bounds.h"
#include "base/text_lines.h"
#include "scene/crossed_parts.h"
#include "sim/contact/gap.h"

namespace hooke {
namespace {

using Of = QuantityRow::Of;

Spring spring_at(const Measurement& m, Index s) { return m.system.springs()[s]; }

double length_of(const Measurement& m, Index s) {
  const Spring spring = spring_at(m, s);
  return glm::length(m.state.position[m.system.index_of(spring.second)] - m.state.position[m.system.index_of(spring.first)]);
}

// With its dashpot.
double force_of(const Measurement& m, Index s) {
  const Spring spring = spring_at(m, s);
  const Index a = m.system.index_of(spring.first), b = m.system.index_of(spring.second);
  const Vec3 along = m.state.position[b] - m.state.position[a];
  const double length = glm::length(along);
  const double rate = length > 0.0 ? glm::dot(m.state.velocity[b] - m.state.velocity[a], along) / length : 0.0;
  const SpringResponse response = response_at(m.system, m.state, spring);
  return response.tension + (response.acts ? m.system.damping_of(spring) * rate : 0.0);
}

// Of the free points.
Vec3 center_of_mass(const Measurement& m) {
  Vec3 sum(0.0);
  double mass = 0.0;
  for (std::size_t i = 0; i < m.system.points().size(); ++i) {
    const Point& point = m.system.points()[i];
    if (point.nailed) continue;
    sum += point.mass * m.state.position[i];
    mass += point.mass;
  }
  return mass > 0.0 ? sum / mass : sum;
}

double max_speed(const Measurement& m) {
  double max = 0.0;
  for (const Vec3& v : m.state.velocity) max = std::max(max, glm::length(v));
  return max;
}

double min_height(const Measurement& m) {
  double min = HUGE_VAL;
  for (const Vec3& x : m.state.position) min = std::min(min, x.y);
  return min;
}

// The maximum depth of the surface of any free point in any solid collider.
double max_penetration(const Measurement& m) {
  double max = 0.0;
  std::vector<Collider> colliders;
  for (std::size_t c = 0; c < m.system.colliders.size(); ++c) colliders.push_back(current_collider(m.system, m.state, c));
  for (std::size_t i = 0; i < m.system.points().size(); ++i) {
    const Point& point = m.system.points()[i];
    if (point.nailed) continue;
    for (const Collider& collider : colliders)
      if (collider.solid && !collider.one_way) max = std::max(max, -gap_to(collider, point.radius, m.state.position[i]).distance);
  }
  return max;
}

template <int c>
double position_of(const Measurement& m, Index i) {
  return m.state.position[i][c];
}
template <int c>
double velocity_of(const Measurement& m, Index i) {
  return m.state.velocity[i][c];
}
template <int c>
double momentum_of(const Measurement& m, Index) {
  return m.momentum.linear[c];
}
template <int c>
double angular_momentum_of(const Measurement& m, Index) {
  return m.momentum.angular[c];
}
template <int c>
double center_of(const Measurement& m, Index) {
  return center_of_mass(m)[c];
}

double value_of(const Measured& measured) { return measured.value.value_or(std::numeric_limits<double>::quiet_NaN()); }
template <Measured Accuracy::*field>
double accuracy_of(const Measurement& m, Index) {
  return m.accuracy == nullptr ? std::numeric_limits<double>::quiet_NaN() : value_of(m.accuracy->*field);
}
template <auto term>
double balance_of(const Measurement& m, Index) {
  return m.accuracy == nullptr || !m.accuracy->is_on ? std::numeric_limits<double>::quiet_NaN() : term(m.accuracy->energy);
}
template <EnergyCause cause>
double work_of(const EnergyBalance& balance) {
  return balance.ledger[cause];
}
double work_of_forces(const EnergyBalance& balance) { return balance.ledger.forces(); }
double work_of_limits(const EnergyBalance& balance) { return balance.ledger.limits(); }
double gain_of_method(const EnergyBalance& balance) { return balance.method(); }

constexpr std::array rows{
    QuantityRow{"time", "s", Of::Scene, "Time", [](const Measurement& m, Index) { return m.state.time; }},
    QuantityRow{"kinetic", "J", Of::Scene, "Kinetic energy", [](const Measurement& m, Index) { return m.energy.kinetic; }},
    QuantityRow{"elastic", "J", Of::Scene, "Elastic energy", [](const Measurement& m, Index) { return m.energy.elastic; }},
    QuantityRow{"gravitational", "J", Of::Scene, "Potential energy", [](const Measurement& m, Index) { return m.energy.gravitational; }},
    QuantityRow{"total", "J", Of::Scene, "Total energy", [](const Measurement& m, Index) { return m.energy.total(); }},
    QuantityRow{"dissipated", "J", Of::Scene, "Energy dissipated since the start",
                [](const Measurement& m, Index) { return m.state.supply.net_input - m.energy.total(); }},
    QuantityRow{"momentum_x", "kg m/s", Of::Scene, "Momentum along x", momentum_of<0>},
    QuantityRow{"momentum_y", "kg m/s", Of::Scene, "Momentum along y", momentum_of<1>},
    QuantityRow{"momentum_z", "kg m/s", Of::Scene, "Momentum along z", momentum_of<2>},
    QuantityRow{"angular_x", "kg m^2/s", Of::Scene, "Angular momentum about x", angular_momentum_of<0>},
    QuantityRow{"angular_y", "kg m^2/s", Of::Scene, "Angular momentum about y", angular_momentum_of<1>},
    QuantityRow{"angular_z", "kg m^2/s", Of::Scene, "Angular momentum about z", angular_momentum_of<2>},
    QuantityRow{"center_x", "m", Of::Scene, "Center of mass of the free points, x", center_of<0>},
    QuantityRow{"center_y", "m", Of::Scene, "Center of mass of the free points, y", center_of<1>},
    QuantityRow{"center_z", "m", Of::Scene, "Center of mass of the free points, z", center_of<2>},
    QuantityRow{"least_strain", "1", Of::Scene, "Minimum strain of a spring", [](const Measurement& m, Index) { return m.min_strain; }},
    QuantityRow{"largest_strain", "1", Of::Scene, "Maximum strain of a spring",
                [](const Measurement& m, Index) { return m.largest_strain; }},
    QuantityRow{"fastest", "m/s", Of::Scene, "Speed of the fastest point", [](const Measurement& m, Index) { return max_speed(m); }},
    QuantityRow{"lowest", "m", Of::Scene, "Height of the lowest point", [](const Measurement& m, Index) { return min_height(m); }},
    QuantityRow{"depth", "m", Of::Scene, "Maximum penetration of a point into a collider",
                [](const Measurement& m, Index) { return max_penetration(m); }},
    QuantityRow{"crossings", "1", Of::Scene, "Edges that pass through faces, or springs of a flat scene through each other",
                [](const Measurement& m, Index) { return static_cast<double>(count_crossings(m.system, m.state)); }},
    QuantityRow{"error", "m", Of::Scene, "Error of a frame, RMS over the points", accuracy_of<&Accuracy::frame>, true},
    QuantityRow{"error_max", "m", Of::Scene, "Error of a frame, maximum over the points", accuracy_of<&Accuracy::frame_max>, true},
    QuantityRow{"accumulated_error", "m", Of::Scene, "Accumulated error, RMS over the points", accuracy_of<&Accuracy::accumulated>, true},
    QuantityRow{"amplification", "1", Of::Scene, "Growth of a small difference in a second", accuracy_of<&Accuracy::amplification>, true},
    QuantityRow{"energy_hand", "J", Of::Scene, "Energy supplied by the hand", balance_of<work_of<EnergyCause::Hand>>, true},
    QuantityRow{"energy_edits", "J", Of::Scene, "Energy supplied by edits", balance_of<work_of<EnergyCause::Edits>>, true},
    QuantityRow{"energy_forces", "J", Of::Scene, "Energy supplied by listed forces", balance_of<work_of_forces>, true},
    QuantityRow{"energy_muscles", "J", Of::Scene, "Energy supplied by muscles and winches", balance_of<work_of<EnergyCause::Muscles>>,
                true},
    QuantityRow{"energy_colliders", "J", Of::Scene, "Energy supplied by moving colliders", balance_of<work_of<EnergyCause::Colliders>>,
                true},
    QuantityRow{"energy_limits", "J", Of::Scene, "Energy supplied by breaking springs and the strain limit", balance_of<work_of_limits>,
                true},
    QuantityRow{"energy_drag", "J", Of::Scene, "Energy supplied by drag; negative: dissipated", balance_of<work_of<EnergyCause::Drag>>,
                true},
    QuantityRow{"energy_dashpots", "J", Of::Scene, "Energy supplied by dashpots; negative: dissipated",
                balance_of<work_of<EnergyCause::Dashpots>>, true},
    QuantityRow{"energy_contact", "J", Of::Scene, "Energy supplied by contact; negative: dissipated",
                balance_of<work_of<EnergyCause::Contact>>, true},
    QuantityRow{"energy_method", "J", Of::Scene, "Energy gained by the numerical method; negative: lost", balance_of<gain_of_method>, true},
    QuantityRow{"x", "m", Of::Point, "Position of a point, x", position_of<0>},
    QuantityRow{"y", "m", Of::Point, "Position of a point, y", position_of<1>},
    QuantityRow{"z", "m", Of::Point, "Position of a point, z", position_of<2>},
    QuantityRow{"vx", "m/s", Of::Point, "Velocity of a point, x", velocity_of<0>},
    QuantityRow{"vy", "m/s", Of::Point, "Velocity of a point, y", velocity_of<1>},
    QuantityRow{"vz", "m/s", Of::Point, "Velocity of a point, z", velocity_of<2>},
    QuantityRow{"length", "m", Of::Spring, "Length of a spring", length_of},
    QuantityRow{"strain", "1", Of::Spring, "Strain of a spring",
                [](const Measurement& m, Index s) { return strain(m.system, m.state, spring_at(m, s)); }},
    QuantityRow{"force", "N", Of::Spring, "Tension of a spring with its dashpot; negative: compression", force_of},
};

}  // namespace

Measurement measure(const System& system, const State& state, const Accuracy* accuracy) {
  Measurement measurement{system, state, compute_energy(system, state), compute_momentum(system, state)};
  measurement.accuracy = accuracy;
  if (system.spring_count() > 0) measurement.min_strain = measurement.largest_strain = strain(system, state, system.springs()[0]);
  for (const Spring& spring : system.springs()) {
    const double spring_strain = strain(system, state, spring);
    measurement.min_strain = std::min(measurement.min_strain, spring_strain);
    measurement.largest_strain = std::max(measurement.largest_strain, spring_strain);
  }
  return measurement;
}

std::span<const QuantityRow> quantity_rows() { return rows; }

std::string Quantity::name() const { return std::string(row->name) + (row->of == Of::Scene ? "" : std::to_string(at)); }
std::string Quantity::heading() const { return name() + " [" + std::string(row->unit) + "]"; }

std::optional<Quantity> find_quantity(std::string_view name, Index points, Index springs) {
  const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
  std::string_view letters = name.substr(0, digits);
  const std::string_view number = name.substr(digits);
  // the standard terms, which are also understood
  if (letters == "max_strain") letters = "largest_strain";
  if (letters == "min_strain") letters = "least_strain";
  const auto row = std::ranges::find(rows, letters, &QuantityRow::name);
  if (row == rows.end() || (row->of == Of::Scene) != number.empty()) return std::nullopt;
  if (row->of == Of::Scene) return Quantity{&*row};

  const auto at = parse_integer(number);
  return at && *at < (row->of == Of::Point ? points : springs) ? std::optional(Quantity{&*row, *at}) : std::nullopt;
}

std::string names_in_range(std::string_view name, Index points, Index springs) {
  const std::string_view letters = name.substr(0, name.find_first_of("0123456789"));
  const bool has_number = letters.size() < name.size() && name.find_first_not_of("0123456789", letters.size()) == std::string_view::npos;
  const auto row = std::ranges::find(rows, letters, &QuantityRow::name);
  if (row == rows.end() || row->of == Of::Scene || !has_number) return {};
  const Index count = row->of == Of::Point ? points : springs;
  if (count == 0) return std::string("another quantity: the scene has no ") + (row->of == Of::Point ? "points" : "springs");
  return std::string(letters) + "0" + (count == 1 ? "" : " to " + std::string(letters) + std::to_string(count - 1));
}

std::string parse_quantities(std::string_view list, Index points, Index springs, std::vector<Quantity>& quantities) {
  for (std::string_view name : split(list, ',')) {
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
    const auto quantity = find_quantity(name, points, springs);
    if (!quantity) return name.empty() ? "," : std::string(name);
    quantities.push_back(*quantity);
  }
  return {};
}

std::string csv_heading(std::span<const Quantity> quantities) {
  std::string line;
  for (const Quantity& quantity : quantities) line += (line.empty() ? "" : ",") + quantity.heading();
  return line + "\n";
}

namespace {

// Points and springs may have been removed since the quantity was chosen.
bool is_in_scene(const Quantity& quantity, const System& system) {
  if (quantity.row->of == QuantityRow::Of::Scene) return true;
  return quantity.at < (quantity.row->of == QuantityRow::Of::Point ? system.point_count() : system.spring_count());
}

}  // namespace

std::string csv_row(std::span<const Quantity> quantities, const System& system, const State& state, const Accuracy* accuracy) {
  const Measurement measurement = measure(system, state, accuracy);
  std::string line;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const double value = is_in_scene(quantities[i], system) ? quantities[i].of(measurement) : std::nan("");
    line += (i == 0 ? "" : ",") + (std::isnan(value) ? std::string() : format_exact(value));
  }
  return line + "\n";
}

std::string quantity_names(bool with_accuracy, bool with_spatial) {
  std::string names;
  for (const QuantityRow& row : rows) {
    if ((row.needs_accuracy && !with_accuracy) || (row.is_spatial() && !with_spatial)) continue;
    names += (names.empty() ? "" : ", ") + std::string(row.name) +
             (row.of == Of::Scene   ? ""
              : row.of == Of::Point ? "<point>"
                                    : "<spring>");
  }
  return names;
}

}  // namespace hooke
