// Saving leaves either the complete old file or the complete new one.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::size_t files_in(const fs::path& folder) { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }

mode_t mode_of(const fs::path& file) {
  struct stat status;
  return stat(file.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

TEST(AtomicWrite, LeavesTheFileAndNoTemporaryFile) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";
  write_atomically(file, "first");
  EXPECT_EQ(contents(file), "first");
  write_atomically(file, "second");
  EXPECT_EQ(contents(file), "second");
  EXPECT_EQ(files_in(scratch.folder), 1u);
}

TEST(AtomicWrite, ANewFileGetsThePermissionsAllowedByTheUmask) {
  const ScratchFolder scratch;
  const mode_t old = umask(027);
  write_atomically(scratch.folder / "new.json", "x");
  umask(old);
  EXPECT_EQ(mode_of(scratch.folder / "new.json"), 0640u);
}

TEST(AtomicWrite, AnOldFileKeepsItsPermissions) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";
  put(file, "old");
  chmod(file.c_str(), 0604);
  write_atomically(file, "new");
  EXPECT_EQ(mode_of(file), 0604u);
}

TEST(AtomicWrite, ASymbolicLinkStaysAndItsFileIsReplaced) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.folder / "there");
  put(scratch.folder / "there" / "scene.json", "old");
  fs::create_symlink("there/scene.json", scratch.folder / "link.json");
  write_atomically(scratch.folder / "link.json", "new");
  EXPECT_TRUE(fs::is_symlink(scratch.folder / "link.json"));
  EXPECT_EQ(contents(scratch.folder / "there" / "scene.json"), "new");
  EXPECT_EQ(files_in(scratch.folder / "there"), 1u);
}

TEST(AtomicWrite, ADanglingLinkStaysAndItsTargetIsCreated) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.folder / "there");
  fs::create_symlink("there/new.json", scratch.folder / "link.json");
  fs::create_symlink("link.json", scratch.folder / "second.json");
  write_atomically(scratch.folder / "second.json", "new");
  EXPECT_TRUE(fs::is_symlink(scratch.folder / "link.json"));
  EXPECT_TRUE(fs::is_symlink(scratch.folder / "second.json"));
  EXPECT_EQ(contents(scratch.folder / "there" / "new.json"), "new");
}

std::string error_of(const fs::path& file) {
  try {
    write_atomically(file, "x");
    return "written";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(AtomicWrite, ALinkWithoutATargetFolderIsRefusedWithTheReason) {
  const ScratchFolder scratch;
  fs::create_symlink("none/new.json", scratch.folder / "link.json");
  const std::string target = (scratch.folder / "none/new.json").string();
  EXPECT_NE(
      error_of(scratch.folder / "link.json").find("link.json (a link to " + target + "): cannot be written: No such file or directory"),
      std::string::npos);
  fs::create_symlink("circle.json", scratch.folder / "circle.json");
  EXPECT_NE(error_of(scratch.folder / "circle.json").find("Too many levels of symbolic links"), std::string::npos);
}

TEST(AtomicWrite, ADirectoryOrPipeIsNotReplaced) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.folder / "sub");
  ASSERT_EQ(mkfifo((scratch.folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_atomically(scratch.folder / "sub", "x"), FileError);
  EXPECT_THROW(write_atomically(scratch.folder / "pipe", "x"), FileError);
  EXPECT_THROW(write_atomically(scratch.folder / "none" / "scene.json", "x"), FileError);
  EXPECT_EQ(files_in(scratch.folder), 2u);
}

TEST(AtomicWrite, AFailedWriteLeavesTheOldFileAndNoTemporaryFile) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";
  put(file, "old");

  // a file size limit of 1000 bytes has the same effect as a full disk
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit tight{1000, before.rlim_max};
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  EXPECT_THROW(write_atomically(file, std::string(5000, 'x')), FileError);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);

  EXPECT_EQ(contents(file), "old");
  EXPECT_EQ(files_in(scratch.folder), 1u);
}

TEST(AtomicWrite, RemovesFilesLeftByKilledWritersButNotThoseInUse) {
  const ScratchFolder scratch;
  const fs::path left = scratch.folder / ".hooke-0123456789abcdef", held = scratch.folder / ".hooke-fedcba9876543210";
  const fs::path foreign = scratch.folder / ".hooke-notes";
  for (const fs::path& file : {left, held, foreign}) put(file, "half");
  const int writer = open(held.c_str(), O_RDONLY);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  write_atomically(scratch.folder / "scene.json", "x");
  close(writer);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(held));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(AtomicWrite, AReadOnlyFileIsNotReplaced) {
  if (geteuid() == 0) {
    // root may write anything
    SUCCEED();
    return;
  }
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";
  put(file, "old");
  chmod(file.c_str(), 0444);
  EXPECT_THROW(write_atomically(file, "new"), FileError);
  EXPECT_EQ(contents(file), "old");
}

}  // namespace
}  // namespace hooke
