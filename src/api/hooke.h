// Hooke as a library: load or build a network of point masses and springs, step it, read its state, apply commands, and query its error.
//
//   hooke::v1::Scene scene = hooke::v1::Scene::load("cloth");
//   hooke::v1::Simulation simulation(scene);
//   simulation.step();
//   std::span<const double> positions = simulation.positions();  // x, y, z of every point [m]
//
// SI units throughout. The same scene gives the same bits as `hooke run`, on any machine and for any number of threads.
//
// Stability: this header is the whole interface, and contains no internal type. What is declared in the namespace hooke::v1 keeps its name,
// its meaning and its binary interface in all versions of libhooke.so.1: programs built with an older version run with a newer one without
// being compiled again. New functions and classes may be added. An incompatible interface would be hooke::v2 in libhooke.so.2.
//
// Errors are exceptions of the class Error: one line, as on the command line, that names the argument. A Simulation is used by one thread
// at a time; different ones may be used at the same time. What was moved from throws an Error when it is used.
//
// hooke/hooke_c.h has the essential part of it for C and other languages.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#if defined(__GNUC__)
#define HOOKE_PUBLIC __attribute__((visibility("default")))
#else
#define HOOKE_PUBLIC
#endif

namespace hooke::v1 {

struct HOOKE_PUBLIC Vector {
  double x = 0.0, y = 0.0, z = 0.0;
};

class HOOKE_PUBLIC Error : public std::runtime_error {
 public:
  enum class Kind { Input, Usage, File };  // as the exit codes 3, 2 and 5
  Error(Kind kind, const std::string& line) : std::runtime_error(line), kind_(kind) {}
  ~Error() override;
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

// A network with everything that a scene file contains. Copies are independent.
class HOOKE_PUBLIC Scene {
 public:
  // Empty: no points, no floor, gravity 9.81 m/s^2 downwards, velocity_verlet with 20 substeps at 60 frames per second.
  Scene();
  // A shipped scene by its name, or a file: .json, .obj, .xsp, .xml.
  static Scene load(const std::string& name);
  // The text of a scene file (docs/reference/scene-format.md); `name` stands for the file in messages.
  static Scene parse(std::string_view json, const std::string& name = "scene");
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  // Adds a point, a spring (rest length as drawn) or members of a scene file, without the braces around them: "generators": [...],
  // "colliders": [...] are added, "gravity": [...], "simulation": {...}, "contact": {...} and other parameters replace those of the scene.
  // Refuses unknown members.
  // add_point and add_spring return the number of what was added, from 0. Adding n of them one by one takes time proportional to n^2:
  // `add` takes lists.
  std::int64_t add_point(const Vector& position, double mass, bool nailed = false);                        // [m], [kg]
  std::int64_t add_spring(std::int64_t first, std::int64_t second, double stiffness, double damping = 0);  // [N/m], [N s/m]
  void add(std::string_view members);

  // A parameter of the command line, as in --set: set("stiffness=200").
  void set(const std::string& setting);
  void set_integrator(const std::string& id);  // "velocity_verlet"
  void set_substeps(int substeps);             // per frame
  void set_frame_rate(double frame_rate);      // [1/s]

  std::int64_t point_count() const;
  std::int64_t spring_count() const;
  // The text of the scene file, which reads back as the same scene, bit for bit.
  std::string json() const;
  // In the format of the extension, atomically.
  void save(const std::string& file) const;

 private:
  friend class Simulation;
  struct Data;
  Data& data() const;
  std::unique_ptr<Data> data_;
};

struct HOOKE_PUBLIC Energy {
  double kinetic = 0.0, elastic = 0.0, gravitational = 0.0;  // [J]
  double total() const { return kinetic + elastic + gravitational; }
};

// A plane with a normal of length 1, a sphere, or a box.
struct HOOKE_PUBLIC Collider {
  enum class Kind { Plane, Sphere, Box };
  Kind kind = Kind::Plane;
  Vector first, second;  // point [m] and normal; center [m] and nothing; min and max [m]
  double radius = 0.0;   // [m], of a sphere
};

// What a point touched, by its number in its list, and the normal towards the point.
struct HOOKE_PUBLIC Partner {
  enum class Kind { Unknown, Collider, Point, Spring, Face };
  Kind kind = Kind::Unknown;
  std::int64_t number = -1;
  Vector normal;
};

// A running scene.
class HOOKE_PUBLIC Simulation {
 public:
  // What is measured of the error of the run.
  enum class Accuracy {
    Off,
    Frame,  // the error of a frame: a tenth of the cost of the run
    Full,   // and its accumulation: two and a half times the cost of the run
  };
  explicit Simulation(const Scene& scene, Accuracy accuracy = Accuracy::Off);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  // Computes one frame, or the frames that cover `seconds` [s]. False if it diverged: the state is that of the last valid frame, and
  // `diagnosis` says why.
  bool step();
  bool step(double seconds);
  // On how many threads frames are computed, to the same bits.
  void set_threads(int threads);
  std::string diagnosis() const;  // one line; empty: nothing to report

  double time() const;         // [s]
  std::uint64_t hash() const;  // of time, positions and velocities; equal for equal bits
  Energy energy() const;
  // x, y, z of every point, in the order of their numbers. Valid until the simulation is stepped, changed or destroyed.
  std::span<const double> positions() const;   // [m]
  std::span<const double> velocities() const;  // [m/s]

  // The network as it is now: springs may have broken.
  std::int64_t point_count() const;
  std::vector<std::int64_t> springs() const;  // the two points of every spring
  std::vector<std::int64_t> faces() const;    // the three points of every triangle of a surface
  std::vector<double> masses() const;         // [kg]
  std::vector<double> radii() const;          // [m]
  std::vector<bool> nailed() const;
  std::vector<double> stiffness() const;     // [N/m], of every spring
  std::vector<double> rest_lengths() const;  // [m]
  std::vector<double> tensions() const;      // [N], of every spring without its dashpot; negative in compression
  std::vector<double> reactions() const;     // [N], x, y, z of the force of every nail; zero for free points
  std::vector<Collider> colliders() const;   // where they are now
  // Of the last frame: the points that touched something, and x, y, z of the mean force of contact on every point [N]; zero for nails.
  std::vector<std::int64_t> contacts() const;
  std::vector<double> contact_forces() const;
  // For each point of `contacts`: the part of the scene that it most probably touched, which is the nearest one in the direction of the
  // force.
  std::vector<Partner> contact_partners() const;

  // RMS over the points of the distance from the exact motion since the start [m], and what the last measured frame added; NaN: not known.
  double error() const;
  double frame_error() const;

  // Commands, in effect from the next frame on.
  void grab(std::int64_t point, const Vector& target);                    // it then follows the target exactly
  void pull(std::int64_t point, const Vector& target, double stiffness);  // by a spring [N/m]
  void move_hand(const Vector& target);                                   // within the next frame
  void release();
  void nail(std::int64_t point, bool nailed = true);
  void move(std::int64_t point, const Vector& position, const Vector& velocity = {});
  void set(const std::string& setting);  // as Scene::set
  void undo();
  void redo();

  // A copy of the scene in its present state.
  Scene scene() const;

 private:
  struct Data;
  Data& data() const;
  std::unique_ptr<Data> data_;
};

// The version of the library: "1.1.0".
HOOKE_PUBLIC const char* version();

}  // namespace hooke::v1
