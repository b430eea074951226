// Autosaves after a crash, other running instances, and files that others change.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "app/document/session.h"
#include "formats/scene_file.h"
#include "support/document_fixture.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

int copies_in(const Home& home) {
  int count = 0;
  std::error_code error;
  for (const fs::directory_entry& run : fs::directory_iterator(home.state / "runs", error))
    count += fs::exists(run.path() / "scene.json") ? 1 : 0;
  return count;
}

TEST(Recovery, OffersTheAutosaveOfAKilledRunBitForBit) {
  const DocumentFixture fixture;
  State state;
  {
    GuiFixture gui = fixture.open();
    gui.unnail(0);
    // of the start, as in a file, whatever the run does
    state = gui.status().snapshot->state;
    gui.key(Key::Period);
    ASSERT_TRUE(gui.wait_until([&] { return copies_in(fixture.home) == 1; }));
    // without a regular exit, as if it were killed
  }
  GuiFixture gui({}, {}, fixture.home);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Recovery);
  const std::string words = gui.text();
  EXPECT_NE(words.find("net, autosaved at "), std::string::npos) << words;
  EXPECT_NE(words.find("You can restore the last autosave"), std::string::npos) << words;
  press_button(gui, "Unsaved work found", "Later");
  EXPECT_EQ(copies_in(fixture.home), 1);

  // the next start offers it again
  gui.app().panels().open_dialog(Dialog::Kind::Recovery);
  gui.frames(2);
  gui.key(Key::Enter);
  gui.frames(2);
  EXPECT_EQ(gui.app().title(), "Hooke - net*");
  EXPECT_FALSE(gui.system().points()[0].nailed);
  EXPECT_EQ(gui.status().snapshot->state.position, state.position);
  EXPECT_EQ(gui.status().snapshot->state.velocity, state.velocity);
  EXPECT_EQ(gui.status().snapshot->state.time, state.time);
  // this run autosaves it now, until it is saved
  EXPECT_EQ(copies_in(fixture.home), 1);
  gui.key(letter('S'), control);
  EXPECT_EQ(copies_in(fixture.home), 0);
  EXPECT_FALSE(load_scene(fixture.file).scene.system.points()[0].nailed);
}

TEST(Recovery, DiscardedWorkIsNotOfferedAgain) {
  const DocumentFixture fixture;
  {
    GuiFixture gui = fixture.open();
    gui.unnail(0);
    ASSERT_TRUE(gui.wait_until([&] { return copies_in(fixture.home) == 1; }));
  }
  GuiFixture gui({}, {}, fixture.home);
  gui.frames(2);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Recovery);
  const ImGuiWindow* box = ImGui::FindWindowByName("Unsaved work found");
  ASSERT_NE(box, nullptr);
  const int row = 0;
  const ImGuiID button = ImHashStr("Delete", 0, ImHashData(&row, sizeof row, box->ID));
  bool deleted = false;
  for (float y = 0.0f; y < box->Size.y && !deleted; y += 8.0f)
    for (float x = 0.0f; x < box->Size.x && !deleted; x += 24.0f) {
      const glm::dvec2 at(box->Pos.x + x, box->Pos.y + y);
      gui.move(at);
      if (ImGui::GetCurrentContext()->HoveredId != button) continue;
      gui.click(at);
      deleted = copies_in(fixture.home) == 0;
    }
  EXPECT_TRUE(deleted);
  gui.frames(3);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_EQ(copies_in(fixture.home), 0);
}

TEST(Recovery, NoAutosaveIsKeptOfSavedOrDiscardedWork) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  gui.frames(5);
  EXPECT_EQ(copies_in(fixture.home), 0);
  gui.unnail(0);
  ASSERT_TRUE(gui.wait_until([&] { return copies_in(fixture.home) == 1; }));
  gui.key(letter('S'), control);
  EXPECT_EQ(copies_in(fixture.home), 0);
  gui.key(letter('Z'), control);
  ASSERT_TRUE(gui.wait_until([&] { return copies_in(fixture.home) == 1; }));
  gui.key(letter('Q'), control);
  gui.frames(2);
  press_button(gui, "Save changes?", "Discard");
  EXPECT_TRUE(gui.app().is_finished());
  EXPECT_TRUE(fs::is_empty(fixture.home.state / "runs") || copies_in(fixture.home) == 0);
}

TEST(Recovery, AnUnreadableAutosaveIsReportedAndKept) {
  const DocumentFixture fixture;
  {
    GuiFixture gui = fixture.open();
    gui.unnail(0);
    ASSERT_TRUE(gui.wait_until([&] { return copies_in(fixture.home) == 1; }));
  }
  for (const fs::directory_entry& run : fs::directory_iterator(fixture.home.state / "runs"))
    if (run.is_directory()) DocumentFixture::write(run.path() / "scene.json", "{\"hooke\": 1, ");
  GuiFixture gui({}, {}, fixture.home);
  gui.key(Key::Enter);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Message);
  EXPECT_NE(gui.text().find("Cannot restore"), std::string::npos);
  EXPECT_EQ(copies_in(fixture.home), 1);
}

TEST(Sessions, OfRunningWindowsAreNotOfferedForRecovery) {
  const DocumentFixture fixture;
  Session other(fixture.home.state / "runs");
  other.set_document(fixture.file, "Net");
  other.write_autosave("{}");
  {
    const Session session(fixture.home.state / "runs");
    EXPECT_TRUE(session.is_open_elsewhere(fixture.file));
    EXPECT_TRUE(session.is_open_elsewhere(fixture.folder / "state" / ".." / "net.json"));
    EXPECT_FALSE(session.is_open_elsewhere(fixture.folder / "other.json"));
    EXPECT_TRUE(session.recoverable_scenes().empty());
  }
  other.end();
  const Session session(fixture.home.state / "runs");
  EXPECT_FALSE(session.is_open_elsewhere(fixture.file));
}

TEST(Sessions, WithoutAFolderKeepNothingAndContinue) {
  for (const fs::path& folder : {fs::path(), fs::path("/proc/nowhere")}) {
    Session session(folder);
    EXPECT_FALSE(session.is_enabled());
    session.set_document("/a.json", "a");
    session.write_autosave("{}");
    session.delete_autosave();
    EXPECT_TRUE(session.recoverable_scenes().empty());
    session.end();
  }
}

TEST(SecondInstance, OnTheSameFileIsReportedAndAsks) {
  const DocumentFixture fixture;
  Session other(fixture.home.state / "runs");
  other.set_document(fixture.file, "Net");
  {
    GuiFixture gui = fixture.open();
    ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
    EXPECT_NE(gui.text().find("net.json is open in another Hooke window"), std::string::npos);
    gui.key(Key::Escape);
    // a copy: saving asks for a name
    gui.key(letter('S'), control);
    EXPECT_EQ(open_dialog(gui), Dialog::Kind::Save);
  }
  GuiFixture gui = fixture.open();
  press_button(gui, "Message", "Open here too");
  gui.unnail(0);
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_FALSE(load_scene(fixture.file).scene.system.points()[0].nailed);
}

TEST(ChangedFile, IsReportedAndReloadedOrKept) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  Scene larger = two_points();
  const PointId id = larger.system.new_point_id();
  larger.system.append_point({.id = id});
  larger.state.position.emplace_back(0.4, 0.4, 0.0);
  larger.state.velocity.emplace_back(0.0);
  save_scene(larger, fixture.file);
  ASSERT_TRUE(gui.wait_until([&] { return !gui.app().panels().banners.file_notice.empty(); }));
  EXPECT_NE(gui.text().find("net.json was changed by another program."), std::string::npos);
  EXPECT_EQ(gui.system().point_count(), 2);
  press_button(gui, "file", "Reload");
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_TRUE(gui.app().panels().banners.file_notice.empty());
}

TEST(ChangedFile, IsNotReplacedWithoutAsking) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  DocumentFixture::write(fixture.file, "changed elsewhere");
  gui.unnail(0);
  gui.key(letter('S'), control);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().title(), "Hooke - net*");
  std::string text;
  std::getline(std::ifstream(fixture.file), text);
  EXPECT_EQ(text, "changed elsewhere");
  gui.key(letter('S'), control);
  press_button(gui, "Message", "Replace");
  EXPECT_EQ(gui.app().title(), "Hooke - net");
  EXPECT_EQ(load_scene(fixture.file).scene.system.point_count(), 2);
}

TEST(ChangedFile, ThatWasDeletedIsReportedAndCanBeWrittenAgain) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  fs::remove(fixture.file);
  ASSERT_TRUE(gui.wait_until([&] { return !gui.app().panels().banners.file_notice.empty(); }));
  EXPECT_NE(gui.text().find("net.json no longer exists"), std::string::npos);
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_TRUE(fs::exists(fixture.file));
  gui.frames(2);
  EXPECT_EQ(gui.text().find("no longer exists"), std::string::npos);
}

}  // namespace
}  // namespace hooke
