"""Box plots as SVG."""

WIDTH, LEFT, RIGHT, ROW, TOP = 640, 190, 24, 26, 34
TEXT = 'font-family="sans-serif" font-size="12" fill="#222222"'


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


def step_of(most):
    """A round number, about a fifth of `most`."""
    power = 1.0
    while power * 10.0 < most:
        power *= 10.0
    while power > most:
        power /= 10.0
    return next(power * f for f in (0.2, 0.5, 1.0, 2.0) if most / (power * f) <= 6.0)


def box_plots(title, unit, boxes):
    """`boxes`: (label, whisker, quartile, median, quartile, whisker, largest value), from least to largest."""
    most = max(box[6] for box in boxes) * 1.02 or 1.0
    least = min(0.0, min(box[1] for box in boxes))
    bottom = TOP + ROW * len(boxes)

    def x(value):
        return LEFT + (WIDTH - LEFT - RIGHT) * (value - least) / (most - least)

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{bottom + 44}" '
           f'viewBox="0 0 {WIDTH} {bottom + 44}">', f'<rect width="{WIDTH}" height="{bottom + 44}" fill="white"/>',
           f'<text x="{LEFT}" y="20" {TEXT} font-weight="bold">{escaped(title)}</text>']
    step, n = step_of(most), 0
    while n * step <= most:
        svg.append(f'<path d="M{x(n * step):.1f} {TOP}V{bottom}" stroke="#dddddd"/>')
        svg.append(f'<text x="{x(n * step):.1f}" y="{bottom + 16}" text-anchor="middle" {TEXT}>{n * step:.4g}</text>')
        n += 1
    svg.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.1f}" y="{bottom + 34}" text-anchor="middle" {TEXT}>'
               f'{escaped(unit)}</text>')
    for row, (label, low, q1, median, q3, high, largest) in enumerate(boxes):
        y = TOP + ROW * (row + 0.5)
        svg += [f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end" {TEXT}>{escaped(label)}</text>',
                f'<path d="M{x(low):.1f} {y:.1f}H{x(high):.1f}M{x(low):.1f} {y - 5:.1f}v10M{x(high):.1f} {y - 5:.1f}v10" '
                'stroke="#333333" fill="none"/>',
                f'<rect x="{x(q1):.1f}" y="{y - 7:.1f}" width="{max(x(q3) - x(q1), 1.0):.1f}" height="14" '
                'fill="#a6cee3" stroke="#333333"/>',
                f'<path d="M{x(median):.1f} {y - 7:.1f}v14" stroke="#b2182b" stroke-width="2"/>',
                f'<circle cx="{x(largest):.1f}" cy="{y:.1f}" r="2.5" fill="none" stroke="#333333"/>']
    return "\n".join(svg + ["</svg>", ""])


def box_of(label, distances):
    """Of what `ramus compare --json` says."""
    low, high = distances["whiskers"]
    q1, q3 = distances["quartiles"]
    return (label, low, q1, distances["median"], q3, high, distances["max"])
