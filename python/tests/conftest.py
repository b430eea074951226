import json
import os
import subprocess

import pytest

# Warnings of Hooke are tested where they are expected.
pytest_plugins: list[str] = []


@pytest.fixture
def command_line():
    """Runs hooke-headless; returns the finished process."""

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([os.environ["HOOKE_HEADLESS"], *arguments], capture_output=True, text=True, check=False)

    return run


@pytest.fixture
def run_json(command_line):
    """The JSON of `hooke run`."""
    return lambda *arguments: json.loads(command_line("run", *arguments, "--quiet", "--json", "-").stdout)
