// Draws the shipped textures: make_textures FOLDER (called by scripts/textures). Each tiles without a seam and is the same on
// every machine.
#include <array>
#include <cmath>
#include <cstdio>

#include "base/errors.h"
#include "draw/view.h"

namespace hooke {
namespace {

constexpr int side = 256;  // [px]

struct Tone {
  double red, green, blue;  // 0..1
};

Tone mixed(const Tone& a, const Tone& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

// A pseudo-random number in 0..1, the same for the same arguments.
double grain(int a, int b, int salt) {
  auto bits = static_cast<std::uint32_t>(a) * 0x9e3779b1u ^ static_cast<std::uint32_t>(b) * 0x85ebca77u ^
              static_cast<std::uint32_t>(salt) * 0xc2b2ae3du;
  bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
  bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
  return static_cast<double>(bits ^ (bits >> 15)) / 4294967295.0;
}

// Two by two squares of alternating color.
Tone checker(int x, int y) {
  constexpr Tone light{0.94, 0.91, 0.85}, dark{0.18, 0.38, 0.47};
  return (2 * x / side + 2 * y / side) % 2 == 0 ? light : dark;
}

// A crossing of threads: which one is on top, and its shading, round across the thread and darker where it passes under.
struct Weave {
  bool warp_on_top;
  int thread;    // index of the thread on top, counted along x for the warp
  int below;     // of the other one
  double light;  // 1 at its center line
};

// `over`: whether the warp thread passes over the weft thread.
template <class Over>
Weave weave(int x, int y, int threads, const Over& over) {
  const double pitch = static_cast<double>(side) / threads;  // [px]
  const int column = static_cast<int>(x / pitch), row = static_cast<int>(y / pitch);
  const double u = (x + 0.5) / pitch - column - 0.5, v = (y + 0.5) / pitch - row - 0.5;  // relative to the crossing, -0.5..0.5
  Weave found;
  found.warp_on_top = over(column, row);
  found.thread = found.warp_on_top ? column : row;
  found.below = found.warp_on_top ? row : column;
  const double across = found.warp_on_top ? u : v, along = found.warp_on_top ? v : u;
  found.light = (1.0 - 1.9 * across * across) * (1.0 - 0.5 * along * along);
  return found;
}

// Plain weave of irregular threads.
Tone linen(int x, int y) {
  constexpr int threads = 32;
  constexpr Tone flax{0.95, 0.91, 0.83}, dark{0.44, 0.38, 0.30};
  const Weave at = weave(x, y, threads, [](int column, int row) { return (column + row) % 2 == 0; });
  const double slub = grain(at.thread, at.warp_on_top ? 1 : 2, 7) - 0.5;                      // brightness varies between threads
  const double speck = grain(at.thread, (at.warp_on_top ? y : x) / 8, at.warp_on_top) - 0.5;  // and along a thread
  return mixed(dark, flax, std::clamp(0.30 + 0.62 * at.light + 0.16 * slub + 0.10 * speck, 0.0, 1.0));
}

// Twill with the same sett in warp and weft.
Tone tartan(int x, int y) {
  constexpr int threads = 64;
  constexpr Tone red{0.70, 0.13, 0.15}, navy{0.11, 0.16, 0.32}, green{0.10, 0.33, 0.24}, cream{0.95, 0.89, 0.72};
  struct Stripe {
    Tone tone;
    int threads;
  };
  // symmetric about its first and last stripe
  constexpr std::array<Stripe, 9> sett{{{red, 7}, {navy, 5}, {red, 2}, {green, 8}, {cream, 2}, {green, 8}, {red, 2}, {navy, 5}, {red, 7}}};
  const auto tone_of = [&](int thread) {
    int rest = thread * 46 / threads;
    for (const Stripe& stripe : sett) {
      if (rest < stripe.threads) return stripe.tone;
      rest -= stripe.threads;
    }
    return red;
  };
  const Weave at = weave(x, y, threads, [](int column, int row) { return (column + row) % 4 < 2; });
  const double light = 0.74 + 0.26 * at.light + 0.06 * (grain(at.thread, at.warp_on_top, 3) - 0.5);
  // the color of the thread below shines through: lines seen from afar would be jagged as the weave is
  const Tone tone = mixed(tone_of(at.thread), tone_of(at.below), 0.3);
  return {light * tone.red, light * tone.green, light * tone.blue};
}

void make(const std::filesystem::path& file, Tone (*tone_at)(int x, int y)) {
  Image image{side, side, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Tone tone = tone_at(x, y);
      for (const double channel : {tone.red, tone.green, tone.blue})
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(channel, 0.0, 1.0))));
    }
  write_png(image, file);
}

}  // namespace
}  // namespace hooke

int main(int count, char** arguments) {
  using namespace hooke;
  if (count != 2) return 2;
  const std::filesystem::path folder(arguments[1]);
  try {
    make(folder / "checker.png", checker);
    make(folder / "linen.png", linen);
    make(folder / "tartan.png", tartan);
  } catch (const FileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 5;
  }
}
