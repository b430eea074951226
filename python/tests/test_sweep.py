"""Sweeps: the values of the command line, columns, parts, charts."""

import numpy as np
import pytest

import hooke

vary = {"stiffness": [100, 316.5, 1000.0], "substeps": np.array([8, 16])}
measure = ["max_strain", "max:fastest", "error"]


@pytest.fixture(scope="module")
def sweep() -> hooke.Sweep:
    return hooke.load("rope").sweep(vary, measure, 0.1)


def test_a_sweep_has_the_values_of_the_command_line(sweep, command_line, tmp_path):
    command_line("sweep", "rope", "--vary", "stiffness=100,316.5,1000", "--vary", "substeps=8,16", "--measure", ",".join(measure),
                 "--seconds", "0.1", "--quiet", "--out", str(tmp_path))
    assert (tmp_path / "sweep.csv").read_text() == sweep.to_csv(tmp_path / "ours.csv") == (tmp_path / "ours.csv").read_text()


def test_the_columns_are_arrays(sweep):
    assert len(sweep) == 6 and sweep.is_complete and sweep.rows.tolist() == list(range(6))
    assert sweep["stiffness"].tolist() == [100, 100, 316.5, 316.5, 1000, 1000] and sweep["substeps"].tolist() == [8, 16] * 3
    for name in measure:
        assert sweep[name].shape == (6,) and sweep[name].dtype == np.float64
    assert sweep.units["stiffness"] == "N/m" and set(sweep.columns) == {"stiffness", "substeps", *measure}
    assert set(sweep.status) <= {"ok", "warning", "diverged"} and len(sweep.notes) == 6
    with pytest.raises(KeyError):
        sweep["speed"]


def test_a_row_has_the_values_of_a_run(sweep):
    scene = hooke.load("rope")
    scene["stiffness"], scene["substeps"] = 316.5, 16
    assert scene.run(0.1).frame_error[-1] == sweep["error"][3]


def test_a_range_is_that_of_the_command_line(command_line, tmp_path):
    ours = hooke.load("rope").sweep({"stiffness": "100:1000:log:4"}, "max_strain", 0.05)
    command_line("sweep", "rope", "--vary", "stiffness=100:1000:log:4", "--measure", "max_strain", "--seconds", "0.05", "-q", "--out", str(tmp_path))
    assert (tmp_path / "sweep.csv").read_text() == ours.to_csv()


def test_the_parts_of_a_sweep_are_merged_into_all_of_it(sweep, tmp_path):
    for part in (1, 2):
        hooke.load("rope").sweep(vary, measure, 0.1, shard=f"{part}/2", out=tmp_path / str(part))
    assert hooke.merge_sweeps([tmp_path / "1", tmp_path / "2"], tmp_path / "all").to_csv() == sweep.to_csv()


def test_a_sweep_is_drawn_with_matplotlib(sweep):
    import matplotlib

    matplotlib.use("Agg")
    axes = sweep.plot("max_strain")
    assert len(axes.lines) == 2 and axes.get_xlabel() == "stiffness [N/m]" and axes.get_xscale() == "log"
    assert len(sweep.plot()) == 3
