// Every edit is one small struct, in a file of the folder commands. It has a name and names of its fields for the text form of
// recordings, `describe` for the history, `apply`, which changes a scene and returns the inverse, and, if commands of one drag replace
// each other, `is_undone_with`. Commands refer to points and springs by id.
//
// Adding a command is its struct and one entry in the list below.
#pragma once

#include <string>
#include <variant>

#include "edit/commands/hand.h"
#include "edit/commands/network.h"
#include "edit/commands/properties.h"
#include "edit/commands/settings.h"
#include "edit/commands/states.h"

namespace hooke {

using CommandVariant =
    std::variant<Insert, Remove, SetNailed, Move, SetVelocity, SetPointColor, SetLoad, SetFixedAxes, SetPointProperty, SetSpringProperty,
                 SetSpringLaw, SetParameter, RestoreParameter, SetIntegrator, GrabPoint, GrabCollider, MoveHand, ReleaseHand, SetGravity,
                 SetColliders, SetForces, SetText, SetPlots, SetTexture, GoToState, SetTorn, MarkTorn, Replace>;

// A class, not an alias, so that the commands can name it in the type of their inverse. Copies are compiled once, in command.cpp.
struct Command : CommandVariant {
  using CommandVariant::CommandVariant;
  Command(const Command&);
  Command(Command&&) noexcept;
  Command& operator=(const Command&);
  Command& operator=(Command&&) noexcept;
  ~Command();
};

// The name in the history: "nail 3 points".
std::string describe(const Command& command);

// Whether undoing `earlier` also undoes `later`: both set the same values.
bool is_undone_with(const Command& later, const Command& earlier);

// Whether it grabs a point, a cloth or a collider.
bool is_grab(const Command& command);

// Approximate memory use.
std::size_t bytes_of(const Command& command);

// The only writer of System, State and Settings outside the step. Applies `command` to the scene, increments its revision unless only the
// State changed, and returns the commands that undo exactly what it changed, to be applied in order. Parts that name removed things do
// nothing. Never changes the time (except GoToState and Replace) or the motion of other points.
Inverse apply(Scene& scene, const Command& command, Effect& effect);

}  // namespace hooke
