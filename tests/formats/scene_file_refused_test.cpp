// Invalid input: every kind is refused with one line that names the file, the field or line, the value and the limit.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "base/file_limits.h"
#include "base/printable.h"
#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

// The message of the reader for the text; empty if it was accepted.
std::string refusal_of(const std::string& text) {
  try {
    parse_scene(text, "bad.json");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

// A valid scene with additional members.
std::string scene_with(const std::string& members) {
  return R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}])" + (members.empty() ? "" : ", " + members) + "}";
}
std::string point_with(const std::string& members) { return R"({"hooke": 1, "points": [{"position": [0, 0, 0], )" + members + "}]}"; }
std::string spring_with(const std::string& members) { return scene_with(R"("springs": [{"points": [0, 1], )" + members + "}]"); }
std::string cloth_with(const std::string& members) {
  return R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 1, 0], )" + members + "}]}";
}
std::string rope_with(const std::string& members) {
  return R"({"hooke": 1, "generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], )" + members + "}]}";
}
std::string collider_with(const std::string& members) { return scene_with(R"("colliders": [{)" + members + "}]"); }

struct Bad {
  std::string text;
  std::string message;  // without the file name
};

void expect_refused(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) EXPECT_EQ(refusal_of(bad.text), "bad.json: " + bad.message) << bad.text.substr(0, 200);
}

TEST(BadScenes, TheTextsThatTheseTestsModifyAreValid) {
  for (const std::string& text :
       {scene_with(""), point_with(R"("mass": 1)"), spring_with(R"("stiffness": 1)"), cloth_with(R"("points": [2, 2], "stiffness": 1)"),
        rope_with(R"("points": 2, "stiffness": 1)"), collider_with(R"("type": "sphere", "center": [0, 0, 0], "radius": 1)")})
    EXPECT_EQ(refusal_of(text), "");
}

TEST(BadScenes, AHandWithoutAPointACircleOrATimeIsRefused) {
  const auto hand = [](const std::string& members) { return scene_with("\"hand\": {" + members + "}"); };
  const std::string circle = R"("circle": {"from": [0, 0, 0], "center": [1, 0, 0]}, )", rest = R"("speed": 1, "seconds": 1)";
  EXPECT_EQ(refusal_of(hand("\"point\": 1, " + circle + rest)), "");
  expect_refused({
      {scene_with("\"hand\": 5"), "hand: 5: must be an object {...}"},
      {hand(circle + rest), "hand.point: missing: must be a point number"},
      {hand("\"point\": -1, " + circle + rest), "hand.point: -1: must be a whole number from 0 to 4999999"},
      {hand("\"point\": 2, " + circle + rest), "hand.point: 2: must be the number of one of the 2 points, from 0"},
      {hand("\"point\": 1, " + rest), "hand.circle: missing: must be {\"from\": [x, y, z], \"center\": [x, y, z]}"},
      {hand(R"("point": 1, "circle": {"center": [1, 0, 0]}, )" + rest), "hand.circle.from: missing: must be [x, y, z]"},
      {hand(R"("point": 1, "circle": {"from": [1, 0, 0]}, )" + rest), "hand.circle.center: missing: must be [x, y, z]"},
      {hand(R"("point": 1, "circle": {"from": [1, 0, 2], "center": [1, 0, 0]}, )" + rest),
       R"(hand.circle: {"from": [1, 0, 2], "center": [1, 0, 0]}: must have from at least 1e-06 m away from the axis through center)"},
      {hand(R"("point": 1, "circle": {"from": [0, 0, 0], "center": [1, 0, 0], "axis": [0, 0, 0]}, )" + rest),
       "hand.circle.axis: [0, 0, 0]: must not be zero"},
      {R"({"hooke": 1, "dimensions": 2, "points": [{"position": [0, 0]}], "hand": {"point": 0, "circle": {"from": [0, 0], "center": [1, 0], "axis": [0, 1, 1]}, )" +
           rest + "}}",
       "hand.circle.axis: [0, 0.7071067811865475, 0.7071067811865475]: must be along z in a 2-D scene"},
      {hand("\"point\": 1, " + circle + R"("seconds": 1)"), "hand.speed: missing: must be from 0 to 1000000"},
      {hand("\"point\": 1, " + circle + R"("seconds": 1, "speed": 2e6)"), "hand.speed: 2000000: must be from 0 to 1000000"},
      {hand("\"point\": 1, " + circle + R"("speed": 1)"), "hand.seconds: missing: must be more than 0"},
      {hand("\"point\": 1, " + circle + R"("speed": 1, "seconds": 0)"), "hand.seconds: 0: must be more than 0"},
  });
}

TEST(BadScenes, ContactOfWhatCannotTouchOrWithImpossibleValuesIsRefused) {
  const auto contact = [](const std::string& members) { return scene_with("\"contact\": {" + members + "}"); };
  EXPECT_EQ(refusal_of(contact(R"("points": true, "springs": false, "faces": false, "restitution": 1)")), "");
  expect_refused({
      {scene_with("\"contact\": true"), "contact: true: must be an object {...}"},
      {contact(R"("points": 1)"), "contact.points: 1: must be true or false"},
      {contact(R"("springs": 1)"), "contact.springs: 1: must be true or false"},
      {contact(R"("faces": "all")"), "contact.faces: \"all\": must be true or false"},
      {contact(R"("thickness": -0.1)"), "contact.thickness: -0.1: must be at least 0"},
      {contact(R"("restitution": 1.5)"), "contact.restitution: 1.5: must be from 0 to 1"},
      {contact(R"("friction": -1)"), "contact.friction: -1: must be at least 0"},
  });
}

TEST(BadScenes, SyntaxIsRefusedWithTheLine) {
  expect_refused({
      {"", "line 1: empty: must be a JSON object {...}"},
      {" \n ", "line 1: empty: must be a JSON object {...}"},
      {"[1, 2]", "line 1: not an object: must be {...}"},
      {"\n5", "line 2: not an object: must be {...}"},
      {"{", "line 1: unexpected end of the file"},
      {"{\"hooke\": 1, \"points\": [", "line 1: unexpected end of the file"},
      {"{\"hooke\": 1,\n\"points\": [{\"position\": [0, 0", "line 2: unexpected end of the file"},
      {"{\"hooke\": 1}\n}", "line 2: The document root must not be followed by other values"},
      {"{\"hooke\": 1,}", "line 1: Missing a name for object member"},
      {"{\"hooke\": 1,\n // a comment\n \"points\": []}", "line 2: Missing a name for object member"},
      {"{\"hooke\": 1,\n\"drag\": NaN}", "line 2: drag: NaN: must be a JSON value (numbers are finite)"},
      {"{\"hooke\": 1,\n\"drag\": Infinity}", "line 2: drag: Infinity: must be a JSON value (numbers are finite)"},
      {"{\"hooke\": 1,\n\"drag\": -inf}", "line 2: drag: -inf: must be a JSON value (numbers are finite)"},
      {"{\"hooke\": 1,\n\"drag\": 01}", "line 2: Missing a comma or '}' after an object member"},
      {"{\"hooke\": 1,\n\"drag\": .5}", "line 2: drag: .5: must be a JSON value (numbers are finite)"},
      {"{\"hooke\": 1, 'drag': 1}", "line 1: Missing a name for object member"},
      {"\xef\xbb\xbf{\"hooke\": 1}", "line 1: a byte order mark: must begin with {"},
      {"{\"hooke\": 1,\n\"name\": \"\xff\"}", "line 2: invalid UTF-8 in a string"},
      {"{\"hooke\": 1,\n\"name\": \"\xc0\x80\"}", "line 2: invalid UTF-8 in a string"},
      {"{\"hooke\": 1,\n\"name\": \"\\udc00\"}", "line 2: a lone surrogate: must be UTF-8"},
      {"{\"hooke\": 1,\n\"name\": \"\\ud800x\"}", "line 2: The surrogate pair in string is invalid"},
      {std::string("{\"hooke\": 1}\0", 13), "line 1: a zero byte: must be JSON text"},
      {"{\"points\": [{\"position\": [0, 1, 0]}, {\"position\": [0, nan, 0]}]}",
       "line 1: points[1].position[1]: nan: must be a JSON value (numbers are finite)"},
      {"solid begin of a mesh", "line 1: scene: solid: must be a JSON value (numbers are finite)"},
  });
}

TEST(BadScenes, TheVersionMustBeSupported) {
  expect_refused({
      {"{}", "Not a Hooke scene: \"hooke\": 1 is missing"},
      {R"({"hooke": 2})", "hooke: 2: must be at most 1: scenes of version 2 need a newer Hooke"},
      {R"({"hooke": 1.5})", "hooke: 1.5: must be at most 1: scenes of version 1.5 need a newer Hooke"},
      {R"({"hooke": 0})", "hooke: 0: must be a whole number from 1 to 1"},
      {R"({"hooke": "1"})", "hooke: \"1\": must be a number"},
  });
}

TEST(BadScenes, TheSameKeyTwiceIsRefusedAtEveryLevel) {
  expect_refused({
      {R"({"hooke": 1, "hooke": 1})", "hooke: given twice: each key must be unique in its object"},
      {point_with(R"("mass": 1, "mass": 2)"), "points[0].mass: given twice: each key must be unique in its object"},
      {scene_with(R"("view": {"camera": {"eye": [0, 0, 1], "eye": [0, 0, 1]}})"),
       "view.camera.eye: given twice: each key must be unique in its object"},
      {scene_with(R"("mine": [{"a": 1}, {"b": [{"c": 1, "c": 2}]}])"),
       "mine[1].b[0].c: given twice: each key must be unique in its object"},
  });
}

TEST(BadScenes, SizesBeyondTheLimitsAreRefused) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(refusal_of(scene_with("\"mine\": " + nested(31))), "");
  const std::string long_text(4097, 'x');
  std::string many = "[0";
  for (int i = 0; i < 1'000'000; ++i) many += ",0";
  expect_refused({
      {scene_with("\"mine\":\n" + nested(32)), "line 2: nesting: 33: must be at most 32"},
      {scene_with("\"mine\":\n" + std::string(1'000'000, '[')), "line 2: nesting: 33: must be at most 32"},
      {scene_with("\"name\": \"" + long_text + "\""), "name: \"" + std::string(40, 'x') + "...\": 4097 bytes: must be at most 4096"},
      {scene_with("\"" + long_text + "\": 1"),
       std::string(60, 'x') + "...: \"" + std::string(40, 'x') + "...\": 4097 bytes: must be at most 4096"},
      {scene_with("\"mine\": [1, \"" + long_text + "\"]"),
       "mine[1]: \"" + std::string(40, 'x') + "...\": 4097 bytes: must be at most 4096"},
      {scene_with("\"mine\": " + many + "]"), "mine: 1000001 values: must be at most 1000000"},
      {cloth_with(R"("stiffness": 1, "points": [2, 2], "nail": )" + many + "]"), "generators[0]: 1000001 values: must be at most 1000000"},
  });
}

TEST(BadScenes, NumbersMustBeWithinTheirLimits) {
  expect_refused({
      {point_with(R"("mass": 1e400)"), "points[0].mass: 1e400: must be a number below 1.8e308"},
      {R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [0, -1e999, 0]}]})",
       "points[1].position[1]: -1e999: must be a number below 1.8e308"},
      {scene_with(R"("drag": 100e307)"), "drag: 100e307: must be a number below 1.8e308"},
      {scene_with(R"("mine": 1e400)"), "mine: 1e400: must be a number below 1.8e308"},
      {scene_with(R"("drag": )" + std::string(400, '9')), "drag: " + std::string(40, '9') + "...: must be a number below 1.8e308"},
      {scene_with(R"("drag": "1")"), "drag: \"1\": must be a number"},
      {scene_with(R"("drag": null)"), "drag: null: must be a number"},
      {scene_with(R"("drag": [1])"), "drag: [1]: must be a number"},
  });
}

TEST(BadScenes, UnphysicalValuesAreRefused) {
  expect_refused({
      {point_with(R"("mass": 0)"), "points[0].mass: 0: must be more than 0"},
      {point_with(R"("mass": -1)"), "points[0].mass: -1: must be more than 0"},
      {point_with(R"("mass": 1e-310)"), "points[0].mass: 1e-310: must be more than 0; numbers below 2.3e-308 count as 0"},
      {point_with(R"("radius": -0.1)"), "points[0].radius: -0.1: must be at least 0"},
      {spring_with(R"("stiffness": -5)"), "springs[0].stiffness: -5: must be at least 0"},
      {spring_with(R"("stiffness": 1, "damping": -1e-9)"), "springs[0].damping: -1e-09: must be at least 0"},
      {spring_with(R"("stiffness": 1, "rest_length": -1)"), "springs[0].rest_length: -1: must be at least 0"},
      {spring_with(R"("stiffness": 1, "break_strain": 0)"), "springs[0].break_strain: 0: must be more than 0"},
      {scene_with(R"("drag": -1)"), "drag: -1: must be at least 0"},
      {scene_with(R"("simulation": {"frame_rate": 0})"), "simulation.frame_rate: 0: must be more than 0"},
      {scene_with(R"("simulation": {"frame_rate": -60})"), "simulation.frame_rate: -60: must be more than 0"},
      {scene_with(R"("simulation": {"substeps": 0})"), "simulation.substeps: 0: must be a whole number from 1 to 1000000"},
      {scene_with(R"("simulation": {"substeps": 1000001})"), "simulation.substeps: 1000001: must be a whole number from 1 to 1000000"},
      {scene_with(R"("simulation": {"substeps": 2.5})"), "simulation.substeps: 2.5: must be a whole number from 1 to 1000000"},
      {scene_with(R"("simulation": {"speed": 0})"), "simulation.speed: 0: must be more than 0"},
      {scene_with(R"("simulation": {"tolerance": 0})"), "simulation.tolerance: 0: must be more than 0"},
      {scene_with(R"("defaults": {"mass": -1})"), "defaults.mass: -1: must be at least 0"},
      {scene_with(R"("defaults": {"stiffness": -1})"), "defaults.stiffness: -1: must be at least 0"},
      {scene_with(R"("defaults": {"radius": -1})"), "defaults.radius: -1: must be at least 0"},
      {scene_with(R"("defaults": {"grab": "push"})"), "defaults.grab: \"push\": must be \"hold\" or \"pull\""},
      {scene_with(R"("controls": {"stiffness": [5, 1, 0.1]})"),
       "controls.stiffness: [5, 1, 0.1]: must be [min, max, step] with min below max"},
      {scene_with(R"("controls": {"stiffness": [0, 1, 0]})"), "controls.stiffness[2]: 0: must be more than 0"},
  });
}

TEST(BadScenes, FieldsOfTheWrongKindAreRefused) {
  expect_refused({
      {scene_with(R"("name": 5)"), "name: 5: must be a string \"...\""},
      {scene_with(R"("dimensions": 4)"), "dimensions: 4: must be a whole number from 2 to 3"},
      {scene_with(R"("gravity": -9.81)"), "gravity: -9.81: must be a list [...]"},
      {scene_with(R"("gravity": [0])"), "gravity: [0]: must have 2 to 3 items"},
      {scene_with(R"("gravity": [0, 0, 0, 0])"), "gravity: [0, 0, 0, 0]: must have 2 to 3 items"},
      {scene_with(R"("gravity": [0, "a", 0])"), "gravity[1]: \"a\": must be a number"},
      {scene_with(R"("damped_springs": 1)"), "damped_springs: 1: must be true or false"},
      {scene_with(R"("springs": {})"), "springs: {}: must be a list [...]"},
      {scene_with(R"("springs": [5])"), "springs[0]: 5: must be an object {...}"},
      {R"({"hooke": 1, "points": 7})", "points: 7: must be a list [...]"},
      {R"({"hooke": 1, "points": [[0, 0, 0]]})", "points[0]: [0, 0, 0]: must be an object {...}"},
      {R"({"hooke": 1, "points": [{}]})", "points[0].position: missing: must be [x, y, z]"},
      {point_with(R"("nailed": 1)"), "points[0].nailed: 1: must be true or false"},
      {point_with(R"("fixed": "yx")"), R"(points[0].fixed: "yx": must be axes in their order, as "y" or "xz")"},
      {point_with(R"("load": 1)"), "points[0].load: 1: must be a list [...]"},
      {point_with(R"("color": "red")"), "points[0].color: \"red\": must be a color \"#rrggbb\""},
      {point_with(R"("color": "#12345g")"), "points[0].color: \"#12345g\": must be a color \"#rrggbb\""},
      {spring_with(R"("damping": 1)"), "springs[0].stiffness: missing: must be a number of at least 0"},
      {scene_with(R"("springs": [{"stiffness": 1}])"), "springs[0].points: missing: must be two point numbers"},
      {scene_with(R"("springs": [{"stiffness": 1, "points": [0]}])"), "springs[0].points: [0]: must have 2 items"},
      {scene_with(R"("springs": [{"stiffness": 1, "points": [0, 0.5]}])"),
       "springs[0].points[1]: 0.5: must be a whole number from 0 to 4999999"},
      {scene_with(R"("simulation": {"integrator": "magic"})"), "simulation.integrator: \"magic\": must be one of " +
                                                                   [] {
                                                                     std::string ids;
                                                                     for (const Integrator& row : integrators())
                                                                       ids += std::string(row.id) + ", ";
                                                                     return ids + "auto";
                                                                   }()},
      {scene_with(R"("simulation": [])"), "simulation: []: must be an object {...}"},
      {scene_with(R"("view": {"background": "black"})"), "view.background: \"black\": must be a color \"#rrggbb\""},
      {scene_with(R"("view": {"camera": {"eye": [1, 2, 3], "target": [1, 2, 3]}})"),
       "view.camera: {\"eye\": [1, 2, 3], \"target\": [1, 2, 3]}: must have different positions for eye and target"},
      {scene_with(R"("view": {"camera": {"up": [0, 0, 0]}})"), "view.camera.up: [0, 0, 0]: must not be zero"},
  });
}

TEST(BadScenes, SpringsAndFacesMustReferToExistingPoints) {
  expect_refused({
      {scene_with(R"("springs": [{"stiffness": 1, "points": [0, 2]}])"),
       "springs[0].points[1]: 2: must be the number of one of the 2 points, from 0"},
      {scene_with(R"("springs": [{"stiffness": 1, "points": [9, 0]}])"),
       "springs[0].points[0]: 9: must be the number of one of the 2 points, from 0"},
      {scene_with(R"("springs": [{"stiffness": 1, "points": [-1, 0]}])"),
       "springs[0].points[0]: -1: must be a whole number from 0 to 4999999"},
      {scene_with(R"("springs": [{"stiffness": 1, "points": [1, 1]}])"), "springs[0].points: [1, 1]: must be two different points"},
      {scene_with(R"("faces": [[0, 1, 2]])"), "faces[0]: 2: must be the number of one of the 2 points, from 0"},
      {scene_with(R"("faces": [[0, 1, 1]])"), "faces[0]: [0, 1, 1]: must be three different points"},
      {scene_with(R"("faces": [[0, 1]])"), "faces[0]: [0, 1]: must have 3 items"},
      {R"({"hooke": 1, "points": [{"position": [-1e308, 0, 0]}, {"position": [1e308, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": 1}]})",
       "springs[0].rest_length: inf as drawn: must be a number below 1.8e308"},
  });
}

TEST(BadScenes, PositionsMustFitTheDimensions) {
  expect_refused({
      {R"({"hooke": 1, "points": [{"position": [0, 1]}]})", "points[0].position: [0, 1]: must have 3 numbers in a 3-D scene"},
      {R"({"hooke": 1, "points": [{"position": [0, 1, 2]}], "dimensions": 2})",
       "points[0].position: [0, 1, 2]: must have z = 0 in a 2-D scene"},
      {R"({"hooke": 1, "dimensions": 2, "gravity": [0, 0, -9.81]})", "gravity: [0, 0, -9.81]: must have z = 0 in a 2-D scene"},
  });
}

TEST(BadScenes, CollidersMustBeComplete) {
  expect_refused({
      {collider_with(R"("radius": 1)"), "colliders[0].type: missing: must be \"plane\", \"sphere\" or \"box\""},
      {collider_with(R"("type": "cone")"), "colliders[0].type: \"cone\": must be \"plane\", \"sphere\" or \"box\""},
      {collider_with(R"("type": "plane", "point": [0, 0, 0])"), "colliders[0].normal: missing: must be given"},
      {collider_with(R"("type": "plane", "point": [0, 0, 0], "normal": [0, 0, 0])"), "colliders[0].normal: [0, 0, 0]: must not be zero"},
      {collider_with(R"("type": "sphere", "center": [0, 0, 0], "radius": 0)"), "colliders[0].radius: 0: must be more than 0"},
      {collider_with(R"("type": "sphere", "center": [0, 0, 0], "radius": 1, "restitution": 1.1)"),
       "colliders[0].restitution: 1.1: must be from 0 to 1"},
      {collider_with(R"("type": "sphere", "center": [0, 0, 0], "radius": 1, "friction": -1)"),
       "colliders[0].friction: -1: must be at least 0"},
      {collider_with(R"("type": "box", "min": [0, 0, 0], "max": [1, 1, 0])"),
       "colliders[0]: {\"type\": \"box\", \"min\": [0, 0, 0], \"max\": [1, 1, 0]}: must have a min below max in each direction"},
      {collider_with(R"("type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "spin": [0, 1, 0])"),
       "colliders[0].spin: [0, 1, 0]: must not be given for a box, which cannot spin"},
      {collider_with(R"("type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "spin": [1, 1, 0])"),
       "colliders[0].spin: [1, 1, 0]: must be along the normal of the plane"},
  });
}

TEST(BadScenes, GeneratorsAreCheckedBeforeTheyGenerateAnything) {
  expect_refused({
      {R"({"hooke": 1, "generators": [{}]})",
       "generators[0].type: missing: must be one of cloth, rope, hanging_rope, chain, sheet, curtain, flag, net, bridge, jelly"},
      {R"({"hooke": 1, "generators": [{"type": "knot"}]})",
       "generators[0].type: \"knot\": must be one of cloth, rope, hanging_rope, chain, sheet, curtain, flag, net, bridge, jelly"},
      {R"({"hooke": 1, "generators": [{"type": "rope", "points": 2}]})", "generators[0].from: missing: must be [x, y, z]"},
      {rope_with(R"("stiffness": 1)"), "generators[0].points: missing: must be a whole number of at least 2"},
      {rope_with(R"("stiffness": 1, "points": 1)"), "generators[0].points: 1: must be a whole number from 2 to 5000000"},
      {rope_with(R"("stiffness": 1, "points": 5000001)"), "generators[0].points: 5000001: must be a whole number from 2 to 5000000"},
      {rope_with(R"("points": 2)"), "generators[0].stiffness: missing: must be a number of at least 0"},
      {rope_with(R"("points": 2, "stiffness": 1, "mass": 0)"), "generators[0].mass: 0: must be more than 0"},
      {rope_with(R"("points": 2, "stiffness": 1, "mass_model": "lumped")"),
       "generators[0].mass_model: \"lumped\": must be \"equal\" or \"tributary\""},
      {rope_with(R"("points": 2, "stiffness": 1, "nail": ["top"])"),
       "generators[0].nail[0]: \"top\": must be a point number or one of from, to"},
      {rope_with(R"("points": 2, "stiffness": 1, "nail": [2])"), "generators[0].nail[0]: 2: must be a whole number from 0 to 1"},
      {cloth_with(R"("stiffness": 1, "points": [2])"), "generators[0].points: [2]: must have 2 items"},
      {cloth_with(R"("stiffness": 1, "points": [2, 2], "density": 1, "mass": 1)"),
       "generators[0]: {\"type\": \"cloth\", \"corner\": [0, 0, 0], \"across\": [1, 0, 0], ...: must have density or mass, not both"},
      {cloth_with(R"("stiffness": 1, "points": [3000, 3000])"),
       "generators[0].points: [3000, 3000]: 9000000 points: must be at most 5000000"},
      {cloth_with(R"("stiffness": 1, "bend_stiffness": 1, "points": [2000, 2000], "nail": ["border"])"),
       "generators[0].points: [2000, 2000]: 23980002 springs: must be at most 20000000"},
      {cloth_with(R"("stiffness": 1, "points": [5000000, 5000000])"),
       "generators[0].points: [5000000, 5000000]: 25000000000000 points: must be at most 5000000"},
      {cloth_with(R"("stiffness": 1, "points": [2, 2], "density": 3e-308)"),
       "generators[0]: mass of a point: 7.5e-309: must be from 2.3e-308 to 1.7e308"},
      {rope_with(R"("stiffness": 1e308, "mass_model": "tributary", "points": 100)"),
       "generators[0]: stiffness of a spring: inf: must be a number below 1.8e308"},
      {R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [2, 0, 0], "points": [2, 2], "stiffness": 1}]})",
       "generators[0]: {\"type\": \"cloth\", \"corner\": [0, 0, 0], \"across\": [1, 0, 0], ...: must have across and down that span an "
       "area"},
  });
  // each is within the limit, but not together
  const std::string half = R"({"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 2500001, "stiffness": 1})";
  EXPECT_EQ(refusal_of(R"({"hooke": 1, "generators": [)" + half + ", " + half + "]}"),
            "bad.json: points: 5000002 with those of the generators: must be at most 5000000");
}

TEST(BadScenes, ControlCharactersAreShownEscaped) {
  EXPECT_EQ(printable("a\nb\t\x1b[31m\x7f \xff \u2028\u202e \u00e9"), "a\\nb\\t\\u001b[31m\\u007f \\xff \\u2028\\u202e \u00e9");
  try {
    parse_scene("{\"hooke\": 1, \"drag\": \"\\u001b[31m\\n\"}", "a\nb.json");
    FAIL();
  } catch (const InputError& refused) {
    EXPECT_STREQ(refused.what(), "a\\nb.json: drag: \"\\u001B[31m\\n\": must be a number");
  }
}

std::string refusal_of_file(const std::filesystem::path& file) {
  try {
    load_scene(file);
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

TEST(BadSceneFiles, SpecialFilesAreRefusedUnread) {
  const ScratchFolder scratch;
  const std::filesystem::path pipe = scratch.folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal_of_file(pipe), pipe.string() + ": file: a pipe: must be a regular file");
  EXPECT_EQ(refusal_of_file(scratch.folder), scratch.folder.string() + ": file: a folder: must be a regular file");
  EXPECT_EQ(refusal_of_file("/dev/zero"), "/dev/zero: file: a device: must be a regular file");
}

TEST(BadSceneFiles, MoreThan256MiBAreRefusedUnread) {
  const ScratchFolder scratch;
  const std::filesystem::path large = scratch.folder / "large.json";
  std::ofstream(large).close();
  std::filesystem::resize_file(large, max_file_bytes + 1);
  EXPECT_EQ(refusal_of_file(large), large.string() + ": size: 268435457 bytes: must be at most 268435456 (256 MiB)");
}

TEST(BadSceneFiles, EveryTruncationIsRefused) {
  const std::string text = format_scene(load_scene(find_scene("two_masses")).scene);
  // the last two bytes are "}" and a line break
  for (std::size_t length = 0; length + 1 < text.size(); ++length) EXPECT_NE(refusal_of(text.substr(0, length)), "") << length;
}

TEST(BadSceneFiles, AFileThatCannotBeOpenedIsAFileError) {
  const ScratchFolder scratch;
  try {
    load_scene(scratch.folder / "none.json");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.what(), (scratch.folder / "none.json").string() + ": cannot be opened: No such file or directory");
  }
}

}  // namespace
}  // namespace hooke
