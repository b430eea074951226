// The descriptor of an open file, closed with the object.
#pragma once

#include <unistd.h>

namespace hooke {

struct Descriptor {
  int number;  // negative: none
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

}  // namespace hooke
