"""4 x 4 matrices as lists of rows, for column vectors; quaternions as (x, y, z, w)."""
import math

IDENTITY = [[1.0 if i == k else 0.0 for k in range(4)] for i in range(4)]


def multiply(*matrices):
    result = matrices[0]
    for m in matrices[1:]:
        result = [[sum(result[i][k] * m[k][j] for k in range(4)) for j in range(4)] for i in range(4)]
    return result


def translation(v):
    return [[1.0, 0.0, 0.0, v[0]], [0.0, 1.0, 0.0, v[1]], [0.0, 0.0, 1.0, v[2]], [0.0, 0.0, 0.0, 1.0]]


def scaling(v):
    return [[v[0], 0.0, 0.0, 0.0], [0.0, v[1], 0.0, 0.0], [0.0, 0.0, v[2], 0.0], [0.0, 0.0, 0.0, 1.0]]


def about(axis, degrees):
    """Right-handed rotation about axis 0, 1 or 2."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    m = [list(row) for row in IDENTITY]
    i, k = (axis + 1) % 3, (axis + 2) % 3
    m[i][i], m[i][k], m[k][i], m[k][k] = c, -s, s, c
    return m


def rotation(q):
    n = math.sqrt(sum(c * c for c in q))
    x, y, z, w = (c / n for c in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0.0],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0.0],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0.0],
            [0.0, 0.0, 0.0, 1.0]]


def transposed(m):
    return [[m[k][i] for k in range(4)] for i in range(4)]


def place(m):
    return [m[i][3] for i in range(3)]


def inverse_affine(m):
    a = [row[:3] for row in m[:3]]
    cof = [[a[(i + 1) % 3][(k + 1) % 3] * a[(i + 2) % 3][(k + 2) % 3] -
            a[(i + 1) % 3][(k + 2) % 3] * a[(i + 2) % 3][(k + 1) % 3] for k in range(3)] for i in range(3)]
    det = sum(a[0][k] * cof[0][k] for k in range(3))
    b = [[cof[k][i] / det for k in range(3)] for i in range(3)]
    at = [-sum(b[i][k] * m[k][3] for k in range(3)) for i in range(3)]
    return [b[i] + [at[i]] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
