// Ctrl+E: every format is written correctly, and failures are reported and do no damage.
#include <gtest/gtest.h>

#include <sstream>

#include "formats/open_file.h"
#include "support/contents.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

// The export dialog opened by its keys on a shipped scene, with a format and a path.
class Export {
 public:
  Export(const std::string& scene, std::string_view extension) : gui_(load_scene(find_scene(scene)).scene) {
    gui_.key(letter('E'), {.control = true});
    ExportState& box = gui_.app().panels().export_state;
    EXPECT_TRUE(box.is_shown);
    leave_field();
    while (export_kinds()[box.kind].extension != extension) ++box.kind;
    box.path = file(extension).string();
  }
  std::filesystem::path file(std::string_view extension) const { return scratch_.folder / ("out" + std::string(extension)); }
  ExportState& box() { return gui_.app().panels().export_state; }
  GuiFixture& gui() { return gui_; }
  Dialog& dialog() { return gui_.app().panels().dialog; }
  bool is_running() { return gui_.app().exporter().is_running(); }
  // No text field is active, so that values set by a test stay.
  void leave_field() {
    ImGui::ClearActiveID();
    gui_.frame();
  }
  void run() {
    gui_.key(Key::Enter);
    EXPECT_TRUE(gui_.wait_until([&] { return !is_running(); }));
    EXPECT_FALSE(is_running());
  }

 private:
  ScratchFolder scratch_;
  GuiFixture gui_;
};

// A scene without a file, such as an imported mesh, has the name of its title.
TEST(Export, TheDialogOffersEveryFormatAndSetsTheExtension) {
  GuiFixture gui(load_scene(find_scene("two_masses")).scene);
  gui.key(letter('E'), {.control = true});
  const std::string words = gui.text();
  for (const FileKind& kind : export_kinds()) EXPECT_NE(words.find(kind.label), std::string::npos) << kind.label;
  EXPECT_TRUE(gui.app().panels().export_state.path.ends_with("/Two masses.obj")) << gui.app().panels().export_state.path;
  gui.click(gui.find("export", {"Table (.csv)"}));
  EXPECT_TRUE(gui.app().panels().export_state.path.ends_with("/Two masses.csv")) << gui.app().panels().export_state.path;
  gui.key(Key::Escape);
  EXPECT_FALSE(gui.app().panels().export_state.is_shown);
}

TEST(Export, OffersNoQuantitiesAlongZForAFlatScene) {
  for (const auto& [scene, is_flat] : {std::pair{"two_masses", true}, std::pair{"trampoline", false}}) {
    Export csv(scene, ".csv");
    const std::string words = csv.gui().text();
    EXPECT_NE(words.find("angular_z"), std::string::npos);
    for (const char* name : {"momentum_z", "angular_x", "center_z"})
      EXPECT_EQ(words.find(name) == std::string::npos, is_flat) << scene << " " << name;
  }
}

TEST(Export, MeshesContainTheSurface) {
  Export obj("trampoline", ".obj");
  obj.run();
  EXPECT_EQ(load_file(obj.file(".obj")).scene.system.faces.size(), std::size_t{2 * 30 * 30});
  EXPECT_FALSE(obj.box().is_shown);
}

TEST(Export, APolygonFileContainsTheStrain) {
  Export ply("trampoline", ".ply");
  ply.run();
  EXPECT_NE(contents(ply.file(".ply")).find("strain"), std::string::npos);
}

TEST(Export, ATableHasOneRowPerFrameWithTheChosenQuantities) {
  Export csv("damping_ratios", ".csv");
  csv.box().seconds = 0.5;
  csv.box().quantities = "time, y1,largest_strain";
  csv.run();
  std::istringstream lines(contents(csv.file(".csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time [s],y1 [m],largest_strain [1]");
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 8), "0,-0.45,") << line;
  int rows = 1;
  while (std::getline(lines, line)) ++rows;
  EXPECT_EQ(rows, 31);
  EXPECT_EQ(csv.gui().status().snapshot->state.time, 0.0) << "the run on the screen is unchanged";
}

TEST(Export, PlotsAreWrittenAsShown) {
  Export csv("two_masses", ".csv");
  ++csv.box().kind;
  ASSERT_EQ(export_kinds()[csv.box().kind].label, "Plots");
  csv.run();
  EXPECT_NE(csv.dialog().text.find("no plots"), std::string::npos) << csv.dialog().text;
  csv.gui().key(Key::Enter);
  csv.gui().app().panels().export_state.is_shown = false;
  csv.gui().key(letter('P'));
  csv.gui().key(Key::Period);
  csv.gui().key(letter('E'), {.control = true});
  csv.leave_field();
  csv.box().path = csv.file(".csv").string();
  csv.run();
  EXPECT_NE(contents(csv.file(".csv")).find("kinetic"), std::string::npos);
}

TEST(Export, APointCacheContainsEveryFrame) {
  Export pc2("damping_ratios", ".pc2");
  pc2.box().seconds = 0.5;
  pc2.run();
  EXPECT_EQ(contents(pc2.file(".pc2")).size(), 32u + 31u * 10u * 12u);
  EXPECT_FALSE(std::filesystem::exists(pc2.file(".pc2.part")));
}

TEST(Export, AFlatSceneIsWrittenAsXspringies) {
  Export xsp("two_masses_bouncy", ".xsp");
  xsp.run();
  EXPECT_EQ(load_file(xsp.file(".xsp")).scene.system.point_count(), 2);
}

TEST(Export, A3DSceneIsRefusedByXspringiesWithTheReason) {
  Export xsp("rope", ".xsp");
  xsp.run();
  EXPECT_EQ(xsp.dialog().kind, Dialog::Kind::Message);
  EXPECT_FALSE(std::filesystem::exists(xsp.file(".xsp")));
}

TEST(Export, APictureIsRequestedFromTheWindow) {
  Export png("two_masses", ".png");
  png.run();
  const auto wanted = png.gui().app().captures().take_wanted_picture();
  ASSERT_TRUE(wanted);
  EXPECT_EQ(wanted->file, png.file(".png"));
  EXPECT_FALSE(png.gui().app().captures().take_wanted_picture());
}

// The fields of the dialog, as they are typed, decide what is drawn.
TEST(Export, AFilmHasTheSizeAndTheBackgroundOfTheDialog) {
  for (const bool transparent : {false, true}) {
    Export film("two_masses", ".webp");
    GuiFixture& gui = film.gui();
    gui.frames(3);
    for (const auto& [label, pixels] : {std::pair{"Width", "320"}, {"Height", "180"}}) {
      const glm::dvec2 at = gui.find("export", {label, "##typed"});
      ASSERT_GT(at.x, 0.0) << label;
      gui.click(at);
      gui.type(pixels);
      const ImGuiWindow& box = *GuiFixture::find_window("export");
      gui.click({box.Pos.x + 0.5 * box.Size.x, box.Pos.y + 6.0});
    }
    if (transparent) gui.click(gui.find("export", {"Transparent background"}));
    film.run();
    FilmRecorder& recorder = gui.app().captures().film_recorder();
    ASSERT_TRUE(recorder.is_filming()) << film.dialog().text;
    PictureOptions wanted;
    const auto draw = [&](const PictureOptions& options) {
      wanted = options;
      return Picture{.width = options.width, .height = options.height, .pixels = std::vector<std::uint8_t>(std::size_t{3} * 320 * 180)};
    };
    recorder.take(0.0, draw);
    EXPECT_EQ(wanted.width, 0) << "the frame that asks for the film shows the dialog";
    recorder.take(0.1, draw);
    EXPECT_EQ(wanted.width, 320);
    EXPECT_EQ(wanted.height, 180);
    EXPECT_EQ(wanted.transparent, transparent);
    EXPECT_FALSE(wanted.panels);
    recorder.end_film();
    EXPECT_TRUE(gui.wait_until([&] { return !recorder.is_writing(); }));
    EXPECT_EQ(contents(film.file(".webp")).substr(8, 4), "WEBP");
  }
}

TEST(Export, AnUnknownQuantityIsReported) {
  Export csv("two_masses", ".csv");
  csv.box().quantities = "time, y7";
  csv.run();
  EXPECT_NE(csv.dialog().text.find("\"y7\" is not a quantity"), std::string::npos) << csv.dialog().text;
  EXPECT_FALSE(std::filesystem::exists(csv.file(".csv")));
}

TEST(Export, ToAMissingFolderIsReported) {
  for (const char* extension : {".obj", ".csv", ".pc2"}) {
    Export box("two_masses", extension);
    box.box().path = (box.file("").parent_path() / "nowhere" / ("out" + std::string(extension))).string();
    box.run();
    EXPECT_EQ(box.dialog().kind, Dialog::Kind::Message) << extension;
    EXPECT_FALSE(box.gui().status().history.unsaved);
  }
}

TEST(Export, WritesNothingIfCanceled) {
  Export csv("cloth", ".csv");
  csv.box().seconds = 600.0;
  csv.gui().key(Key::Enter);
  ASSERT_TRUE(csv.is_running());
  csv.gui().key(Key::Escape);
  EXPECT_TRUE(csv.gui().wait_until([&] { return !csv.is_running(); }));
  EXPECT_FALSE(csv.is_running());
  EXPECT_FALSE(std::filesystem::exists(csv.file(".csv")));
}

TEST(Export, PlotsAreDrawnAsAChart) {
  for (const bool spectrum : {false, true}) {
    Export svg("two_masses", ".svg");
    svg.gui().key(Key::Escape);
    svg.gui().key(letter('P'));
    svg.gui().key(Key::Space);
    ASSERT_TRUE(svg.gui().wait_until([&] { return svg.gui().status().snapshot->state.time > 0.5; }));
    svg.gui().key(Key::Space);
    svg.gui().app().panels().plots.shows_spectrum = spectrum;
    svg.box().is_shown = true;
    svg.gui().frames(2);
    svg.leave_field();
    svg.run();
    EXPECT_NE(contents(svg.file(".svg")).find(spectrum ? "frequency [Hz]" : "time [s]"), std::string::npos) << svg.dialog().text;
  }
}

}  // namespace
}  // namespace hooke
