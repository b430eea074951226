import json
import os
import subprocess

import pytest


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


@pytest.fixture
def refusal(command_line):
    """The line by which the command line refuses its arguments, with the name of the argument in Python for that of the option."""

    def line(*arguments: str) -> str:
        text = command_line(*arguments).stderr.removesuffix("\n").removesuffix(" (see --help)").removeprefix("hooke-headless: ")
        assert "\n" not in text
        if not text.startswith("--"):
            return text
        option, rest = text.removeprefix("--").split(" ", 1)
        return f"{option.removesuffix(':').replace('-', '_')}: {rest}"

    return line
