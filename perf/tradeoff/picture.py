"""Work-precision diagrams as SVG, without a library: error against cost on logarithmic axes, a line a method."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 470, 350, 62, 12, 34, 46
COLOURS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2"]


class Axis:
    """A logarithmic axis from `low` to `high`, drawn between two pixels."""

    def __init__(self, low, high, first, last):
        self.low, self.high, self.first, self.last = math.log10(low), math.log10(high), first, last

    def at(self, value):
        share = (min(max(math.log10(max(value, 1e-300)), self.low), self.high) - self.low) / (self.high - self.low)
        return self.first + share * (self.last - self.first)

    def ticks(self):
        """1, 2 and 5 of each decade in range."""
        decades = range(math.floor(self.low) - 1, math.ceil(self.high) + 1)
        return [m * 10.0**d for d in decades for m in (1, 2, 5) if self.low - 1e-9 <= math.log10(m * 10.0**d) <= self.high + 1e-9]


def front(points):
    """Those of (cost, error) that no other one beats in both."""
    return {p for p in points if not any(o != p and o[0] <= p[0] and o[1] <= p[1] for o in points)}


def text(x, y, words, anchor="middle", size=11, turn=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}"{turn}>{escape(words)}</text>'


def frame(x, y, title, across, up):
    parts = []
    for value in x.ticks():
        parts.append(f'<path d="M{x.at(value):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#e4e4e4"/>' + text(x.at(value), HEIGHT - BOTTOM + 15, f"{value:g}", size=10))
    for value in y.ticks():
        parts.append(f'<path d="M{LEFT} {y.at(value):.1f}H{WIDTH - RIGHT}" stroke="#e4e4e4"/>' + text(LEFT - 5, y.at(value) + 4, f"{value:g}", "end", 10))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts += [f'<path d="M{LEFT} {TOP}V{HEIGHT - BOTTOM}H{WIDTH - RIGHT}" stroke="black" fill="none"/>',
              text((LEFT + WIDTH) / 2, 18, title, size=13), text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, across),
              text(14, middle, up, turn=f' transform="rotate(-90 14 {middle:.1f})"')]
    return parts


def line(x, y, points, colour, best):
    """A method: dots at the difference, a stroke up to the end of its interval, rings around those on the front."""
    path = " ".join(f"{x.at(cost):.1f},{y.at(error):.1f}" for cost, error, _ in points)
    parts = [f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.3"/>']
    for cost, error, upper in points:
        cx, cy = x.at(cost), y.at(error)
        parts.append(f'<path d="M{cx:.1f} {cy:.1f}V{y.at(upper):.1f}m-3 0h6" stroke="{colour}" fill="none"/><circle cx="{cx:.1f}" cy="{cy:.1f}" r="3.2" fill="{colour}"/>')
        if (cost, upper) in best:
            parts.append(f'<circle cx="{cx:.1f}" cy="{y.at(upper):.1f}" r="5.5" fill="none" stroke="black"/>')
    return parts


def panel(title, across, up, lines, floor, limits):
    """lines: {method: [(cost, error, end of its interval)]}; floor: the error of chance, a dashed line, or None."""
    x, y = Axis(*limits[0], LEFT, WIDTH - RIGHT), Axis(*limits[1], HEIGHT - BOTTOM, TOP)
    best = front({(cost, upper) for points in lines.values() for cost, _, upper in points})
    parts = frame(x, y, title, across, up)
    if floor:
        parts.append(f'<path d="M{LEFT} {y.at(floor):.1f}H{WIDTH - RIGHT}" stroke="black" stroke-dasharray="5 4"/>')
    for colour, points in zip(COLOURS, lines.values()):
        parts += line(x, y, sorted(points), colour, best)
    return parts


def legend(names):
    parts = []
    for number, (name, colour) in enumerate(zip(names, COLOURS)):
        column, row = number % 4, number // 4
        x, y = LEFT + column * 225, 16 + 18 * row
        parts.append(f'<path d="M{x} {y}h22" stroke="{colour}" stroke-width="2"/><circle cx="{x + 11}" cy="{y}" r="3.2" fill="{colour}"/>')
        parts.append(text(x + 28, y + 4, name, "start"))
    return parts


def draw(path, panels, names):
    """Panels two abreast, a legend below."""
    rows = (len(panels) + 1) // 2
    high = rows * HEIGHT + 26 + 18 * ((len(names) + 3) // 4)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {high}" width="{2 * WIDTH}" height="{high}" font-family="sans-serif">',
             f'<rect width="{2 * WIDTH}" height="{high}" fill="white"/>']
    for number, content in enumerate(panels):
        parts.append(f'<g transform="translate({number % 2 * WIDTH} {number // 2 * HEIGHT})">' + "\n".join(content) + "</g>")
    parts.append(f'<g transform="translate(0 {rows * HEIGHT})">' + "\n".join(legend(names)) + "</g></svg>")
    path.write_text("\n".join(parts) + "\n")
