// Bullet in double precision, in two ways.
//  - The soft body: springs are constraints on positions, solved one after another. With one iteration a step, a stiffness of
//    k h^2 w / (1 + k h^2 w) for the inverse masses w of both ends makes it XPBD: it converges to the same motion. With n iterations it is
//    1 - (1 - that)^(1/n), the rule of position-based dynamics, which converges to springs that are stiffer or softer than k.
//  - The deformable body: a force per spring, the same equations of motion, with at most two different stiffnesses and one damping. Steps
//  are
//    semi-implicit, with velocities half a step before the positions, where it starts; dashpots are solved for implicitly. Or, with Newton
//    iterations, backward Euler.
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <glm/common.hpp>
#include <set>

#include "peers/peer.h"

namespace hooke {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// the friction of a contact is the product of those of both bodies
double friction_of(const System& system) {
  if (system.contact.any()) return std::sqrt(system.contact.friction);
  return system.colliders.empty() ? 0.0 : std::sqrt(system.colliders.front().friction);
}

// Distances to bodies are interpolated on a grid, at first of 0.25 m for soft bodies, with which points enter a ball of 0.3 m by 6 cm.
void refine_distances(btSoftBodyWorldInfo& info) {
  info.m_sparsesdf.setDefaultVoxelsz(0.005);
  info.m_sparsesdf.Reset();
}

// The world and the bodies that do not move.
struct BulletWorld {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  void add_colliders(const System& system, btDiscreteDynamicsWorld& world) {
    for (const Collider& collider : system.colliders) {
      btTransform place = btTransform::getIdentity();
      if (const Sphere* ball = std::get_if<Sphere>(&collider.shape)) {
        shapes.push_back(std::make_unique<btSphereShape>(ball->radius));
        place.setOrigin(to_bullet(ball->center));
      } else if (const Plane* plane = std::get_if<Plane>(&collider.shape)) {
        // soft bodies touch only convex shapes: a box below the plane, which is perpendicular to an axis
        constexpr double depth = 0.5;
        shapes.push_back(std::make_unique<btBoxShape>(to_bullet(Vec3(5.0) - (5.0 - depth) * glm::abs(plane->normal))));
        place.setOrigin(to_bullet(plane->point - depth * plane->normal));
      }
      btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, shapes.back().get());
      info.m_startWorldTransform = place;
      bodies.push_back(std::make_unique<btRigidBody>(info));
      bodies.back()->setFriction(friction_of(system));
      world.addRigidBody(bodies.back().get());
    }
  }
};

// The points as nodes and the springs as links with their rest lengths.
std::unique_ptr<btSoftBody> make_body(const Problem& problem, btSoftBodyWorldInfo& info) {
  const System& system = problem.system;
  std::vector<btVector3> places;
  std::vector<btScalar> masses;
  for (Index i = 0; i < system.point_count(); ++i) {
    places.push_back(to_bullet(problem.start.position[i]));
    masses.push_back(system.points()[i].nailed ? 0.0 : system.points()[i].mass);
  }
  auto body = std::make_unique<btSoftBody>(&info, system.point_count(), places.data(), masses.data());
  for (const Spring& spring : system.springs()) body->appendLink(system.index_of(spring.first), system.index_of(spring.second));
  if (system.contact.faces)
    for (const Face& face : system.faces)
      body->appendFace(system.index_of(face.points[0]), system.index_of(face.points[1]), system.index_of(face.points[2]));
  body->updateConstants();
  body->m_bUpdateRtCst = false;
  for (int i = 0; i < body->m_links.size(); ++i) {
    const double length = system.springs()[i].rest_length;
    body->m_links[i].m_rl = length;
    body->m_links[i].m_c1 = length * length;
  }
  for (Index i = 0; i < system.point_count(); ++i) body->m_nodes[i].m_v = to_bullet(problem.start.velocity[i]);
  body->getCollisionShape()->setMargin(system.points().front().radius);
  body->setActivationState(DISABLE_DEACTIVATION);
  body->m_cfg.collisions = 0;
  body->m_cfg.kDF = friction_of(system);
  body->m_cfg.kCHR = body->m_cfg.kKHR = 1.0;
  return body;
}

void read_body(const btSoftBody& body, State& state) {
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    state.position[i] = from_bullet(body.m_nodes[static_cast<int>(i)].m_x);
    state.velocity[i] = from_bullet(body.m_nodes[static_cast<int>(i)].m_v);
  }
}

class BulletPeer : public Peer {
 public:
  explicit BulletPeer(const Problem& problem) : problem_(problem) {}

 protected:
  // Runs a world that holds this body, and takes the body out of it.
  template <class World>
  PeerRun step_body(World& world, btSoftBody& body, const PeerSetting& setting, double h) const {
    const auto advance = [&] {
      for (int i = 0; i < setting.steps; ++i) world.stepSimulation(h, 0);
    };
    PeerRun run = take_snapshots(problem_, setting, advance, [&](State& state) { read_body(body, state); });
    world.removeSoftBody(&body);
    return run;
  }

  const Problem& problem_;
};

class SoftBodyPeer : public BulletPeer {
 public:
  using BulletPeer::BulletPeer;

  PeerRun run(const PeerSetting& setting) override {
    const System& system = problem_.system;
    const double h = problem_.seconds / setting.snapshots / setting.steps;
    BulletWorld parts;
    btSequentialImpulseConstraintSolver solver;
    btSoftRigidDynamicsWorld world(&parts.dispatcher, &parts.broadphase, &solver, &parts.configuration);
    world.setGravity(to_bullet(system.gravity));
    world.getWorldInfo().m_gravity = to_bullet(system.gravity);
    refine_distances(world.getWorldInfo());
    parts.add_colliders(system, world);
    const std::unique_ptr<btSoftBody> body = make_body(problem_, world.getWorldInfo());
    body->m_cfg.piterations = setting.iterations;
    if (!system.colliders.empty()) body->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
    for (int i = 0; i < body->m_links.size(); ++i) {
      btSoftBody::Link& link = body->m_links[i];
      const double w = link.m_n[0]->m_im + link.m_n[1]->m_im, stiffness = system.springs()[i].stiffness * h * h * w;
      if (w > 0.0) link.m_c0 = w / (1.0 - std::pow(1.0 / (1.0 + stiffness), 1.0 / setting.iterations));
    }
    world.addSoftBody(body.get());
    return step_body(world, *body, setting, h);
  }
};

// The two stiffnesses; empty: there are more.
std::vector<double> stiffnesses_of(const System& system) {
  std::set<double> all;
  for (const Spring& spring : system.springs()) all.insert(spring.stiffness);
  return all.size() <= 2 ? std::vector<double>(all.begin(), all.end()) : std::vector<double>();
}

struct DeformableSolver : btDeformableBodySolver {
  void iterate(int iterations) {
    m_maxNewtonIterations = iterations;
    m_newtonTolerance = 1e-12;
  }
};

template <bool is_implicit>
class DeformablePeer : public BulletPeer {
 public:
  using BulletPeer::BulletPeer;

  PeerRun run(const PeerSetting& setting) override {
    const System& system = problem_.system;
    const double h = problem_.seconds / setting.snapshots / setting.steps;
    BulletWorld parts;
    DeformableSolver deformable;
    deformable.iterate(setting.iterations);
    btDeformableMultiBodyConstraintSolver solver;
    solver.setDeformableSolver(&deformable);
    btDeformableMultiBodyDynamicsWorld world(&parts.dispatcher, &parts.broadphase, &solver, &parts.configuration, &deformable);
    world.setGravity(to_bullet(system.gravity));
    world.getWorldInfo().m_gravity = to_bullet(system.gravity);
    refine_distances(world.getWorldInfo());
    world.setImplicit(is_implicit);
    world.setUseProjection(true);
    parts.add_colliders(system, world);
    const std::unique_ptr<btSoftBody> body = make_body(problem_, world.getWorldInfo());
    if (!system.colliders.empty()) body->m_cfg.collisions |= btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    if (system.contact.faces) {
      body->m_cfg.collisions |= btSoftBody::fCollision::VF_DD;
      body->setSelfCollision(true);
      body->getCollisionShape()->setMargin(0.5 * setting.thickness_factor * system.contact.thickness);
      body->m_repulsionStiffness = 1000.0;  // fewer crossings than with 0.5, its default
      body->initializeFaceTree();
    }

    const std::vector<double> stiffnesses = stiffnesses_of(system);
    for (int i = 0; i < body->m_links.size(); ++i)
      body->m_links[i].m_bbending = system.springs()[i].stiffness != stiffnesses.front() ? -1 : 0;  // one bit, signed
    const std::vector<Vec3> accelerations = start_accelerations(problem_);
    if (!is_implicit)
      for (Index i = 0; i < system.point_count(); ++i) body->m_nodes[i].m_v -= to_bullet(0.5 * h * accelerations[i]);

    for (int i = 0; i < body->m_nodes.size(); ++i) body->m_nodes[i].m_vn = body->m_nodes[i].m_v;  // of the last step

    world.addSoftBody(body.get());
    btDeformableMassSpringForce springs(stiffnesses.front(), system.springs().front().damping, true, stiffnesses.back());
    btDeformableGravityForce gravity(to_bullet(system.gravity));
    world.addForce(body.get(), &springs);
    world.addForce(body.get(), &gravity);
    return step_body(world, *body, setting, h);
  }
};

std::string soft_body_obstacle(const Problem& problem) {
  if (problem.system.contact.any()) return "contact of faces of one body";
  for (const Spring& spring : problem.system.springs())
    if (spring.damping > 0.0) return "dashpots";
  return "";
}

std::string deformable_obstacle(const Problem& problem) {
  if (stiffnesses_of(problem.system).empty()) return "more than two stiffnesses";
  for (const Spring& spring : problem.system.springs())
    if (spring.damping != problem.system.springs().front().damping) return "different dashpots";
  return "";
}

std::string implicit_obstacle(const Problem& problem) {
  constexpr int max_points = 10'000;
  if (problem.system.point_count() > max_points) return "a sweep of cloth 128 takes more than ten minutes";
  return deformable_obstacle(problem);
}

template <class Kind>
std::unique_ptr<Peer> load_bullet(const Problem& problem) {
  return std::make_unique<Kind>(problem);
}

}  // namespace

const PeerKind bullet_soft_body_peer{.id = "bullet_soft_body",
                                     .limit = 0.0,
                                     .is_damped_apart = false,
                                     .iterations = {1, 4},
                                     .obstacle = soft_body_obstacle,
                                     .load = load_bullet<SoftBodyPeer>};
const PeerKind bullet_deformable_peer{.id = "bullet_deformable",
                                      .limit = 2.0,
                                      .is_damped_apart = true,
                                      .iterations = {1},
                                      .obstacle = deformable_obstacle,
                                      .load = load_bullet<DeformablePeer<false>>};
const PeerKind bullet_implicit_peer{.id = "bullet_implicit",
                                    .limit = 0.0,
                                    .is_damped_apart = true,
                                    .iterations = {1, 4},
                                    .obstacle = implicit_obstacle,
                                    .load = load_bullet<DeformablePeer<true>>};

}  // namespace hooke
