// Commands that set properties of points and springs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "edit/effect.h"

namespace hooke {

// Nails or releases points and sets their velocity: 0 in an edit, which stops a nailed point; the previous one in its inverse.
struct SetNailed {
  struct Item {
    static constexpr auto fields = names("point", "nailed", "velocity");
    PointId point;
    bool nailed;
    Vec3 velocity{0.0};
  };
  static constexpr std::string_view name = "set_nailed";
  static constexpr auto fields = names("items");
  std::vector<Item> items;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Sets positions and velocities of points.
struct Move {
  struct Item {
    static constexpr auto fields = names("point", "position", "velocity");
    PointId point;
    Vec3 position;
    Vec3 velocity;
  };
  static constexpr std::string_view name = "move";
  static constexpr auto fields = names("items");
  std::vector<Item> items;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const Move& earlier) const;
};

// Sets velocities of free points.
struct SetVelocity {
  static constexpr std::string_view name = "set_velocity";
  static constexpr auto fields = names("values");
  std::vector<std::pair<PointId, Vec3>> values;  // [m/s]

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Sets the color of points, or removes it.
struct SetPointColor {
  static constexpr std::string_view name = "set_point_color";
  static constexpr auto fields = names("values");
  std::vector<std::pair<PointId, std::optional<Color>>> values;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Sets the loads of points.
struct SetLoad {
  static constexpr std::string_view name = "set_load";
  static constexpr auto fields = names("values");
  std::vector<std::pair<PointId, Vec3>> values;  // [N]

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Sets along which axes points do not move (Point::fixed_axes).
struct SetFixedAxes {
  static constexpr std::string_view name = "set_fixed_axes";
  static constexpr auto fields = names("values");
  std::vector<std::pair<PointId, std::uint8_t>> values;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

enum class PointProperty { Mass, Radius };
constexpr double Point::*member_of(PointProperty property) { return property == PointProperty::Mass ? &Point::mass : &Point::radius; }
struct SetPointProperty {
  static constexpr std::string_view name = "set_point_property";
  static constexpr auto fields = names("property", "values");
  PointProperty property;
  std::vector<std::pair<PointId, double>> values;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

enum class SpringProperty { Stiffness, Damping, RestLength, BreakStrain };
constexpr double Spring::*member_of(SpringProperty property) {
  return std::array{&Spring::stiffness, &Spring::damping, &Spring::rest_length, &Spring::break_strain}[static_cast<std::size_t>(property)];
}
struct SetSpringProperty {
  static constexpr std::string_view name = "set_spring_property";
  static constexpr auto fields = names("property", "values");
  SpringProperty property;
  std::vector<std::pair<SpringId, double>> values;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Sets the laws of springs.
struct SetSpringLaw {
  static constexpr std::string_view name = "set_spring_law";
  static constexpr auto fields = names("values");
  std::vector<std::pair<SpringId, std::optional<SpringLaw>>> values;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

}  // namespace hooke
