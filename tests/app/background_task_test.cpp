// Saving and opening large files in the background.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>

#include "formats/scene_file.h"
#include "support/document_fixture.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A file size limit has the same effect as a full disk.
TEST(Saving, OnAFullDiskLosesNothingAndReportsIt) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  gui.unnail(0);
  const auto size = fs::file_size(fixture.file);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{100, before.rlim_max};
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &tight);
  gui.key(letter('S'), control);
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
  const std::string words = gui.text();
  EXPECT_NE(words.find("Nothing is lost"), std::string::npos) << words;
  EXPECT_NE(words.find("cannot be written"), std::string::npos) << words;
  EXPECT_EQ(gui.app().title(), "Hooke - net*");
  EXPECT_EQ(fs::file_size(fixture.file), size);
  EXPECT_TRUE(load_scene(fixture.file).scene.system.points()[0].nailed);
  // once there is space again, saving succeeds
  gui.key(Key::Escape);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().title(), "Hooke - net");
}

TEST(Saving, WithAnUnknownExtensionIsRefusedWithAMessage) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  gui.key(letter('S'), control_shift);
  gui.type((fixture.folder / "net.xsp").string());
  gui.key(Key::Enter);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Message);
  EXPECT_FALSE(fs::exists(fixture.folder / "net.xsp"));
}

// Unconnected points, so many that reading and writing them takes many frames.
Scene many_points() {
  Scene scene;
  scene.name = "Dust";
  std::vector<Point> points(100'000);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    points[i].id = PointId{i};
    scene.state.position.push_back({0.001 * i, std::sin(i), std::cos(i)});
    scene.state.velocity.push_back({0.1, -0.2, 0.3});
  }
  scene.system.set_points(std::move(points));
  return scene;
}

// In a window that keeps drawing frames meanwhile.
void drop_large(GuiFixture& gui, const fs::path& large) {
  save_scene(many_points(), large);
  gui.app().set_task_patience(std::chrono::milliseconds(0));
  gui.waits_for_work = false;
  gui.app().handle(FileDrop{large});
}

TEST(BackgroundTask, OpensALargeFileWhileTheWindowKeepsDrawing) {
  const DocumentFixture fixture;
  const fs::path large = fixture.folder / "dust.json";
  GuiFixture gui = fixture.open();
  drop_large(gui, large);
  std::string words;
  for (int i = 0; i < 5; ++i) words = gui.text();
  EXPECT_NE(words.find("Opening dust.json"), std::string::npos) << words;
  EXPECT_EQ(gui.status().snapshot->system->point_count(), 2) << "the document stays until the new one is read";
  ASSERT_TRUE(gui.wait_until([&] { return gui.status().snapshot->system->point_count() == 100'000; }));
  gui.frames(2);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_EQ(gui.app().title(), "Hooke - dust");
}

TEST(BackgroundTask, CanBeCanceledAndLeavesTheDocumentUnchanged) {
  const DocumentFixture fixture;
  const fs::path large = fixture.folder / "dust.json";
  GuiFixture gui = fixture.open();
  drop_large(gui, large);
  gui.frames(2);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Working);
  gui.key(Key::Escape);
  ASSERT_TRUE(gui.wait_until([&] { return open_dialog(gui) == Dialog::Kind::None; }));
  EXPECT_EQ(gui.status().snapshot->system->point_count(), 2);
  EXPECT_EQ(gui.app().title(), "Hooke - net");
  // the next file opens
  gui.waits_for_work = true;
  gui.app().handle(FileDrop{large});
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 100'000);
}

TEST(BackgroundTask, OfSavingCanBeCanceledBeforeTheOldFileIsTouched) {
  const DocumentFixture fixture;
  const fs::path large = fixture.folder / "dust.json";
  save_scene(many_points(), large);
  const auto written = fs::last_write_time(large);
  GuiFixture gui(load_scene(large).scene, large, fixture.home);
  gui.key(letter('A'), control);
  gui.key(Key::Delete);
  gui.key(letter('Z'), control);
  ASSERT_EQ(gui.app().title(), "Hooke - dust");
  gui.key(Key::Right);
  ASSERT_EQ(gui.app().title(), "Hooke - dust*");
  gui.app().set_task_patience(std::chrono::milliseconds(0));
  gui.waits_for_work = false;
  gui.app().handle(KeyPress{letter('S'), control});
  gui.frame();
  gui.key(Key::Escape);
  ASSERT_TRUE(gui.wait_until([&] { return open_dialog(gui) == Dialog::Kind::None; }));
  EXPECT_EQ(gui.app().title(), "Hooke - dust*");
  EXPECT_EQ(fs::last_write_time(large), written);
  EXPECT_EQ(std::distance(fs::directory_iterator(fixture.folder), {}), 4) << "net, dust, config, state: no partial file";
  // if it is not canceled, the file is saved and the dialog closes itself
  gui.app().handle(KeyPress{letter('S'), control});
  ASSERT_TRUE(gui.wait_until([&] { return gui.app().title() == "Hooke - dust"; }));
  EXPECT_EQ(load_scene(large).scene.system.point_count(), 100'000);
}

TEST(Opening, OfAnImportFormatMakesAnUntitledDocument) {
  const DocumentFixture fixture;
  DocumentFixture::write(fixture.folder / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  GuiFixture gui = fixture.open();
  gui.app().handle(FileDrop{fixture.folder / "sheet.obj"});
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 3);
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Save);

  // nor does an export propose to replace the file that was imported
  gui.key(Key::Escape);
  gui.key(letter('E'), control);
  EXPECT_EQ(gui.app().panels().export_state.path, (fixture.folder / "sheet 2.obj").string());
}

}  // namespace
}  // namespace hooke
