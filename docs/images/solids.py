"""Spheres, cylinders and boxes in perspective, by a ray for each pixel: the drawing of make_ghost.py.

A body is a list of shapes: kind, sizes, place in space (4 x 4), colour. Each pixel has the nearest of them, so that no
part shows through another, as it would if shapes were painted one over the other by their distances.
"""

import numpy as np
from PIL import Image

WIDTH, VIEW, FINE = 800, 368, 2  # pixels of the view, and rays per pixel in each direction
LIGHT = np.array([0.25, -0.35, 1.0]) / np.linalg.norm([0.25, -0.35, 1.0])


class Camera:
    def __init__(self, eye, target, focal):
        self.eye, self.focal, self.centre = np.array(eye), focal * FINE, np.array([WIDTH, VIEW]) * FINE / 2
        forward = (target - self.eye) / np.linalg.norm(target - self.eye)
        right = np.cross(forward, [0, 0, 1]) / np.linalg.norm(np.cross(forward, [0, 0, 1]))
        self.axes = np.array([right, np.cross(forward, right), forward])
        y, x = (np.mgrid[: VIEW * FINE, : WIDTH * FINE] + 0.5 - self.centre[::-1, None, None]) / self.focal
        self.rays = np.stack([x, y, np.ones_like(x)], -1) @ self.axes  # of depth 1: their length is the depth

    def pixel(self, point):
        seen = self.axes @ (point - self.eye)
        return self.centre + self.focal * seen[:2] / seen[2]

    def window(self, centre, radius):
        """The part of the picture in which a ball can be seen: only there are rays followed."""
        (x, y), around = self.pixel(centre), 1.2 * self.focal * radius / (self.axes[2] @ (centre - self.eye) - radius) + 2
        span = lambda middle, most: slice(*(int(np.clip(middle + side * around, 0, most * FINE)) for side in (-1, 1)))
        return span(y, VIEW), span(x, WIDTH)


@np.errstate(all="ignore")  # a ray along a face or past a shape gives no number, which is no hit
def hit(kind, sizes, place, start, rays):
    """How far along each ray a shape is met (infinity if it is not), and its normals there."""
    o, d = np.broadcast_to((start - place[:3, 3]) @ place[:3, :3], rays.shape), rays @ place[:3, :3]
    if kind == "box":
        near, far = np.sort([(-np.array(sizes) - o) / d, (np.array(sizes) - o) / d], 0)
        t, normal = near.max(-1), np.where(near >= near.max(-1, keepdims=True), -np.sign(d), 0)
        good = (t < far.min(-1)) & (t > 0)
    else:
        (radius, half), n = sizes, 3 if kind == "sphere" else 2
        a, b, c = (d[..., :n] ** 2).sum(-1), (o[..., :n] * d[..., :n]).sum(-1), (o[..., :n] ** 2).sum(-1) - radius**2
        t = (-b - np.sqrt(b * b - a * c)) / a
        normal, good = (o + t[..., None] * d) / radius, t > 0
    if kind == "cylinder":
        good &= abs(normal[..., 2] * radius) <= half
        normal[..., 2] = 0
        cap = (-np.sign(d[..., 2]) * half - o[..., 2]) / d[..., 2]
        met = (((o + cap[..., None] * d)[..., :2] ** 2).sum(-1) <= radius**2) & (cap > 0)
        t, good = np.where(met, cap, t), good | met
        normal = np.where(met[..., None], -np.sign(d) * [0, 0, 1], normal)
    return np.where(good, t, np.inf), normal @ place[:3, :3].T


def layer(camera, bodies):
    """Depth, shaded colour, whether a body is seen, and whether it ends there: lines that keep shapes apart."""
    depth, colour = np.full(camera.rays.shape[:2], np.inf), np.ones(camera.rays.shape)
    seen, line = np.full(depth.shape, -1), np.zeros(depth.shape, bool)
    for number, body in enumerate(bodies):
        for kind, sizes, place, paint in body:
            part = camera.window(place[:3, 3], np.linalg.norm(sizes))
            t, normal = hit(kind, sizes, place, camera.eye, camera.rays[part])
            first = t < depth[part]
            depth[part][first], seen[part][first] = t[first], number
            colour[part][first] = ((0.62 + 0.38 * np.clip(normal @ LIGHT, -0.6, 1))[..., None] * paint)[first]
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        line |= (seen != np.roll(seen, step, axis)) & (depth <= np.roll(depth, step, axis)) & (seen >= 0)
    return depth, colour, seen >= 0, line


def ground(camera, bodies):
    """A grid of 100 mm that fades out, with the shadow of the bodies."""
    away = -camera.eye[2] / camera.rays[..., 2]
    point = camera.eye + away[..., None] * camera.rays
    fade = np.clip((1.15 - np.hypot(point[..., 0] - 0.3, point[..., 1])) / 0.5, 0, 1) * (away > 0)
    dark = 0.14 * (abs(point[..., :2] - np.round(point[..., :2], 1)) < np.maximum(0.0012 * away, 0.0015)[..., None]).any(-1)
    shadow = np.zeros(dark.shape, bool)
    for kind, sizes, place, _ in sum(bodies, []):
        part = camera.window(place[:3, 3] - LIGHT * place[2, 3] / LIGHT[2], 1.15 * np.linalg.norm(sizes))
        shadow[part] |= np.isfinite(hit(kind, sizes, place, point[part], np.broadcast_to(LIGHT, point[part].shape))[0])
    return 1 - (fade * (dark + 0.11 * shadow))[..., None]


def blend(camera, bodies, ghost):
    """The view of the bodies, with a ghost that they hide where they are in front of it."""
    depth, colour, seen, line = layer(camera, bodies)
    over, tint, shown, rim = layer(camera, ghost)
    picture = np.where(seen[..., None], colour, ground(camera, bodies)) * np.where(line, 0.55, 1)[..., None]
    # Where both arms are in one place, the physics is what is seen; the ghost comes out of it without a jump.
    before = np.where(shown, np.clip((np.minimum(depth, 99) - np.minimum(over, 99)) / 0.02, 0, 1), 0)
    picture += 0.42 * before[..., None] * (tint - picture)
    picture[rim & (before > 0.5)] = 0.8 * np.array(ghost[0][0][3]) + 0.1
    return Image.fromarray((255 * picture.reshape(VIEW, FINE, WIDTH, FINE, 3).mean((1, 3)).clip(0, 1)).astype(np.uint8))
