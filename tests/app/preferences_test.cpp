// Preferences, recent files and the dialogs that choose a file.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/document/preferences.h"
#include "app/document/system_dialog.h"
#include "formats/scene_file.h"
#include "support/contents.h"
#include "support/document_fixture.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

TEST(Preferences, ArePersistentAndACorruptFileIsIgnoredWithOneMessage) {
  const DocumentFixture fixture;
  const Preferences mine{1.5, 20.0, true, true};
  save_preferences(mine, fixture.home.config);
  EXPECT_EQ(load_preferences(fixture.home.config).preferences, mine);
  for (const char* bad :
       {"{", "[]", "", "{\"interface_scale\": 99}", "{\"interface_scale\": \"large\"}", "\xff\xfe", "{\"a\":1,\"a\":2}"}) {
    DocumentFixture::write(fixture.home.config / "settings.json", bad);
    {
      GuiFixture gui(two_points(), {}, fixture.home);
      ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message) << bad;
      const std::string words = gui.text();
      EXPECT_NE(words.find("Settings ignored; using defaults"), std::string::npos);
      EXPECT_NE(words.find("settings.json.bad"), std::string::npos);
      EXPECT_EQ(gui.app().interface_scale(), 1.0);
    }
    std::string aside;
    std::getline(std::ifstream(fixture.home.config / "settings.json.bad"), aside);
    EXPECT_EQ(aside, bad);
    GuiFixture again(two_points(), {}, fixture.home);
    EXPECT_EQ(open_dialog(again), Dialog::Kind::None) << bad;
  }
}

TEST(Preferences, ThatAreAFolderOrCannotBeWrittenDoNotStopTheProgram) {
  const DocumentFixture fixture;
  fs::remove(fixture.home.config / "settings.json");
  fs::create_directories(fixture.home.config / "settings.json");
  EXPECT_FALSE(load_preferences(fixture.home.config).message.empty());
  GuiFixture gui(two_points(), {}, {"/proc/nowhere", "/proc/nowhere"});
  gui.key(letter('='), control);
  EXPECT_EQ(gui.app().interface_scale(), 1.15);
  EXPECT_FALSE(gui.app().is_finished());
}

TEST(Preferences, WhetherTheAccuracyIsMeasuredIsPersistent) {
  const DocumentFixture desk;
  {
    GuiFixture gui(two_points(), {}, desk.home);
    EXPECT_TRUE(gui.status().accuracy.is_on);
    gui.app().handle(Request(Control(SetAccuracy{AccuracyMode::Off})));
    gui.frames(2);
    EXPECT_FALSE(gui.status().accuracy.is_on);
  }
  {
    GuiFixture again(two_points(), {}, desk.home);
    EXPECT_FALSE(again.status().accuracy.is_on);
    again.app().handle(Request(Control(SetAccuracy{AccuracyMode::Full})));
  }
  GuiFixture last(two_points(), {}, desk.home);
  EXPECT_TRUE(last.status().accuracy.is_on);
}

TEST(Preferences, TheThemeIsPersistent) {
  const DocumentFixture fixture;
  { GuiFixture(two_points(), {}, fixture.home).key(letter('L'), control_shift); }
  EXPECT_EQ(GuiFixture(two_points(), {}, fixture.home).app().panels().look, Look::Light);
}

TEST(Preferences, PanelWidthsAreLimitedToTheirRange) {
  const DocumentFixture fixture;
  {
    GuiFixture gui(two_points(), {}, fixture.home);
    for (int i = 0; i < 20; ++i) gui.key(letter('='), control);
    EXPECT_EQ(gui.app().interface_scale(), 3.0);
    for (int i = 0; i < 40; ++i) gui.key(letter('-'), control);
    EXPECT_EQ(gui.app().interface_scale(), 0.75);
  }
  EXPECT_EQ(GuiFixture(two_points(), {}, fixture.home).app().interface_scale(), 0.75);
}

TEST(RecentFiles, AreTheNewestWithoutDuplicates) {
  const DocumentFixture fixture;
  {
    RecentFiles recent(fixture.home.state);
    for (int i = 0; i < 20; ++i) recent.add(fixture.folder / (std::to_string(i) + ".json"));
    recent.add(fixture.folder / "15.json");
    recent.remove(fixture.folder / "19.json");
  }
  const RecentFiles recent(fixture.home.state);
  ASSERT_EQ(recent.files().size(), RecentFiles::max - 1);
  EXPECT_EQ(recent.files()[0], fixture.folder / "15.json");
  EXPECT_EQ(recent.files()[1], fixture.folder / "18.json");
  DocumentFixture::write(fixture.home.state / "recent.json", "{\"files\": 7}");
  EXPECT_TRUE(RecentFiles(fixture.home.state).files().empty());
}

TEST(RecentFiles, AreListedInTheMenuAndOpen) {
  const DocumentFixture fixture;
  { const GuiFixture gui = fixture.open(); }
  GuiFixture gui({}, {}, fixture.home);
  gui.click({24.0, 18.0});  // File
  gui.frames(3);
  EXPECT_NE(gui.text().find("Open recent"), std::string::npos) << gui.text();
  gui.key(Key::Escape);
  gui.key(letter('O'), control);
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().dialog.browser.folder, fixture.folder);
  EXPECT_NE(gui.text().find("net.json"), std::string::npos);
}

TEST(Browser, ListsFoldersFirstAndOnlyReadableFormats) {
  const ScratchFolder scratch;
  for (const char* name : {"b.json", "A.xsp", "c.txt", "d.ply", ".hidden.json"}) DocumentFixture::write(scratch.folder / name, "");
  fs::create_directories(scratch.folder / "zoo");
  const auto wanted = [](const fs::path& file) { return file.extension() != ".txt"; };
  const FolderListing listing = list_folder(scratch.folder, wanted);
  std::string names;
  for (const FolderItem& item : listing.items) names += item.name + " ";
  EXPECT_EQ(names, "zoo A.xsp b.json d.ply ");
  EXPECT_TRUE(list_folder(scratch.folder, wanted, 2).truncated);
  EXPECT_FALSE(list_folder(scratch.folder / "none", wanted).error.empty());
}

TEST(Browser, EntersFoldersAndOpensByDoubleClick) {
  const DocumentFixture fixture;
  fs::create_directories(fixture.folder / "inner");
  save_scene(two_points(), fixture.folder / "inner" / "deep.json");
  GuiFixture gui = fixture.open();
  gui.key(letter('O'), control);
  gui.frames(2);
  // a typed folder is shown, not opened
  gui.type((fixture.folder / "inner").string());
  gui.key(Key::Enter);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Open);
  EXPECT_EQ(gui.app().panels().dialog.browser.folder, fixture.folder / "inner");
  EXPECT_NE(gui.text().find("deep.json"), std::string::npos);
  // a name is relative to it
  gui.frames(2);
  gui.type("deep");
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().title(), "Hooke - deep");
}

TEST(Paths, AreRelativeToTheFolderShown) {
  const ScratchFolder scratch;
  fs::create_directories(scratch.folder / "some.folder");
  DocumentFixture::write(scratch.folder / "bare", "");
  EXPECT_EQ(resolve_typed_path("net", scratch.folder), scratch.folder / "net.json");
  EXPECT_EQ(resolve_typed_path("../x.xsp", "/a/b"), "/a/x.xsp");
  EXPECT_EQ(resolve_typed_path("/a/net", "/b"), "/a/net.json");
  EXPECT_EQ(resolve_typed_path("bare", scratch.folder), scratch.folder / "bare");
  EXPECT_EQ(resolve_typed_path("~", "/b"), home_folder());
}

// A program that records its arguments and prints a prepared answer.
struct FakeDialog {
  ScratchFolder scratch;
  std::string path = std::getenv("PATH");
  FakeDialog(const char* name, const std::string& answer, int code) {
    const fs::path program = scratch.folder / name;
    DocumentFixture::write(program, "#!/bin/sh\nprintf '%s\\n' \"$@\" > '" + (scratch.folder / "called").string() + "'\necho '" + answer +
                                        "'\nexit " + std::to_string(code) + "\n");
    ::chmod(program.c_str(), 0700);
    ::setenv("PATH", (scratch.folder.string() + ":" + path).c_str(), 1);
  }
  ~FakeDialog() { ::setenv("PATH", path.c_str(), 1); }
  std::string called() const { return contents(scratch.folder / "called"); }
};

TEST(DesktopDialog, ReturnsAFile) {
  const DocumentFixture fixture;
  const FakeDialog fake("zenity", fixture.file.string(), 0);
  GuiFixture gui({}, {}, fixture.home);
  gui.key(letter('O'), control);
  press_button(gui, "Open scene", "System dialog");
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_TRUE(gui.wait_until([&] { return gui.app().title() == "Hooke - net"; }));
  EXPECT_NE(fake.called().find("--file-selection\n"), std::string::npos);
}

TEST(DesktopDialog, IfCanceledChangesNothing) {
  const DocumentFixture fixture;
  const FakeDialog fake("zenity", "/somewhere.json", 1);
  SystemDialog dialog;
  ASSERT_TRUE(dialog.start(SystemDialog::Kind::Save, "/a; rm -rf $HOME.json"));
  std::optional<fs::path> answer;
  for (int i = 0; i < 1000 && !answer; ++i) {
    answer = dialog.take_answer();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->empty());
  EXPECT_FALSE(dialog.is_open());
  // the name is passed on as it is, not through a shell
  EXPECT_NE(fake.called().find("--filename=/a; rm -rf $HOME.json\n"), std::string::npos);
}

TEST(DesktopDialog, IsClosedTogetherWithItsOwner) {
  ScratchFolder scratch;
  const FakeDialog fake("zenity", "/x.json", 0);
  DocumentFixture::write(fake.scratch.folder / "zenity", "#!/bin/sh\nexec sleep 1000\n");
  SystemDialog dialog;
  ASSERT_TRUE(dialog.start(SystemDialog::Kind::Open, "/"));
  EXPECT_FALSE(dialog.take_answer());
}

TEST(Homes, FollowTheXdgSpecification) {
  const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
  ::setenv("HOME", "/home/somebody", 1);
  ::setenv("XDG_CONFIG_HOME", "/c", 1);
  ::setenv("XDG_STATE_HOME", "relative", 1);
  EXPECT_EQ(xdg_home().config, "/c/hooke");
  EXPECT_EQ(xdg_home().state, "/home/somebody/.local/state/hooke");
  ::unsetenv("XDG_CONFIG_HOME");
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(xdg_home().config, "/home/somebody/.config/hooke");
  ::unsetenv("HOME");
  EXPECT_EQ(xdg_home().state, "");
  ::setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace hooke
