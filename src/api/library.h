// What a Simulation of the library is.
#pragma once

#include "api/hooke.h"
#include "lab/lab.h"

namespace hooke::v1 {

struct Simulation::Data {
  Lab lab;
  std::string name;
  const System& system() const { return lab.scene().system; }

  // Applied at once, and in effect from the next frame on.
  void submit(Command command) {
    lab.submit(std::move(command));
    lab.apply_pending();
  }
  void submit(Control control) {
    lab.submit(std::move(control));
    lab.apply_pending();
  }
};

}  // namespace hooke::v1
