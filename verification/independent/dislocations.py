"""Reference values of dislocation kernels from other programs: python dislocations.py FOLDER writes one table per kernel to FOLDER.

Needs numpy 2.4.6, cutde 26.3.6 and dislocs 0.1.3 from PyPI.
"""
import sys
import numpy as np
import dislocs
import cutde.fullspace as full
import cutde.halfspace as half

rng = np.random.default_rng(20)
U = rng.uniform
out = sys.argv[1]


def write(name, package, note, header, rows):
    with open(f"{out}/{name}.csv", "w") as f:
        f.write(f"# Package: {package}.\n# Command: python verification/independent/dislocations.py crates/cycles/tests/data (numpy 2.4.6, default_rng(20)).\n")
        f.write(f"# {note}\n")
        f.write(header + "\n")
        for row in rows:
            f.write(",".join(repr(float(v)) for v in row) + "\n")


ANSWER = "ux,uy,uz,exx,eyy,ezz,exy,eyz,exz"
ORDER = [0, 3, 5, 1, 4, 2]  # xx, yy, zz, xy, yz, xz of dislocs


def rectangle(top, length, width, strike, dip, slip, at, nu):
    m = np.array([[*top, length, width, strike, dip, *slip]])
    u, s, e, flag = dislocs.rde(np.array([at]), m, 1.0, nu)
    assert flag[0, 0] == 0 if flag.ndim == 2 else flag[0] == 0
    return [*u[0], *e[0][ORDER]]


def placed(top, width, strike, dip):
    phi, delta = np.radians(strike), np.radians(dip)
    along = np.array([np.sin(phi), np.cos(phi), 0.0])
    left = np.array([-along[1], along[0], 0.0])
    up = np.cos(delta) * left + np.sin(delta) * np.array([0, 0, 1.0])
    return along, up, np.cross(along, up)


rows = []
for i in range(36):
    length, width, strike = U(1, 6), U(1, 4), U(0, 360)
    dip = 90.0 if i % 6 == 0 else U(4, 86)
    top = [U(-2, 2), U(-2, 2), 0.0 if i % 5 == 1 else -U(0.1, 3)]
    slip, nu = U(-1, 1, 3), U(0.05, 0.45)
    at = [U(-6, 6), U(-6, 6), 0.0 if i % 4 == 3 else -U(0, 6)]
    along, up, n = placed(top, width, strike, dip)
    b = along * slip[0] + up * slip[1] + n * slip[2]
    centre = np.array(top) - up * width / 2
    answer = rectangle(top, length, width, strike, dip, slip, at, nu)
    rows.append([*centre, np.pi / 2 - np.radians(strike), np.radians(dip), length, width, *b, nu, *at, *answer])
write("rectangle_half", "dislocs 0.1.3 (PyPI), rde", "Half-space; lengths m, angles rad, strain -; slip is a vector.",
      "cx,cy,cz,strike,dip,length,width,bx,by,bz,nu,x,y,z," + ANSWER, rows)


def frame(v):
    n = np.cross(v[1] - v[0], v[2] - v[0])
    n /= np.linalg.norm(n)
    s = np.cross([0, 0, 1.0], n)
    s = s / np.linalg.norm(s) if np.linalg.norm(s) > 0 else np.array([0, n[2], 0])
    return s, np.cross(n, s), n


def triangle(module, v, slip, at, nu):
    p, t, s = np.array([at]), v[None], np.array([slip])
    e = module.strain(p, t, s, nu)[0]
    return [*module.disp(p, t, s, nu)[0], *e[[0, 1, 2, 3, 5, 4]]]


for name, module in (("half", half), ("whole", full)):
    rows = []
    for i in range(36):
        v = U(-3, 3, (3, 3))
        v[:, 2] = -U(0.1, 6, 3)
        if i % 6 == 1:  # A vertex on the surface.
            v[0, 2] = 0.0
        if i % 6 == 2:  # A side on the surface.
            v[0, 2] = v[1, 2] = 0.0
        if i % 6 == 3:  # Vertical.
            v[2, :2] = 0.3 * v[0, :2] + 0.7 * v[1, :2]
        if i % 6 == 4:  # Horizontal.
            v[:, 2] = v[0, 2]
        slip, nu = U(-1, 1, 3), U(0.05, 0.45)
        at = np.array([U(-6, 6), U(-6, 6), -U(0, 6)])
        if i % 4 == 3 and name == "half":
            at[2] = 0.0
        b = sum(a * s for a, s in zip(frame(v), slip))
        rows.append([*v.ravel(), *b, nu, *at, *triangle(module, v, slip, at, nu)])
    write(f"triangle_{name}", f"cutde 26.3.6 (PyPI), {name}space.disp and strain", f"{name.capitalize()}-space; lengths m, strain -; slip is a vector.",
          "x1,y1,z1,x2,y2,z2,x3,y3,z3,bx,by,bz,nu,x,y,z," + ANSWER, rows)

rows = []
for i in range(36):  # A rectangle in a whole-space is two triangles of cutde.
    length, width, strike = U(1, 6), U(1, 4), U(0, 360)
    dip = 90.0 if i % 6 == 0 else U(4, 86)
    centre, slip, nu, at = U(-3, 3, 3), U(-1, 1, 3), U(0.05, 0.45), U(-6, 6, 3)
    along, up, n = placed(None, width, strike, dip)
    b = along * slip[0] + up * slip[1] + n * slip[2]
    c = [centre + i * along * length / 2 + j * up * width / 2 for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    answer = np.zeros(9)
    for v in (np.array([c[0], c[1], c[2]]), np.array([c[0], c[2], c[3]])):
        answer += triangle(full, v, [b @ a for a in frame(v)], at, nu)
    rows.append([*centre, np.pi / 2 - np.radians(strike), np.radians(dip), length, width, *b, nu, *at, *answer])
write("rectangle_whole", "cutde 26.3.6 (PyPI), fullspace.disp and strain of two triangles",
      "Whole-space; lengths m, angles rad, strain -; slip is a vector.",
      "cx,cy,cz,strike,dip,length,width,bx,by,bz,nu,x,y,z," + ANSWER, rows)

rows = []
LONG = 1e4
for i in range(36):
    # A segment in plane strain is a very long rectangle. Its two halves have equal effects in the plane y = 0 where they meet, so
    # that one half suffices, for which rde loses no digits. Strike is along y, and the plane has the coordinates (-x, z).
    a = np.array([U(-3, 3), 0.0 if i % 5 == 1 else -U(0.1, 3)])
    dip, width = U(4, 86) if i % 6 else 90.0, U(1, 4)
    e = a - width * np.array([np.cos(np.radians(dip)), np.sin(np.radians(dip))])  # Down dip.
    slip, nu = U(-1, 1, 3), U(0.05, 0.45)  # Out of the plane, up dip, opening.
    at = [U(-6, 6), 0.0 if i % 4 == 3 else -U(0, 6)]

    def half_of(chosen, length):
        row = rectangle([-a[0], -length / 2, a[1]], length, width, 0.0, dip, chosen, [-at[0], 0.0, at[1]], nu)
        return 2 * np.array(row)

    def part(kinds):
        # Extrapolation to infinite length l: errors have terms in 1/l to 1/l^3 for displacement, 1/l^2 to 1/l^4 for strain.
        rows = np.array([half_of(slip * np.array(kinds), 2**k * LONG) for k in range(4)])
        limit = lambda powers: np.linalg.solve([[0.5 ** (k * p) for k in range(4)] for p in powers], [1, 0, 0, 0]) @ rows
        return np.concatenate([limit([0, 1, 2, 3])[:3], limit([0, 2, 3, 4])[3:]])

    edge, screw = part([0, 1, 1]), part([1, 0, 0])
    tr = 2 * nu / (1 - 2 * nu) * (edge[3] + edge[5])
    rows.append([*e, *a, slip[1], slip[0], slip[2], nu, *at, -edge[0], edge[2], tr + 2 * edge[3], tr + 2 * edge[5],
                 -2 * edge[8], screw[1], -2 * screw[6], 2 * screw[7]])
write("segment_half", "dislocs 0.1.3 (PyPI), rde of lengths from 2e4 to 16e4 m, extrapolated",
      "Half-space in the plane, shear modulus 1 Pa; slip up dip, along y, and opening of the upper side less the lower side.",
      "x1,z1,x2,z2,up,screw,opening,nu,x,z,ux,uz,sxx,szz,sxz,uy,sxy,syz", rows)
