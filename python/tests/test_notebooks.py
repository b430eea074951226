"""The notebooks of docs/guide/notebooks run without errors, cell by cell as in Jupyter, in an empty folder."""

import ast
import json
import pathlib

import pytest

notebooks = sorted((pathlib.Path(__file__).parents[2] / "docs" / "guide" / "notebooks").glob("*.ipynb"))


def test_there_are_four_notebooks():
    assert [file.stem for file in notebooks] == ["first_steps", "fit_stiffness", "identify_stiffness", "speed_and_error"]


@pytest.mark.filterwarnings("error::hooke.HookeWarning")
@pytest.mark.parametrize("file", notebooks, ids=lambda file: file.stem)
def test_the_notebook_runs(file, tmp_path, monkeypatch):
    import matplotlib

    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    variables: dict[str, object] = {"__name__": "__main__"}
    for number, cell in enumerate(json.loads(file.read_text())["cells"]):
        if cell["cell_type"] != "code":
            continue
        module = ast.parse("".join(cell["source"]).rstrip(";"))
        shown = ast.Expression(module.body.pop().value) if isinstance(module.body[-1], ast.Expr) else None
        exec(compile(module, f"{file.name}, cell {number}", "exec"), variables)
        if shown is None:
            continue
        value = eval(compile(shown, f"{file.name}, cell {number}", "eval"), variables)
        if hasattr(value, "_repr_png_"):
            assert value._repr_png_()
