"""The library from another language: its C interface by ctypes, with the bits of the module."""

import ctypes
import os

import numpy as np

import hooke


def library() -> ctypes.CDLL:
    c = ctypes.CDLL(os.environ["HOOKE_LIBRARY"])
    for name in ("hooke_version", "hooke_error"):
        getattr(c, name).restype = ctypes.c_char_p
    for name in ("hooke_scene_load", "hooke_simulation_new", "hooke_simulation_positions"):
        getattr(c, name).restype = ctypes.c_void_p
    c.hooke_simulation_hash.restype = ctypes.c_uint64
    c.hooke_simulation_point_count.restype = ctypes.c_int64
    return c


def test_a_simulation_has_the_bits_of_a_run():
    c = library()
    assert c.hooke_version().decode() == hooke.__version__
    scene = ctypes.c_void_p(c.hooke_scene_load(b"cloth"))
    simulation = ctypes.c_void_p(c.hooke_simulation_new(scene, 0))
    c.hooke_scene_free(scene)
    assert c.hooke_simulation_step(simulation, ctypes.c_double(0.1)) == 1
    run = hooke.load("cloth").run(0.1, accuracy="off")
    assert f"{c.hooke_simulation_hash(simulation):016x}" == run.hash
    count = c.hooke_simulation_point_count(simulation)
    positions = ctypes.cast(c.hooke_simulation_positions(simulation), ctypes.POINTER(ctypes.c_double))
    assert np.array_equal(np.ctypeslib.as_array(positions, (count, 3)), run.positions[-1])
    c.hooke_simulation_free(simulation)


def test_mistakes_are_answered_with_a_line():
    c = library()
    assert c.hooke_scene_load(b"nowhere") is None and c.hooke_error().startswith(b"nowhere: no such file or shipped scene")


def test_contact_forces_are_those_of_the_module():
    c = library()
    scene = hooke.load("marbles")
    simulation = ctypes.c_void_p(c.hooke_simulation_new(ctypes.c_void_p(c.hooke_scene_load(b"marbles")), 0))
    lab = scene.lab()
    for _ in range(60):
        assert c.hooke_simulation_frame(simulation) == 1
    lab.step(60)
    forces = np.empty((scene.point_count, 3))
    assert c.hooke_simulation_contact_forces(simulation, forces.ctypes.data_as(ctypes.c_void_p)) == 0
    assert forces.any() and np.array_equal(forces, lab.contact_forces)
    touching = [contact.point for contact in lab.contacts]
    assert touching == np.flatnonzero(forces.any(axis=1)).tolist()
    for contact in lab.contacts:
        assert contact.kind in ("collider", "point") and np.array_equal(contact.force, forces[contact.point])
        assert np.dot(contact.normal, contact.force) > 0 and abs(np.linalg.norm(contact.normal) - 1) < 1e-12
    c.hooke_simulation_free(simulation)
