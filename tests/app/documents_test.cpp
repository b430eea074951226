// Documents in the window: recovery after a kill, files open in other windows or changed by other programs, file dialogs.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/document/preferences.h"
#include "app/document/session.h"
#include "app/document/system_dialog.h"
#include "formats/scene_file.h"
#include "support/contents.h"
#include "support/flat_scene.h"
#include "support/gui_trial.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

constexpr Modifiers control{.control = true}, control_shift{.control = true, .shift = true};

Scene two_points() {
  Trial trial;
  const PointId nail = trial.nail({0.0, 0.5, 0.0}), bob = trial.add({0.2, 0.0, 0.0});
  trial.join(nail, bob, 100.0, 0.5);
  return flat_scene("Two points", trial);
}

// The folders of a user; unsaved work is autosaved after one second.
struct OwnDesk {
  ScratchFolder scratch;
  fs::path folder = scratch.folder;
  Home home{folder / "config", folder / "state"};
  fs::path file = folder / "net.json";
  OwnDesk() {
    fs::create_directories(home.config);
    write(home.config / "settings.json", R"({"autosave_seconds": 1})");
    save_scene(two_points(), file);
  }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  GuiTrial open() const { return GuiTrial(load_scene(file).scene, file, home); }
};

// Builds frames until the condition holds, for at most some seconds.
template <class Condition>
bool wait_for(GuiTrial& gui, Condition condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    gui.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

int copies_in(const Home& home) {
  int count = 0;
  std::error_code error;
  for (const fs::directory_entry& run : fs::directory_iterator(home.state / "runs", error))
    count += fs::exists(run.path() / "scene.json") ? 1 : 0;
  return count;
}

Dialog::Kind open_dialog(GuiTrial& gui) { return gui.app().panels().dialog.kind; }

// Presses a button of a dialog by its label.
void press_button(GuiTrial& gui, const char* box, const char* label) {
  gui.frames(2);
  const glm::dvec2 at = gui.find(box, {label});
  ASSERT_GT(at.x, 0.0) << label << " in\n" << gui.words();
  gui.click(at);
  gui.frames(2);
}

TEST(Recovery, OffersTheAutosaveOfAKilledRunBitForBit) {
  const OwnDesk desk;
  State state;
  {
    GuiTrial gui = desk.open();
    gui.key(letter('R'));
    gui.key(Key::Period);
    ASSERT_TRUE(wait_for(gui, [&] { return copies_in(desk.home) == 1; }));
    // without a regular exit, as if it were killed
    state = gui.status().snapshot->state;
  }
  GuiTrial gui({}, {}, desk.home);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Recovery);
  const std::string words = gui.words();
  EXPECT_NE(words.find("net, autosaved at "), std::string::npos) << words;
  press_button(gui, "Unsaved work found", "Later");
  EXPECT_EQ(copies_in(desk.home), 1);

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
  EXPECT_EQ(copies_in(desk.home), 1);
  gui.key(letter('S'), control);
  EXPECT_EQ(copies_in(desk.home), 0);
  EXPECT_FALSE(load_scene(desk.file).scene.system.points()[0].nailed);
}

TEST(Recovery, DiscardedWorkIsNotOfferedAgain) {
  const OwnDesk desk;
  {
    GuiTrial gui = desk.open();
    gui.key(letter('R'));
    ASSERT_TRUE(wait_for(gui, [&] { return copies_in(desk.home) == 1; }));
  }
  GuiTrial gui({}, {}, desk.home);
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
      deleted = copies_in(desk.home) == 0;
    }
  EXPECT_TRUE(deleted);
  gui.frames(3);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_EQ(copies_in(desk.home), 0);
}

TEST(Recovery, NoAutosaveIsKeptOfSavedOrDiscardedWork) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  gui.frames(5);
  EXPECT_EQ(copies_in(desk.home), 0);
  gui.key(letter('R'));
  ASSERT_TRUE(wait_for(gui, [&] { return copies_in(desk.home) == 1; }));
  gui.key(letter('S'), control);
  EXPECT_EQ(copies_in(desk.home), 0);
  gui.key(letter('Z'), control);
  ASSERT_TRUE(wait_for(gui, [&] { return copies_in(desk.home) == 1; }));
  gui.key(letter('Q'), control);
  gui.frames(2);
  press_button(gui, "Save changes?", "Discard");
  EXPECT_TRUE(gui.app().is_finished());
  EXPECT_TRUE(fs::is_empty(desk.home.state / "runs") || copies_in(desk.home) == 0);
}

TEST(Recovery, AnUnreadableAutosaveIsReportedAndKept) {
  const OwnDesk desk;
  {
    GuiTrial gui = desk.open();
    gui.key(letter('R'));
    ASSERT_TRUE(wait_for(gui, [&] { return copies_in(desk.home) == 1; }));
  }
  for (const fs::directory_entry& run : fs::directory_iterator(desk.home.state / "runs"))
    if (run.is_directory()) OwnDesk::write(run.path() / "scene.json", "{\"hooke\": 1, ");
  GuiTrial gui({}, {}, desk.home);
  gui.key(Key::Enter);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Message);
  EXPECT_NE(gui.words().find("Cannot restore"), std::string::npos);
  EXPECT_EQ(copies_in(desk.home), 1);
}

TEST(Sessions, OfRunningWindowsAreNotOfferedForRecovery) {
  const OwnDesk desk;
  Session other(desk.home.state / "runs");
  other.set_document(desk.file, "Net");
  other.keep("{}");
  {
    const Session session(desk.home.state / "runs");
    EXPECT_TRUE(session.is_open_elsewhere(desk.file));
    EXPECT_TRUE(session.is_open_elsewhere(desk.folder / "state" / ".." / "net.json"));
    EXPECT_FALSE(session.is_open_elsewhere(desk.folder / "other.json"));
    EXPECT_TRUE(session.recoverable_scenes().empty());
  }
  other.end();
  const Session session(desk.home.state / "runs");
  EXPECT_FALSE(session.is_open_elsewhere(desk.file));
}

TEST(Sessions, WithoutAFolderKeepNothingAndContinue) {
  for (const fs::path& folder : {fs::path(), fs::path("/proc/nowhere")}) {
    Session session(folder);
    EXPECT_FALSE(session.is_enabled());
    session.set_document("/a.json", "a");
    session.keep("{}");
    session.forget();
    EXPECT_TRUE(session.recoverable_scenes().empty());
    session.end();
  }
}

TEST(SecondInstance, OnTheSameFileIsReportedAndAsks) {
  const OwnDesk desk;
  Session other(desk.home.state / "runs");
  other.set_document(desk.file, "Net");
  {
    GuiTrial gui = desk.open();
    ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
    EXPECT_NE(gui.words().find("net.json is open in another Hooke window"), std::string::npos);
    gui.key(Key::Escape);
    // a copy: saving asks for a name
    gui.key(letter('S'), control);
    EXPECT_EQ(open_dialog(gui), Dialog::Kind::Save);
  }
  GuiTrial gui = desk.open();
  press_button(gui, "Message", "Open here too");
  gui.key(letter('R'));
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_FALSE(load_scene(desk.file).scene.system.points()[0].nailed);
}

TEST(ChangedFile, IsReportedAndReloadedOrKept) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  Scene larger = two_points();
  const PointId id = larger.system.new_point_id();
  larger.system.append_point({.id = id});
  larger.state.position.emplace_back(0.4, 0.4, 0.0);
  larger.state.velocity.emplace_back(0.0);
  save_scene(larger, desk.file);
  ASSERT_TRUE(wait_for(gui, [&] { return !gui.app().panels().file_notice.empty(); }));
  EXPECT_NE(gui.words().find("net.json was changed by another program."), std::string::npos);
  EXPECT_EQ(gui.system().point_count(), 2);
  press_button(gui, "file", "Reload");
  EXPECT_EQ(gui.system().point_count(), 3);
  EXPECT_TRUE(gui.app().panels().file_notice.empty());
}

TEST(ChangedFile, IsNotReplacedWithoutAsking) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  OwnDesk::write(desk.file, "changed elsewhere");
  gui.key(letter('R'));
  gui.key(letter('S'), control);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
  gui.key(Key::Escape);
  EXPECT_EQ(gui.app().title(), "Hooke - net*");
  std::string text;
  std::getline(std::ifstream(desk.file), text);
  EXPECT_EQ(text, "changed elsewhere");
  gui.key(letter('S'), control);
  press_button(gui, "Message", "Replace");
  EXPECT_EQ(gui.app().title(), "Hooke - net");
  EXPECT_EQ(load_scene(desk.file).scene.system.point_count(), 2);
}

TEST(ChangedFile, ThatWasDeletedIsReportedAndCanBeWrittenAgain) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  fs::remove(desk.file);
  ASSERT_TRUE(wait_for(gui, [&] { return !gui.app().panels().file_notice.empty(); }));
  EXPECT_NE(gui.words().find("net.json no longer exists"), std::string::npos);
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_TRUE(fs::exists(desk.file));
  gui.frames(2);
  EXPECT_EQ(gui.words().find("no longer exists"), std::string::npos);
}

// A file size limit has the same effect as a full disk.
TEST(Saving, OnAFullDiskLosesNothingAndReportsIt) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  gui.key(letter('R'));
  const auto size = fs::file_size(desk.file);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{100, before.rlim_max};
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &tight);
  gui.key(letter('S'), control);
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message);
  const std::string words = gui.words();
  EXPECT_NE(words.find("Nothing is lost"), std::string::npos) << words;
  EXPECT_NE(words.find("cannot be written"), std::string::npos) << words;
  EXPECT_EQ(gui.app().title(), "Hooke - net*");
  EXPECT_EQ(fs::file_size(desk.file), size);
  EXPECT_TRUE(load_scene(desk.file).scene.system.points()[0].nailed);
  // once there is space again, saving succeeds
  gui.key(Key::Escape);
  gui.key(letter('S'), control);
  EXPECT_EQ(gui.app().title(), "Hooke - net");
}

TEST(Saving, WithAnUnknownExtensionIsRefusedWithAMessage) {
  const OwnDesk desk;
  GuiTrial gui = desk.open();
  gui.key(letter('S'), control_shift);
  gui.type((desk.folder / "net.xsp").string());
  gui.key(Key::Enter);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Message);
  EXPECT_FALSE(fs::exists(desk.folder / "net.xsp"));
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
void drop_large(GuiTrial& gui, const fs::path& large) {
  save_scene(many_points(), large);
  gui.app().set_task_patience(std::chrono::milliseconds(0));
  gui.waits_for_work = false;
  gui.app().handle(FileDrop{large});
}

TEST(BackgroundTask, OpensALargeFileWhileTheWindowKeepsDrawing) {
  const OwnDesk desk;
  const fs::path large = desk.folder / "dust.json";
  GuiTrial gui = desk.open();
  drop_large(gui, large);
  std::string words;
  for (int i = 0; i < 5; ++i) words = gui.words();
  EXPECT_NE(words.find("Opening dust.json"), std::string::npos) << words;
  EXPECT_EQ(gui.status().snapshot->system->point_count(), 2) << "the document stays until the new one is read";
  ASSERT_TRUE(wait_for(gui, [&] { return gui.status().snapshot->system->point_count() == 100'000; }));
  gui.frames(2);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_EQ(gui.app().title(), "Hooke - dust");
}

TEST(BackgroundTask, CanBeCanceledAndLeavesTheDocumentUnchanged) {
  const OwnDesk desk;
  const fs::path large = desk.folder / "dust.json";
  GuiTrial gui = desk.open();
  drop_large(gui, large);
  gui.frames(2);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Working);
  gui.key(Key::Escape);
  ASSERT_TRUE(wait_for(gui, [&] { return open_dialog(gui) == Dialog::Kind::None; }));
  EXPECT_EQ(gui.status().snapshot->system->point_count(), 2);
  EXPECT_EQ(gui.app().title(), "Hooke - net");
  // the next file opens
  gui.waits_for_work = true;
  gui.app().handle(FileDrop{large});
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 100'000);
}

TEST(BackgroundTask, OfSavingCanBeCanceledBeforeTheOldFileIsTouched) {
  const OwnDesk desk;
  const fs::path large = desk.folder / "dust.json";
  save_scene(many_points(), large);
  const auto written = fs::last_write_time(large);
  GuiTrial gui(load_scene(large).scene, large, desk.home);
  gui.key(letter('A'), control);
  gui.key(Key::Delete);
  gui.key(letter('Z'), control);
  ASSERT_EQ(gui.app().title(), "Hooke - dust*");
  gui.app().set_task_patience(std::chrono::milliseconds(0));
  gui.waits_for_work = false;
  gui.app().handle(KeyPress{letter('S'), control});
  gui.frame();
  gui.key(Key::Escape);
  ASSERT_TRUE(wait_for(gui, [&] { return open_dialog(gui) == Dialog::Kind::None; }));
  EXPECT_EQ(gui.app().title(), "Hooke - dust*");
  EXPECT_EQ(fs::last_write_time(large), written);
  EXPECT_EQ(std::distance(fs::directory_iterator(desk.folder), {}), 4) << "net, dust, config, state: no partial file";
  // if it is not canceled, the file is saved and the dialog closes itself
  gui.app().handle(KeyPress{letter('S'), control});
  ASSERT_TRUE(wait_for(gui, [&] { return gui.app().title() == "Hooke - dust"; }));
  EXPECT_EQ(load_scene(large).scene.system.point_count(), 100'000);
}

TEST(Opening, OfAnImportFormatMakesAnUntitledDocument) {
  const OwnDesk desk;
  OwnDesk::write(desk.folder / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  GuiTrial gui = desk.open();
  gui.app().handle(FileDrop{desk.folder / "sheet.obj"});
  gui.frames(2);
  EXPECT_EQ(gui.system().point_count(), 3);
  gui.key(letter('S'), control);
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::Save);
}

TEST(Preferences, ArePersistentAndACorruptFileIsIgnoredWithOneMessage) {
  const OwnDesk desk;
  const Preferences mine{1.5, 20.0, true, true};
  save_preferences(mine, desk.home.config);
  EXPECT_EQ(load_preferences(desk.home.config).preferences, mine);
  for (const char* bad :
       {"{", "[]", "", "{\"interface_scale\": 99}", "{\"interface_scale\": \"large\"}", "\xff\xfe", "{\"a\":1,\"a\":2}"}) {
    OwnDesk::write(desk.home.config / "settings.json", bad);
    {
      GuiTrial gui(two_points(), {}, desk.home);
      ASSERT_EQ(open_dialog(gui), Dialog::Kind::Message) << bad;
      const std::string words = gui.words();
      EXPECT_NE(words.find("Settings ignored; using defaults"), std::string::npos);
      EXPECT_NE(words.find("settings.json.bad"), std::string::npos);
      EXPECT_EQ(gui.app().interface_scale(), 1.0);
    }
    std::string aside;
    std::getline(std::ifstream(desk.home.config / "settings.json.bad"), aside);
    EXPECT_EQ(aside, bad);
    GuiTrial again(two_points(), {}, desk.home);
    EXPECT_EQ(open_dialog(again), Dialog::Kind::None) << bad;
  }
}

TEST(Preferences, ThatAreAFolderOrCannotBeWrittenDoNotStopTheProgram) {
  const OwnDesk desk;
  fs::remove(desk.home.config / "settings.json");
  fs::create_directories(desk.home.config / "settings.json");
  EXPECT_FALSE(load_preferences(desk.home.config).message.empty());
  GuiTrial gui(two_points(), {}, {"/proc/nowhere", "/proc/nowhere"});
  gui.key(letter('='), control);
  EXPECT_EQ(gui.app().interface_scale(), 1.15);
  EXPECT_FALSE(gui.app().is_finished());
}

TEST(Preferences, TheThemeIsPersistent) {
  const OwnDesk desk;
  { GuiTrial(two_points(), {}, desk.home).key(letter('L'), control_shift); }
  EXPECT_EQ(GuiTrial(two_points(), {}, desk.home).app().panels().look, Look::Light);
}

TEST(Preferences, PanelWidthsAreLimitedToTheirRange) {
  const OwnDesk desk;
  {
    GuiTrial gui(two_points(), {}, desk.home);
    for (int i = 0; i < 20; ++i) gui.key(letter('='), control);
    EXPECT_EQ(gui.app().interface_scale(), 3.0);
    for (int i = 0; i < 40; ++i) gui.key(letter('-'), control);
    EXPECT_EQ(gui.app().interface_scale(), 0.75);
  }
  EXPECT_EQ(GuiTrial(two_points(), {}, desk.home).app().interface_scale(), 0.75);
}

TEST(RecentFiles, AreTheNewestWithoutDuplicates) {
  const OwnDesk desk;
  {
    RecentFiles recent(desk.home.state);
    for (int i = 0; i < 20; ++i) recent.add(desk.folder / (std::to_string(i) + ".json"));
    recent.add(desk.folder / "15.json");
    recent.forget(desk.folder / "19.json");
  }
  const RecentFiles recent(desk.home.state);
  ASSERT_EQ(recent.files().size(), RecentFiles::max - 1);
  EXPECT_EQ(recent.files()[0], desk.folder / "15.json");
  EXPECT_EQ(recent.files()[1], desk.folder / "18.json");
  OwnDesk::write(desk.home.state / "recent.json", "{\"files\": 7}");
  EXPECT_TRUE(RecentFiles(desk.home.state).files().empty());
}

TEST(RecentFiles, AreListedInTheMenuAndOpen) {
  const OwnDesk desk;
  { const GuiTrial gui = desk.open(); }
  GuiTrial gui({}, {}, desk.home);
  gui.click({24.0, 18.0});  // File
  gui.frames(3);
  EXPECT_NE(gui.words().find("Open recent"), std::string::npos) << gui.words();
  gui.key(Key::Escape);
  gui.key(letter('O'), control);
  gui.frames(2);
  EXPECT_EQ(gui.app().panels().dialog.browser.folder, desk.folder);
  EXPECT_NE(gui.words().find("net.json"), std::string::npos);
}

TEST(Browser, ListsFoldersFirstAndOnlyReadableFormats) {
  const ScratchFolder scratch;
  for (const char* name : {"b.json", "A.xsp", "c.txt", "d.ply", ".hidden.json"}) OwnDesk::write(scratch.folder / name, "");
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
  const OwnDesk desk;
  fs::create_directories(desk.folder / "inner");
  save_scene(two_points(), desk.folder / "inner" / "deep.json");
  GuiTrial gui = desk.open();
  gui.key(letter('O'), control);
  gui.frames(2);
  // a typed folder is shown, not opened
  gui.type((desk.folder / "inner").string());
  gui.key(Key::Enter);
  ASSERT_EQ(open_dialog(gui), Dialog::Kind::Open);
  EXPECT_EQ(gui.app().panels().dialog.browser.folder, desk.folder / "inner");
  EXPECT_NE(gui.words().find("deep.json"), std::string::npos);
  // a name is relative to it
  gui.frames(2);
  gui.type("deep");
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().title(), "Hooke - deep");
}

TEST(Paths, AreRelativeToTheFolderShown) {
  const ScratchFolder scratch;
  fs::create_directories(scratch.folder / "some.folder");
  OwnDesk::write(scratch.folder / "bare", "");
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
    OwnDesk::write(program, "#!/bin/sh\nprintf '%s\\n' \"$@\" > '" + (scratch.folder / "called").string() + "'\necho '" + answer +
                                "'\nexit " + std::to_string(code) + "\n");
    ::chmod(program.c_str(), 0700);
    ::setenv("PATH", (scratch.folder.string() + ":" + path).c_str(), 1);
  }
  ~FakeDialog() { ::setenv("PATH", path.c_str(), 1); }
  std::string called() const { return contents(scratch.folder / "called"); }
};

TEST(DesktopDialog, ReturnsAFile) {
  const OwnDesk desk;
  const FakeDialog fake("zenity", desk.file.string(), 0);
  GuiTrial gui({}, {}, desk.home);
  gui.key(letter('O'), control);
  press_button(gui, "Open scene", "System dialog");
  EXPECT_EQ(open_dialog(gui), Dialog::Kind::None);
  EXPECT_TRUE(wait_for(gui, [&] { return gui.app().title() == "Hooke - net"; }));
  EXPECT_NE(fake.called().find("--file-selection\n"), std::string::npos);
}

TEST(DesktopDialog, IfCanceledChangesNothing) {
  const OwnDesk desk;
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
  OwnDesk::write(fake.scratch.folder / "zenity", "#!/bin/sh\nexec sleep 1000\n");
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
