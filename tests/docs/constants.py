#!/usr/bin/env python3
"""Writes docs/development/constants.md, the table of the numbers that change results: constants.py [--check]

They stand in src/sim/*/constants.h, one declaration or more after the comment that explains them. With --check the page is compared and
not written; the exit code is 1 if it differs.
"""

import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[2]
page = root / "docs/development/constants.md"
declaration = re.compile(r"inline constexpr [\w:]+ (.*);", re.DOTALL)


def constants_of(header):
    """(comment, [(name, value)]) in the order of the header; names without values belong to the text of a section."""
    comment, declared = [], ""
    for line in header.read_text().splitlines():
        line = line.strip()
        if declared or line.startswith("inline constexpr"):
            declared += " " + re.sub(r"\s*//.*", "", line)
            if not declared.endswith(";"):
                continue
            names = declaration.search(declared).group(1)
            yield " ".join(comment) or "as above", re.findall(r"(\w+) = ([^,]+)", names)
            declared, comment = "", []
        elif line.startswith("// "):
            comment.append(line[3:])
        elif not line:
            comment = []


def table():
    lines = ["# The numbers that change results", "",
             "Made by `scripts/constants` from the headers `src/sim/*/constants.h`; `[1]` is a pure number. Coefficients of methods are in their files.", ""]
    for header in sorted((root / "src/sim").glob("*/constants.h")):
        lines += [f"## {header.parent.name}", "", "| constant | value | unit, reason and source |", "|---|---|---|"]
        for comment, names in constants_of(header):
            first, *others = [f"| `{name}` | {value.replace(chr(39), '')} |" for name, value in names]
            lines.append(f"{first} {comment.replace('|', '&#124;')} |")
            lines += [f"{other} |" for other in others]
        lines.append("")
    return "\n".join(lines)


if sys.argv[1:] not in ([], ["--check"]):
    sys.exit(__doc__)
if not sys.argv[1:]:
    page.parent.mkdir(exist_ok=True)
    page.write_text(table())
elif not page.exists() or page.read_text() != table():
    sys.exit(f"{page.relative_to(root)} differs from the headers: run scripts/constants")
