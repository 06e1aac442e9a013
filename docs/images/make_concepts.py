"""Draws the pictures of docs/concepts.md from the robot files in robots/, as SVG into this folder.

Run it in the root of the project, with Python 3.11 or newer and nothing else:

    python3 docs/images/make_concepts.py

All geometry is computed: DH frames from robot.toml, links from the URDF. Only places of labels are chosen by hand.
"""

import math
import re
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"

INK, GREY, PALE = "#1f2328", "#8a9199", "#d5d9de"
X, Y, Z = "#c0392b", "#2e8b57", "#1f5fbf"  # axes of frames
A, ALPHA, D, THETA = "#c0392b", "#8e44ad", "#1f5fbf", "#b35900"  # the four entries of a row


# Rigid motions: 4 x 4 matrices, nested lists; lengths in m, angles in rad.


def product(*factors):
    result = [[float(i == j) for j in range(4)] for i in range(4)]
    for factor in factors:
        result = [[sum(result[i][k] * factor[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
    return result


def shift(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turn(axis, angle):
    """A turn about a unit vector, by the formula of Rodrigues."""
    x, y, z = axis
    c, s, v = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    return [
        [x * x * v + c, x * y * v - z * s, x * z * v + y * s, 0],
        [y * x * v + z * s, y * y * v + c, y * z * v - x * s, 0],
        [z * x * v - y * s, z * y * v + x * s, z * z * v + c, 0],
        [0, 0, 0, 1],
    ]


AXIS_X, AXIS_Y, AXIS_Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def fixed_axes(rpy):
    return product(turn(AXIS_Z, rpy[2]), turn(AXIS_Y, rpy[1]), turn(AXIS_X, rpy[0]))


def inverse(pose):
    rotation = [[pose[j][i] for j in range(3)] for i in range(3)]
    moved = [-sum(rotation[i][k] * pose[k][3] for k in range(3)) for i in range(3)]
    return [rotation[i] + [moved[i]] for i in range(3)] + [[0, 0, 0, 1]]


def origin(pose):
    return tuple(pose[i][3] for i in range(3))


def axis_of(pose, number):
    return tuple(pose[i][number] for i in range(3))


def along(point, direction, length):
    return tuple(p + length * d for p, d in zip(point, direction))


# Robot files


def declared(table):
    """A declared transform, such as base_from_dh0."""
    degrees = table.get("rpy_deg", [0, 0, 0])
    return product(shift(*table.get("xyz_m", [0, 0, 0])), fixed_axes([math.radians(angle) for angle in degrees]))


class Table:
    """The table of a robot file, with rows regrouped for the standard and for the modified convention."""

    def __init__(self, robot):
        self.file = tomllib.loads((ROOT / "robots" / robot / "robot.toml").read_text())
        dh = self.file["dh"]
        self.is_standard = dh["convention"] == "standard"
        self.base_from_dh0 = declared(dh.get("base_from_dh0", {}))
        self.dhn_from_tip = declared(dh.get("dhn_from_tip", {}))
        self.rows = [
            {
                "a": row["a_m"],
                "alpha": math.radians(row["alpha_deg"]),
                "d": row["d_m"],
                "theta": math.radians(row.get("theta_deg", 0)),
                "sign": row.get("sign", 1),
            }
            for row in dh["row"]
        ]

    def parts(self, q, change=None):
        """`Rz(theta) Tz(d)` and `Tx(a) Rx(alpha)` of each row."""
        parts = []
        for index, (row, value) in enumerate(zip(self.rows, q)):
            row = row | (change or {}).get(index, {})
            screw = product(turn(AXIS_Z, row["theta"] + row["sign"] * value), shift(0, 0, row["d"]))
            parts.append((screw, product(shift(row["a"], 0, 0), turn(AXIS_X, row["alpha"]))))
        return parts

    def frames(self, q, standard, change=None):
        """Frames 0 to n of one convention. The joint's own product is the same in both: only the cut between rows moves."""
        pose, frames = self.base_from_dh0, [self.base_from_dh0]
        parts = self.parts(q, change)
        for index, (screw, link) in enumerate(parts):
            if self.is_standard:
                cut = product(pose, screw)
                pose = product(cut, link)
                frames.append(pose if standard else cut)
            else:
                cut = product(pose, link)
                pose = product(cut, screw)
                following = parts[index + 1][1] if index + 1 < len(parts) else shift(0, 0, 0)
                frames.append(product(pose, following) if standard else pose)
        return frames

    def bones(self, q, change=None):
        """The line from frame 0 to frame n along every d and a."""
        points, pose = [origin(self.base_from_dh0)], self.base_from_dh0
        for screw, link in self.parts(q, change):
            for factor in (screw, link) if self.is_standard else (link, screw):
                pose = product(pose, factor)
                points.append(origin(pose))
        return points


class Urdf:
    """Poses of the links of a URDF, in its root."""

    def __init__(self, robot):
        tree = ElementTree.parse(ROOT / "robots" / robot / f"{robot}.urdf").getroot()
        self.joints = []
        for joint in tree.findall("joint"):
            place, axis = joint.find("origin"), joint.find("axis")
            numbers = lambda element, key, default: [
                float(word) for word in (element.get(key, default) if element is not None else default).split()
            ]
            self.joints.append(
                {
                    "name": joint.get("name"),
                    "moves": joint.get("type") != "fixed",
                    "parent": joint.find("parent").get("link"),
                    "child": joint.find("child").get("link"),
                    "pose": product(
                        shift(*numbers(place, "xyz", "0 0 0")), fixed_axes(numbers(place, "rpy", "0 0 0"))
                    ),
                    "axis": numbers(axis, "xyz", "1 0 0"),
                }
            )
        children = {joint["child"] for joint in self.joints}
        self.root = next(joint["parent"] for joint in self.joints if joint["parent"] not in children)

    def poses(self, q):
        """`q` by name; joints that are not named are at 0."""
        poses = {self.root: shift(0, 0, 0)}
        open_joints = list(self.joints)
        while open_joints:
            joint = next(joint for joint in open_joints if joint["parent"] in poses)
            open_joints.remove(joint)
            moved = turn(joint["axis"], q.get(joint["name"], 0)) if joint["moves"] else shift(0, 0, 0)
            poses[joint["child"]] = product(poses[joint["parent"]], joint["pose"], moved)
        return poses


# Drawing


class View:
    """An orthographic view: where a point of space is in the picture."""

    def __init__(self, azimuth_deg, elevation_deg, scale, centre, looks_at):
        azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
        self.right = (-math.sin(azimuth), math.cos(azimuth), 0)
        self.up = (
            -math.sin(elevation) * math.cos(azimuth),
            -math.sin(elevation) * math.sin(azimuth),
            math.cos(elevation),
        )
        self.scale, self.centre, self.looks_at = scale, centre, looks_at

    def __call__(self, point):
        seen = [p - c for p, c in zip(point, self.looks_at)]
        return (
            self.centre[0] + self.scale * sum(s * r for s, r in zip(seen, self.right)),
            self.centre[1] - self.scale * sum(s * u for s, u in zip(seen, self.up)),
        )


def symbol(text):
    """`x_3` with the index set lower, of single letters alone; an index of several characters is in braces."""

    def lowered(found):
        letter, index = found[1], found[2].strip("{}")
        return f'{letter}<tspan dy="4" font-size="72%">{index}</tspan><tspan dy="-4">\u200b</tspan>'

    text = re.sub(r"(?<!\w)([A-Za-zα-ω])_(\w|\{[^}]+\})", lowered, text)
    return text.replace("  ", "\u00a0 ")


class Picture:
    def __init__(self, width, height, title):
        self.size, self.title, self.elements = (width, height), title, []

    def add(self, element):
        self.elements.append(element)

    def line(self, start, end, colour=INK, width=2.0, dashes=None, opacity=1):
        extra = f' stroke-dasharray="{dashes}"' if dashes else ""
        self.add(
            f'<line x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}" stroke="{colour}" '
            f'stroke-width="{width}" stroke-linecap="round" opacity="{opacity}"{extra}/>'
        )

    def polyline(self, points, colour, width, opacity=1, dashes=None):
        extra = f' stroke-dasharray="{dashes}"' if dashes else ""
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(
            f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="{width}" '
            f'stroke-linecap="round" stroke-linejoin="round" opacity="{opacity}"{extra}/>'
        )

    def head(self, start, end, colour, size):
        angle = math.atan2(end[1] - start[1], end[0] - start[0])
        points = [end]
        for side in (2.7, -2.7):
            points.append((end[0] + size * math.cos(angle + side), end[1] + size * math.sin(angle + side)))
        self.add(f'<polygon points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="{colour}"/>')

    def arrow(self, start, end, colour=INK, width=2.2, size=10, dashes=None):
        length = math.dist(start, end)
        if length < 4:
            return
        short = max(length - 0.7 * size, 0.1) / length
        stop = tuple(s + short * (e - s) for s, e in zip(start, end))
        self.line(start, stop, colour, width, dashes)
        self.head(start, end, colour, min(size, length))

    def both_ways(self, start, end, colour, width=2.4):
        middle = tuple((s + e) / 2 for s, e in zip(start, end))
        self.arrow(middle, end, colour, width)
        self.arrow(middle, start, colour, width)

    def arc(self, points, colour, width=2.4):
        self.polyline(points, colour, width)
        self.head(points[-3], points[-1], colour, 10)

    def text(self, at, words, colour=INK, size=17, anchor="middle", weight="normal", halo=True):
        """Words on a white halo, so that lines behind them do not disturb."""
        style = f'x="{at[0]:.1f}" y="{at[1]:.1f}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}"'
        if halo:
            self.add(
                f'<text {style} fill="#ffffff" stroke="#ffffff" stroke-width="5" stroke-linejoin="round">{symbol(words)}</text>'
            )
        self.add(f'<text {style} fill="{colour}">{symbol(words)}</text>')

    def box(self, at, size, words, colour=INK, fill="#f3f5f7"):
        x, y = at[0] - size[0] / 2, at[1] - size[1] / 2
        self.add(
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{size[0]}" height="{size[1]}" rx="6" fill="{fill}" stroke="{colour}" stroke-width="1.5"/>'
        )
        self.text((at[0], at[1] + 6), words, colour, 16, halo=False)

    def dot(self, at, radius=4.0, colour=INK, fill=None):
        self.add(
            f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius}" fill="{fill or colour}" stroke="{colour}" stroke-width="2"/>'
        )

    def frame(self, view, pose, length, name="", names=None, offset=(0, 0), width=2.4, dashes=None, with_y=False):
        """Axes x and z of a frame, y only if wanted; `names` are offsets of the axis labels in pixels."""
        start = origin(pose)
        for number, colour in ((0, X), (1, Y), (2, Z)):
            if number == 1 and not with_y:
                continue
            end = along(start, axis_of(pose, number), length)
            self.arrow(view(start), view(end), colour, width, dashes=dashes)
            label = (names or {}).get("xyz"[number])
            if label:
                words, dx, dy = label
                x, y = view(end)
                self.text((x + dx, y + dy), words, colour)
        self.dot(view(start), 3.5)
        if name:
            x, y = view(start)
            self.text((x + offset[0], y + offset[1]), name, INK, 16, weight="bold")

    def axis(self, view, point, direction, before, behind, words="", at=(0, 0), anchor="middle"):
        """The line of a joint."""
        start, end = along(point, direction, -before), along(point, direction, behind)
        self.line(view(start), view(end), GREY, 1.6, "9 4 2 4")
        if words:
            x, y = view(end)
            self.text((x + at[0], y + at[1]), words, "#5b636b", 15, anchor)

    def write(self, name):
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="Helvetica, Arial, sans-serif" role="img">\n<title>{self.title}</title>\n'
            # The picture brings its own background: it reads the same on a light and on a dark page.
            f'<rect width="{width}" height="{height}" rx="10" fill="#ffffff"/>\n'
        )
        (IMAGES / name).write_text(head + "\n".join(self.elements) + "\n</svg>\n")


def arc_points(view, centre, start, axis, angle, radius, steps=24):
    """Points of an arc about an axis, from the direction `start`."""
    points = []
    for step in range(steps + 1):
        turned = product(turn(axis, angle * step / steps), shift(*[radius * part for part in start]))
        points.append(view(tuple(c + p for c, p in zip(centre, origin(turned)))))
    return points


# Pictures


def rows():
    """The four entries of a row between joints 3 and 4 of the Panda, in both conventions."""
    table = Table("panda")
    q = [0, 0, math.radians(50), 0, 0, 0, 0]
    row, following = table.rows[2], table.rows[3]
    picture = Picture(1100, 640, "The same two joints of a Panda in the standard and in the modified convention")
    for standard, left in ((True, 0), (False, 550)):
        view = View(-62, 24, 960, (left + 235, 500), (0, 0, 0.333))
        frames = table.frames(q, standard)
        first, second = (frames[2], frames[3]) if standard else (frames[3], frames[4])
        shoulder, elbow = origin(table.frames(q, True)[2]), origin(table.frames(q, False)[3])
        on_axis_4 = origin(table.frames(q, False)[4])
        axis_3, axis_4 = axis_of(table.frames(q, True)[2], 2), axis_of(table.frames(q, False)[4], 2)
        normal = axis_of(table.frames(q, False)[3], 0)
        before = axis_of(table.frames(q, True)[2], 0)
        picture.axis(view, shoulder, axis_3, 0.07, 0.45, "axis of joint 3", (-8, 8), "end")
        picture.axis(view, on_axis_4, axis_4, 0.13, 0.16, "axis of joint 4", (8, 12), "start")
        picture.polyline([view(shoulder), view(elbow), view(on_axis_4)], PALE, 12)
        # d is drawn beside the axis, a on the common normal.
        beside = lambda point: (view(point)[0] - 30, view(point)[1])
        for point in (shoulder, elbow):
            picture.line(beside(point), view(point), GREY, 1.2)
        picture.both_ways(beside(shoulder), beside(elbow), D)
        picture.both_ways(view(elbow), view(on_axis_4), A)
        x, y = beside(along(shoulder, axis_3, row["d"] / 2))
        picture.text((x - 12, y), f"d_3 = {row['d'] * 1000:.0f} mm", D, 18, "end")
        x, y = view(along(elbow, normal, following["a"] / 2))
        picture.text((x + 10, y + 38), "a_3 =", A, 18)
        picture.text((x + 12, y + 60), f"{following['a'] * 1000:.1f} mm", A, 18)
        # theta from the x axis before to the common normal; drawn at the foot of the axis.
        foot = along(shoulder, axis_3, 0.0)
        picture.line(view(foot), view(along(foot, normal, 0.14)), GREY, 1.6, "5 5")
        picture.line(view(foot), view(along(foot, before, 0.14)), GREY, 1.6, "5 5")
        picture.arc(arc_points(view, foot, before, axis_3, q[2], 0.1), THETA)
        x, y = view(along(foot, tuple(b + n for b, n in zip(before, normal)), 0.062))
        picture.text((x + 8, y + 8), "θ_3", THETA, 19, "start")
        # alpha about the common normal, at its far end.
        picture.line(view(on_axis_4), view(along(on_axis_4, axis_3, 0.13)), GREY, 1.6, "5 5")
        picture.arc(arc_points(view, on_axis_4, axis_3, normal, following["alpha"], 0.085), ALPHA)
        direction = tuple(b + n for b, n in zip(axis_3, axis_4))
        x, y = view(along(on_axis_4, direction, 0.075))
        picture.text((x + 6, y - 6), "α_3 = 90°", ALPHA, 18, "start" if x > view(on_axis_4)[0] else "end")
        if standard:
            picture.frame(view, first, 0.1, names={"z": ("z_2", 16, 6), "x": ("x_2", 8, 18)})
            picture.frame(view, second, 0.1, names={"z": ("z_3", -8, 20), "x": ("x_3", 16, 6)})
            picture.text((left + 275, 36), "standard", INK, 22, weight="bold")
            picture.text((left + 275, 62), "frame i is on the axis of joint i + 1", INK, 16)
            picture.text((left + 275, 596), "row of joint 3: θ_3, d_3, a_3, α_3", INK, 17)
            picture.text((left + 275, 622), "Rz(θ_3) Tz(d_3) Tx(a_3) Rx(α_3)", INK, 17)
        else:
            picture.frame(view, frames[2], 0.1, names={"z": ("z_2", 12, -4), "x": ("x_2", 8, 18)})
            picture.frame(view, first, 0.1, names={"z": ("z_3", -16, 6), "x": ("x_3", -52, -12)})
            picture.frame(view, second, 0.1, names={"z": ("z_4", -8, 20), "x": ("x_4", 16, 6)})
            picture.text((left + 275, 36), "modified (Craig)", INK, 22, weight="bold")
            picture.text((left + 275, 62), "frame i is on the axis of joint i", INK, 16)
            picture.text((left + 275, 596), "row of joint 3: α_2, a_2, θ_3, d_3      row of joint 4: α_3, a_3, θ_4, d_4", INK, 17)
            picture.text((left + 275, 622), "Rx(α_{i-1}) Tx(a_{i-1}) Rz(θ_i) Tz(d_i)", INK, 17)
    picture.line((550, 24), (550, 616), PALE, 2)
    picture.write("dh_rows.svg")


def frames():
    """All frames of a UR5e in both conventions, in one configuration."""
    table = Table("ur5e")
    q = [math.radians(angle) for angle in (20, -70, 75, -95, -80, 20)]
    picture = Picture(1100, 600, "The frames of a UR5e in the standard and in the modified convention")
    numbers = {
        True: {0: (22, 6), 1: (26, 14), 2: (-2, -16), 3: (-6, 30), 4: (-6, -16), 5: (14, -14), 6: (22, 8)},
        False: {0: (22, 6), 1: (-22, -16), 2: (26, 14), 3: (-2, -16), 4: (-8, -16), 5: (4, -16), 6: (22, 8)},
    }
    for standard, left in ((True, 0), (False, 550)):
        view = View(-50, 16, 600, (left + 100, 540), (0, 0, 0))
        picture.text((left + 275, 36), "standard" if standard else "modified", INK, 22, weight="bold")
        words = "frame i moves with joint i, its z axis is that of joint i + 1"
        if not standard:
            words = "frame i moves with joint i, its z axis is that of joint i"
        picture.text((left + 275, 62), words, INK, 16)
        picture.polyline([view(point) for point in table.bones(q)], PALE, 16)
        poses = table.frames(q, standard)
        for number, pose in enumerate(poses):
            picture.frame(view, pose, 0.09, width=2.6)
        for number, pose in enumerate(poses):
            x, y = view(origin(pose))
            dx, dy = numbers[standard][number]
            picture.text((x + dx, y + dy), str(number), INK, 18, weight="bold")
    picture.text((330, 560), "red: x axis", X, 16)
    picture.text((440, 560), "blue: z axis", Z, 16)
    picture.line((550, 24), (550, 576), PALE, 2)
    picture.write("dh_frames.svg")


def constants():
    """The declared transforms before and after the rows: those of the UR5e's base and of the Panda's flange."""
    picture = Picture(1100, 580, "The declared transforms before and after the rows of a table")
    # The chain of transforms.
    places = [(90, "base"), (320, "dh0"), (550, "dhn"), (780, "tip"), (1000, "TCP")]
    for (start, _), (end, _), words in zip(
        places, places[1:], ("base_from_dh0", "rows, joint positions", "dhn_from_tip", "[tcp]")
    ):
        picture.arrow((start + 46, 70), (end - 48, 70))
        picture.text(((start + end) / 2, 52), words, INK, 15)
    for x, words in places:
        picture.box((x, 70), (88, 36), words)
    picture.line((40, 125), (1060, 125), PALE, 2)
    # The base of the UR5e.
    ur5e = Table("ur5e")
    picture.text((275, 165), "UR5e: base_from_dh0 = { rpy_deg = [0, 0, 180] }", INK, 17, weight="bold")
    view = View(-50, 22, 480, (275, 440), (0, 0, 0))
    picture.polyline([view(point) for point in ur5e.bones([0] * 6)[:2]], PALE, 26)
    base = shift(0, 0, 0)
    picture.frame(
        view, base, 0.4, names={"x": ("x of base_link", -10, 26), "y": ("y of base_link", 62, 4), "z": ("", 0, 0)}, dashes="7 5", with_y=True
    )
    picture.frame(
        view, ur5e.base_from_dh0, 0.3, names={"x": ("x of dh0", 6, -12), "y": ("y of dh0", -42, 4), "z": ("z of both", 46, 14)}, with_y=True
    )
    picture.line((60, 536), (96, 536), INK, 2.4)
    picture.text((104, 541), "dh0, frame 0 of the table", INK, 15, "start")
    picture.line((310, 536), (346, 536), INK, 2.4, "7 5")
    picture.text((354, 541), "base_link of the URDF", INK, 15, "start")
    # The flange and the hand of the Panda.
    panda = Table("panda")
    picture.text((825, 165), "Panda: dhn_from_tip = { xyz_m = [0, 0, 0.107] }", INK, 17, weight="bold")
    last = shift(0, 0, 0)
    tip = product(last, panda.dhn_from_tip)
    tcp = product(tip, declared(panda.file["tcp"]))
    view = View(112, 20, 1250, (740, 220), (0, 0, 0.0))
    view.up = tuple(-part for part in view.up)  # the tool points downwards
    view.right = tuple(-part for part in view.right)
    picture.polyline([view(origin(last)), view(origin(tip))], PALE, 26)
    picture.polyline([view(origin(tip)), view(origin(tcp))], PALE, 14)
    for pose, words in ((last, "dhn: frame of the last row"), (tip, "tip: panda_link8, the flange"), (tcp, "TCP")):
        picture.frame(view, pose, 0.055, names={"x": ("x", 12, 6)}, width=2.8)
        x, y = view(origin(pose))
        picture.text((x + 112, y + 4), words, INK, 16, "start")
    for start, end, words in ((last, tip, "107 mm"), (tip, tcp, "103.4 mm, -45°")):
        (x, y), (_, below) = view(origin(start)), view(origin(end))
        picture.both_ways((x - 60, y), (x - 60, below), D, 2)
        for height in (y, below):
            picture.line((x - 66, height), (x - 18, height), GREY, 1.2)
        picture.text((x - 74, (y + below) / 2 + 5), words, D, 16, "end")
    picture.write("dh_constants.svg")


def compared():
    """Which frames a check compares: a UR5e, and its table with one wrong zero. The distances are computed."""
    table, urdf = Table("ur5e"), Urdf("ur5e")
    names = [joint["name"] for joint in urdf.joints if joint["moves"]]
    links = [joint["child"] for joint in urdf.joints if joint["moves"]]
    wrong = {2: {"theta": math.radians(12)}}
    zero = [0.0] * 6
    # Between the frame of a row and its link: one constant, fitted at zero.
    at_zero = urdf.poses({})
    fitted = [
        product(inverse(frame), at_zero[link]) for frame, link in zip(table.frames(zero, True, wrong)[1:], links)
    ]
    picture = Picture(1100, 640, "Which frames a check compares: base and tip decide, links between have a fitted constant")
    moved = [math.radians(angle) for angle in (15, -75, 80, -100, -80, 0)]
    for q, left, title in ((zero, 0, "all joints at 0"), (moved, 550, "another configuration")):
        of_table, of_urdf = table.frames(q, True, wrong), urdf.poses(dict(zip(names, q)))
        tip = product(of_table[-1], table.dhn_from_tip)
        view = View(-62, 14, 440, (left + (60 if q is zero else 110), 330), (0, 0, 0))
        picture.text((left + 275, 36), title, INK, 20, weight="bold")
        picture.polyline([view(point) for point in table.bones(q)], GREY, 14, opacity=0.55)
        picture.polyline([view(point) for point in table.bones(q, wrong)], THETA, 5, dashes="10 7")
        for link, frame, constant in zip(links, of_table[1:], fitted):
            placed = product(frame, constant)
            here, there = view(origin(of_urdf[link])), view(origin(placed))
            picture.line(here, there, THETA, 1.6, "3 4")
            picture.dot(here, 5, GREY, "#ffffff")
            picture.dot(there, 3.5, THETA)
        here, there = view(origin(of_urdf["tool0"])), view(origin(tip))
        picture.line(here, there, X, 3)
        picture.dot(here, 7, X, "#ffffff")
        picture.dot(there, 5, X)
        picture.dot(view((0, 0, 0)), 7, X, "#ffffff")
        picture.text((view((0, 0, 0))[0] - 12, view((0, 0, 0))[1] + 26), "base", X, 16, weight="bold")
        picture.text(((here[0] + there[0]) / 2 + 14, (here[1] + there[1]) / 2 + 6), "tip", X, 16, "start", "bold")
        # Distances.
        top = 428
        picture.text((left + 60, top), "frame", INK, 15, "start", "bold")
        picture.text((left + 330, top), "distance", INK, 15, "end", "bold")
        rows = [(link, math.dist(origin(of_urdf[link]), origin(product(frame, constant))))
                for link, frame, constant in zip(links, of_table[1:], fitted)]  # fmt: skip
        rows.append(("tool0, the tip", math.dist(origin(of_urdf["tool0"]), origin(tip))))
        for number, (words, distance_m) in enumerate(rows):
            is_tip = number == len(rows) - 1
            colour, y = X if is_tip else INK, top + 24 * (number + 1)
            picture.text((left + 60, y), words, colour, 15, "start", "bold" if is_tip else "normal")
            picture.text((left + 330, y), f"{1000 * distance_m:.1f} mm", colour, 15, "end", "bold" if is_tip else "normal")
            words = "decides" if is_tip else ("fitted here" if q is zero else "does not decide")
            picture.text((left + 350, y), words, colour, 15, "start", "bold" if is_tip else "normal")
    picture.line((550, 24), (550, 616), PALE, 2)
    picture.text((60, 80), "grey: URDF", "#5b636b", 16, "start")
    picture.text((60, 104), "orange: table, theta of elbow_joint 12° off", THETA, 16, "start")
    picture.dot((66, 123), 5, GREY, "#ffffff")
    picture.text((84, 128), "frame of a link in the URDF", "#5b636b", 16, "start")
    picture.dot((66, 147), 3.5, THETA)
    picture.text((84, 152), "the same frame by the table, with its fitted constant", THETA, 16, "start")
    picture.line((58, 171), (76, 171), THETA, 1.6, "3 4")
    picture.text((84, 176), "distance of the two; 0 where the constants are fitted", THETA, 16, "start")
    picture.dot((66, 195), 5, X)
    picture.text((84, 200), "tip by the table: nothing is fitted", X, 16, "start")
    picture.write("dh_compared.svg")


if __name__ == "__main__":
    rows()
    frames()
    constants()
    compared()
