"""Writes start.csv: 60 disks of two sizes, at random places in a box of 0.1 m x 0.15 m, none on another."""

import csv
import random

WIDTH, HEIGHT = 0.1, 0.15  # m
RADII = (0.003, 0.004)  # m
DENSITY = 6.4  # kg/m², mass over area

random.seed(1)
disks = []
while len(disks) < 60:
    radius = random.choice(RADII)
    x = random.uniform(radius, WIDTH - radius)
    y = random.uniform(radius, HEIGHT - radius)
    if all((x - d["x"]) ** 2 + (y - d["y"]) ** 2 > (radius + d["radius"]) ** 2 for d in disks):
        disks.append({"x": x, "y": y, "radius": radius, "vx": 0.0, "vy": 0.0, "mass": DENSITY * 3.141592653589793 * radius**2})

with open("start.csv", "w", encoding="utf-8", newline="") as file:
    table = csv.DictWriter(file, disks[0])
    table.writeheader()
    table.writerows(disks)
