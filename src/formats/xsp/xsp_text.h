// The content of XSpringies 1.x scene files (.xsp), in the units of the file: pixels, y upward, pixels per second. xsp_file converts it to
// a scene.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hooke {

struct XspMass {
  int line = 0;  // in the file
  int id = 0;    // > 0
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;
  double mass = 1.0;  // negative: fixed; 0: 1
  double elasticity = 1.0;
};

struct XspSpring {
  int line = 0;
  int id = 0;
  int first = 0, second = 0;                                 // ids of masses
  double stiffness = 0.0, damping = 0.0, rest_length = 0.0;  // >= 0
};

struct XspForce {
  bool active = false;
  double p1 = 0.0, p2 = 0.0;
};

enum class XspSide { Top, Left, Right, Bottom };

// Defaults for commands that a file lacks.
struct XspDocument {
  double new_mass = 1.0, new_elasticity = 1.0;    // cmas, elas: of new masses
  double new_stiffness = 1.0, new_damping = 0.0;  // kspr, kdmp: of new springs
  bool new_masses_fixed = false;                  // fixm
  bool springs_shown = true;                      // shws
  int center = -1;                                // cent: the id of a mass, or -1: the middle of the window
  std::map<int, XspForce> forces;                 // frce, by id
  double viscosity = 0.0;                         // visc, >= 0
  double stickiness = 0.0;                        // stck
  double step = 0.025, precision = 1.0;           // step, prec; step > 0
  bool adaptive = false;                          // adpt
  double grid = 20.0;                             // gsnp
  bool snap_to_grid = false;
  std::array<bool, 4> walls{};  // wall, by XspSide
  std::vector<XspMass> masses;
  std::vector<XspSpring> springs;
  std::vector<std::string> unknown;   // lines with other commands
  std::vector<std::string> warnings;  // "line 7: visc: already set before; the last value is used"
};

// Throws InputError ("FILE: line N: COMMAND: VALUE: LIMIT") for invalid files. `file` is its name in messages. Ids are unique, and springs
// connect existing masses. Refuses the dialect of GoSpringies, which has the same first line.
XspDocument parse_xsp_text(std::string_view text, const std::string& file);

// A text that parse_xsp_text reads back as the same document.
std::string format_xsp_text(const XspDocument& document);

}  // namespace hooke
