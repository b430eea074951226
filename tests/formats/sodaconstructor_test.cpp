// Models of Sodaconstructor 2.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/file_kind.h"

namespace hooke {
namespace {

std::string field_text(const std::string& name, const std::string& value, const std::string& kind = "double") {
  return "<field name=\"" + name + "\">\n<" + kind + ">" + value + "</" + kind + "></field>";
}

std::string object_text(const std::string& kind, int number, const std::string& fields) {
  return "<object id=\"" + kind + "#" + std::to_string(number) + "\" type=\"com.sodaplay.soda.constructor2.model." + kind + "\">" + fields +
         "</object>";
}

std::string listed_text(const std::string& name, const std::string& objects) {
  return "<field name=\"" + name + "\"><list class=\"java.util.Vector\">" + objects + "</list></field>";
}

struct SodaModel {
  std::string direction = "forward", link = "Muscle", end = "Mass#2", rest_length = "40", extra = "";

  std::string text() const {
    const std::string ends = "<field name=\"a\"><ref refid=\"Node#1\" /></field><field name=\"b\"><ref refid=\"" + end + "\" /></field>";
    const std::string wave = object_text("Wave", 1,
                                         field_text("amplitude", "0.5") + field_text("direction", direction, "string") +
                                             field_text("phase", "0.125") + field_text("speed", "2.0E-2"));
    const std::string nodes =
        object_text("Node", 1, field_text("x", "100") + field_text("y", "200")) +
        object_text("Mass", 2, field_text("vx", "2") + field_text("vy", "0") + field_text("x", "100") + field_text("y", "150"));
    const std::string springs =
        object_text(link, 1, ends + field_text("amplitude", "0.5") + field_text("phase", "0.25") + field_text("restLength", rest_length));
    const std::string content = field_text("friction", "0.1") + field_text("gravity", "0.4") + field_text("gravityDirection", "1", "int") +
                                listed_text("nodes", nodes) + listed_text("springs", springs) + field_text("springyness", "0.2") +
                                field_text("surfaceReflection", "-0.75") + "<field name=\"wave\">" + wave + "</field>" + extra;
    return "<object id=\"ConstructorApplication#1\" type=\"x\"><field name=\"model\">" + object_text("Model", 1, content) +
           "</field></object>";
  }
};

LoadedScene read_model(const std::string& text) { return find_file_kind("hanging.xml")->parse(text, "hanging.xml", {}); }

std::string refused(const std::string& text) {
  try {
    read_model(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Sodaconstructor, AModelBecomesAScene) {
  const LoadedScene loaded = read_model(SodaModel().text());
  const Scene& scene = loaded.scene;
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(scene.name, "hanging");
  EXPECT_EQ(scene.system.dimensions, 2);
  EXPECT_EQ(scene.state.position, (std::vector<Vec3>{{1, 2, 0}, {1, 1.5, 0}}));
  EXPECT_EQ(scene.state.velocity, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(scene.system.points()[0].nailed);
  EXPECT_FALSE(scene.system.points()[1].nailed);
  EXPECT_DOUBLE_EQ(scene.system.springs()[0].stiffness, 500.0);
  EXPECT_DOUBLE_EQ(scene.system.springs()[0].rest_length, 0.4);
  EXPECT_DOUBLE_EQ(scene.system.gravity.y, -10.0);
  EXPECT_DOUBLE_EQ(scene.system.drag, -50.0 * std::log(0.9));
  EXPECT_EQ(scene.system.colliders[0].restitution, 0.75);
  const SpringLaw muscle = scene.system.springs()[0].law.value();
  EXPECT_DOUBLE_EQ(muscle.amplitude, 0.25);
  EXPECT_DOUBLE_EQ(muscle.frequency, 1.0);
  EXPECT_NEAR(std::sin(muscle.phase), std::sin(std::numbers::pi / 4.0), 1e-15);
}

TEST(Sodaconstructor, TheDirectionOfTheWaveIsThatOfTime) {
  const auto rest_length = [](const std::string& direction, double time) {
    const Spring spring = read_model(SodaModel{.direction = direction}.text()).scene.system.springs()[0];
    return rest_length_at(*spring.law, spring.rest_length, time).length;
  };
  for (const double t : {0.0, 0.1, 0.37}) EXPECT_NEAR(rest_length("forward", t), rest_length("reverse", -t), 1e-12);
}

TEST(Sodaconstructor, ASpringIsNoMuscle) { EXPECT_FALSE(read_model(SodaModel{.link = "Spring"}.text()).scene.system.springs()[0].law); }

TEST(Sodaconstructor, AnythingElseIsRefusedInOneLine) {
  EXPECT_EQ(refused(""), "hanging.xml: line 1: XML: No document element found");
  EXPECT_EQ(refused("<a>\n<b>\n</a>"), "hanging.xml: line 3: XML: Start-end tags mismatch");
  EXPECT_EQ(refused("<object id='x'/>"), "hanging.xml: object: must be a model of Sodaconstructor 2");
  EXPECT_EQ(refused("<!DOCTYPE a><a/>"), "hanging.xml: object: must be a model of Sodaconstructor 2");
  EXPECT_EQ(refused(SodaModel{.end = "Mass#9"}.text()), "hanging.xml: Muscle#1.b: must be a mass of the model");
  EXPECT_EQ(refused(SodaModel{.end = "Node#1"}.text()), "hanging.xml: Muscle#1.b: must be another mass than a");
  EXPECT_EQ(refused(SodaModel{.rest_length = "inf"}.text()), "hanging.xml: Muscle#1.restLength: \"inf\": must be a number");
  EXPECT_EQ(refused(SodaModel{.rest_length = ""}.text()), "hanging.xml: Muscle#1.restLength: \"\": must be a number");
  EXPECT_EQ(refused(SodaModel{.rest_length = "-1"}.text()), "hanging.xml: Muscle#1.restLength: \"-1\": must be from 0 to 1000000000");
}

}  // namespace
}  // namespace hooke
