"""The paper's field (equations 7 to 10), summed here by itself: what leaving segments out beyond a bounding volume does
to the surface."""

import math

WIDTH = 5.0
W = WIDTH * math.log(2.0)
ISO = math.exp(-W)
REACH = 1.5  # radii, the paper's


def foot(p, a, b):
    """Along, across, length, radius at the foot; of a segment between two rows."""
    way = [b[k] - a[k] for k in range(3)]
    length = math.sqrt(sum(w * w for w in way))
    along = sum((p[k] - a[k]) * way[k] for k in range(3)) / length
    across = math.sqrt(max(0.0, sum((p[k] - a[k]) ** 2 for k in range(3)) - along * along))
    share = min(1.0, max(0.0, along / length))
    return along, across, length, a[3] + share * (b[3] - a[3])


def kernel(along, across, length, radius):
    root = math.sqrt(W) / radius
    return math.exp(-W * (across / radius) ** 2) * 0.5 * (math.erf(root * along) + math.erf(root * (length - along)))


def whole(p, a, b):
    return kernel(*foot(p, a, b))


def in_cylinder(p, a, b):
    along, across, length, radius = foot(p, a, b)
    return kernel(along, across, length, radius) if across <= REACH * radius and (
        -REACH * radius <= along <= length + REACH * radius) else 0.0


def in_box(p, a, b):
    reach = REACH * max(a[3], b[3])
    inside = all(min(a[k], b[k]) - reach <= p[k] <= max(a[k], b[k]) + reach for k in range(3))
    return whole(p, a, b) if inside else 0.0


def faded(p, a, b):
    """As ramus has it: smoothly from 1.4 to 1.7 radii across."""
    along, across, length, radius = foot(p, a, b)
    share = min(1.0, max(0.0, (across / radius - 1.4) / 0.3))
    return kernel(along, across, length, radius) * (1.0 - share * share * (3.0 - 2.0 * share))


def radius_there(segments, middle, way, contribution, radius):
    """Where the field falls below the isovalue, from the axis outward."""
    near, far = 0.5 * radius, 1.45 * radius
    for _ in range(40):
        at = 0.5 * (near + far)
        p = [middle[k] + at * way[k] for k in range(3)]
        if sum(contribution(p, a, b) for a, b in segments) > ISO:
            near = at
        else:
            far = at
    return 0.5 * (near + far)


def radius_changes(rows):
    """(what, mean, largest) change of the radius, as a share, by each way of leaving out segments."""
    segments = [(rows[row[4]], row) for row in rows if row[4] >= 0]
    places = []
    for n in range(4, len(segments) - 4, 2):
        a, b = segments[n]
        way = [b[k] - a[k] for k in range(3)]
        size = math.sqrt(sum(w * w for w in way))
        side, up = (-way[1] / size, way[0] / size, 0.0), (0.0, 0.0, 1.0)
        for turn in range(8):
            c, s = math.cos(math.pi * turn / 4.0 + 0.2), math.sin(math.pi * turn / 4.0 + 0.2)
            places.append(([0.5 * (a[k] + b[k]) for k in range(3)], [c * side[k] + s * up[k] for k in range(3)], a[3]))
    exact = [radius_there(segments, *place[:2], whole, place[2]) for place in places]
    for name, contribution in (("beyond a box of 1.5 radii around each", in_box),
                               ("beyond a cylinder of 1.5 radii around each (the paper's)", in_cylinder),
                               ("smoothly from 1.4 to 1.7 radii across (ramus)", faded)):
        changes = [abs(radius_there(segments, *place[:2], contribution, place[2]) / radius - 1.0)
                   for place, radius in zip(places, exact)]
        yield name, sum(changes) / len(changes), max(changes)
