// Films encoded by ffmpeg, if it is installed: raw pictures are passed through a pipe, without a shell.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/errors.h"
#include "base/printable.h"
#include "draw/film/film_encoder.h"

extern char** environ;

namespace hooke {
namespace {

// The arguments of ffmpeg. Without -xerror its exit code is 0 even where the end of the file could not be written. H.264 with 4:2:0
// subsampling requires even sides: odd ones are padded with a black line.
std::vector<std::string> arguments_for(const std::filesystem::path& file, int width, int height, double video_frame_rate) {
  return {"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-xerror", "-f", "rawvideo", "-pixel_format", "rgb24",
          "-video_size", std::to_string(width) + "x" + std::to_string(height), "-framerate", format_exact(video_frame_rate), "-i", "pipe:0",
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-codec:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
          "-f", "mp4",
          // a name that begins with - or resembles a protocol is still a file
          "file:" + file.string()};
}

// XMP metadata at the end of the file: length, kind and UUID of such a box (XMP specification, part 3), then the packet.
std::string xmp_box(const std::string& description) {
  constexpr std::string_view kind = "uuid\xbe\x7a\xcf\xcb\x97\xa9\x42\xe8\x9c\x71\x99\x94\x91\xe3\xaf\xac";
  const std::string packet = xmp_packet(description);
  const std::size_t length = 4 + kind.size() + packet.size();  // less than 64 KiB
  return std::string{'\0', '\0', static_cast<char>(length >> 8), static_cast<char>(length & 0xff)} + std::string(kind) + packet;
}

// In the folder of the film, with the id of this process in its name.
std::filesystem::path sibling_file(const std::filesystem::path& file, const char* ending) {
  return file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ending);
}

class VideoEncoder : public FilmEncoder {
 public:
  VideoEncoder(std::filesystem::path file, int width, int height, double video_frame_rate);
  ~VideoEncoder() override;
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  void add(const Picture& picture, long frames) override {
    for (long i = 0; i < frames; ++i) add(picture);
  }

  void close(const std::string& comment) override {
    if (const int code = finish(); code != 0) fail("ffmpeg ended with " + std::to_string(code));
    if (!comment.empty()) std::ofstream(unfinished_, std::ios::binary | std::ios::app) << xmp_box(comment);
    std::error_code error;
    std::filesystem::rename(unfinished_, file_, error);
    if (error) fail(error.message());
  }

  void abort() override {
    aborted_ = true;
    ::shutdown(ffmpeg_socket_, SHUT_RDWR);
  }

 private:
  void add(const Picture& picture) {
    if (picture.width != width_ || picture.height != height_) fail("the size of the picture differs");
    const std::uint8_t* at = picture.pixels.data();
    std::size_t left = picture.pixels.size();
    while (left > 0) {
      const ssize_t sent = ::send(ffmpeg_socket_, at, left, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent < 0) {
        // the rest of its input is not needed
        if (aborted_) ::kill(ffmpeg_, SIGKILL);
        finish();
        fail("ffmpeg ended early");
      }
      at += sent;
      left -= static_cast<std::size_t>(sent);
    }
  }

  // The exit code of ffmpeg; -1 if a signal ended it.
  int finish() {
    if (ffmpeg_socket_ >= 0) ::close(ffmpeg_socket_.exchange(-1));
    if (ffmpeg_ <= 0) return -1;
    int status = 0;
    while (::waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) {
    }
    ffmpeg_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // Adds the first line of the output of ffmpeg to the message. Also called by the constructor, after which no destructor runs.
  [[noreturn]] void fail(const std::string& why) const {
    std::string first_line;
    std::getline(std::ifstream(stderr_file_), first_line);
    std::error_code ignored;
    std::filesystem::remove(stderr_file_, ignored);
    throw FileError(printable(file_.native()) + ": " + why + (first_line.empty() ? "" : ": " + printable(first_line, 200)));
  }

  std::filesystem::path file_, unfinished_, stderr_file_;
  int width_, height_;
  std::atomic<int> ffmpeg_socket_ = -1;
  std::atomic<bool> aborted_ = false;
  pid_t ffmpeg_ = 0;
};

VideoEncoder::VideoEncoder(std::filesystem::path file, int width, int height, double video_frame_rate)
    : file_(std::move(file)),
      unfinished_(sibling_file(file_, ".part")),
      stderr_file_(sibling_file(file_, ".log")),
      width_(width),
      height_(height) {
  // a socket, so that writing to an ffmpeg that has ended is an error and not a signal
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) fail(std::strerror(errno));
  ffmpeg_socket_ = sockets[1];

  std::vector<std::string> command_line = arguments_for(unfinished_, width, height, video_frame_rate);
  std::vector<char*> arguments;
  for (std::string& argument : command_line) arguments.push_back(argument.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, sockets[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, stderr_file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  // in a process group of its own: Ctrl+C ends the pictures, and not their encoding
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = ::posix_spawnp(&ffmpeg_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(sockets[0]);
  if (error == 0) return;

  ffmpeg_ = 0;
  ::close(ffmpeg_socket_.exchange(-1));
  if (std::error_code ignored; !std::filesystem::exists(file_.parent_path().empty() ? "." : file_.parent_path(), ignored))
    fail("the folder does not exist");
  fail("ffmpeg, which encodes films, cannot be started: " + std::string(std::strerror(error)) + " (apt-get install ffmpeg)");
}

VideoEncoder::~VideoEncoder() {
  if (ffmpeg_ > 0) ::kill(ffmpeg_, SIGKILL);
  finish();
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
  std::filesystem::remove(stderr_file_, ignored);
}

}  // namespace

std::unique_ptr<FilmEncoder> start_mp4(const std::filesystem::path& file, int width, int height, double frame_rate) {
  return std::make_unique<VideoEncoder>(file, width, height, frame_rate);
}

}  // namespace hooke
