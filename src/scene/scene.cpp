#include "scene/scene.h"

#include "sim/control/automatic.h"

namespace hooke {

Scene empty_scene(int dimensions) {
  Scene scene;
  scene.system.dimensions = dimensions;
  // whatever is built, however stiff and light, does not blow up
  scene.settings.integrator = &automatic_method();
  // a hand-built truss stands: it sags by about 1 % of its span, and springs between two free points have a damping ratio of 0.05
  scene.defaults = {.mass = 0.1, .stiffness = 1e4, .damping = 2.0};
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.3, .friction = 0.3}};
  return scene;
}

}  // namespace hooke
