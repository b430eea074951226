#!/usr/bin/env python3
"""Draws docs/pictures/speed.svg from the tables of docs/evidence/speed.md: speed_chart.py [--check]

On the left, the time of a step against the size of the cloth; on the right, the time that each feature takes, relative to a cloth without it.
With --check the picture is compared and not written; the exit code is 1 if it differs.
"""

import math
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[2]
page = root / "docs/evidence/speed.md"
picture = root / "docs/pictures/speed.svg"

# Okabe and Ito 2008, legible in print and with color vision deficiencies.
COLORS = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#000000"]
WIDTH, HEIGHT, TOP = 980, 510, 64


def table(heading):
    """{row: [number or None of each column]} of the table that has this heading in its first line."""
    lines = page.read_text().split(f"\n{heading}\n")[1].splitlines()[1:]
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        name, *cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[name.replace("`", "")] = [float(cell) if re.fullmatch(r"[\d.]+", cell) else None for cell in cells]
    return rows


def text(x, y, words, anchor="start", color="#333333", size=13, weight="normal"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}" font-size="{size}" font-weight="{weight}">{words}</text>'


def line(x0, y0, x1, y1, color="#DDDDDD"):
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{color}"/>'


def steps_by_size(left, right, bottom):
    """Lines over the number of points of a side; the vertical axis begins at zero."""
    rows = table("| velocity_verlet or named, ns per spring and step | 32 x 32 | 64 x 64 | 128 x 128 | 256 x 256 | 512 x 512 | 1024 x 1024 |")
    sizes, top = [32, 64, 128, 256, 512, 1024], 3.0
    x = [left + (right - left) * i / (len(sizes) - 1) for i in range(len(sizes))]
    y = lambda value: bottom - (bottom - TOP) * value / top
    parts = [text(left - 34, 26, "Time of a step, in nanoseconds per spring", size=15, weight="bold")]
    for value in (0, 0.5, 1, 1.5, 2, 2.5, 3):
        parts += [line(left, y(value), right, y(value)), text(left - 8, y(value) + 4, f"{value:g}", "end")]
    parts += [text(x[i], bottom + 20, f"{size}²", "middle") for i, size in enumerate(sizes)]
    parts.append(text((left + right) / 2, bottom + 42, "points of the cloth", "middle"))
    for n, (name, values) in enumerate(rows.items()):
        points = [(x[i], y(value)) for i, value in enumerate(values) if value is not None]
        parts.append(f'<polyline fill="none" stroke="{COLORS[n]}" stroke-width="2" points="{" ".join(f"{a:.1f},{b:.1f}" for a, b in points)}"/>')
        parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.2" fill="{COLORS[n]}"/>' for a, b in points]
        key = TOP + 14 + 20 * n
        parts += [line(left + 14, key - 4, left + 38, key - 4, COLORS[n]), f'<circle cx="{left + 26}" cy="{key - 4}" r="3.2" fill="{COLORS[n]}"/>',
                  text(left + 46, key, name)]
    return parts


def costs_of_features(left, right, bottom):
    """Bars on a logarithmic axis, relative to the row `grid`; of the smaller cloth where the larger one is not measured."""
    rows = table("| ns per spring and step | 32 x 32 | 64 x 64 |")
    grid = rows.pop("grid")
    ratios = {name: next(row[i] / grid[i] for i in (1, 0) if row[i] is not None) for name, row in rows.items()}
    ratios = dict(sorted(ratios.items(), key=lambda item: item[1]))
    x = lambda ratio: left + (right - left) * math.log(ratio / 0.4) / math.log(600 / 0.4)
    step = (bottom - TOP) / len(ratios)
    parts = [text(left - 190, 26, "Time with a feature, relative to a cloth alone", size=15, weight="bold")]
    for ratio in (1, 10, 100):
        parts += [line(x(ratio), TOP, x(ratio), bottom), text(x(ratio), bottom + 20, f"{ratio}", "middle")]
    parts.append(text((left + right) / 2, bottom + 42, "times the cloth alone", "middle"))
    for n, (name, ratio) in enumerate(ratios.items()):
        y = TOP + step * n
        begin, end = sorted((x(1), x(ratio)))
        parts += [f'<rect x="{begin:.1f}" y="{y + 3:.1f}" width="{max(end - begin, 1):.1f}" height="{step - 6:.1f}" fill="{COLORS[0 if ratio >= 1 else 2]}"/>',
                  text(left - 8, y + step / 2 + 4, name, "end", size=12), text(end + 6, y + step / 2 + 4, f"{ratio:.2g}" if ratio < 10 else f"{ratio:.0f}", size=12)]
    return parts


def chart():
    parts = steps_by_size(52, 420, HEIGHT - 62) + costs_of_features(680, 940, HEIGHT - 62)
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="DejaVu Sans, sans-serif">')
    return "\n".join([head, f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>', *parts, "</svg>", ""])


if sys.argv[1:] not in ([], ["--check"]):
    sys.exit(__doc__)
if not sys.argv[1:]:
    picture.write_text(chart())
elif not picture.exists() or picture.read_text() != chart():
    sys.exit(f"{picture.relative_to(root)} differs from the tables of {page.relative_to(root)}: run scripts/speed-chart")
