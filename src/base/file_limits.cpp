#include "base/file_limits.h"

#include <array>

namespace hooke {

std::span<const FileLimit> file_limits() {
  static constexpr std::array rows{
      FileLimit{"file", "a regular file of at most 256 MiB, JSON in UTF-8, of version 1"},
      FileLimit{"points", "at most 5000000, listed and generated"},
      FileLimit{"springs", "at most 20000000, listed and generated"},
      FileLimit{"faces", "at most 10000000, listed and generated"},
      FileLimit{"colliders, generators, forces", "at most 1000, 1000 and 100"},
      FileLimit{"nesting", "at most 32 levels"},
      FileLimit{"a string or key", "at most 4096 bytes; each key once in its object"},
      FileLimit{"values", "at most 1000000 in one point, spring, generator or other member"},
      FileLimit{"numbers",
                "finite; mass, frame rate and speed more than 0; stiffness, damping, rest length, radius, drag and friction at least 0"},
      FileLimit{"restitution", "from 0 to 1"},
      FileLimit{"substeps", "from 1 to 1000000"},
      FileLimit{"a texture", "a PNG of at most 8192 x 8192 pixels, in the scene's folder or below it"},
      FileLimit{"a spring", "joins two different points that exist"},
  };
  return rows;
}

}  // namespace hooke
