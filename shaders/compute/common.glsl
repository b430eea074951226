// What all passes share. The program puts before it: #version, real (float or double) and its vectors real3 and real4, SINGLE (1 if real is
// float), and what the scene has: DASHPOTS, PULL, WIND (1: on faces, 2: on points), COLLIDERS (their number), WORKS (whether
// anything but springs and gravity changes the energy), FLAT, and GRID with ROWS, COLUMNS and STORED_ROWS, where all points are one. The buffers are filled by src/device/packed_scene.cpp.
layout(local_size_x = 64) in;

layout(location = 0) uniform int points;
layout(location = 1) uniform int pass;      // of the list in the frame
layout(location = 2) uniform int moment;    // of the forces, in steps since the start of the frame
layout(location = 3) uniform int acting;    // where the velocities at which dashpots and air act begin: points (v) or 2 points (predicted)
layout(location = 4) uniform int substep;   // since the start of the frame
layout(location = 5) uniform int reused;    // the substep after which accelerations are still those of the last pass unless it moved something; -1: never
layout(location = 6) uniform int first;     // dashpots of a sweep, to the one before `end`
layout(location = 7) uniform int end;
layout(location = 8) uniform ivec3 pulled;  // points that the hand pulls

struct Spring {
  real stiffness, rest_length, damping;  // k [N/m], l0 [m], d [N s/m]
  real only_pulls;                       // 1: a cable
};

// v = decay v + weight a, then x += drift v, and the prediction ahead_decay v + ahead_weight a (src/sim/forces/kick.h).
struct Pass {
  real decay, weight, drift, ahead_decay, ahead_weight;
  real duration;  // [s], of the kick
  real unused[2];
};

// The motion: positions [m] from 0, velocities [m/s] from `points`, predicted velocities from 2 `points` on, in place of which contact leaves
// displacements by impacts [m]. w of a position: the inverse mass
// [1/kg], 0 for points that are nailed or held.
layout(std430, binding = 0) buffer From { real4 from[]; };
layout(std430, binding = 1) buffer To { real4 to[]; };
layout(std430, binding = 2) buffer Accelerations { real4 accelerations[]; };  // [m/s^2]

// The springs of point i, unless all are of a grid: neighbors[first_neighbor[i]] .. neighbors[first_neighbor[i + 1] - 1], each the other end and the spring.
layout(std430, binding = 3) buffer FirstNeighbor { int first_neighbor[]; };
layout(std430, binding = 4) buffer Neighbors { ivec2 neighbors[]; };
layout(std430, binding = 5) buffer Springs { Spring springs[]; };

layout(std430, binding = 6) buffer Frame {
  real4 acceleration;  // [m/s^2], of gravity, and of wind by drag
  real4 pull;          // weights of the pulled points; w: stiffness [N/m]
  real4 air;           // normal and tangential coefficient of wind [kg/m^3]
  real4 substeps;      // h [s]; the velocity lag of the method under friction [1]; the rate of the dashpots [1/s]; drag [1/s]
  real4 pull_velocity;  // [m/s], of the hand that pulls
  real4 held;           // weight of the point that the hand holds [N]; w: its index, -1: none
  Pass passes[3];
};
// At the start of each substep and at the end of the last: where the hand pulls to [m], and the velocity of the wind [m/s].
struct Moment {
  real4 target, wind;
};
layout(std430, binding = 7) buffer Moments { Moment moments[]; };

// Faces (w = -1) and quads on which wind acts, and those of each point.
layout(std430, binding = 8) buffer Panels { ivec4 panels[]; };
layout(std430, binding = 9) buffer FirstPanel { int first_panel[]; };
layout(std430, binding = 10) buffer PanelsOfPoints { int panel_of[]; };
layout(std430, binding = 11) buffer Radii { real radius[]; };  // [m]

// What happened in each substep: bit 0: contact changed a motion, bit 1: a spring broke, bit 2: an impact changed a motion.
layout(std430, binding = 12) buffer Events { uint events[]; };

// Of each point, if WORKS: since the start of the frame, by the causes of src/sim/model/energy_ledger.h [J]; and at the last forces [W].
struct Work {
  real4 of_forces;   // the hand, wind, drag, dashpots
  real4 of_contact;  // contact, at most that of moving colliders, impulses [N s], displacement out of colliders
  real4 power;       // wind, dashpots
};
layout(std430, binding = 17) buffer Works { Work works[]; };
