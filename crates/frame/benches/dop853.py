"""The wobbling frame of the bench by scipy's DOP853, timed beside it.

Run after the bench, which leaves frame, pair and its own displacement in target/tmp/frame_bench.json (`make bench`).
The method is what one would take off the shelf: p-form of Eq. 6.6 and 6.7, restarted at every sample, where the record
bends, relative tolerance 1e-10, the exact passage by the apex below 1e-8 rad, and the same rule of rest.
"""

import json
import math
import sys
import time
from pathlib import Path

from scipy.integrate import DOP853

TARGET = Path(__file__).parents[3] / "target"


def wobble(case):
    """Largest travel of the deck, m, under the pair of `case`; infinite where the frame overturns."""
    width, height, gravity = case["width_m"], case["height_m"], case["gravity_m_s2"]
    column, deck, stiffness = case["column_mass_kg"], case["deck_mass_kg"], case["stiffness_n_m"]
    b, h = width / 2, height / 2
    size, alpha, gamma = math.hypot(b, h), math.atan(b / h), deck / (case["columns"] * column)
    sa, ca = math.sin(alpha), math.cos(alpha)
    tilt = (48 * gamma + 15 + ca * ca) / 12
    e, diameter, axis = 1 + 4 * gamma, sa * sa / 4 + ca * ca / 3, sa * sa / 2
    kappa = math.sqrt((e * ca * ca + diameter) / tilt)
    load, held = (1 + 2 * gamma) / size, stiffness / (column * size**2)

    def turning(t):
        s, c = math.sin(t), math.cos(t)
        u, du = s * ca + (1 - c) * sa, c * ca + s * sa
        j = e * u * u + diameter * s * s + axis * (1 - c) ** 2
        return u, j, 2 * (e * u * du + diameter * s * c + axis * (1 - c) * s)

    def energy(y):
        t, _, w, p = y
        stretched = 2 * b * math.sin(t / 2)
        potential = load * gravity * (math.cos(alpha - t) - ca) + held * stretched**2 / 2
        return tilt * w * w / 2 + p * p / (2 * turning(t)[1]) + potential

    dt, ax, ay = case["dt_s"], case["x_m_s2"], case["y_m_s2"]
    threshold, rest = gravity * sa / ca, load * gravity * sa * 1e-5
    y, largest = None, 0.0
    for index in range(len(ax) - 1):
        x0, y0, dx, dy = ax[index], ay[index], (ax[index + 1] - ax[index]) / dt, (ay[index + 1] - ay[index]) / dt
        now = 0.0
        if y is None:
            quadratic = (dx * dx + dy * dy, 2 * (x0 * dx + y0 * dy), x0 * x0 + y0 * y0 - threshold**2)
            if math.hypot(ax[index + 1], ay[index + 1]) <= threshold and quadratic[2] <= 0:
                continue
            if quadratic[2] <= 0:
                root = math.sqrt(quadratic[1] ** 2 - 4 * quadratic[0] * quadratic[2])
                now = (root - quadratic[1]) / (2 * quadratic[0])
            y = [1e-9, math.atan2(-(y0 + dy * now), -(x0 + dx * now)), 0.0, 0.0]

        def slope(time_s, y):
            t, f, w, p = y
            gx, gy, s, c = x0 + dx * time_s, y0 + dy * time_s, math.sin(f), math.cos(f)
            u, j, dj = turning(t)
            force = load * (gravity * math.sin(alpha - t) + math.cos(alpha - t) * (gx * c + gy * s))
            spring = held * b * b * math.sin(t)
            return [w, p / j, (dj * p * p / (2 * j * j) - force - spring) / tilt, load * u * (gx * s - gy * c)]

        while now < dt * (1 - 1e-12):
            solver = DOP853(slope, now, y, dt, rtol=1e-10, atol=[1e-14, 1e-10, 1e-13, 1e-18])
            while solver.status == "running":
                solver.step()
                t, f, w, p = solver.y
                if not solver.status == "running" or (t < 1e-8 and w < 0):
                    break
                largest = max(largest, t)
                if t > math.pi / 2:
                    return math.inf
            now, y = solver.t, list(solver.y)
            if solver.status == "failed":
                raise SystemExit(f"DOP853 gave up at sample {index}")
            t, f, w, p = y
            if t < 1e-8 and w < 0:
                t = max(t, 1e-15)
                rate = p / ((tilt * kappa**2) * t * t)
                f += math.copysign(2 * math.atan2(-w, kappa * t * abs(rate)) / kappa, p)
                now += -2 * t * w / (w * w + (kappa * t * rate) ** 2)
                y = [t, f, -w, p]
        largest = max(largest, y[0])
        if energy(y) < rest and math.hypot(ax[index + 1], ay[index + 1]) <= threshold:
            y = None
    return 4 * size * math.sin(largest / 2) * math.cos(alpha - largest / 2)


def seconds_of_bench(title):
    """Mean time of the bench's own run, s."""
    for described in TARGET.glob("criterion/**/new/benchmark.json"):
        if json.loads(described.read_text())["function_id"] == title:
            return json.loads((described.parent / "estimates.json").read_text())["mean"]["point_estimate"] * 1e-9
    sys.exit("run the bench first: cargo bench -p uplift-frame --bench frame")


def main():
    case = json.loads((TARGET / "tmp/frame_bench.json").read_text())
    begin = time.perf_counter()
    travel = wobble(case)
    taken, own = time.perf_counter() - begin, seconds_of_bench(case["title"])
    print(f"DOP853  U {travel:.6f} m in {1e3 * taken:.0f} ms")
    print(f"uplift  U {case['displacement_m']:.6f} m in {1e3 * own:.2f} ms: {taken / own:.0f} times faster")


main()
