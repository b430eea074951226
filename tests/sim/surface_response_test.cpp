#include "sim/contact/surface/surface_response.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace hooke {
namespace {

// An edge, points 0 and 1 of mass 1 kg, falls onto two nailed edges across it.
struct FallingEdge {
  SurfaceContacts contacts;
  std::vector<double> inverse_mass{1.0, 1.0, 0.0, 0.0};
  std::vector<Vec3> velocity{Vec3(0.0, -1.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(0.0), Vec3(0.0)};

  void support(double at) {
    SurfaceContact contact{.kind = FeaturePair::TwoEdges, .points = {0, 1, 2, 3}};
    contact.move_to({.weight = {1.0 - at, at, -0.5, -0.5}, .separation = Vec3(0.0, 0.01, 0.0), .distance = 0.01}, inverse_mass);
    contacts.surface.push_back(contact);
  }
};

// The first contact alone would turn the edge; what it has done too much once the second acts is taken back.
TEST(SurfaceResponse, BringsWhatSeveralContactsCarryToRest) {
  FallingEdge edge;
  edge.support(0.25);
  edge.support(0.75);
  EXPECT_TRUE(edge.contacts.settle(edge.inverse_mass, 0.0, edge.velocity));
  for (int i = 0; i < 2; ++i) EXPECT_LT(glm::length(edge.velocity[i]), 0.02) << i;
  // they share the momentum of 2 kg m/s
  EXPECT_NEAR(edge.contacts.surface[0].impulse.normal, 1.0, 0.02);
  EXPECT_NEAR(edge.contacts.surface[1].impulse.normal, 1.0, 0.02);
}

TEST(SurfaceResponse, LimitsFrictionByTheSumOfTheImpulses) {
  FallingEdge edge;
  edge.support(0.25);
  edge.support(0.75);
  for (int i = 0; i < 2; ++i) edge.velocity[i].x = 0.2;
  edge.contacts.settle(edge.inverse_mass, 0.3, edge.velocity);
  for (int i = 0; i < 2; ++i) EXPECT_LT(glm::length(edge.velocity[i]), 0.02) << i;

  FallingEdge faster;
  faster.support(0.25);
  faster.support(0.75);
  for (int i = 0; i < 2; ++i) faster.velocity[i].x = 1.0;
  faster.contacts.settle(faster.inverse_mass, 0.3, faster.velocity);
  EXPECT_NEAR(faster.velocity[0].x + faster.velocity[1].x, 2.0 * (1.0 - 0.3), 0.02);
}

TEST(SurfaceResponse, NeverPulls) {
  FallingEdge edge;
  edge.support(0.5);
  edge.velocity = {Vec3(0.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0), Vec3(0.0)};
  EXPECT_FALSE(edge.contacts.settle(edge.inverse_mass, 0.3, edge.velocity));
  EXPECT_EQ(edge.velocity[0], Vec3(0.0, 1.0, 0.0));
}

}  // namespace
}  // namespace hooke
