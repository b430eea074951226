#!/usr/bin/env python3
"""The documentation: links, limits of length, language, keys, labels, generated tables, and the commands that it shows.

    docs_test.py [--headless PROGRAM] [--make-manual PROGRAM]

Without --headless no command is run, without --make-manual no table is compared. docs_test.py --count prints the words of each page.
"""

import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
docs = root / "docs"
top = [root / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")]
pages = top + sorted(docs.rglob("*.md"))

WORDS_IN_ALL = 22_000
WORDS_OF_A_PAGE = {"README.md": 700, "docs/guide/error.md": 500, "docs/development/architecture.md": 1300, "docs/reference/contact.md": 1350}
WORDS_OF_A_FOLDER = {"guide": 900, "evidence": 300, "development": 700}
LINES_OF_A_VERSION = {"Unreleased": 40, "1.1.0": 60}

# Commands that are shown and not run by this test, with the reason.
OPENS_A_WINDOW = ["scripts/run", "hooke --reset-settings", "hooke cloth"]
NEEDS_A_BUILD = [
    "scripts/test", "scripts/test-sanitized", "scripts/setup", "scripts/fuzz", "scripts/tidy", ".ci/run", "cmake ", "c++ ", "tar ",
    "build/release/tests/", "build/release/bin/make_manual ", "HOOKE_PRINT=1 ", "PYTHONPATH=", "scripts/test-release", "scripts/package", "scripts/source-archive",
]
MEASURES_FOR_MINUTES = [
    "scripts/accuracy", "scripts/speed", "scripts/stability", "scripts/peers", "scripts/campaign", "scripts/questions", "scripts/pictures",
    "scripts/animation", "scripts/tolerance", "scripts/contact", "hooke bench --kernels", "hooke bench --scaling",
    "hooke bench --capacity", "hooke bench --edits", "hooke bench --overhead", "hooke check --hard", "hooke bench cloth",
]
NEEDS_OTHER_PROGRAMS = {"--engine": "lmp", ".mp4": "ffmpeg"}  # a part of the command, the program

# What readers have: a mesh.
TENT = "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nv 50 50 80\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"

problems = []


def problem(page, text):
    problems.append(f"{page.relative_to(root)}: {text}")


def prose_of(text):
    """The text without code, tables, pictures, addresses, and what is generated between comments."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"<!-- (\w+): begin -->.*?<!-- \1: end -->", "", text, flags=re.DOTALL)
    text = re.sub(r"<!-- (table \w+|results) -->.*?<!-- end( of results)? -->", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    lines, previous_blank = [], True
    for line in text.splitlines():
        is_code = re.match(r" {4,}\S", line) and previous_blank
        if not line.lstrip().startswith("|") and not is_code:
            lines.append(line)
        previous_blank = not line.strip() or bool(is_code)
    text = "\n".join(lines)
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    return re.sub(r"\]\([^)]*\)", "]", text)


def words_of(page):
    return len([word for word in prose_of(page.read_text()).split() if re.search(r"\w", word)])


def all_words_of(page):
    """The strictest count: everything between blanks that is neither code nor a row of a table, also in generated parts."""
    text = re.sub(r"<!--.*?-->|^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    words, previous_blank = 0, True
    for line in text.splitlines():
        is_code = re.match(r" {4,}\S", line) and previous_blank
        if not line.lstrip().startswith("|") and not is_code:
            words += len(line.split())
        previous_blank = not line.strip() or bool(is_code)
    return words


def commands_of(page):
    """The commands of indented blocks."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    found, previous_blank = [], True
    for line in text.splitlines():
        is_code = re.match(r" {4,}\S", line) and previous_blank
        if is_code:
            found.append(line.strip())
        previous_blank = not line.strip() or bool(is_code)
    return [re.sub(r"\s+#.*", "", line) for line in found if re.match(r"(\$ )?(hooke|scripts/|build/|cmake|\.ci|HOOKE_|PYTHONPATH|tar|c\+\+|git)", line)]


def anchors_of(page):
    found = set()
    for line in page.read_text().splitlines():
        if match := re.match(r"#+ (.*)", line):
            title = re.sub(r"[`*]", "", match[1]).lower()
            found.add(re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", title)))
    return found


def check_links():
    for page in pages:
        text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
        for address in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"[a-z]+://", address):
                continue
            name, _, anchor = address.partition("#")
            target = (page.parent / name).resolve() if name else page
            if not target.exists():
                problem(page, f"{address}: there is no such file")
            elif anchor and target.suffix == ".md" and anchor not in anchors_of(target):
                problem(page, f"{address}: there is no such heading")
    # pages that sources, scripts, tests and the text of other pages name
    for folder in ("src", "tests", "scripts", "python", "cmake", "packaging", ".ci", "docs"):
        for file in (root / folder).rglob("*"):
            if not file.is_file() or file.suffix in (".png", ".hookelog", ".obj", ".pyc", ".webp", ".svg") or "corpus" in file.parts or file == pathlib.Path(__file__):
                continue
            for name in re.findall(r"docs/[\w./-]*\.(?:md|json|csv|ipynb|png|svg|webp)", file.read_text(errors="ignore")):
                if not (root / name).exists():
                    problem(file, f"{name}: there is no such page")


def check_lengths():
    for page in pages:
        name = str(page.relative_to(root))
        limit = WORDS_OF_A_PAGE.get(name, WORDS_OF_A_FOLDER.get(page.parent.name))
        if limit is not None and words_of(page) > limit:
            problem(page, f"{words_of(page)} words, at most {limit}")
    if (words := sum(map(all_words_of, pages))) > WORDS_IN_ALL:
        problems.append(f"docs, README, CHANGELOG, CONTRIBUTING: {words} words, at most {WORDS_IN_ALL}")
    for section in re.split(r"^## ", (root / "CHANGELOG.md").read_text(), flags=re.MULTILINE)[1:]:
        version = re.match(r"\[([^]]*)\]", section)[1]
        if version in LINES_OF_A_VERSION and len(section.strip().splitlines()) > LINES_OF_A_VERSION[version]:
            problems.append(f"CHANGELOG.md: {version}: {len(section.strip().splitlines())} lines, at most {LINES_OF_A_VERSION[version]}")
    for page in sorted((docs / "guide").glob("*.md")):
        if not re.search(r"!\[[^]]+\]\([^)]+\)", "\n".join(page.read_text().splitlines()[:12])):
            problem(page, "no picture near the top")


def check_language():
    """What tells of earlier versions belongs into the changelog."""
    for page in pages:
        if page.name != "CHANGELOG.md":
            for words in re.findall(r"\b(?:no longer|formerly|previously|anymore|any more|of the same|of before|since then)\b", prose_of(page.read_text())):
                problem(page, f"{words}: no history, and no sentence that needs the one before it")


def check_keys():
    keys = set(re.findall(r"\*\*(.+?)\*\* \|", (docs / "reference/keys.md").read_text()))
    is_key = re.compile(r"(Ctrl\+|Shift\+)*([A-Z0-9,.=\[\]-]|F\d+|Space|Esc|Enter|Tab|Del|Backspace|Right|Left|Up|Down|Home)$")
    for page in [root / "README.md", *sorted((docs / "guide").glob("*.md"))]:
        for key in re.findall(r"\*\*([^*\s]+)\*\*", page.read_text()):
            if is_key.match(key) and key not in keys:
                problem(page, f"{key}: no such key in docs/reference/keys.md")


def check_labels():
    """*Labels* of the guide are names of scenes, or start or end a text of the program."""
    sources = "".join(file.read_text() for kind in ("*.cpp", "*.h", "*.inc") for file in (root / "src").rglob(kind))
    scenes = {json.loads(file.read_text()).get("name") for file in (root / "assets/scenes").glob("*.json")}
    for page in [root / "README.md", *sorted((docs / "guide").glob("*.md"))]:
        for label in re.findall(r"(?<![*\w])\*([A-Z][^*\n?]{1,40})\*(?!\*)", page.read_text()):
            if label not in scenes and f'"{label}' not in sources and f'{label}"' not in sources:
                problem(page, f"{label}: no such label or scene")


def check_names():
    """Names of code in the description of the architecture, `Lab::advance` or `sim/contact/contact`, exist."""
    page = docs / "development/architecture.md"
    sources = "".join(file.read_text() for kind in ("*.cpp", "*.h") for file in (root / "src").rglob(kind))
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    for name in re.findall(r"`([^`\n ]+)`", text):
        if re.fullmatch(r"[A-Z]\w*[a-z]\w*(::\w+)?|[a-z]+_\w+", name):
            if not re.search(rf"\b{name.rpartition('::')[2]}\b", sources) and not list((root / "src").rglob(f"{name}.cpp")):
                problem(page, f"{name}: there is no such name in src")
        elif re.fullmatch(r"(src|sim|app|scene|ui|lab|edit|shaders|assets)/[a-z\d_./-]+", name):
            path = root / name if (root / name).parent.exists() else root / "src" / name
            if not path.exists() and not list(path.parent.glob(path.name + ".*")):
                problem(page, f"{name}: there is no such file")


def check_tables(make_manual):
    with tempfile.TemporaryDirectory() as folder:
        for page in pages:
            if "<!-- table " not in page.read_text():
                continue
            copy = pathlib.Path(folder) / page.name
            shutil.copy(page, copy)
            subprocess.run([make_manual, "docs", copy], check=True)
            if copy.read_text() != page.read_text():
                problem(page, f"a table is not up to date: build/release/bin/make_manual docs {page.relative_to(root)}")


def reason_not_to_run(command):
    for reason, starts in (("opens a window", OPENS_A_WINDOW), ("needs a build", NEEDS_A_BUILD), ("takes minutes", MEASURES_FOR_MINUTES)):
        if any(command.startswith(start) for start in starts):
            return reason
    return next((f"needs {program}" for part, program in NEEDS_OTHER_PROGRAMS.items() if part in command and not shutil.which(program)), None)


def words_with_files(command, folder):
    """The words of a command, with the parts of a sweep, which a cluster has computed in another folder, in place of `parts/*`."""
    for part in folder.glob("part[12]") if "parts/*" in command else []:
        part.rename(folder / "parts" / part.name)
    return [word for pattern in shlex.split(command)[1:] for word in (sorted(map(str, folder.glob(pattern))) if "*" in pattern else [pattern])]


def check_options(page, command, headless, helps={}):
    """The words of a command that is not run: a script that exists, or a command and options that `--help` knows."""
    words = shlex.split(command.replace("build/release/bin/hooke", "hooke"))
    if words[0].startswith(("scripts/", ".ci/")) and not (root / words[0]).exists():
        problem(page, f"{command}: there is no {words[0]}")
    if words[0] not in ("hooke", "hooke-headless") or len(words) < 2 or words[1].startswith("-") or not headless:
        return
    if words[1] not in helps:
        result = subprocess.run([headless, words[1], "--help"], capture_output=True, text=True)
        helps[words[1]] = result.stdout if result.returncode == 0 else None
    if helps[words[1]] is None:
        if words[1].islower() and not (root / "assets/scenes" / f"{words[1]}.json").exists():
            problem(page, f"{command}: no such command")
        return
    for word in words[2:]:
        if word.startswith("--") and not re.search(re.escape(word.partition("=")[0]) + r"\b", helps[words[1]]):
            problem(page, f"{command}: there is no option {word}")


def check_commands(headless, prints):
    recording = root / "tests/docs/session.hookelog"
    as_root_too = os.environ | {f"OMPI_{name}": "1" for name in ("ALLOW_RUN_AS_ROOT", "ALLOW_RUN_AS_ROOT_CONFIRM", "MCA_rmaps_base_oversubscribe")}
    captured = set()
    for page in pages:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            shutil.copy(recording, folder)
            (folder / "tent.obj").write_text(TENT)
            (folder / "parts").mkdir()
            for command in commands_of(page):
                command = command.removeprefix("$ ").replace("build/release/bin/hooke ", "hooke ")
                reason = reason_not_to_run(command)
                if reason or not headless:
                    check_options(page, command, headless)
                    if prints:
                        print(f"not run ({reason}): {command}")
                    continue
                if not command.startswith(("hooke ", "hooke-headless ")):
                    problem(page, f"{command}: neither run nor in a list of this test")
                    continue
                # a film of a second shows as much as one of five; the same picture need not be drawn for each page
                command = re.sub(r"--seconds [2-9](?= .*\.(webp|gif|mp4)$)", "--seconds 1", command)
                if command.startswith("hooke capture") and command in captured:
                    continue
                captured.add(command)
                words = [str(headless), *words_with_files(command, folder)]
                result = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300, stdin=subprocess.DEVNULL, env=as_root_too)
                if prints:
                    print(f"{result.returncode}: {command}")
                if result.returncode != 0:
                    problem(page, f"{command}: exit code {result.returncode}: {result.stderr.strip()[-300:]}")
        # commands in jobs and scripts
        for block in re.findall(r"^```(?:sh|yaml)$(.*?)^```$", page.read_text(), flags=re.DOTALL | re.MULTILINE):
            for command in re.findall(r"\bhooke-headless \w.*", block.replace("\\\n", " ")):
                check_options(page, command, headless)
        # commands within the text
        text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
        for command in re.findall(r"(?<!`)`((?:hooke|hooke-headless|scripts/|\.ci/)[^`\n]*)`", text):
            try:
                if re.match(r"(hooke|hooke-headless) |scripts/|\.ci/", command):
                    check_options(page, command, headless)
            except ValueError as error:
                problem(page, f"{command}: {error}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--headless", type=pathlib.Path, help="hooke-headless, to run the commands")
    parser.add_argument("--make-manual", type=pathlib.Path, help="make_manual, to compare the tables")
    parser.add_argument("--count", action="store_true", help="print the words of each page, and do nothing else")
    parser.add_argument("--verbose", action="store_true", help="print the commands and their exit codes")
    arguments = parser.parse_args()
    if arguments.count:
        for page in pages:
            print(f"{words_of(page):6} {page.relative_to(root)}")
        print(f"{sum(map(words_of, pages)):6} words outside code, tables and what is generated")
        print(f"{sum(map(all_words_of, pages)):6} of anything between blanks outside code and rows of tables, at most {WORDS_IN_ALL}")
        return
    check_links()
    check_lengths()
    check_language()
    check_keys()
    check_labels()
    check_names()
    if arguments.make_manual:
        check_tables(arguments.make_manual.resolve())
    check_commands(arguments.headless and arguments.headless.resolve(), arguments.verbose)
    print("\n".join(problems))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
