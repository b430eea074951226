// The real window under Xvfb, driven by mouse and keys; judged by what it saves, not only by what it shows.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/tools/tool_context.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "support/desktop.h"
#include "support/picture.h"
#include "ui/layout.h"

namespace hooke {
namespace {

// Builds a net by hand in the scene `assignment` and saves it.
class Session {
 public:
  Session() { start({"assignment"}); }

  void start(const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {HOOKE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    program = Process(words, output());
  }
  std::filesystem::path output() const { return desktop.folder() / "output"; }

  // The screen position of a position in the scene.
  glm::dvec2 on_screen(const Vec3& place) const {
    const Scene scene = load_scene(find_scene("assignment")).scene;
    const Rect rect = lay_out(Desktop::width, Desktop::height, 1.0).scene;
    const Camera camera = make_scene_camera(scene.view, scene.system, scene.state, rect.width / rect.height);
    const Vec3 seen = camera.project(place, {rect.width, rect.height});
    return glm::round(glm::dvec2(rect.x + seen.x, rect.y + seen.y));
  }

  void save_as(const std::filesystem::path& to) {
    file = to;
    write("s", to);
  }
  // The state of the run, whereas the file of the scene contains its start.
  void save_present_state(const std::filesystem::path& to) { write("e", to); }
  // Saves the state of the run until it is as expected.
  bool shows(const std::function<bool(const Scene&)>& expected) {
    return wait_for([&] {
      std::filesystem::remove(present());
      save_present_state(present());
      return wait_for([&] { return std::filesystem::exists(present()); }, 5.0) && expected(shown());
    });
  }
  Scene shown() const { return load_scene(present()).scene; }
  // Saves until the file is as expected.
  bool saves(const std::function<bool(const Scene&)>& expected) {
    return wait_for([&] {
      std::filesystem::remove(file);
      desktop.control("s");
      return wait_for([&] { return std::filesystem::exists(file); }, 5.0) && expected(saved());
    });
  }
  Scene saved() const { return load_scene(file).scene; }

 private:
  // Types the path into the dialog that this key opens with Ctrl and Shift.
  void write(const std::string& key, const std::filesystem::path& to) {
    desktop.run_xdotool("keydown ctrl keydown shift");
    desktop.key(key);
    desktop.run_xdotool("keyup shift keyup ctrl");
    rest(0.3);
    desktop.control("a");
    desktop.type(to.string());
    desktop.key("Return");
  }
  std::filesystem::path present() const { return desktop.folder() / "present.json"; }

 public:
  Desktop desktop;
  Process program;
  std::filesystem::path file;
};

double gap(const Scene& scene, Index point, const Vec3& place) { return glm::distance(scene.state.position[point], place); }

// The size of a screen pixel in the scene [m].
constexpr double pixel = 0.005;

// The program is stopped while the keys are pressed and released, as in a frame that takes long.
TEST(Window, SelectsAllInTheSaveDialogWithKeysOfOneFrame) {
  Session session;
  Desktop& desktop = session.desktop;
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment"));
  rest(1.5);
  desktop.run_xdotool("key --delay 100 ctrl+shift+s");
  rest(1.0);
  desktop.key("End");
  session.program.signal(SIGSTOP);
  desktop.run_xdotool("key ctrl+a");
  session.program.signal(SIGCONT);
  rest(0.5);
  const std::filesystem::path to = desktop.folder() / "all.json";
  desktop.type(to.string());
  desktop.key("Return");
  EXPECT_TRUE(desktop.wait_for_title("Hooke - all"));
  EXPECT_TRUE(std::filesystem::exists(to));
}

TEST(Window, BuildsRunsDragsReleasesUndoesSavesAndReopens) {
  const Vec3 top(-0.2, 0.5, 0.0), middle(0.1, 0.3, 0.0), bottom(0.3, 0.1, 0.0), loose(-0.6, -0.7, 0.0);
  Session session;
  Desktop& desktop = session.desktop;
  ASSERT_TRUE(desktop.is_up());
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment"));
  rest(1.5);  // the title appears before the window is mapped, and keys are received only then

  // three points and a separate one
  desktop.key("a");
  for (const Vec3& place : {top, middle, bottom, loose}) desktop.click(session.on_screen(place));
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment*"));
  session.save_as(desktop.folder() / "net.json");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - net"));
  ASSERT_EQ(session.saved().system.point_count(), 4);
  EXPECT_LT(gap(session.saved(), 1, middle), pixel);

  // two springs, one by two clicks and one by a drag; one nail
  desktop.key("t");
  desktop.click(session.on_screen(top));
  desktop.click(session.on_screen(middle));
  desktop.drag(session.on_screen(middle), session.on_screen(bottom));
  desktop.key("n");
  desktop.click(session.on_screen(top));
  ASSERT_TRUE(session.saves([](const Scene& scene) { return scene.system.spring_count() == 2 && scene.system.points()[0].nailed; }));
  EXPECT_NEAR(session.saved().system.springs()[0].rest_length, glm::distance(top, middle), 2.0 * pixel);
  desktop.save_screenshot("window_built.png");

  // during the run the nail stays, the rest moves, and the separate point comes to rest on the ground
  desktop.key("space");
  const double ground = -1.0 + 0.02;
  ASSERT_TRUE(session.shows(
      [&](const Scene& scene) { return std::abs(scene.state.position[3].y - ground) < 1e-6 && gap(scene, 2, bottom) > 0.05; }));
  EXPECT_LT(gap(session.shown(), 0, top), pixel);
  desktop.save_screenshot("window_running.png");

  // during the run the hand grabs the separate point, releases it, and moves the nailed one
  desktop.key("d");
  const Vec3 lying = session.shown().state.position[3], lifted(-0.6, -0.3, 0.0), moved(-0.1, 0.6, 0.0);
  desktop.press(session.on_screen(lying));
  desktop.move(session.on_screen(lifted));
  EXPECT_TRUE(session.shows([&](const Scene& scene) { return gap(scene, 3, lifted) < 2.0 * pixel; }));
  desktop.release();
  EXPECT_TRUE(session.shows([&](const Scene& scene) { return std::abs(scene.state.position[3].y - ground) < 1e-6; }));
  desktop.drag(session.on_screen(top), session.on_screen(moved));
  EXPECT_TRUE(session.shows([&](const Scene& scene) { return gap(scene, 0, moved) < 2.0 * pixel && scene.system.points()[0].nailed; }));

  // the nail is released, and undo restores it
  desktop.key("r");
  EXPECT_TRUE(session.shows([](const Scene& scene) { return !scene.system.points()[0].nailed && scene.state.position[0].y < 0.0; }));
  desktop.key("space");
  rest(0.2);
  desktop.control("z");
  EXPECT_TRUE(session.saves([](const Scene& scene) { return scene.system.points()[0].nailed; }));

  // quits without a question, and reopens the saved file
  const Scene last = session.saved();
  desktop.control("q");
  EXPECT_EQ(session.program.exit_code(), 0);
  EXPECT_EQ(contents(session.output()), "");
  session.start({session.file.string()});
  ASSERT_TRUE(desktop.wait_for_title("Hooke - net"));
  rest(1.5);
  session.save_as(desktop.folder() / "again.json");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - again"));
  const Scene again = session.saved();
  EXPECT_EQ(again.state.position, last.state.position);
  EXPECT_EQ(again.state.velocity, last.state.velocity);
  EXPECT_EQ(again.system, last.system);
  desktop.save_screenshot("window_reopened.png");
}

TEST(Window, SavesAPictureOfTheSceneWithoutPanels) {
  Session session;
  Desktop& desktop = session.desktop;
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment"));
  rest(1.5);
  session.save_as(desktop.folder() / "net.json");
  ASSERT_TRUE(desktop.wait_for_title("Hooke - net"));
  const std::filesystem::path file = desktop.folder() / "net.png";
  EXPECT_TRUE(wait_for([&] {
    desktop.control("p");
    return std::filesystem::exists(file);
  }));
  rest(0.5);
  const Image picture = read_png(file);
  const Rect scene = lay_out(Desktop::width, Desktop::height, 1.0).scene;
  EXPECT_EQ(picture.width, static_cast<int>(scene.width));
  EXPECT_EQ(picture.height, static_cast<int>(scene.height));
}

TEST(Window, AsksBeforeChangesAreLostAndEscNeverQuits) {
  Session session;
  Desktop& desktop = session.desktop;
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment"));
  rest(1.5);  // the title appears before the window is mapped, and keys are received only then
  desktop.key("Escape");
  desktop.key("a");
  desktop.click(session.on_screen(Vec3(0.0)));
  ASSERT_TRUE(desktop.wait_for_title("Hooke - Assignment*"));
  desktop.control("q");
  rest(0.3);
  EXPECT_TRUE(session.program.is_running());
  desktop.save_screenshot("window_unsaved.png");
  desktop.key("Escape");
  desktop.key("Escape");
  desktop.control("z");
  EXPECT_TRUE(session.program.is_running());
  // quit without saving: the second button
  desktop.control("q");
  rest(0.3);
  desktop.click({0.5 * Desktop::width, 0.42 * Desktop::height + 26.0});
  EXPECT_EQ(session.program.exit_code(), 0);
}

// The position of a point that moves freely at 0.1 m/s shows the time.
TEST(Window, ResumesWithoutAJumpAfterBeingSuspended) {
  constexpr double speed = 0.1, stood_still = 6.0;
  Session session;
  Desktop& desktop = session.desktop;
  const std::filesystem::path file = desktop.folder() / "flight.json";
  std::ofstream(file) << R"({"hooke": 1, "name": "Flight", "dimensions": 2, "gravity": [0, 0, 0],)"
                      << R"( "points": [{"position": [0, 0, 0], "velocity": [0.1, 0, 0]}]})";
  session.start({file.string()});
  ASSERT_TRUE(desktop.wait_for_title("Hooke - flight"));

  const auto start = std::chrono::steady_clock::now();
  desktop.key("space");
  rest(0.5);
  session.program.signal(SIGSTOP);
  rest(stood_still);
  session.program.signal(SIGCONT);
  rest(0.3);
  desktop.key("space");
  const double real = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double simulated = 0.0;
  ASSERT_TRUE(session.shows([&](const Scene& scene) {
    simulated = scene.state.position[0].x / speed;
    return true;
  }));
  EXPECT_GT(simulated, 0.1);
  // keys may take a while on a busy machine, but not as long as the suspension
  EXPECT_LT(simulated, real - 0.5 * stood_still);
}

// Without the strain legend, which is drawn over the scene only in the window.
Image cut(const Image& image, const Rect& part) {
  constexpr int legend_width = 220, legend_height = 80;
  const int x = static_cast<int>(part.x), y = static_cast<int>(part.y);
  Image made{static_cast<int>(part.width), static_cast<int>(part.height), {}};
  for (int row = 0; row < made.height; ++row)
    for (int column = 0; column < made.width; ++column) {
      const bool of_legend = row >= made.height - legend_height && column < legend_width;
      const Color color = of_legend ? Color{} : at(image, x + column, y + row);
      made.pixels.insert(made.pixels.end(), {color.red, color.green, color.blue});
    }
  return made;
}

TEST(Window, ShowsTheSamePictureAsIsDrawnWithoutADisplay) {
  // a cloth that has reached the ball
  Session session;
  Desktop& desktop = session.desktop;
  Lab lab(load_scene(find_scene("cloth_on_ball")).scene);
  for (int frame = 0; frame < 45; ++frame) lab.step();
  const std::filesystem::path file = desktop.folder() / "fallen.json";
  save_scene(lab.scene(), file);

  session.start({file.string()});
  ASSERT_TRUE(desktop.wait_for_title("Hooke - fallen"));
  desktop.move({4.0, Desktop::height - 4.0});
  const Rect place = lay_out(Desktop::width, Desktop::height, 1.0).scene;

  const Lab opened(load_scene(file).scene);
  const int width = static_cast<int>(place.width), height = static_cast<int>(place.height);
  const Scene& scene = opened.scene();
  const Camera camera = make_scene_camera(scene.view, scene.system, scene.state, place.width / place.height);
  const Offscreen offscreen;
  View view;
  const ViewOptions options = options_for(scene.view, scene.cloth_texture);
  view.draw(*opened.status()->snapshot, {}, camera, options, width, height, nullptr);
  const Image drawn = cut(view.read(), {0.0, 0.0, place.width, place.height});
  // when it is on the screen
  Image shown;
  wait_for([&] {
    desktop.save_screenshot("window_fallen.png");
    shown = cut(read_png("window_fallen.png"), place);
    return difference(shown, drawn) <= 0.002;
  });
  EXPECT_LE(difference(shown, drawn), 0.002);

  // another frame gives another picture
  view.draw(*Lab(load_scene(find_scene("cloth_on_ball")).scene).status()->snapshot, {}, camera, options, width, height, nullptr);
  EXPECT_GT(difference(shown, cut(view.read(), {0.0, 0.0, place.width, place.height})), 0.02);
}

TEST(CommandLine, WithoutADisplayTheWindowReportsItInOneLine) {
  const std::filesystem::path output = std::filesystem::temp_directory_path() / ("hooke_line_" + std::to_string(::getpid()));
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", HOOKE_PROGRAM});
    return Process(words, output).exit_code();
  };
  const auto lines = [&] { return std::ranges::count(contents(output), '\n'); };
  EXPECT_EQ(run({"cloth"}), 5);
  EXPECT_EQ(lines(), 1);
  EXPECT_EQ(contents(output).find("hooke: cannot open a window"), 0u);
  EXPECT_EQ(run({"no_such_scene"}), 5);
  EXPECT_EQ(lines(), 1);
  EXPECT_EQ(run({"--no-such-option"}), 2);
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_EQ(contents(output).find("hooke " HOOKE_VERSION "\nGPU: "), 0u);
  EXPECT_EQ(lines(), 2);
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_NE(contents(output).find("SCENE"), std::string::npos);
  std::filesystem::remove(output);
}

}  // namespace
}  // namespace hooke
