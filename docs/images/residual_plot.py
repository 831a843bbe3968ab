#!/usr/bin/env python3
"""residual_plot.py CALIBRATION.json TITLE > PICTURE.svg: position errors of the control set before and after.

Reads what `truepose calibrate --output CALIBRATION.json` writes. Nothing in the picture is typed in.
"""

import html
import json
import math
import sys

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 300, 56, 20, 58, 48
BINS = 48


def histogram(values, step):
    counts = [0] * BINS
    for value in values:
        counts[min(BINS - 1, int(value / step))] += 1
    return counts


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def bars(counts, most, color):
    wide = (WIDTH - LEFT - RIGHT) / BINS
    high = HEIGHT - TOP - BOTTOM
    return "".join(
        f'<rect x="{LEFT + i * wide:.1f}" y="{HEIGHT - BOTTOM - high * n / most:.1f}" width="{wide - 0.6:.1f}" '
        f'height="{high * n / most:.1f}" fill="{color}" fill-opacity="0.6"/>' for i, n in enumerate(counts) if n)


def axis(step):
    marks, distance = [], 0.5 if step * BINS > 1.5 else 0.25
    for k in range(int(step * BINS / distance) + 1):
        x = LEFT + k * distance / (step * BINS) * (WIDTH - LEFT - RIGHT)
        marks.append(f'<line x1="{x:.1f}" y1="{HEIGHT - BOTTOM}" x2="{x:.1f}" y2="{HEIGHT - BOTTOM + 5}" stroke="#444"/>'
                     f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{k * distance:g}</text>')
    return "".join(marks)


def picture(title, before, after):
    step = max(before + after) * 1.001 / BINS
    of_before, of_after = histogram(before, step), histogram(after, step)
    most = max(of_before + of_after)
    return f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="system-ui, sans-serif" font-size="13" role="img" aria-label="{html.escape(title)}">
<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>
<text x="{LEFT}" y="24" font-size="15">{html.escape(title)}</text>
<text x="{LEFT}" y="44" fill="#b2562a">before: RMS {rms(before):.3f} mm</text>
<text x="{LEFT + 190}" y="44" fill="#2a6a9a">after: RMS {rms(after):.3f} mm</text>
{bars(of_before, most, "#d9773f")}
{bars(of_after, most, "#3b82b8")}
<line x1="{LEFT}" y1="{HEIGHT - BOTTOM}" x2="{WIDTH - RIGHT}" y2="{HEIGHT - BOTTOM}" stroke="#444"/>
{axis(step)}
<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">position error, mm</text>
<text transform="translate(16 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">poses</text>
</svg>
'''


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [row for row in json.load(file)["residuals"] if row.get("control")]
    title = f"{sys.argv[2]}: {len(rows)} poses that had no part in the identification"
    print(picture(title, [row["before_position_mm"] for row in rows], [row["after_position_mm"] for row in rows]), end="")


if __name__ == "__main__":
    main()
