// How the rows of the table of parameters read and write a scene, and when they apply to it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>

#include "scene/new_point.h"
#include "scene/parameters.h"

namespace hooke {

// Scales gravity to a magnitude; directed downwards if there was none.
inline void set_gravity(Scene& scene, double size) {
  Vec3& gravity = scene.system.gravity;
  const double magnitude = glm::length(gravity);
  gravity = magnitude > 0.0 ? gravity * (size / magnitude) : Vec3(0.0, -size, 0.0);
}

// Of a number, a switch or a choice, to which `of` gives a reference.
template <class Of>
constexpr Parameter::Access plain(Of) {
  return {.read = [](const Scene& scene) { return static_cast<double>(Of{}(scene)); },
          .write = [](Scene& scene, double value) { Of{}(scene) = static_cast<std::remove_cvref_t<decltype(Of{}(scene))>>(value); }};
}

inline double weight_of(Parameter::Weight weight, const SheetWeights* sheet, const Spring& spring) {
  switch (weight) {
    case Parameter::Weight::One:
      return 1.0;
    case Parameter::Weight::InverseLength:
      return spring.rest_length > 0.0 ? 1.0 / spring.rest_length : 0.0;
    case Parameter::Weight::Length:
      return spring.rest_length;
    case Parameter::Weight::SheetWeight:
      return sheet_weight_of(sheet, spring.id);
  }
  return 0.0;
}

inline double weight_of(const Parameter::Springs& springs, const SheetWeights* sheet, const Spring& spring) {
  return springs.family && spring.family != *springs.family ? 0.0 : weight_of(springs.weight, sheet, spring);
}

inline double read_springs(const Parameter::Springs& springs, const Scene& scene) {
  CommonValue common;
  for (const Spring& spring : scene.system.springs())
    if (const double weight = weight_of(springs, scene.sheet.get(), spring); weight > 0.0)
      common.include(spring.*springs.property / weight);
  return common.value_or(springs.property == &Spring::stiffness ? scene.defaults.stiffness : scene.defaults.damping);
}

inline void write_springs(const Parameter::Springs& springs, Scene& scene, double value) {
  for (Index s = 0; s < scene.system.spring_count(); ++s)
    if (const double weight = weight_of(springs, scene.sheet.get(), scene.system.springs()[s]); weight > 0.0)
      (*scene.system.spring(s)).*springs.property = weight * value;
}

// mass = density area
inline double read_density(const Scene& scene) {
  CommonValue common;
  for (const Point& point : scene.system.points())
    if (const double area = area_of(scene.sheet.get(), point.id); area > 0.0) common.include(point.mass / area);
  return common.value_or(0.0);
}
inline void write_density(Scene& scene, double value) {
  for (Index i = 0; i < scene.system.point_count(); ++i)
    if (const double area = area_of(scene.sheet.get(), scene.system.points()[i].id); area > 0.0) scene.system.point(i).mass = value * area;
}

// Radius, and mass if it follows the radius.
inline double read_radius(const Scene& scene) {
  CommonValue common;
  for (const Point& point : scene.system.points()) common.include(point.radius);
  return common.value_or(scene.defaults.radius > 0.0 ? scene.defaults.radius : NewPoint{}.radius);
}
inline void write_radius(Scene& scene, double value) {
  for (Index i = 0; i < scene.system.point_count(); ++i) {
    Point& point = scene.system.point(i);
    if (scene.defaults.mass_follows_radius) point.mass = mass_at_radius(point, value);
    point.radius = value;
  }
}

template <SpringParameterization parameterization>
bool has_parameterization(const Scene& scene) {
  return scene.parameterization == parameterization;
}
inline bool has_springs(const Scene& scene) { return scene.system.spring_count() > 0; }
inline bool is_per_strain(const Scene& scene) {
  return has_springs(scene) && has_parameterization<SpringParameterization::PerStrain>(scene);
}
inline bool is_by_size(const Scene& scene) { return has_springs(scene) && has_parameterization<SpringParameterization::BySize>(scene); }
inline bool is_sheet_material(const Scene& scene) {
  return scene.sheet != nullptr && has_parameterization<SpringParameterization::Material>(scene);
}
// Without a cloth there is no material.
inline bool is_per_spring(const Scene& scene) {
  return has_parameterization<SpringParameterization::Plain>(scene) ||
         (scene.sheet == nullptr && has_parameterization<SpringParameterization::Material>(scene));
}
inline bool has_plain_stiffness(const Scene& scene) {
  return is_per_spring(scene) || has_parameterization<SpringParameterization::BySize>(scene);
}
inline bool has_plain_damping(const Scene& scene) {
  return is_per_spring(scene) || has_parameterization<SpringParameterization::PerStrain>(scene);
}

template <SpringFamily family>
bool has_family(const Scene& scene) {
  return scene.system.count_of(family) > 0;
}
template <SpringFamily family>
bool has_family_stiffness(const Scene& scene) {
  return has_family<family>(scene) && has_plain_stiffness(scene);
}

// The material of a sheet does not determine its bending: bend springs keep their own k.
inline bool has_bend_stiffness(const Scene& scene) {
  return has_family<SpringFamily::Bend>(scene) && (has_plain_stiffness(scene) || is_sheet_material(scene));
}

// The percentage that, divided by 100, gives this fraction bit for bit, if there is one.
inline double percent_of(double fraction) {
  const double percent = 100.0 * fraction;
  for (const double near : {percent, std::nextafter(percent, 0.0), std::nextafter(percent, INFINITY)})
    if (near / 100.0 == fraction) return near;
  return percent;
}

}  // namespace hooke
