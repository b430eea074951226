// Reads values of scene files, and collects warnings.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/json_field.h"
#include "sim/model/system.h"

namespace hooke {

// The member with this key; none: it is missing. And one that must not be missing.
std::optional<JsonField> find_member(const JsonField& field, std::string_view key);
JsonField required(const JsonField& field, std::string_view key, std::string_view limit = "must be given");

class SceneFields {
 public:
  // Three numbers, or two in a 2-D scene, in the plane z = 0. `in_plane`: z must be 0 in a 2-D scene. The dimensions may be known only
  // later: check_dimensions then refuses vectors that do not fit.
  Vec3 position(const JsonField& field) { return vector(field, true); }
  Vec3 vector(const JsonField& field) { return vector(field, false); }
  void check_dimensions(int dimensions) const;

  // A direction as a unit vector; unchanged if it is one already, so that a saved vector is read back bit for bit.
  Vec3 direction(const JsonField& field);

  // "#rrggbb"
  Color color(const JsonField& field) const;

  // Warns about an unknown key and adds it to the preserved members, with its original text if that is given.
  void preserve_unknown(const JsonField& field, std::string& members, std::string_view text = {});

  void warn(const std::string& line) { warnings_.push_back(line); }
  // Repeated warnings are listed once, with their number.
  std::vector<std::string> warnings(const std::string& file) const;

 private:
  Vec3 vector(const JsonField& field, bool in_plane);

  struct Unknown {
    std::string first;  // path of the first
    std::size_t count = 0;
  };
  std::string vector_2d_error_, nonzero_z_error_;  // errors for the first vector of two numbers, with z != 0
  std::map<std::string, Unknown> unknown_keys_;    // by their name
  std::vector<std::string> warnings_;
};

}  // namespace hooke
