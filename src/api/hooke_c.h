/* Hooke for C and for languages that call C: the interface of hooke/hooke.h with handles. SI units throughout.

     hooke_scene* scene = hooke_scene_load("cloth");
     hooke_simulation* simulation = hooke_simulation_new(scene, HOOKE_ACCURACY_OFF);
     hooke_simulation_step(simulation, 1.0);
     const double* positions = hooke_simulation_positions(simulation);

   Errors: functions that return a handle or a pointer return NULL, those that return int return -1, those that return a number NaN or -1;
   hooke_error then returns one line, of this thread, and hooke_error_code 2 for usage, 3 for input and 5 for a file. The stability is that
   of hooke/hooke.h. Strings are valid until the next call for the same handle, or the next error. */
#ifndef HOOKE_C_H
#define HOOKE_C_H

#include <stdint.h>

#if defined(__GNUC__)
#define HOOKE_C_PUBLIC __attribute__((visibility("default")))
#else
#define HOOKE_C_PUBLIC
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_scene hooke_scene;
typedef struct hooke_simulation hooke_simulation;
typedef struct {
  int kind;         /* 0: a plane with a point and a normal; 1: a sphere with a center; 2: a box with min and max */
  double first[3];  /* [m] */
  double second[3]; /* [m]; of a plane [1] */
  double radius;    /* [m] */
} hooke_collider;
enum { HOOKE_ACCURACY_OFF = 0, HOOKE_ACCURACY_FRAME = 1, HOOKE_ACCURACY_FULL = 2 };  // NOLINT(readability-identifier-naming)

HOOKE_C_PUBLIC const char* hooke_version(void);
HOOKE_C_PUBLIC const char* hooke_error(void);
HOOKE_C_PUBLIC int hooke_error_code(void);

HOOKE_C_PUBLIC hooke_scene* hooke_scene_new(void);
HOOKE_C_PUBLIC hooke_scene* hooke_scene_load(const char* name);
HOOKE_C_PUBLIC hooke_scene* hooke_scene_parse(const char* json);
HOOKE_C_PUBLIC void hooke_scene_free(hooke_scene* scene); /* NULL: nothing */
HOOKE_C_PUBLIC int hooke_scene_add(hooke_scene* scene, const char* members);
HOOKE_C_PUBLIC int64_t hooke_scene_add_point(hooke_scene* scene, const double position[3], double mass, int nailed);
HOOKE_C_PUBLIC int64_t hooke_scene_add_spring(hooke_scene* scene, int64_t first, int64_t second, double stiffness, double damping);
HOOKE_C_PUBLIC int hooke_scene_set(hooke_scene* scene, const char* setting); /* "stiffness=200" */
HOOKE_C_PUBLIC int hooke_scene_set_integrator(hooke_scene* scene, const char* id);
HOOKE_C_PUBLIC int hooke_scene_save(hooke_scene* scene, const char* file);
HOOKE_C_PUBLIC int64_t hooke_scene_point_count(const hooke_scene* scene);
HOOKE_C_PUBLIC int64_t hooke_scene_spring_count(const hooke_scene* scene);
HOOKE_C_PUBLIC const char* hooke_scene_json(hooke_scene* scene);

/* Copies the scene. */
HOOKE_C_PUBLIC hooke_simulation* hooke_simulation_new(const hooke_scene* scene, int accuracy);
HOOKE_C_PUBLIC void hooke_simulation_free(hooke_simulation* simulation);
/* 1: stepped; 0: it diverged, and hooke_simulation_diagnosis says why. */
HOOKE_C_PUBLIC int hooke_simulation_frame(hooke_simulation* simulation);
HOOKE_C_PUBLIC int hooke_simulation_step(hooke_simulation* simulation, double seconds);
HOOKE_C_PUBLIC int hooke_simulation_set_threads(hooke_simulation* simulation, int threads);
HOOKE_C_PUBLIC hooke_scene* hooke_simulation_scene(const hooke_simulation* simulation); /* a copy in the present state */
HOOKE_C_PUBLIC const char* hooke_simulation_diagnosis(hooke_simulation* simulation);

HOOKE_C_PUBLIC double hooke_simulation_time(const hooke_simulation* simulation);
HOOKE_C_PUBLIC uint64_t hooke_simulation_hash(const hooke_simulation* simulation); /* 0 after an error */
HOOKE_C_PUBLIC double hooke_simulation_error(const hooke_simulation* simulation);
HOOKE_C_PUBLIC double hooke_simulation_frame_error(const hooke_simulation* simulation);
HOOKE_C_PUBLIC int hooke_simulation_energy(const hooke_simulation* simulation, double energy[3]); /* kinetic, elastic, gravitational */
HOOKE_C_PUBLIC int64_t hooke_simulation_point_count(const hooke_simulation* simulation);
HOOKE_C_PUBLIC int64_t hooke_simulation_spring_count(const hooke_simulation* simulation);
HOOKE_C_PUBLIC int64_t hooke_simulation_face_count(const hooke_simulation* simulation);
HOOKE_C_PUBLIC int64_t hooke_simulation_collider_count(const hooke_simulation* simulation);
/* x, y, z of every point; valid until the simulation is stepped, changed or freed. */
HOOKE_C_PUBLIC const double* hooke_simulation_positions(const hooke_simulation* simulation);
HOOKE_C_PUBLIC const double* hooke_simulation_velocities(const hooke_simulation* simulation);
/* Fill arrays of the caller: two points of every spring and three of every face; mass [kg], radius [m] and nail (1 or 0) of every point;
   stiffness [N/m], rest length [m] and tension [N] of every spring; the force of the nail of every point [N], and the mean force of contact
   on it over the last frame [N]; every collider as it is now. */
HOOKE_C_PUBLIC int hooke_simulation_springs(const hooke_simulation* simulation, int64_t* points);
HOOKE_C_PUBLIC int hooke_simulation_faces(const hooke_simulation* simulation, int64_t* points);
HOOKE_C_PUBLIC int hooke_simulation_masses(const hooke_simulation* simulation, double* masses);
HOOKE_C_PUBLIC int hooke_simulation_radii(const hooke_simulation* simulation, double* radii);
HOOKE_C_PUBLIC int hooke_simulation_nailed(const hooke_simulation* simulation, int* nailed);
HOOKE_C_PUBLIC int hooke_simulation_stiffness(const hooke_simulation* simulation, double* stiffness);
HOOKE_C_PUBLIC int hooke_simulation_rest_lengths(const hooke_simulation* simulation, double* lengths);
HOOKE_C_PUBLIC int hooke_simulation_tensions(const hooke_simulation* simulation, double* tensions);
HOOKE_C_PUBLIC int hooke_simulation_reactions(const hooke_simulation* simulation, double* reactions);
HOOKE_C_PUBLIC int hooke_simulation_contact_forces(const hooke_simulation* simulation, double* forces);
HOOKE_C_PUBLIC int hooke_simulation_colliders(const hooke_simulation* simulation, hooke_collider* colliders);
/* The number of points that touched something in the last frame, at most that of all points: these points, the kind of what each touched
   (1: a collider, 2: a point, 3: a spring, 4: a face, 0: unknown), its number in its list, and x, y, z of the normal towards the point. */
HOOKE_C_PUBLIC int64_t hooke_simulation_contacts(const hooke_simulation* simulation, int64_t* points, int* kinds, int64_t* numbers,
                                                 double* normals);

HOOKE_C_PUBLIC int hooke_simulation_grab(hooke_simulation* simulation, int64_t point, const double target[3]);
HOOKE_C_PUBLIC int hooke_simulation_pull(hooke_simulation* simulation, int64_t point, const double target[3], double stiffness);
HOOKE_C_PUBLIC int hooke_simulation_move_hand(hooke_simulation* simulation, const double target[3]);
HOOKE_C_PUBLIC int hooke_simulation_release(hooke_simulation* simulation);
HOOKE_C_PUBLIC int hooke_simulation_nail(hooke_simulation* simulation, int64_t point, int nailed);
HOOKE_C_PUBLIC int hooke_simulation_move(hooke_simulation* simulation, int64_t point, const double position[3], const double velocity[3]);
HOOKE_C_PUBLIC int hooke_simulation_set(hooke_simulation* simulation, const char* setting);
HOOKE_C_PUBLIC int hooke_simulation_undo(hooke_simulation* simulation);
HOOKE_C_PUBLIC int hooke_simulation_redo(hooke_simulation* simulation);

#ifdef __cplusplus
}
#endif

#endif
