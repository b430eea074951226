// Point caches byte for byte, and formats chosen by file extension.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <cstring>
#include <filesystem>
#include <functional>

#include "base/atomic_write.h"
#include "base/read_file.h"
#include "formats/open_file.h"
#include "formats/point_cache.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

struct Folder : ScratchFolder {
  fs::path file(const std::string& name, std::string_view bytes) const {
    write_atomically(folder / name, bytes);
    return folder / name;
  }
};

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "not refused";
}

template <class... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof raw);
  };
  (put(values), ...);
  return bytes;
}

TEST(PointCache, IsByteForByteAsSpecified) {
  const Folder folder;
  const fs::path file = folder.folder / "run.pc2";
  PointCacheWriter cache(file, 2);
  cache.add(std::vector{Vec3(1.0, 2.0, 3.0), Vec3(-1.0, 0.5, 0.1)});
  cache.add(std::vector{Vec3(4.0, 5.0, 6.0), Vec3(0.0)});
  cache.close();
  EXPECT_EQ(read_file(file), std::string("POINTCACHE2\0", 12) + bytes_of(std::int32_t{1}, std::int32_t{2}, 0.0f, 1.0f, std::int32_t{2}) +
                                 bytes_of(1.0f, 2.0f, 3.0f, -1.0f, 0.5f, 0.1f, 4.0f, 5.0f, 6.0f, 0.0f, 0.0f, 0.0f));
}

TEST(PointCache, IfUnfinishedLeavesTheOldFile) {
  const Folder folder;
  const fs::path file = folder.file("run.pc2", "old");
  { PointCacheWriter(file, 1).add(std::vector{Vec3(1.0)}); }
  EXPECT_EQ(read_file(file), "old");
}

TEST(PointCache, ReportsWriteErrors) {
  const Folder folder;
  EXPECT_THROW(PointCacheWriter(folder.folder / "none" / "run.pc2", 1), FileError);
  PointCacheWriter cache(folder.folder / "run.pc2", 1);
  EXPECT_THROW(cache.add(std::vector{Vec3(1e39, 0.0, 0.0)}), FileError);
  EXPECT_THROW(PointCacheWriter("/dev/full", 1), FileError);
}

TEST(OpenFile, ReadsEachExtensionWithItsReader) {
  const Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", mass = "#1.0\nmass 1 100 0 0 0 1 1\n";
  EXPECT_EQ(load_file(folder.file("a.obj", triangle)).scene.system.point_count(), 3);
  EXPECT_EQ(load_file(folder.file("A.OBJ", triangle)).scene.system.point_count(), 3);
  EXPECT_EQ(load_file(folder.file("a.xsp", mass)).scene.system.point_count(), 1);
  EXPECT_EQ(load_file(folder.file("a.json", "{\"hooke\": 1, \"points\": [{\"position\": [0, 0, 0]}]}")).scene.system.point_count(), 1);
  EXPECT_EQ(load_file(folder.file("scene", "{\"hooke\": 1}")).scene.system.point_count(), 0);

  const std::string ply = folder.file("a.ply", "ply").string();
  EXPECT_EQ(refusal([&] { load_file(ply); }), ply + ": file format: .ply: can only be written: must be .json, .obj or .xsp");
  EXPECT_THROW(load_file(folder.folder / "none.obj"), FileError);
  EXPECT_EQ(refusal([&] { load_file(folder.file("bad\n.xsp", "")); }),
            folder.folder.string() + "/bad\\n.xsp: line 1: \"\": must begin with #1.0");
  fs::create_directory(folder.folder / "folder.obj");
  EXPECT_THROW(load_file(folder.folder / "folder.obj"), InputError);
}

TEST(OpenFile, WritesEachExtensionWithItsWriter) {
  const Folder folder;
  const Scene scene = load_file(folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).scene;
  for (const char* name : {"b.json", "b.obj", "b.PLY"}) {
    EXPECT_TRUE(write_scene_as(scene, folder.folder / name).empty());
    EXPECT_GT(fs::file_size(folder.folder / name), 0u);
  }
  EXPECT_EQ(load_file(folder.folder / "b.json").scene.system, scene.system);

  // refused, and the old file is unchanged
  folder.file("b.xsp", "old");
  EXPECT_EQ(refusal([&] { write_scene_as(scene, folder.folder / "b.xsp"); }),
            folder.folder.string() + "/b.xsp: dimensions: 3: must be 2 to be written as .xsp");
  EXPECT_EQ(read_file(folder.folder / "b.xsp"), "old");
  EXPECT_EQ(refusal([&] { write_scene_as(scene, folder.folder / "b.stl"); }),
            folder.folder.string() + "/b.stl: file format: \".stl\": must be .json, .obj, .ply, .xsp or .lmp");

  Scene flat = load_file(folder.file("c.xsp", "#1.0\nmass 1 100 0 0 0 1 1\nmass 2 50 0 0 0 1 1\nspng 1 1 2 5 1 50\n")).scene;
  flat.system.spring(0)->break_strain = 0.5;
  EXPECT_EQ(write_scene_as(flat, folder.folder / "d.xsp").size(), 1u);
  EXPECT_EQ(load_file(folder.folder / "d.xsp").scene.state, flat.state);
}

TEST(OpenFile, OpensNoFileThatAMeshRefersTo) {
  // a pipe: opening it would block
  const Folder folder;
  ASSERT_EQ(mkfifo((folder.folder / "cloth.mtl").c_str(), 0600), 0);
  const fs::path file = folder.file("a.obj", "mtllib cloth.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\ncall cloth.mtl\n");
  EXPECT_EQ(load_file(file).scene.system.point_count(), 3);
}

}  // namespace
}  // namespace hooke
