// The gallery: its thumbnails are what Hooke draws, and its cards open their scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "formats/gallery.h"
#include "support/gui_fixture.h"
#include "support/picture.h"
#include "thumbnail.h"

namespace hooke {
namespace {

const ShippedScene& shipped(std::string_view id) { return *std::ranges::find(shipped_scenes(), id, &ShippedScene::id); }

TEST(Thumbnails, EverySceneHasOneAndTheirTotalSizeIsSmall) {
  std::uintmax_t bytes = 0;
  for (const ShippedScene& scene : shipped_scenes()) {
    const Image image = read_png(thumbnail_file(scene));
    EXPECT_EQ(image.width, thumbnail_width) << scene.id;
    EXPECT_EQ(image.height, 2 * thumbnail_height) << scene.id;
    bytes += std::filesystem::file_size(thumbnail_file(scene));
  }
  EXPECT_LT(bytes, 50'000u * shipped_scenes().size());
}

TEST(Thumbnails, NoneIsLeftFromADeletedScene) {
  for (const auto& file : std::filesystem::directory_iterator(thumbnail_file(shipped_scenes().front()).parent_path()))
    EXPECT_TRUE(std::ranges::any_of(shipped_scenes(), [&](const ShippedScene& scene) { return thumbnail_file(scene) == file.path(); }))
        << file.path();
}

// Scenes of each group, with surfaces, lines, textures and solids. Other vector widths and drivers change single pixels.
TEST(Thumbnails, AreWhatHookeDraws) {
  const Offscreen offscreen;
  View view;
  for (const char* id : {"cloth", "cloth_on_ball", "damping_ratios", "normal_modes", "two_masses", "jelly_cubes", "rope_64"})
    EXPECT_LT(difference(render_thumbnail(view, shipped(id)), read_png(thumbnail_file(shipped(id)))), 0.02) << id;
}

TEST(Thumbnails, OfTwoScenesDiffer) {
  EXPECT_GT(difference(read_png(thumbnail_file(shipped("cloth"))), read_png(thumbnail_file(shipped("curtain")))), 0.2);
}

TEST(Thumbnails, TheContactSheetContainsAllInOrder) {
  const Picture sheet = read_thumbnails();
  const std::size_t number = 7;
  const Image one = read_png(thumbnail_file(shipped_scenes()[number]));
  const int left = number % thumbnail_columns * thumbnail_width, top = number / thumbnail_columns * 2 * thumbnail_height;
  for (const auto& [x, y] : {std::pair{0, 0}, {thumbnail_width - 1, 0}, {150, 90}, {thumbnail_width - 1, 2 * thumbnail_height - 1}})
    EXPECT_EQ(at(sheet, left + x, top + y), at(one, x, y));
}

TEST(GalleryPage, ShowsEveryGroupAndTheInstructionsOfItsScenes) {
  GuiFixture gui;
  EXPECT_EQ(gui.text().find("Gallery"), std::string::npos);
  gui.key(letter('G'));
  ImGui::GetIO().DisplaySize = {1280.0f, 6000.0f};
  gui.app().resize({1280.0, 6000.0}, 1.0);
  gui.frames(2);
  const std::string words = gui.text();
  for (const GalleryCard& card : gallery_cards()) {
    EXPECT_NE(words.find(card.scene->group), std::string::npos) << card.scene->group;
    EXPECT_NE(words.find(card.scene->title), std::string::npos) << card.scene->title;
    // its first word that is long enough to be distinctive
    const std::string begin = card.description.substr(0, card.description.find(' ', 3));
    EXPECT_GT(card.description.size(), 40u) << card.scene->id;
    EXPECT_NE(words.find(begin), std::string::npos) << begin;
  }
  gui.key(Key::Escape);
  EXPECT_EQ(gui.text().find("Gallery"), std::string::npos);
}

TEST(GalleryPage, AClickOnACardOpensItsSceneAndClosesThePage) {
  GuiFixture gui;
  gui.key(letter('G'));
  gui.click(gui.find("gallery", {"cloth_swing"}));
  EXPECT_EQ(gui.status().document->name, "Cloth swing");
  EXPECT_FALSE(gui.app().panels().gallery.is_shown);
}

TEST(GalleryPage, ArrowKeysAndEnterOpenAScene) {
  GuiFixture gui;
  gui.key(letter('G'));
  gui.key(Key::Right);
  gui.key(Key::Right);
  gui.key(Key::Left);
  gui.key(Key::Enter);
  EXPECT_EQ(gui.status().document->name, shipped_scenes()[1].title);
}

TEST(GalleryPage, AsksBeforeChangesAreLost) {
  GuiFixture gui;
  gui.key(letter('A'));
  gui.click({500.0, 400.0});
  ASSERT_TRUE(gui.status().history.unsaved);
  gui.key(letter('G'));
  gui.key(Key::Enter);
  EXPECT_EQ(gui.app().panels().dialog.kind, Dialog::Kind::Unsaved);
  EXPECT_EQ(gui.system().point_count(), 1);
  gui.key(Key::Escape);
  EXPECT_TRUE(gui.app().panels().gallery.is_shown);
  EXPECT_EQ(gui.system().point_count(), 1);
}

TEST(GalleryPage, KeepsKeysAndClicksFromTheScene) {
  GuiFixture gui;
  gui.key(letter('A'));
  gui.key(letter('G'));
  gui.click({500.0, 60.0});
  gui.key(Key::Space);
  EXPECT_FALSE(gui.status().run.running);
  EXPECT_EQ(gui.system().point_count(), 0);
}

}  // namespace
}  // namespace hooke
