// Draws a Snapshot with Marks into its own framebuffer, the same for a window and for an image.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "draw/camera.h"
#include "draw/marks.h"

struct ImDrawData;

namespace hooke {

// A part of the framebuffer [px], origin at the top left. Width 0: the whole framebuffer.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

inline constexpr Color dark_background{32, 36, 40}, light_background{232, 235, 239};

struct ViewOptions {
  bool points = true, springs = true, surface = true, colliders = true, grid = true;
  bool coils = false;                       // springs are drawn as coils
  bool velocities = false, forces = false;  // of points, as arrows
  bool point_numbers = false;
  bool transparent = false;    // no background
  bool shadows = true;         // of objects near the ground, a ball or a box
  bool strain_colors = true;   // on springs, or on the surface if springs are hidden
  ClothTexture cloth_texture;  // on the surface
  int samples = 4;             // MSAA samples per pixel; 0: off
  double scale = 1.0;          // framebuffer pixels per screen point; scales line widths
  Color background = dark_background;
  Viewport place;  // of the scene; panels use the whole framebuffer
};

// The options for the view settings of a scene.
ViewOptions options_for(const ViewSettings& settings, const ClothTexture& cloth_texture);

using Image = Picture;

// Owns OpenGL objects. Create and destroy it with its context current, after load_gl().
class View {
 public:
  View();
  ~View();
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  // Draws the scene, then (if given) the panels, into the view's framebuffer of width x height pixels.
  void draw(const Snapshot& snapshot, const Marks& marks, const Camera& camera, const ViewOptions& options, int width, int height,
            const ImDrawData* panels);
  // Uploads the font atlas of the current ImGui context as a texture. Call again when the fonts change.
  void upload_fonts();
  // Uploads a picture for the panels and returns its ImGui texture id. Replaces the previous picture.
  void* upload_picture(const Picture& picture);
  // Copies the picture to the framebuffer of the window, and waits until it is done so that it can be timed.
  void show() const;
  // With the opacity of each pixel, if wanted.
  Image read(bool with_opacity = false) const;

  // Strain [1] at the ends of the color scale for this snapshot, for the legend: symmetric, rounded up to 1, 2 or 5 x 10^n.
  static double strain_scale(const Snapshot& snapshot);
  // The color of a strain relative to the scale, in [-1, 1]: blue for compression, gray, orange for tension.
  static Color strain_color(double relative);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Loads the OpenGL functions of the current context and checks for version 3.3. Returns an error message, empty on success.
std::string load_gl();

// PNG, 8-bit RGB or RGBA.
std::string encode_png(const Image& image);
// Replaces the file when everything is written (base/atomic_write.h). Throws FileError.
void write_png(const Image& image, const std::filesystem::path& file);

}  // namespace hooke
