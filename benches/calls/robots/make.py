"""Writes the robots beside this file, whose numbers are random but the same in every run:   python3 make.py

humanoid.toml has 29 joints on a fixed pelvis: two legs of 6, a waist of 3, two arms of 7. chain.toml has 60 joints in
a chain, with neighboring axes parallel or at right angles.
"""

import pathlib
import random

FOLDER = pathlib.Path(__file__).parent
HEAD = """# Written by make.py, numbers at random: {what}
format = 1

[robot]
name = "{name}"
gravity = [0, 0, -9.81]
"""
LINK = """
[[link]]
name = "{name}"
parent = "{parent}"
joint = {{ type = "revolute", axis = "{axis}" }}
origin = {{ xyz = {xyz}{rpy} }}
mass = {mass}
center_of_mass = {center}
inertia = {{ xx = {xx}, yy = {yy}, zz = {zz}, xy = {xy}, xz = {xz}, yz = {yz} }}
"""


class Robot:
    def __init__(self, name, what):
        self.numbers = random.Random(1)
        self.name = name
        self.text = HEAD.format(name=name, what=what)

    def number(self, low, high):
        return float(f"{self.numbers.uniform(low, high):.4g}")

    def link(self, name, parent, axis, xyz, rpy=""):
        principal = [self.number(0.008, 0.012) for _ in range(3)]
        mixed = [self.number(-0.001, 0.001) for _ in range(3)]
        self.text += LINK.format(
            name=name, parent=parent, axis=axis, xyz=xyz, rpy=rpy, mass=self.number(0.5, 3),
            center=[self.number(-0.05, 0.05) for _ in range(3)],
            **dict(zip(["xx", "yy", "zz", "xy", "xz", "yz"], principal + mixed)))
        return name

    def limb(self, name, parent, at, axes, lengths):
        for index, (axis, length) in enumerate(zip(axes, lengths, strict=True)):
            parent = self.link(f"{name}_{index + 1}", parent, axis, at)
            at = [0, 0, length]
        return parent

    def write(self):
        (FOLDER / f"{self.name}.toml").write_text(self.text)


humanoid = Robot("humanoid", "29 joints on a pelvis that is held")
for side, y in [("left", 0.1), ("right", -0.1)]:
    humanoid.limb(f"{side}_leg", "base", [0, y, -0.05], "zxyyyx", [0, 0, -0.4, -0.4, 0, -0.05])
chest = humanoid.limb("waist", "base", [0, 0, 0.1], "zxy", [0, 0, 0.3])
for side, y in [("left", 0.2), ("right", -0.2)]:
    humanoid.limb(f"{side}_arm", chest, [0, y, 0.3], "yxzyzyx", [0, 0, -0.3, -0.25, 0, 0, -0.1])
humanoid.write()

chain = Robot("chain", "a chain of 60 joints")
before = "base"
for joint in range(60):
    turn = chain.numbers.choice(["0", '"pi/2"', '"-pi/2"'])
    xyz = [chain.number(-0.2, 0.2) for _ in range(3)]
    before = chain.link(f"link_{joint + 1}", before, "z", xyz, f", rpy = [{turn}, 0, 0]")
chain.write()
