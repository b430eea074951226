// Reads the points, springs, faces and generators of a scene file.
#pragma once

#include <string>
#include <vector>

#include "formats/scene_json/scene_fields.h"
#include "formats/scene_json/shape_fields.h"
#include "scene/network.h"
#include "scene/scene.h"

namespace hooke {

// For messages: "7: must be the number of one of the 5 points, from 0".
std::string no_such_point(std::uint32_t number, std::size_t points);

// Items are read one by one, in any order of their lists; `take` completes the network. Each throws InputError.
class NetworkReader {
 public:
  // `name` stands for the file in messages. Unknown members of points and springs are kept in `unknown`. All must outlive it.
  NetworkReader(const std::string& name, SceneFields& fields, PreservedJson& unknown) : name_(name), fields_(fields), unknown_(unknown) {}

  void read_point(const JsonField& field);
  void read_spring(const JsonField& field);
  void read_face(const JsonField& field);
  // Of the next face: those listed, then those of the generators.
  void read_rest_angles(const JsonField& field);
  void read_generator(const JsonField& field) { shapes_.push_back(read_shape(field, fields_)); }

  // Generates what the generators describe, resolves rest lengths that were not given, and checks the whole.
  Network take(int dimensions);

 private:
  void read_cloth_place(const JsonField& field);
  PointId read_point_number(const JsonField& field) const;
  void generate_shapes(int dimensions);
  void check_generated(std::size_t generator, std::size_t first_point, std::size_t first_spring, int dimensions) const;
  void check_point_numbers() const;
  void set_rest_lengths();
  void warn_about_coincident_points();
  [[noreturn]] void refuse(const std::string& field, const std::string& what) const;

  const std::string& name_;
  SceneFields& fields_;
  PreservedJson& unknown_;
  Network network_;
  std::vector<Shape> shapes_;
};

}  // namespace hooke
