// Point caches byte for byte, and formats chosen by file extension.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <zlib.h>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/read_file.h"
#include "formats/open_file.h"
#include "formats/point_cache.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

struct Folder : ScratchFolder {
  fs::path file(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
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

TEST(PointCache, FarFromTheOriginWarnsOfItsPrecision) {
  State state;
  state.position = {Vec3(0.0), Vec3(1.0, 0.0, 0.0)};
  EXPECT_FALSE(point_cache_warning(state));
  for (Vec3& x : state.position) x.y -= 10000.0;
  EXPECT_EQ(point_cache_warning(state).value_or(""),
            "point cache: positions are rounded by up to 0.596046 mm: the scene is far from the origin, compared with its size");
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
  EXPECT_EQ(refusal([&] { load_file(ply); }), ply + ": file format: .ply: can only be written: must be .json, .obj, .xsp or .xml");
  const std::string stl = folder.file("a.stl", "solid x").string();
  EXPECT_EQ(refusal([&] { load_file(stl); }), stl + ": file format: .stl: must be .json, .obj, .xsp or .xml");
  EXPECT_EQ(load_file(folder.file("scene.json~", "\n{\"hooke\": 1}")).scene.system.point_count(), 0);
  EXPECT_THROW(load_file(folder.folder / "none.obj"), FileError);
  EXPECT_EQ(refusal([&] { load_file(folder.file("bad\n.xsp", "")); }),
            folder.folder.string() + "/bad\\n.xsp: line 1: \"\": must begin with #1.0");
  fs::create_directory(folder.folder / "folder.obj");
  EXPECT_THROW(load_file(folder.folder / "folder.obj"), InputError);
}

std::string gzip(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

TEST(OpenFile, ReadsCompressedFilesAndByteOrderMarks) {
  const Folder folder;
  const std::string texts[] = {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "#1.0\nmass 1 100 0 0 0 1 1\n",
                               "{\"hooke\": 1, \"points\": [{\"position\": [0, 0, 0]}]}"};
  const char* names[] = {"a.obj", "a.xsp", "a.json"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = names[i], mark = "\xef\xbb\xbf";
    const Index points = load_file(folder.file(name, texts[i])).scene.system.point_count();
    EXPECT_GT(points, 0);
    EXPECT_EQ(load_file(folder.file("marked_" + name, mark + texts[i])).scene.system.point_count(), points) << name;
    const std::string bytes = gzip(texts[i]);
    // XSpringies compresses without changing the name
    EXPECT_EQ(load_file(folder.file("zipped_" + name, bytes)).scene.system.point_count(), points) << name;
    EXPECT_EQ(load_file(folder.file(name + ".gz", bytes)).scene.system.point_count(), points) << name;
    EXPECT_EQ(load_file(folder.file(name + ".gz", gzip(mark + texts[i]) + gzip("\n"))).scene.system.point_count(), points) << name;

    const std::string file = folder.file("bad_" + name + ".gz", bytes.substr(0, bytes.size() - 9)).string();
    EXPECT_EQ(refusal([&] { load_file(file); }), file + ": file: damaged or incomplete gzip");
    for (const std::string& start : {std::string("\xff\xfe"), std::string("\xfe\xff"), std::string("v\0", 2), std::string("\0v", 2)}) {
      const std::string wide = folder.file("wide_" + name, start + texts[i]).string();
      EXPECT_EQ(refusal([&] { load_file(wide); }), wide + ": encoding: UTF-16: must be UTF-8 or ASCII");
    }
  }
  for (const std::string& start :
       {std::string("\xff\xfe\0\0", 4), std::string("\0\0\xfe\xff", 4), std::string("v\0\0\0", 4), std::string("\0\0\0v", 4)}) {
    const std::string wide = folder.file("wide.obj", start).string();
    EXPECT_EQ(refusal([&] { load_file(wide); }), wide + ": encoding: UTF-32: must be UTF-8 or ASCII");
  }
  std::string members;
  const std::string mebibyte = gzip(std::string(std::size_t{1} << 20, ' '));
  for (int i = 0; i < 257; ++i) members += mebibyte;
  const std::string bomb = folder.file("bomb.obj.gz", members).string();
  EXPECT_NE(refusal([&] { load_file(bomb); }).find("(256 MiB)"), std::string::npos);
  const std::string written = (folder.folder / "b.obj.gz").string();
  EXPECT_NE(refusal([&] { write_scene_as(Scene(), written); }).find("must be .json"), std::string::npos);
}

TEST(OpenFile, ImportOptionsAreThoseOfMeshes) {
  const Folder folder;
  const fs::path mesh = folder.file("a.obj", "v 0 0 0\nv 1000 0 0\nv 0 0 500\nf 1 2 3\n");
  ImportOptions options;
  for (const ImportOption& row : import_options()) row.set(options, row.name == "up" ? "z" : row.name == "scale" ? "0.001" : "0");
  const LoadedScene loaded = load_file(mesh, {}, options);
  EXPECT_EQ(loaded.scene.state.position[2], Vec3(0.0, 0.5, 0.0));
  EXPECT_EQ(loaded.summary, mesh.string() + ": 1 x 0.5 x 0 m, 3 points");
  const std::string scene = folder.file("a.xsp", "#1.0\n").string();
  EXPECT_EQ(refusal([&] { load_file(scene, {}, options); }), scene + ": weld, scale and up: only of a mesh");
  for (const ImportOption& row : import_options()) EXPECT_THROW(row.set(options, "-1"), UsageError) << row.name;
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
