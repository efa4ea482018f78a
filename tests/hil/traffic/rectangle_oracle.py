"""Distances of rectangles by other means than the bench: bounded least squares and convex hulls.

usage: rectangle_oracle.py FILE; each line: x y yaw length width of two rectangles, our gap, normal
and point.
Prints the numbers of separate and of overlapping pairs, and the largest differences of both.
"""
import sys

import numpy as np
from scipy.optimize import lsq_linear
from scipy.spatial import ConvexHull, Delaunay, HalfspaceIntersection


def half_sides(yaw, length, width):
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s], [s, c]]) @ np.diag([0.5 * length, 0.5 * width])


def corners(x, y, sides):
    return np.array([x, y]) + np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]]) @ sides.T


def centroid_of_overlap(hulls, inside):
    faces = np.vstack([hull.equations for hull in hulls])
    corners = HalfspaceIntersection(faces, inside).intersections
    pieces = corners[Delaunay(corners).simplices]
    areas = np.abs(np.linalg.det(pieces[:, 1:] - pieces[:, :1]))
    return (areas[:, None] * pieces.mean(axis=1)).sum(axis=0) / areas.sum()


counts, worst = [0, 0], [0.0, 0.0]
for row in np.loadtxt(sys.argv[1]):
    a, b, gap, normal, point = row[0:5], row[5:10], row[10], row[11:13], row[13:15]
    sides_a, sides_b = half_sides(*a[2:]), half_sides(*b[2:])
    # The hull of all differences (Minkowski): the origin lies inside where the rectangles overlap,
    # and the nearest face is the shortest way out.
    of_a, of_b = corners(*a[:2], sides_a), corners(*b[:2], sides_b)
    differences = (of_b[:, None] - of_a[None]).reshape(-1, 2)
    faces = ConvexHull(differences).equations[:, 2]
    overlap = int(faces.max() <= 0.0)
    if overlap:
        expected = faces.max()
        moved = differences - expected * 1.000001 * normal  # apart along our normal: no overlap
        centre = centroid_of_overlap([ConvexHull(of_a), ConvexHull(of_b)], point)
        error = max(abs(gap - expected), ConvexHull(moved).equations[:, 2].max() < 0.0,
                    np.linalg.norm(centre - point))
    else:
        nearest = lsq_linear(np.hstack([sides_a, -sides_b]), b[:2] - a[:2], (-1, 1), method="bvls")
        error = max(abs(gap - np.linalg.norm(nearest.fun)),
                    np.linalg.norm(-nearest.fun - gap * normal))
    counts[overlap] += 1
    worst[overlap] = max(worst[overlap], float(error))
print(*counts, *worst)
