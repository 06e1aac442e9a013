"""Draws docs/images/ghost.gif: a UR5e on its pick motion, and as a ghost the arm that a wrong DH table predicts.

Run `python3 docs/images/make_ghost.py` with Python 3.11 or newer, numpy, Pillow 10.1 or newer, the fonts DejaVu, and
`congruent` on PATH. Poses and the verdict are those of `congruent`: this script only chooses joint positions and draws.
"""

import json
import subprocess
import tempfile
import textwrap
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from solids import FINE, VIEW, WIDTH, Camera, blend

ROOT = Path(__file__).resolve().parents[2]
ROBOT, SCENARIO = ROOT / "robots" / "ur5e", ROOT / "scenarios" / "ur5e_pick.toml"
FLIPPED = "shoulder_pan_joint"  # at home, 0 deg, this error is not seen; every turn of the joint shows it
STORY = f"The table has sign = -1 for {FLIPPED}, in place of 1. At home, nobody sees it."
HEIGHT, FRAME_MS = VIEW + 106, 60  # the caption is below the view
COLOURS = 95  # more make the file larger, not better
INK, GREY, PALE, GHOST, SOLID = "#1f2328", "#6b737c", "#d5d9de", "#e8590c", "#9fa6ae"
GHOST_RGB, RUBBER, WOOD = np.array([[232, 89, 12], [64, 66, 71], [237, 230, 214]]) / 255


def congruent(*arguments, code=0, cwd=None):
    done = subprocess.run(["congruent", *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    if done.returncode != code:
        raise SystemExit(f"congruent {arguments[0]} ended with {done.returncode}: {done.stderr or done.stdout}")
    return done.stdout


def pose(xyz, w=1.0, vector=(0, 0, 0)):
    """The pose of a position and a unit quaternion."""
    cross, result = np.cross(np.eye(3), vector), np.eye(4)
    result[:3, :3] += 2 * w * cross + 2 * cross @ cross
    result[:3, 3] = xyz
    return result


def poses(robot, source, table):
    answer = json.loads(congruent("fk", robot, "--source", source, "--configurations", table, "--format", "json"))
    read = lambda entry: pose(entry["translation_m"], entry["quaternion_wxyz"][0], entry["quaternion_wxyz"][1:])
    return [{name: read(entry) for name, entry in result["links"].items()} for result in answer["results"]]


def compare(configurations):
    """Poses in physics, by the wrong table and by the right one, and the verdict. The wrong table differs in one line."""
    text = (ROBOT / "robot.toml").read_text().replace('"ur5e.urdf"', json.dumps(str(ROBOT / "ur5e.urdf")))
    head, row, tail = text.partition(f'joint = "{FLIPPED}"')
    with tempfile.TemporaryDirectory() as work:
        wrong, asked = Path(work) / "wrong_sign.toml", Path(work) / "motion.jsonl"
        wrong.write_text(head + row + tail.replace("sign = 1", "sign = -1", 1))
        asked.write_text("".join(json.dumps({"q": q}) + "\n" for q in configurations))
        answers = poses(ROBOT, "simulation", asked), poses(wrong, "dh", asked), poses(ROBOT, "dh", asked)
        return *answers, congruent("check", "--quiet", wrong.name, code=1, cwd=work).strip()


def motion():
    """Joint positions by frame, how long each is shown, and whether the verdict is: the scenario's moves, then home."""
    scenario = tomllib.loads(SCENARIO.read_text())
    at = home = {FLIPPED: 0.0, "wrist_3_joint": 0.0} | scenario["start"]["joints_deg"]
    frames = [[home, 440, False]]
    for move in [*scenario["motion"], {"move_joints_deg": home, "duration_s": 0.96}]:
        goal, steps = at | move["move_joints_deg"], round(1000 * move["duration_s"] / FRAME_MS)
        for s in np.arange(1, steps + 1) / steps:
            part = s**3 * (10 - 15 * s + 6 * s * s)
            frames.append([{joint: at[joint] + part * (goal[joint] - at[joint]) for joint in at}, FRAME_MS, False])
        at = goal
    frames[-steps - 1][1:] = [2000, True]  # time to read, with the arms apart
    return [({joint: np.radians(q[joint]) for joint in q}, ms, told or k >= len(frames) - steps)
            for k, (q, ms, told) in enumerate(frames[:-1])]  # the last one is the first again


def shapes(tree):
    """The visual shapes of each link: kind, sizes, place in the link, colour. This robot's are cylinders and spheres."""
    colours = {material.get("name"): material.find("color").get("rgba") for material in tree.findall("material")}
    numbers = lambda text: np.array([float(word) for word in text.split()])
    found = {}
    for link in tree.findall("link"):
        for visual in link.findall("visual"):
            place, shape = pose(numbers(visual.find("origin").get("xyz"))), visual.find("geometry")[0]
            for axis, angle in reversed(list(enumerate(numbers(visual.find("origin").get("rpy", "0 0 0")) / 2))):
                place = place @ pose((0, 0, 0), np.cos(angle), np.sin(angle) * np.eye(3)[axis])
            sizes = float(shape.get("radius")), float(shape.get("length", 0)) / 2
            paint = numbers(colours[visual.find("material").get("name")])[:3]
            found.setdefault(link.get("name"), []).append((shape.tag, sizes, place, paint))
    return found


def panel(view, ends, off, verdict):
    """A picture with its legend, the tips of both arms, and the caption."""
    picture = Image.new("RGB", (WIDTH, HEIGHT), "white")
    picture.paste(view)
    draw = ImageDraw.Draw(picture)
    write = lambda x, y, text, colour=INK, size=15, kind="", anchor="lm": draw.text(
        (x, y), text, colour, ImageFont.truetype(f"DejaVuSans{kind}.ttf", size), anchor)
    for y, colour, text in ((26, SOLID, "URDF in physics"), (50, GHOST, "DH table, one sign wrong")):
        draw.rounded_rectangle((20, y - 7, 42, y + 7), 4, fill=colour)
        write(50, y, text)
    draw.line([tuple(end) for end in ends], "#b42318", 2)
    for (x, y), colour in zip(ends, (INK, GHOST)):
        draw.ellipse((x - 4, y - 4, x + 4, y + 4), colour, "white")
    draw.line((20, VIEW + 2, WIDTH - 20, VIEW + 2), PALE)
    write(20, VIEW + 23, "Tip of the table from tip in physics:", size=16)
    write(420, VIEW + 23, f"{off:.1f} mm", GHOST if off >= 0.05 else INK, 18, "-Bold", "rm")
    if verdict:
        write(WIDTH - 20, VIEW + 23, "$ congruent check -q wrong_sign.toml", GREY, 12, "Mono", "rm")
    else:
        write(20, VIEW + 52, STORY, GREY, 14)
    for row, line in enumerate(textwrap.wrap(verdict, 104)):
        write(20, VIEW + 50 + 18 * row, line, size=12, kind="Mono")
    draw.rounded_rectangle((0, 0, WIDTH - 1, HEIGHT - 1), 14, outline=PALE)
    return picture


def save(pictures, durations, file):
    """One palette for all frames; what stays is transparent (colour 0), and so are the corners of the panel."""
    sample = Image.fromarray(np.concatenate([np.array(picture) for picture in pictures[::8]]))
    table = np.array(sample.quantize(COLOURS, Image.Quantize.MEDIANCUT, kmeans=2).getpalette()).reshape(-1, 3)[:COLOURS]
    table[table.min(1) >= 248] = 255  # the mean of almost white is not white
    palette, inside = Image.new("P", (1, 1)), Image.new("1", (WIDTH, HEIGHT))
    palette.putpalette(table.flatten().tolist())
    ImageDraw.Draw(inside).rounded_rectangle((0, 0, WIDTH - 1, HEIGHT - 1), 14, fill=1)
    frames, last = [], 0
    for picture in pictures:
        now = (np.array(picture.quantize(palette=palette, dither=Image.Dither.NONE)) + 1) * np.array(inside)
        frames.append(Image.fromarray(np.where(now == last, 0, now).astype(np.uint8)).convert("P"))
        frames[-1].putpalette([255, 255, 255, *table.flatten().tolist()])
        last = now
    options = {"duration": durations, "loop": 0, "transparency": 0, "disposal": 1, "optimize": False}
    frames[0].save(file, save_all=True, append_images=frames[1:], **options)


def main():
    frames, file, pictures, offs = motion(), ROOT / "docs" / "images" / "ghost.gif", [], []
    robot, tree = tomllib.loads((ROBOT / "robot.toml").read_text()), ElementTree.parse(ROBOT / "ur5e.urdf")
    solid, ghosts, right, verdict = compare([q for q, *_ in frames])
    child = lambda joint: tree.find(f"joint[@name='{joint}']/child").get("link")
    frame_of = {child(row["joint"]): f"dh{number}" for number, row in enumerate(robot["dh"]["row"], 1)} | {"tool0": "tool0"}
    half = robot["tcp"]["xyz_m"][2] / 2
    parts = shapes(tree) | {"tool0": [("cylinder", (0.014, half), pose((0, 0, half)), RUBBER)]}  # the declared cup
    things = tomllib.loads(SCENARIO.read_text())["obstacle"][1:]  # without the table, which the grid is
    fixed = [[("box", np.array(thing["box_m"]) / 2, pose(thing["xyz_m"]), WOOD)] for thing in things]
    camera = Camera((1.75, -1.05, 1.0), (0.26, 0.0, 0.285), 735)
    placed = lambda at, body, ghostly: [(kind, s, at @ p, GHOST_RGB if ghostly else paint) for kind, s, p, paint in body]
    for (_, _, told), now, ghost, true in zip(frames, solid, ghosts, right):
        bodies = fixed + [placed(now[link], parts[link], False) for link in parts]
        # A link is fixed to a frame of the table: where, the right table says.
        moved = {link: ghost[frame] @ np.linalg.inv(true[frame]) @ now[link] for link, frame in frame_of.items()}
        spirit = [placed(moved[link], parts[link], True) for link in moved]
        tips = now["tool0"][:3, 3], ghost["tool0"][:3, 3]
        offs.append(1000 * np.linalg.norm(tips[0] - tips[1]))
        ends = [camera.pixel(tip) / FINE for tip in tips]
        pictures.append(panel(blend(camera, bodies, spirit), ends, offs[-1], verdict if told else ""))
    durations = [ms for _, ms, _ in frames]
    save(pictures, durations, file)
    print(f"{file.name}: {len(frames)} frames, {sum(durations) / 1000:.1f} s, {file.stat().st_size / 1e6:.2f} MB")
    print(f"the tip is off by {min(offs):.1f} to {max(offs):.1f} mm\n{verdict}")


if __name__ == "__main__":
    main()
