// A scene that is saved and loaded again is the same scene, bit for bit.

#include <bit>
#include <cmath>
#include <cstring>

#include "campaign/check.h"
#include "campaign/random_document.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

bool same_cloth(const Scene& a, const Scene& b) {
  for (const Point& point : a.system.points()) {
    const glm::dvec2 first = cloth_coordinates_of(a.cloth_texture, point.id), second = cloth_coordinates_of(b.cloth_texture, point.id);
    if (first != second && !(std::isnan(first.x) && std::isnan(second.x))) return false;
    if (area_of(a.sheet.get(), point.id) != area_of(b.sheet.get(), point.id)) return false;
  }
  for (const Spring& spring : a.system.springs())
    if (sheet_weight_of(a.sheet.get(), spring.id) != sheet_weight_of(b.sheet.get(), spring.id)) return false;
  return true;
}

void expect_same(const Scene& a, const Scene& b) {
  expect(a.name == b.name && a.description == b.description, "different name or description");
  expect(a.system == b.system, "different system");
  expect(same_bits(a.state.position, b.state.position) && same_bits(a.state.velocity, b.state.velocity),
         "different positions or velocities");
  expect(std::bit_cast<std::uint64_t>(a.state.time) == std::bit_cast<std::uint64_t>(b.state.time), "different time");
  expect(a.settings == b.settings, "different settings");
  expect(a.view == b.view, "different view");
  expect(same_cloth(a, b), "different cloth");
  expect(a.defaults == b.defaults && a.parameterization == b.parameterization && a.controls == b.controls, "different defaults");
  expect(a.preserved_json == b.preserved_json, "different preserved keys");
}

// Inserts a list of generators before the settings of the simulation. Rest angles, one for each face, would be too few.
std::string with_generators(std::string text, const std::string& generators) {
  if (const std::size_t angles = text.find("\n  \"rest_angles\": "); angles != std::string::npos)
    text.erase(angles, text.find("\n  \"", angles + 1) - angles);
  const std::size_t at = text.find("\n  \"simulation\": ");
  expect(at != std::string::npos, "no simulation in the file");
  return text.insert(at, "\n  \"generators\": " + generators + ",");
}

long run(std::uint64_t number) {
  Random random(number);
  Scene scene = random_document(random, Numbers::Any);
  std::string text = format_scene(scene);
  if (random.one_in(4)) {
    scene = parse_scene(with_generators(std::move(text), random_generators(random)), "random.json").scene;
    text = format_scene(scene);
    expect(text.find("\n  \"generators\": ") != std::string::npos, "the generators are missing");
  }
  const Scene again = parse_scene(text, "random.json").scene;
  expect_same(scene, again);
  expect(format_scene(again) == text, "different text:\n" + text + "\n" + format_scene(again));
  return 1;
}

}  // namespace

const Check round_trips{"round_trips", "scenes", 20, run};

}  // namespace hooke
