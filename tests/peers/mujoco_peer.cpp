// MuJoCo: a body with three sliding joints per point, a site for a nail, and a spatial tendon per spring. These are the same equations of
// motion: tendons have a stiffness, a rest length and a damping. Its Euler method is semi-implicit: velocities belong to half a step
// before the positions, so it starts there and is then the leapfrog.
#include <mujoco/mujoco.h>
#include <algorithm>

#include <fstream>
#include <stdexcept>

#include "base/bounds.h"
#include "base/formatted.h"
#include "peers/peer.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

std::string triple(const Vec3& v) { return format_exact(v.x) + " " + format_exact(v.y) + " " + format_exact(v.z); }

int free_count(const Problem& problem) {
  int count = 0;
  for (const Point& point : problem.system.points()) count += point.nailed ? 0 : 1;
  return count;
}

std::string mujoco_obstacle(const Problem& problem) {
  // ten_J and ten_J_colind have a column for each coordinate, and mjData must be smaller than 2 GiB
  const double bytes = 12.0 * problem.system.spring_count() * 3.0 * free_count(problem);
  if (bytes > 1.9e9) return formatted("its Jacobian of the tendons takes %.1f GB, more than the 2 GiB of mjData", 1e-9 * bytes);
  if (problem.system.contact.any()) return "contact of faces";
  return "";
}

std::string model_text(const Problem& problem) {
  const System& system = problem.system;
  const bool has_contact = !system.colliders.empty();
  const int coordinates = 3 * free_count(problem), contacts = has_contact ? system.point_count() + 100 : 1;
  std::string text = "<mujoco><compiler boundmass='0' boundinertia='0'/>";
  append_formatted(text, "<size njmax='%d' nconmax='%d' nstack='%d'/>", 4 * contacts, contacts,
                   (has_contact ? 10'000 : 100) * coordinates + 100'000);
  text += "<option gravity='" + triple(system.gravity) + "' jacobian='sparse' solver='CG'>";
  if (!has_contact) text += "<flag constraint='disable' contact='disable'/>";
  text += "</option><worldbody>";
  for (const Collider& collider : system.colliders) {
    text += "<geom contype='2' conaffinity='1' friction='" + format_exact(collider.friction) + " 0 0' ";
    if (const Sphere* ball = std::get_if<Sphere>(&collider.shape))
      text += "type='sphere' size='" + format_exact(ball->radius) + "' pos='" + triple(ball->center) + "'/>";
    else if (const Plane* plane = std::get_if<Plane>(&collider.shape))
      text += "type='plane' size='5 5 1' zaxis='" + triple(plane->normal) + "' pos='" + triple(plane->point) + "'/>";
  }
  for (Index i = 0; i < system.point_count(); ++i) {
    const Point& point = system.points()[i];
    const std::string at = "pos='" + triple(problem.start.position[i]) + "'", site = "<site name='" + std::to_string(i) + "'";
    if (point.nailed) {
      text += site + " " + at + "/>";
      continue;
    }
    text += "<body " + at + "><inertial pos='0 0 0' mass='" + format_exact(point.mass) + "' diaginertia='1 1 1'/>";
    for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"}) text += "<joint type='slide' axis='" + std::string(axis) + "'/>";
    if (has_contact) text += "<geom type='sphere' contype='1' conaffinity='2' friction='0 0 0' size='" + format_exact(point.radius) + "'/>";
    text += site + "/></body>";
  }
  text += "</worldbody><tendon>";
  for (const Spring& spring : system.springs())
    text += "<spatial stiffness='" + format_exact(spring.stiffness) + "' damping='" + format_exact(spring.damping) + "' springlength='" +
            format_exact(spring.rest_length) + "'><site site='" + std::to_string(system.index_of(spring.first)) + "'/><site site='" +
            std::to_string(system.index_of(spring.second)) + "'/></spatial>";
  return text + "</tendon></mujoco>\n";
}

template <mjtIntegrator method>
class MujocoPeer : public Peer {
 public:
  explicit MujocoPeer(const Problem& problem) : problem_(problem) {
    // warnings are read from mjData; the default handler writes a file
    mju_user_warning = [](const char*) {};
    const ScratchFolder scratch;
    const std::string file = scratch.folder / "model.xml";
    std::ofstream(file) << model_text(problem);
    char error[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + error);
    model_->opt.integrator = method;
    data_.reset(mj_makeData(model_.get()));
    if (!data_) throw std::runtime_error("MuJoCo: no memory for mjData");
  }

  PeerRun run(const PeerSetting& setting) override {
    mjModel& m = *model_;
    mjData& d = *data_;
    const double h = problem_.seconds / setting.snapshots / setting.steps;
    m.opt.timestep = h;
    mj_resetData(&m, &d);
    const std::vector<Vec3> accelerations = start_accelerations(problem_);
    int coordinate = 0;
    for_free_points([&](Index i) {
      const Vec3 start = problem_.start.velocity[i] - (method == mjINT_EULER ? 0.5 * h : 0.0) * accelerations[i];
      for (int c = 0; c < 3; ++c) d.qvel[coordinate++] = start[c];
    });
    const auto advance = [&] {
      for (int i = 0; i < setting.steps; ++i) mj_step(&m, &d);
    };
    return take_snapshots(problem_, setting, advance, [&](State& state) {
      int next = 0;
      for_free_points([&](Index i) {
        for (int c = 0; c < 3; ++c, ++next) {
          state.position[i][c] = problem_.start.position[i][c] + d.qpos[next];
          state.velocity[i][c] = d.qvel[next];
        }
      });
      // MuJoCo resets what it considers unstable
      if (d.warning[mjWARN_BADQPOS].number + d.warning[mjWARN_BADQVEL].number + d.warning[mjWARN_BADQACC].number > 0)
        std::ranges::fill(state.position, Vec3(NAN));
    });
  }

 private:
  template <class Visit>
  void for_free_points(const Visit& visit) const {
    for (Index i = 0; i < problem_.system.point_count(); ++i)
      if (!problem_.system.points()[i].nailed) visit(i);
  }
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  const Problem& problem_;
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

template <mjtIntegrator method>
std::unique_ptr<Peer> load_mujoco(const Problem& problem) {
  return std::make_unique<MujocoPeer<method>>(problem);
}

}  // namespace

const PeerKind mujoco_euler_peer{.id = "mujoco_euler",
                                 .limit = 2.0,
                                 .is_damped_apart = false,
                                 .iterations = {1},
                                 .obstacle = mujoco_obstacle,
                                 .load = load_mujoco<mjINT_EULER>};
const PeerKind mujoco_runge_kutta_peer{.id = "mujoco_rk4",
                                       .limit = 2.828,
                                       .is_damped_apart = false,
                                       .iterations = {1},
                                       .obstacle = mujoco_obstacle,
                                       .load = load_mujoco<mjINT_RK4>};

}  // namespace hooke
