"""The examples of README.md and docs/guide/python.md run."""

import pathlib
import re

import hooke

page = pathlib.Path(__file__).parents[2] / "docs" / "guide" / "python.md"


def test_the_examples_of_the_page_run(tmp_path, monkeypatch):
    import matplotlib

    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL)
    assert len(blocks) == 3
    variables: dict[str, object] = {}
    # shorter than on the page, so that the test is fast
    first = blocks[0].replace("seconds=2", "seconds=0.1").replace("points=(32, 32)", "points=(6, 6)").replace('load("cloth")', "Scene()")
    exec(compile(first.replace("(1280, 720)", "(160, 90)"), page.name, "exec"), variables)
    assert variables["run"].positions.shape == (7, 36, 3) and (tmp_path / "cloth.png").exists()
    scene = hooke.Scene()
    first_point = scene.add_point((0, 0, 0), nailed=True)
    scene.add_spring(first_point, scene.add_point((1, 0, 0)))
    derivatives: dict[str, object] = {"scene": scene, "measured": 0.0}
    exec(compile(blocks[1].replace("seconds=1,", "seconds=0.1,"), page.name, "exec"), derivatives)
    exec(compile(blocks[2], page.name, "exec"), variables)
    assert not variables["scene"].run(0.05, accuracy="off").diverged


def test_the_example_of_the_readme_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    block = re.search(r"```python\n(.*?)```", (page.parents[2] / "README.md").read_text(), re.DOTALL)
    assert block is not None
    variables: dict[str, object] = {}
    exec(compile(block[1].replace("seconds=1", "seconds=0.05"), "README.md", "exec"), variables)
    assert (tmp_path / "cloth.png").exists()
