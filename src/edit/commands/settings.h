// Commands that set parameters, the method, the environment and the appearance.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "edit/effect.h"

namespace hooke {

struct Parameter;

// Sets a parameter (parameters.h), clamped to its range.
struct SetParameter {
  static constexpr std::string_view name = "set_parameter";
  static constexpr auto fields = names("parameter", "value");
  const Parameter* parameter;
  double value;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
};

// The same without clamping: restores a value that a file or an earlier edit set outside the range of the slider.
struct RestoreParameter {
  static constexpr std::string_view name = "restore_parameter";
  static constexpr auto fields = names("parameter", "value");
  const Parameter* parameter;
  double value;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const RestoreParameter& earlier) const { return parameter == earlier.parameter; }
};

struct SetIntegrator {
  static constexpr std::string_view name = "set_integrator";
  static constexpr auto fields = names("integrator");
  const Integrator* integrator;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetIntegrator&) const { return true; }
};

// Set gravity and the whole list of colliders: the inverses of parameters that change several values at once.
struct SetGravity {
  static constexpr std::string_view name = "set_gravity";
  static constexpr auto fields = names("gravity");
  Vec3 gravity;

  std::string describe() const { return "change gravity"; }
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetGravity&) const { return true; }
};
struct SetColliders {
  static constexpr std::string_view name = "set_colliders";
  static constexpr auto fields = names("colliders");
  std::vector<Collider> colliders;

  std::string describe() const { return "change the colliders"; }
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetColliders&) const { return true; }
};

// Replaces the list of forces: to switch, change, add or remove any of them.
struct SetForces {
  static constexpr std::string_view name = "set_forces";
  static constexpr auto fields = names("forces");
  std::vector<Force> forces;

  std::string describe() const { return "change the forces"; }
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetForces&) const { return true; }
};

// Sets the texts of the scene.
struct SetText {
  static constexpr std::string_view name = "set_text";
  static constexpr auto fields = names("title", "description", "notes");
  std::string title, description, notes;

  std::string describe() const { return "change the title or the notes"; }
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetText&) const { return true; }
};

// Sets what is plotted, by the names of quantities.
struct SetPlots {
  static constexpr std::string_view name = "set_plots";
  static constexpr auto fields = names("plots");
  std::vector<std::string> plots;

  std::string describe() const { return "choose what to plot"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

// The image of a texture (texture.h). An inverse restores the previous image and coordinates as a whole instead, because setting a texture
// assigns texture coordinates to points that have none.
struct TextureImage {
  std::shared_ptr<const Picture> picture;
  std::optional<ClothTexture> restored{};
};

// Sets the texture of the faces.
struct SetTexture {
  static constexpr std::string_view name = "set_texture";
  static constexpr auto fields = names("texture", "size", "picture");
  std::string texture;
  std::optional<double> size;  // [m]
  TextureImage image;

  std::string describe() const { return texture.empty() ? "remove the texture" : "set the texture"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

}  // namespace hooke
