// The energy ledger: joules by cause, copied, compared and subtracted as a block.
#pragma once

#include <array>
#include <cstddef>

namespace hooke {

// What changes the energy of a scene (kinetic, elastic and gravitational). Work is positive where its cause supplies energy. What no cause
// explains was gained or lost by the numerical method. Reports show Potentials and Forces together as "forces", and Breaks and StrainLimit
// as "limits"; the other terms have the names of their causes.
enum class EnergyCause {
  Hand,         // what the hand does on the points it holds or pulls, also through contact; either sign
  Edits,        // changes of the scene between frames; either sign
  Potentials,   // listed forces that have a potential, and moving air that pushes at points at rest; either sign
  Forces,       // all other listed forces, by their power; either sign
  Muscles,      // springs whose rest length moves: muscles and winches; either sign
  Colliders,    // colliders that move, and the displacement of points that start inside one; either sign
  Breaks,       // the elastic energy of springs that break; never positive
  StrainLimit,  // stops springs at their largest length; positive only where the hand or a collider moves
  Drag,         // air at rest; never positive
  Dashpots,     // dashpots of springs; never positive
  Contact,      // impacts and friction, without what the hand and colliders supply; never positive
};

struct EnergyLedger {
  static constexpr std::size_t causes = static_cast<std::size_t>(EnergyCause::Contact) + 1;
  std::array<double, causes> work{};  // [J]

  void add(EnergyCause cause, double joules) { (*this)[cause] += joules; }
  double& operator[](EnergyCause cause) { return work[static_cast<std::size_t>(cause)]; }
  double operator[](EnergyCause cause) const { return work[static_cast<std::size_t>(cause)]; }
  // Of all causes, and of the two terms of reports that have several.
  double sum() const;
  double forces() const { return (*this)[EnergyCause::Potentials] + (*this)[EnergyCause::Forces]; }
  double limits() const { return (*this)[EnergyCause::Breaks] + (*this)[EnergyCause::StrainLimit]; }

  EnergyLedger& operator+=(const EnergyLedger& other);
  EnergyLedger& operator-=(const EnergyLedger& other);
  EnergyLedger& operator*=(double factor);
  bool operator==(const EnergyLedger&) const = default;
};

// The part of a frame's ledger that its causes can have done. Drag, dashpots, contact and, unless the hand or a collider `moves`, a strain
// limit only take energy. What some of them supplied in the frame is returned by the others in proportion to what they took, because they
// act on the same points within a substep; the rest of it is an error of the method and is left out.
EnergyLedger explained(const EnergyLedger& frame, bool moves);

}  // namespace hooke
