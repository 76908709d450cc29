"""How far the cross-sections of a mask's isosurface are from circles: from that of the surface, from one of their own area,
and from the circle that is nearest of all. What is left in the last no round vessel can mend."""

import csv
import math

RAYS = 72
CELL = 8.0  # mm, of the grid that triangles are looked up in


def read_obj(path):
    points, triangles = [], []
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append(tuple(map(float, words[1:4])))
            elif words and words[0] == "f":
                triangles.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:4]))
    return points, triangles


def read_places(path):
    """(branch, at, radius of the surface, alone) along the branches of radii.csv."""
    with open(path, encoding="ascii", newline="") as file:
        return [(int(line["branch"]), tuple(float(line[k]) for k in "xyz"), float(line["surface_radius"]),
                 line["alone"] == "yes") for line in csv.DictReader(file)]


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    size = math.sqrt(dot(a, a))
    return tuple(x / size for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Surface:
    def __init__(self, path):
        self.points, self.triangles = read_obj(path)
        self.grid = {}
        for n, triangle in enumerate(self.triangles):
            self.grid.setdefault(tuple(math.floor(x / CELL) for x in self.points[triangle[0]]), []).append(n)

    def section(self, at, along, reach):
        """Segments, in the plane through `at` across `along`, of what is within `reach` mm."""
        side = unit(cross(along, (1, 0, 0) if abs(along[0]) < 0.6 else (0, 1, 0)))
        up = cross(along, side)
        low, high = ([math.floor((x + sign * (reach + 4.0)) / CELL) for x in at] for sign in (-1, 1))
        found = []
        for i in range(low[0], high[0] + 1):
            for j in range(low[1], high[1] + 1):
                for k in range(low[2], high[2] + 1):
                    for n in self.grid.get((i, j, k), ()):
                        corners = [minus(self.points[p], at) for p in self.triangles[n]]
                        heights = [dot(corner, along) for corner in corners]
                        ends = []
                        for a in range(3):
                            b = (a + 1) % 3
                            if (heights[a] > 0) != (heights[b] > 0):
                                share = heights[a] / (heights[a] - heights[b])
                                place = [p + share * (q - p) for p, q in zip(corners[a], corners[b])]
                                ends.append((dot(place, side), dot(place, up)))
                        if len(ends) == 2:
                            found.append((*ends[0], *ends[1]))
        return found


def outline(section, reach):
    """Where rays from the middle leave the section; nothing where one of them does not within reach."""
    points = []
    for n in range(RAYS):
        angle = 2.0 * math.pi * (n + 0.37) / RAYS
        wx, wy = math.cos(angle), math.sin(angle)
        nearest = reach
        for ax, ay, bx, by in section:
            ca, cb = wx * ay - wy * ax, wx * by - wy * bx
            if (ca > 0) != (cb > 0):
                share = ca / (ca - cb)
                away = wx * (ax + share * (bx - ax)) + wy * (ay + share * (by - ay))
                if 0.0 < away < nearest:
                    nearest = away
        if nearest == reach:
            return []
        points.append((nearest * wx, nearest * wy))
    return points


def from_circle(points, x, y, radius):
    """Mean distance along the outline."""
    total = length = 0.0
    for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
        size = math.hypot(bx - ax, by - ay)
        total += size * abs(math.hypot(0.5 * (ax + bx) - x, 0.5 * (ay + by) - y) - radius)
        length += size
    return total / length


def of_its_area(points):
    """Middle and radius."""
    area = x = y = 0.0
    for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
        part = ax * by - bx * ay
        area, x, y = area + 0.5 * part, x + part * (ax + bx) / 6.0, y + part * (ay + by) / 6.0
    return [x / area, y / area, math.sqrt(area / math.pi)]


def nearest_circle(points):
    """The least mean distance, by steps that halve."""
    circle = of_its_area(points)
    best, step = from_circle(points, *circle), 0.3 * circle[2]
    least = 0.01 * circle[2]
    while step > least:
        tries = [[c + (sign * step if k == n else 0.0) for k, c in enumerate(circle)] for n in range(3) for sign in (1, -1)]
        found, other = min((from_circle(points, *other), other) for other in tries)
        if found < best:
            best, circle = found, other
        else:
            step *= 0.5
    return best


def distances(surface, places):
    """Of sections away from joints, ends and other vessels, weighted by their circumference: how many, and their mean distance
    in mm from the circle of the surface around the centerline, from that of their own area, from the nearest circle."""
    sums, weight, count = [0.0, 0.0, 0.0], 0.0, 0
    for n, (branch, at, radius, alone) in enumerate(places):
        if not alone or not radius > 0.0:
            continue
        before, behind = n, n
        while before > 0 and places[before - 1][0] == branch and math.dist(places[before][1], at) < radius:
            before -= 1
        while behind + 1 < len(places) and places[behind + 1][0] == branch and math.dist(places[behind][1], at) < radius:
            behind += 1
        if math.dist(places[before][1], places[behind][1]) < 0.1 * radius:
            continue
        reach = 3.0 * max(radius, 1.0)
        points = outline(surface.section(at, unit(minus(places[behind][1], places[before][1])), reach), reach)
        if not points:
            continue
        circle = of_its_area(points)
        for k, distance in enumerate((from_circle(points, 0.0, 0.0, radius), from_circle(points, *circle), nearest_circle(points))):
            sums[k] += circle[2] * distance
        weight += circle[2]
        count += 1
    return (count, *(total / weight for total in sums))
