#!/usr/bin/env python3
"""The pixels that Camera_test.cpp expects: the formulas of CameraModel, with the parameters of support/SfmScene.hpp."""
from math import atan, atan2, hypot, pi, sqrt, tan

X, Y, Z = 0.6, -0.3, 0.9
x, y = X / Z, Y / Z
r2 = x * x + y * y
r = sqrt(r2)
theta = atan2(hypot(X, Y), Z)
a, b, s = theta * X / hypot(X, Y), theta * Y / hypot(X, Y), theta * theta


def tangential(u, v, p1, p2):
    q = u * u + v * v
    return 2 * p1 * u * v + p2 * (q + 2 * u * u), 2 * p2 * u * v + p1 * (q + 2 * v * v)


def pixel(name, fx, fy, cx, cy, u, v):
    print(f"  expectPixel(CameraModel::{name}, {fx * u + cx:.12g}, {fy * v + cy:.12g});")


g = 1 + 0.03 * s - 0.008 * s**2 + 0.002 * s**3 - 0.0004 * s**4
pixel("OpenCVFisheye", 420, 425, 503, 398, g * a, g * b)
g = (1 - 0.21 * r2 + 0.06 * r2**2 - 0.01 * r2**3) / (1 + 0.03 * r2 - 0.012 * r2**2 + 0.002 * r2**3)
t = tangential(x, y, 0.0004, -0.0003)
pixel("FullOpenCV", 700, 705, 502, 402, g * x + t[0], g * y + t[1])
g = atan(2 * r * tan(0.9 / 2)) / 0.9 / r
pixel("Fov", 600, 610, 505, 395, g * x, g * y)
pixel("SimpleRadialFisheye", 430, 430, 500, 400, (1 - 0.02 * s) * a, (1 - 0.02 * s) * b)
g = 1 + 0.02 * s - 0.004 * s**2
pixel("RadialFisheye", 440, 440, 498, 402, g * a, g * b)
g = 1 + 0.02 * s - 0.01 * s**2 + 0.002 * s**3 - 0.0003 * s**4
t = tangential(a, b, 0.001, -0.0008)
pixel("ThinPrismFisheye", 450, 455, 502, 401, g * a + t[0] + 0.0006 * s, g * b + t[1] - 0.0005 * s)
g = 1 + 0.03 * s - 0.01 * s**2 + 0.003 * s**3 - 0.0006 * s**4 + 1e-4 * s**5 - 1e-5 * s**6
c, d = g * a, g * b
q = c * c + d * d
t = tangential(c, d, -0.0005, 0.0007)
pixel("RadTanThinPrismFisheye", 400, 402, 501, 399, c + t[0] + 0.0008 * q - 1e-4 * q**2, d + t[1] - 0.0006 * q + 1e-4 * q**2)
g = 2 / (Z + sqrt(Z * Z + 4 * 0.2 * (X * X + Y * Y)))
pixel("SimpleDivision", 650, 650, 500, 400, g * X, g * Y)
g = 2 / (Z + sqrt(Z * Z - 4 * 0.05 * (X * X + Y * Y)))
pixel("Division", 660, 670, 505, 405, g * X, g * Y)
pixel("SimpleFisheye", 380, 380, 500, 400, a, b)
pixel("Fisheye", 390, 395, 505, 398, a, b)
g = 1 / (0.6 * sqrt(1.1 * (X * X + Y * Y) + Z * Z) + 0.4 * Z)
pixel("Eucm", 500, 505, 502, 398, g * X, g * Y)
pixel("Equirectangular", 1, 1, 0, 0, (atan2(X, Z) / (2 * pi) + 0.5) * 1000, (0.5 - atan2(-Y, hypot(X, Z)) / pi) * 800)
