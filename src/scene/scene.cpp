#include "scene/scene.h"

namespace hooke {

Scene empty_scene() {
  Scene scene;
  scene.system.dimensions = 2;
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.3, .friction = 0.3}};
  return scene;
}

}  // namespace hooke
