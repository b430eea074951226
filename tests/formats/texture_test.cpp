// Textures: which files a scene may name, what is read from them, and the texture coordinates of points.
#include <gtest/gtest.h>

#include "formats/texture.h"

#include <sys/resource.h>
#include <zlib.h>

#include <fstream>

#include "base/errors.h"
#include "edit/command.h"
#include "formats/scene_file.h"
#include "support/picture.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

const std::string sheet =
    R"({"type": "cloth", "corner": [0, 0, 0], "across": [2, 0, 0], "down": [0, -1, 0], "points": [3, 2], "stiffness": 10})";

std::string scene_with(const std::string& view, const std::string& more = "") {
  return R"({"hooke": 1, "generators": [)" + sheet + "]" + more + R"(, "view": {)" + view + "}}";
}

std::string refusal(const std::filesystem::path& file) {
  try {
    load_scene(file);
    return "";
  } catch (const InputError& refused) {
    return refused.what();
  }
}

// A folder with a scene whose texture is `texture`.
struct Folder : ScratchFolder {
  std::filesystem::path scene = folder / "scene.json";
  void write(const std::filesystem::path& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  void name(const std::string& texture) const { write("scene.json", scene_with(R"("texture": ")" + texture + "\"")); }
  std::string refused(const std::string& texture) const {
    name(texture);
    std::string message = refusal(scene);
    if (message.starts_with(scene.string() + ": ")) message.erase(0, scene.string().size() + 2);
    return message;
  }
};

TEST(Texture, APngInTheFolderOfTheSceneIsRead) {
  const Folder folder;
  std::filesystem::create_directory(folder.folder / "pictures");
  write_png(Image{2, 1, {255, 0, 0, 0, 0, 255}}, folder.folder / "pictures/two.PNG");
  folder.name("pictures/two.PNG");
  const LoadedScene loaded = load_scene(folder.scene);
  EXPECT_TRUE(loaded.warnings.empty());
  ASSERT_TRUE(loaded.scene.cloth_texture.picture);
  EXPECT_EQ(loaded.scene.cloth_texture.picture->width, 2);
  EXPECT_EQ(loaded.scene.cloth_texture.picture->height, 1);
  EXPECT_EQ(loaded.scene.cloth_texture.picture->pixels, (std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255}));
  EXPECT_EQ(loaded.scene.cloth_texture.width, 2.0);  // as wide as the cloth
}

TEST(Texture, APathWithDotsThatStaysInTheFolderIsRead) {
  const Folder folder;
  std::filesystem::create_directory(folder.folder / "sub");
  write_png(Image{1, 1, {1, 2, 3}}, folder.folder / "sub/ok.png");
  for (const char* path : {"./sub/ok.png", "sub/./ok.png", "sub/../sub/ok.png"}) {
    folder.name(path);
    EXPECT_TRUE(load_scene(folder.scene).scene.cloth_texture.picture) << path;
  }
}

// The rule of docs/reference/scene-format.md: a name and the ".." after it cancel, whether or not there is such a folder.
TEST(Texture, APathIsTakenLiterallyAndMustNotLeaveTheFolderOnItsWay) {
  const Folder folder;
  write_png(Image{1, 1, {1, 2, 3}}, folder.folder / "ok.png");
  folder.name("missing/../ok.png");
  EXPECT_TRUE(load_scene(folder.scene).scene.cloth_texture.picture);
  const std::string own_name = folder.folder.filename();
  for (const std::string& path : {"../" + own_name + "/ok.png", "./../" + own_name + "/ok.png", "a/../../" + own_name + "/ok.png"})
    EXPECT_EQ(folder.refused(path), "view.texture: \"" + path + "\": must be in the folder of the scene");
}

TEST(Texture, AShippedOneIsReadByItsName) {
  const Folder folder;
  for (const ShippedTexture& texture : shipped_textures()) {
    folder.name(std::string(texture.id));
    const Scene scene = load_scene(folder.scene).scene;
    ASSERT_TRUE(scene.cloth_texture.picture) << texture.id;
    EXPECT_GE(scene.cloth_texture.picture->width, 64);
    EXPECT_EQ(scene.cloth_texture.width, texture.width);
  }
}

TEST(Texture, MustBeAShippedOneOrAPngWithinTheFolder) {
  const Folder folder;
  EXPECT_EQ(folder.refused("silk"), "view.texture: \"silk\": must be checker, linen, tartan, or a .png in the folder of the scene");
  for (const char* outside : {"../a.png", "/etc/a.png", "a/../../b.png", "./../b.png"})
    EXPECT_EQ(folder.refused(outside), "view.texture: \"" + std::string(outside) + "\": must be in the folder of the scene");
  EXPECT_NE(folder.refused(R"(a\u0000.png)").find("must be in the folder of the scene"), std::string::npos);
}

TEST(Texture, IsNotReachedThroughALink) {
  const Folder folder;
  const ScratchFolder elsewhere;
  write_png(Image{1, 1, {1, 2, 3}}, elsewhere.folder / "a.png");
  std::filesystem::create_symlink(elsewhere.folder / "a.png", folder.folder / "link.png");
  std::filesystem::create_directory_symlink(elsewhere.folder, folder.folder / "inner");
  for (const char* link : {"link.png", "inner/a.png"})
    EXPECT_EQ(folder.refused(link),
              "view.texture: \"" + std::string(link) + "\": must be in the folder of the scene, and not reached through a link");
}

TEST(Texture, IsRefusedIfItIsNoPngOrTooLarge) {
  const Folder folder;
  write_png(Image{8193, 1, std::vector<std::uint8_t>(3 * 8193)}, folder.folder / "wide.png");
  EXPECT_EQ(folder.refused("wide.png"), "view.texture: \"wide.png\": 8193 x 1 pixels: must be at most 8192 x 8192");
  folder.write("text.png", "no picture");
  EXPECT_NE(folder.refused("text.png").find("must be a PNG"), std::string::npos);
  std::filesystem::create_directory(folder.folder / "folder.png");
  EXPECT_NE(folder.refused("folder.png").find("must be a regular file"), std::string::npos);

  // truncated after the header and within the picture
  write_png(Image{64, 64, std::vector<std::uint8_t>(3 * 64 * 64, 77)}, folder.folder / "whole.png");
  const auto size = std::filesystem::file_size(folder.folder / "whole.png");
  for (const auto kept : {std::uintmax_t{40}, size / 2, size - 20}) {
    std::filesystem::resize_file(folder.folder / "whole.png", kept);
    EXPECT_NE(folder.refused("whole.png").find("must be a PNG"), std::string::npos) << kept;
  }
}

// A chunk of a PNG file: length, type, data and checksum.
std::string png_chunk(const std::string& type, const std::string& data) {
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const std::string checked = type + data;
  return number(data.size()) + checked +
         number(crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())));
}

// `mebibytes` of zeros, compressed.
std::string compressed_zeros(int mebibytes) {
  const std::string zeros(1 << 20, '\0');
  std::string buffer(1 << 14, '\0'), result;
  z_stream stream{};
  EXPECT_EQ(deflateInit(&stream, Z_BEST_SPEED), Z_OK);
  for (int i = 0; i <= mebibytes; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zeros.data()));
    stream.avail_in = i < mebibytes ? static_cast<uInt>(zeros.size()) : 0;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      deflate(&stream, i < mebibytes ? Z_NO_FLUSH : Z_FINISH);
      result.append(buffer, 0, buffer.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
  return result;
}

TEST(Texture, TextBeforeThePixelsIsNeitherReservedNorInflated) {
  const Folder folder;
  const Image square{2, 2, std::vector<std::uint8_t>(3 * 4, 77)};
  write_png(square, folder.folder / "a.png");
  std::stringstream whole;
  whole << std::ifstream(folder.folder / "a.png").rdbuf();
  const std::string bytes = whole.str();
  const std::size_t header = 8 + 12 + 13;
  const auto with = [&](const std::string& chunk) { folder.write("a.png", bytes.substr(0, header) + chunk + bytes.substr(header)); };

  // [KiB]
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak();
  with(png_chunk("zTXt", std::string("a\0\0", 3) + compressed_zeros(400)));
  folder.name("a.png");
  EXPECT_EQ(load_scene(folder.scene).scene.cloth_texture.picture->pixels, square.pixels);
  EXPECT_LT(peak() - before, 200'000);

  with(std::string("\x44\x52\0\3tEXt", 8));
  EXPECT_EQ(folder.refused("a.png"),
            "view.texture: \"a.png\": chunk at byte 33 of 1146224643 bytes, which the file does not have: must be a PNG");
  EXPECT_LT(peak() - before, 200'000);
}

TEST(Texture, AMissingOneIsReported) {
  const Folder folder;
  folder.name("missing.png");
  const LoadedScene loaded = load_scene(folder.scene);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.warnings[0],
            folder.scene.string() + ": view.texture: \"missing.png\": cannot be opened: No such file or directory: drawn without it");
  EXPECT_FALSE(loaded.scene.cloth_texture.picture);
  EXPECT_EQ(loaded.scene.view.texture, "missing.png");
}

TEST(Texture, IsHalvedUntilItIsNoLargerThanAScreen) {
  const Folder folder;
  std::vector<std::uint8_t> pixels;
  for (int x = 0; x < 3 * 4096; ++x) pixels.push_back(static_cast<std::uint8_t>(x / 3 % 2 == 0 ? 10 : 30));
  write_png(Image{4096, 1, pixels}, folder.folder / "wide.png");
  folder.name("wide.png");
  const LoadedScene loaded = load_scene(folder.scene);
  const Picture& picture = *loaded.scene.cloth_texture.picture;
  EXPECT_EQ(picture.width, 2048);
  EXPECT_EQ(picture.height, 1);
  EXPECT_EQ(picture.pixels, std::vector<std::uint8_t>(3 * 2048, 20));
}

TEST(ClothCoordinates, OfAGeneratedClothAreMetersFromItsCorner) {
  const Scene scene = parse_scene(scene_with("", R"(, "points": [{"position": [0, 5, 0]}])"), "test").scene;
  EXPECT_TRUE(std::isnan(cloth_coordinates_of(scene.cloth_texture, PointId{0}).x));
  EXPECT_EQ(cloth_coordinates_of(scene.cloth_texture, PointId{1}), glm::dvec2(0.0, 0.0));
  EXPECT_EQ(cloth_coordinates_of(scene.cloth_texture, PointId{3}), glm::dvec2(2.0, 0.0));
  EXPECT_EQ(cloth_coordinates_of(scene.cloth_texture, PointId{5}), glm::dvec2(1.0, 1.0));
  EXPECT_TRUE(std::isnan(cloth_coordinates_of(scene.cloth_texture, PointId{99}).x));
}

TEST(ClothCoordinates, OfListedPointsAreReadBackBitForBit) {
  const std::string text = R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0], "uv": [0.1, -3e-300]}]})";
  const Scene scene = parse_scene(text, "test").scene;
  EXPECT_EQ(cloth_coordinates_of(scene.cloth_texture, PointId{1}), glm::dvec2(0.1, -3e-300));
  const Scene again = parse_scene(format_scene(scene), "again").scene;
  EXPECT_TRUE(std::isnan(cloth_coordinates_of(again.cloth_texture, PointId{0}).x));
  EXPECT_EQ(cloth_coordinates_of(again.cloth_texture, PointId{1}), glm::dvec2(0.1, -3e-300));
}

TEST(ClothCoordinates, OfAMovedClothAreListedWithIt) {
  Scene scene = parse_scene(scene_with(R"("texture": "checker")"), "test").scene;
  scene.state.position[0].z = 1.0;
  const std::string text = format_scene(scene);
  EXPECT_EQ(text.find("generators"), std::string::npos);
  const Scene again = parse_scene(text, "again").scene;
  for (std::uint32_t i = 0; i < 6; ++i)
    EXPECT_EQ(cloth_coordinates_of(again.cloth_texture, PointId{i}), cloth_coordinates_of(scene.cloth_texture, PointId{i}));
}

// An inclined triangle without given texture coordinates: its sides keep their lengths and its texture is upright.
TEST(ClothCoordinates, OfOtherFacesAreAProjectionInTheirPlane) {
  const std::string text = R"({"hooke": 1, "points": [{"position": [5, 5, 0]}, {"position": [6, 5, 0]}, {"position": [5, 4, 1]}],
    "faces": [[0, 2, 1]], "view": {"texture": "linen"}})";
  const Scene scene = parse_scene(text, "test").scene;
  const auto place = [&](std::uint32_t i) { return cloth_coordinates_of(scene.cloth_texture, PointId{i}); };
  EXPECT_NEAR(glm::distance(place(1) - place(0), glm::dvec2(1.0, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(place(2) - place(0), glm::dvec2(0.0, std::sqrt(2.0))), 0.0, 1e-12);
}

TEST(ViewSwitches, AndTheTextureAreReadBackFromAFile) {
  const std::string view =
      R"("surface": false, "springs": false, "points": false, "strain_colors": false, "shadows": false, "texture": "linen", "texture_size": 0.3)";
  const Scene scene = parse_scene(scene_with(view), "test").scene;
  EXPECT_EQ(scene.view, (ViewSettings{.surface = false,
                                      .springs = false,
                                      .points = false,
                                      .strain_colors = false,
                                      .shadows = false,
                                      .texture = "linen",
                                      .texture_size = 0.3}));
  EXPECT_EQ(scene.cloth_texture.width, 0.3);
  EXPECT_EQ(parse_scene(format_scene(scene), "again").scene.view, scene.view);
}

TEST(SetTexture, GivesNoCoordinatesToPointsTooFarAway) {
  const std::string far =
      R"({"hooke": 1, "points": [{"position": [0, 1.7e308, 0]}, {"position": [0, -1.7e308, 0]}, {"position": [1, 0, 0]}],
                              "faces": [[0, 1, 2]], "view": {"texture": "linen"}})";
  const Scene scene = parse_scene(far, "far").scene;
  for (const Point& point : scene.system.points()) {
    const glm::dvec2 place = cloth_coordinates_of(scene.cloth_texture, point.id);
    EXPECT_EQ(std::isfinite(place.x), std::isfinite(place.y));
  }
  EXPECT_EQ(format_scene(parse_scene(format_scene(scene), "again").scene), format_scene(scene));
}

TEST(SetTexture, IsUndoneCompletely) {
  Scene scene = parse_scene(scene_with(R"("texture": "linen", "texture_size": 0.3)"), "test").scene;
  const ViewSettings before = scene.view;
  const auto picture = std::make_shared<const Picture>(Picture{1, 1, {1, 2, 3}});
  Effect effect;
  const auto inverse = apply(scene, SetTexture{.texture = "checker", .image = {picture}}, effect);
  EXPECT_EQ(scene.view.texture, "checker");
  EXPECT_EQ(scene.cloth_texture.picture, picture);
  EXPECT_EQ(scene.cloth_texture.width, 0.25);
  ASSERT_EQ(inverse.size(), 1u);
  apply(scene, inverse[0], effect);
  EXPECT_EQ(scene.view, before);
  EXPECT_EQ(scene.cloth_texture.width, 0.3);
  EXPECT_FALSE(scene.cloth_texture.picture);
  EXPECT_FALSE(effect.structure);
}

}  // namespace
}  // namespace hooke
